// SPDX-License-Identifier: GPL-3.0-or-later
// Principled Hair's models, each in a file of its own; hair.cpp picks. f_cos without the lobe's weight.
#pragma once

#include "bsdf/fresnel.h"
#include "bsdf/lobe_result.h"

namespace cardioid::CD_ISA_NS {

LobeEval eval_chiang(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi);
/// A direction; its value and density are those of eval_chiang.
Vec3 sample_chiang(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 u);
Spectrum chiang_albedo(const bsdf::Lobe& lobe, int i, Vec3 wo);

inline Float cos_of_sin(Float s) { return safe_sqrt(1.0f - s * s); }
inline Spectrum exp_of(Spectrum x) { return {exp(x.r), exp(x.g), exp(x.b)}; }

/// Scale between colour and absorption of Principled Hair (Chiang et al. 2016), by azimuthal roughness.
inline Float hair_albedo_scale(Float x) {
    return ((((0.245f * x + 5.574f) * x - 10.73f) * x + 2.532f) * x - 0.215f) * x + 5.969f;
}

}  // namespace cardioid::CD_ISA_NS
