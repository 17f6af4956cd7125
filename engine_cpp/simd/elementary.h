// SPDX-License-Identifier: GPL-3.0-or-later
// exp, log, pow, sin, cos, atan2, acos … over lanes: polynomials after Cephes (S. Moshier), relative error about 2e-7
// inside the stated ranges. The tests compare them with <cmath> at every width.
#pragma once

#include "simd/lanes.h"

namespace cardioid::CD_ISA_NS {

inline constexpr float k_pi = 3.14159265358979323846f;
inline constexpr float k_inv_pi = 0.31830988618379067154f;
inline constexpr float k_two_pi = 6.28318530717958647692f;

/// 2^x for x in [-126, 127]; clamped outside.
inline Float exp2(Float x) {
    x = clamp(x, -126.0f, 127.0f);
    const Float whole = floor(x + 0.5f);
    const Float f = x - whole;
    Float p = 1.535336188319500e-4f;
    p = fma(p, f, 1.339887440266574e-3f);
    p = fma(p, f, 9.618437357674640e-3f);
    p = fma(p, f, 5.550332471162809e-2f);
    p = fma(p, f, 2.402264791363012e-1f);
    p = fma(p, f, 6.931472028550421e-1f);
    p = fma(p, f, 1.0f);
    return p * float_of_bits((to_int(whole) + Int(127)) << 23);
}

/// log2(x) for normal x > 0; x <= 0 gives about -126.
inline Float log2(Float x) {
    x = max(x, 1.17549435e-38f);
    const Int ix = bits_of(x);
    Int e = (ix >> 23) - Int(126);
    Float m = float_of_bits((ix & Int(0x007fffff)) | Int(0x3f000000));
    const Mask low = m < Float(0.70710678118f);
    e = select(low, e - Int(1), e);
    m = select(low, m + m, m) - 1.0f;
    const Float z = m * m;
    Float p = 7.0376836292e-2f;
    p = fma(p, m, -1.1514610310e-1f);
    p = fma(p, m, 1.1676998740e-1f);
    p = fma(p, m, -1.2420140846e-1f);
    p = fma(p, m, 1.4249322787e-1f);
    p = fma(p, m, -1.6668057665e-1f);
    p = fma(p, m, 2.0000714765e-1f);
    p = fma(p, m, -2.4999993993e-1f);
    p = fma(p, m, 3.3333331174e-1f);
    const Float y = m * z * p - 0.5f * z;
    return fma(m + y, 1.44269504088896341f, to_float(e));
}

inline Float exp(Float x) { return exp2(x * 1.44269504088896341f); }
inline Float log(Float x) { return log2(x) * 0.69314718055994531f; }
/// x^y for x >= 0; 0^0 = 1 and 0^y = 0.
inline Float pow(Float x, Float y) {
    const Float r = exp2(y * log2(x));
    return select(x <= Float(0.0f), select(y == Float(0.0f), Float(1.0f), Float(0.0f)), r);
}

/// sin and cos together; |x| up to about 8192.
inline void sincos(Float x, Float& s, Float& c) {
    const Float q = floor(fma(x, 0.63661977236758134f, 0.5f));
    const Int n = to_int(q);
    Float r = fma(q, -1.5703125f, x);
    r = fma(q, -4.837512969970703125e-4f, r);
    r = fma(q, -7.54978995489188216e-8f, r);
    const Float z = r * r;
    Float sp = -1.9515295891e-4f;
    sp = fma(sp, z, 8.3321608736e-3f);
    sp = fma(sp, z, -1.6666654611e-1f);
    sp = fma(sp * z, r, r);
    Float cp = 2.443315711809948e-5f;
    cp = fma(cp, z, -1.388731625493765e-3f);
    cp = fma(cp, z, 4.166664568298827e-2f);
    cp = fma(cp * z, z, fma(z, -0.5f, 1.0f));
    const Mask swap = (n & Int(1)) != Int(0);
    const Float ss = select(swap, cp, sp);
    const Float cc = select(swap, sp, cp);
    s = float_of_bits(bits_of(ss) ^ ((n & Int(2)) << 30));
    c = float_of_bits(bits_of(cc) ^ (((n + Int(1)) & Int(2)) << 30));
}
inline Float sin(Float x) {
    Float s, c;
    sincos(x, s, c);
    return s;
}
inline Float cos(Float x) {
    Float s, c;
    sincos(x, s, c);
    return c;
}
inline Float tan(Float x) {
    Float s, c;
    sincos(x, s, c);
    return s / c;
}

inline Float atan(Float x) {
    const Float a = abs(x);
    const Mask big = a > Float(2.414213562373095f);
    const Mask mid = (a > Float(0.4142135623730950f)) & ~big;
    const Float t = select(big, -1.0f / max(a, 1e-30f), select(mid, (a - 1.0f) / (a + 1.0f), a));
    const Float base = select(big, Float(1.5707963267948966f), select(mid, Float(0.7853981633974483f), Float(0.0f)));
    const Float z = t * t;
    Float p = 8.05374449538e-2f;
    p = fma(p, z, -1.38776856032e-1f);
    p = fma(p, z, 1.99777106478e-1f);
    p = fma(p, z, -3.33329491539e-1f);
    return copysign(base + fma(p * z, t, t), x);
}
/// atan2(0, 0) = 0.
inline Float atan2(Float y, Float x) {
    const Float ax = abs(x), ay = abs(y);
    const Mask steep = ay > ax;
    const Float num = select(steep, ax, ay), den = select(steep, ay, ax);
    Float r = atan(num / max(den, 1e-38f));
    r = select(steep, Float(1.5707963267948966f) - r, r);
    r = select(x < Float(0.0f), Float(k_pi) - r, r);
    return copysign(r, y);
}
/// acos for x in [-1, 1]; clamped outside.
inline Float acos(Float x) {
    x = clamp(x, -1.0f, 1.0f);
    return 2.0f * atan2(sqrt(1.0f - x), sqrt(1.0f + x));
}
inline Float asin(Float x) { return Float(1.5707963267948966f) - acos(x); }

}  // namespace cardioid::CD_ISA_NS
