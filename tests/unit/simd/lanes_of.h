// SPDX-License-Identifier: GPL-3.0-or-later
// Lanes from and to plain numbers.
#pragma once

#include "simd/vec.h"

#include <cstdint>

namespace cardioid::simd_tests {

using namespace CD_ISA_NS;  // NOLINT(google-build-using-namespace): the width under test

/// Lane i holds f(i).
template <class F>
Float float_lanes_of(F f) {
    Float r = 0.0f;
    for (int i = 0; i < W; ++i) r.v[i] = f(i);
    return r;
}

template <class F>
Int int_lanes_of(F f) {
    Int r = 0;
    for (int i = 0; i < W; ++i) r.v[i] = static_cast<std::int32_t>(f(i));
    return r;
}

inline bool lane_of(Mask m, int i) { return (bits(m) >> i & 1u) != 0; }

}  // namespace cardioid::simd_tests
