// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simd/vec.h"

namespace cardioid::CD_ISA_NS {

/// Turns the shading normal toward the geometric one ng just as far as it takes for the mirror direction of wo to rise
/// above the surface; most lanes need nothing. All unit, ng on wo's side.
inline Vec3 bend_normal(Vec3 ng, Vec3 wo, Vec3 n) {
    const Float iz = dot(wo, ng);
    const Float threshold = min(0.9f * iz, 0.01f);
    const Mask fine = (2.0f * dot(n, wo) * dot(n, ng) - iz) >= threshold;
    if (all(fine)) return n;
    // In the plane of ng and n: n' = (x, z) with 2(n'·wo)·z - iz = threshold, a quadratic in z².
    const Vec3 side = n - ng * dot(n, ng);
    const Vec3 x = select(length_squared(side) > Float(0.0f), normalize(side), n);
    const Float ix = dot(wo, x);
    const Float a = max(ix * ix + iz * iz, 1e-20f);
    const Float b = 2.0f * (a + iz * threshold);
    const Float c = (threshold + iz) * (threshold + iz);
    const Float root = safe_sqrt(b * b - 4.0f * a * c);
    const Float z2 = 0.25f * select(ix < Float(0.0f), b + root, b - root) / a;
    return select(fine, n, x * safe_sqrt(1.0f - z2) + ng * safe_sqrt(z2));
}

}  // namespace cardioid::CD_ISA_NS
