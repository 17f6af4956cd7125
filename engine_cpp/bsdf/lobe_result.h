// SPDX-License-Identifier: GPL-3.0-or-later
// What evaluating and sampling a lobe return. Conventions: bsdf/kernels.h.
#pragma once

#include "simd/vec.h"

namespace cardioid::CD_ISA_NS {

struct LobeEval {
    Spectrum f_cos;
    Float pdf;
};

struct LobeSample {
    Vec3 wi;
    Spectrum f_cos;  ///< weight·f·|cos|; for delta lanes: weight·f such that throughput *= f_cos/pdf
    Float pdf;       ///< solid angle; for delta lanes the discrete probability
    Mask valid, delta, transmitted;
    Float eta;  ///< 1 for reflection; the relative index passed through for refraction
};

inline LobeSample no_sample(Vec3 direction) {
    const Mask no = mask_of(false);
    return {direction, Spectrum(0.0f), Float(0.0f), no, no, no, Float(1.0f)};
}

}  // namespace cardioid::CD_ISA_NS
