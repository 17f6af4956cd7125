// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluate and sample one lobe over W lanes, lanes [i, i+W) of a chunk. Conventions:
// - wo and wi are unit vectors that point away from the surface; ng is the geometric normal on wo's side.
// - eval returns weight·f·|cos(normal, wi)| and the density of sample() in solid angle; both are 0 for delta lanes,
//   and where wi is on the wrong side of ng for the lobe (light leaks).
// - pdf and value are of this lobe alone; the caller mixes lobes.
// - non-adjoint (camera side, Cycles' convention: radiance is not scaled by eta²).
#pragma once

#include "bsdf/lobe.h"
#include "simd/vec.h"

namespace cardioid::CD_ISA_NS {

struct LobeEval {
    Spectrum f_cos;
    Float pdf;
};

struct LobeSample {
    Vec3 wi;
    Spectrum f_cos;     ///< weight·f·|cos|; for delta lanes: weight·f such that throughput *= f_cos/pdf
    Float pdf;          ///< solid angle; for delta lanes the discrete probability
    Mask valid, delta, transmitted;
    Float eta;          ///< 1 for reflection; the relative index passed through for refraction
};

LobeEval eval_lobe(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi, Vec3 ng);

/// u: three uniform numbers in [0,1) per lane (u.z picks reflection or refraction). Inactive lanes give valid = false.
LobeSample sample_lobe(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 ng, Vec3 u, Mask active);

/// Directional albedo (weight included), approximate: it chooses between lobes and scales layers.
Spectrum lobe_albedo(const bsdf::Lobe& lobe, int i, Vec3 wo);

/// Lanes whose alpha makes the lobe a delta.
Mask is_delta(const bsdf::Lobe& lobe, int i);

/// Class S (spec 1): deltas, and lobes whose Blender roughness (larger axis) is at or under `caustic_roughness`.
/// Depends on the lobe alone.
Mask is_specular(const bsdf::Lobe& lobe, int i, float caustic_roughness);

}  // namespace cardioid::CD_ISA_NS
