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

/// Translucent, Burley diffuse, velvet, both sheens and toon.
LobeEval eval_broad(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi, Vec3 ng);
LobeSample sample_broad(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 ng, Vec3 u, Mask active);

/// The hair kinds: over the whole sphere, whatever the sides of the surface. Directions inside the strand (under its normal)
/// count as transmitted.
LobeEval eval_hair(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi);
LobeSample sample_hair(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 ng, Vec3 u, Mask active);
/// Albedo by the lobe's own formula, weight not included.
Spectrum hair_albedo(const bsdf::Lobe& lobe, int i, Vec3 wo);

/// Multiple-scattering compensation of a GGX lobe with preserve_energy: the factor of weight.
Spectrum energy_compensation(const bsdf::Lobe& lobe, int i, Vec3 wo);

}  // namespace cardioid::CD_ISA_NS
