// SPDX-License-Identifier: GPL-3.0-or-later
// Phase functions over lanes, normalised over the sphere of directions (1/sr). `parameter`: see phase_kind.h; values out of
// range are clamped as in Cycles (|g| to 0.999).
#pragma once

#include "bsdf/phase_kind.h"
#include "simd/vec.h"

namespace cardioid::CD_ISA_NS {

/// `cosine`: between the direction of travel (-wo) and wi; 1 is straight on.
Float eval_phase(bsdf::PhaseKind kind, Vec3 parameter, Float cosine);

struct PhaseSample {
    Vec3 wi;
    Float value;  ///< eval_phase; also the density of wi in solid angle, since sampling is exact
};

/// wo: unit, back to where the ray came from; u0, u1 in [0, 1).
PhaseSample sample_phase(bsdf::PhaseKind kind, Vec3 parameter, Vec3 wo, Float u0, Float u1);

/// Mean cosine; fournier_forand, which has no closed form, gives 1 (as Cycles does where it needs one number).
Float mean_cosine(bsdf::PhaseKind kind, Vec3 parameter);

}  // namespace cardioid::CD_ISA_NS
