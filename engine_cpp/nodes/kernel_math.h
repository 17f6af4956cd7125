// SPDX-License-Identifier: GPL-3.0-or-later
// Arithmetic with Blender's answers for the awkward cases: division by zero, powers of negative numbers.
#pragma once

#include "simd/vec.h"

namespace cardioid::CD_ISA_NS {

inline constexpr float k_infinity = __builtin_inff();

/// 0 where the divisor is 0.
inline Float safe_divide(Float a, Float b) { return select(b != Float(0.0f), a / b, Float(0.0f)); }
inline Float truncate(Float a) { return copysign(floor(abs(a)), a); }
inline Float fraction(Float a) { return a - floor(a); }
inline Float mix(Float a, Float b, Float t) { return a + t * (b - a); }

/// fmod; 0 where b is 0.
inline Float safe_modulo(Float a, Float b) {
    const Float x = abs(a), y = abs(b);
    Float r = x - y * floor(x / y);
    // The quotient is rounded, so the whole part may be one off.
    r = select(r < Float(0.0f), r + y, r);
    r = select(r >= y, r - y, r);
    return select(b != Float(0.0f), copysign(r, a), Float(0.0f));
}

/// a^b; a negative base needs an integer exponent, else 0.
inline Float safe_power(Float a, Float b) {
    Float r = pow(abs(a), b);
    const Mask zero = a == Float(0.0f);
    r = select(zero, select(b < Float(0.0f), Float(k_infinity), select(b > Float(0.0f), Float(0.0f), Float(1.0f))), r);
    const Mask whole = b == floor(b);
    const Float half = b * 0.5f;
    const Float negative = select(whole, select(half == floor(half), r, -r), Float(0.0f));
    return select(a < Float(0.0f), negative, r);
}

}  // namespace cardioid::CD_ISA_NS
