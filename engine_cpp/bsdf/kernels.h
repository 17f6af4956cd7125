// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluate and sample one lobe over W lanes, lanes [i, i+W) of a chunk. Conventions:
// - wo and wi are unit vectors that point away from the surface; ng is the geometric normal on wo's side.
// - eval returns weight·f·|cos(normal, wi)| and the density of sample() in solid angle; both are 0 for delta lanes,
//   and where wi is on the wrong side of ng for the lobe (light leaks).
// - pdf and value are of this lobe alone; the caller mixes lobes.
// - non-adjoint (camera side, Cycles' convention: radiance is not scaled by eta²).
#pragma once

#include "bsdf/diffuse.h"
#include "bsdf/families.h"

namespace cardioid::CD_ISA_NS {

inline LobeEval eval_lobe(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi, Vec3 ng) {
    using bsdf::LobeKind;
    switch (lobe.kind) {
        case LobeKind::diffuse: return eval_diffuse(lobe, i, wo, wi, ng);
        case LobeKind::ggx_reflection: return eval_ggx_reflection(lobe, i, wo, wi, ng);
        case LobeKind::ggx_refraction:
        case LobeKind::ggx_glass: return eval_ggx_interface(lobe, i, wo, wi, ng);
        case LobeKind::subsurface: return {Spectrum(0.0f), Float(0.0f)};
        case LobeKind::hair_reflection:
        case LobeKind::hair_transmission:
        case LobeKind::hair_chiang:
        case LobeKind::hair_huang: return eval_hair(lobe, i, wo, wi);
        default: return eval_broad(lobe, i, wo, wi, ng);
    }
}

/// u: three uniform numbers in [0,1) per lane (u.z picks reflection or refraction). Inactive lanes give valid = false.
inline LobeSample sample_lobe(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 ng, Vec3 u, Mask active) {
    using bsdf::LobeKind;
    switch (lobe.kind) {
        case LobeKind::diffuse: return sample_diffuse(lobe, i, wo, ng, u, active);
        case LobeKind::ggx_reflection: return sample_ggx_reflection(lobe, i, wo, ng, u, active);
        case LobeKind::ggx_refraction:
        case LobeKind::ggx_glass: return sample_ggx_interface(lobe, i, wo, ng, u, active);
        case LobeKind::subsurface: return no_sample(ng);
        case LobeKind::hair_reflection:
        case LobeKind::hair_transmission:
        case LobeKind::hair_chiang:
        case LobeKind::hair_huang: return sample_hair(lobe, i, wo, ng, u, active);
        default: return sample_broad(lobe, i, wo, ng, u, active);
    }
}

/// Directional albedo (weight included), approximate: it chooses between lobes and scales layers.
Spectrum lobe_albedo(const bsdf::Lobe& lobe, int i, Vec3 wo);

/// Lanes that are a perfect mirror or window.
Mask is_delta(const bsdf::Lobe& lobe, int i);

/// Class S (spec 1): deltas, and lobes whose Blender roughness (larger axis) is at or under `caustic_roughness`.
/// Depends on the lobe alone.
Mask is_specular(const bsdf::Lobe& lobe, int i, float caustic_roughness);

}  // namespace cardioid::CD_ISA_NS
