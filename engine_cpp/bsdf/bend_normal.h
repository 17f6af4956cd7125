// SPDX-License-Identifier: GPL-3.0-or-later
// The shading normal of specular lobes, raised so that the mirror direction stays above the surface.
#pragma once

#include "simd/vec.h"

namespace cardioid::CD_ISA_NS {

/// n where the reflection of wo about n clears the surface (ng) by min(0.01, 0.9·cos); elsewhere n is turned toward
/// ng, in their plane, until it just does. All unit; ng on wo's side. Cycles' rule, so that bump-mapped mirrors look
/// the same.
inline Vec3 bend_normal(Vec3 ng, Vec3 wo, Vec3 n) {
    const Float oz = dot(ng, wo);
    const Float least = min(0.9f * oz, 0.01f);
    const Vec3 reflected = n * (2.0f * dot(n, wo)) - wo;
    const Mask keep = dot(ng, reflected) >= least;
    if (all(keep)) return n;
    // With ng as z and n in the xz plane: 2(x·ox + z·oz)z - oz = least, x = sqrt(1 - z²), is quadratic in z².
    const Vec3 aside = n - ng * dot(n, ng);
    const Vec3 x_axis = select(length_squared(aside) > Float(1e-14f), normalize(aside), n);
    const Float ox = dot(wo, x_axis);
    const Float a = ox * ox + oz * oz, b = 2.0f * (a + oz * least), c = (least + oz) * (least + oz);
    const Float root = safe_sqrt(b * b - 4.0f * a * c);
    // The root for which ox and least + oz(1 - 2z²) have the same sign solves the equation before squaring.
    const Float z2 = 0.25f * (b + select(ox < Float(0.0f), root, -root)) / max(a, 1e-20f);
    const Vec3 bent = x_axis * safe_sqrt(1.0f - z2) + ng * safe_sqrt(z2);
    return select(keep, n, bent);
}

}  // namespace cardioid::CD_ISA_NS
