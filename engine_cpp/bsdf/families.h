// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluation and sampling per family of lobe kinds; kernels.h picks the family. Contracts as there.
#pragma once

#include "bsdf/lobe.h"
#include "bsdf/lobe_result.h"

namespace cardioid::CD_ISA_NS {

LobeEval eval_ggx_reflection(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi, Vec3 ng);
LobeSample sample_ggx_reflection(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 ng, Vec3 u, Mask active);

/// Refraction and glass.
LobeEval eval_ggx_interface(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi, Vec3 ng);
LobeSample sample_ggx_interface(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 ng, Vec3 u, Mask active);

/// Translucent, Burley diffuse, velvet and both sheens: sampled over a whole hemisphere.
LobeEval eval_broad(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi, Vec3 ng);
LobeSample sample_broad(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 ng, Vec3 u, Mask active);

/// Multiple-scattering compensation of a GGX lobe with preserve_energy: the factor of weight.
Spectrum energy_compensation(const bsdf::Lobe& lobe, int i, Vec3 wo);

}  // namespace cardioid::CD_ISA_NS
