// SPDX-License-Identifier: GPL-3.0-or-later
// Uniform directions in cones, and the lamps that are seen as cones: spheres, disks that face the receiver, suns.
#pragma once

#include "light/kernels.h"

namespace cardioid::CD_ISA_NS {

/// 1 - cos of the angle with this sine², without cancellation.
inline Float one_minus_cos_of_sin2(Float sin2) { return sin2 / (1.0f + safe_sqrt(1.0f - sin2)); }

inline Float cone_pdf(Float one_minus_cos) { return (1.0f / k_two_pi) / one_minus_cos; }

/// A direction in local coordinates around z; `rise` is 1 - z, exact for narrow cones.
struct ConeDirection {
    Vec3 local;
    Float rise, sin2;
};
inline ConeDirection sample_cone(Float one_minus_cos, Float u, Float v) {
    ConeDirection out;
    out.rise = u * one_minus_cos;
    out.sin2 = out.rise * (2.0f - out.rise);
    const Float sine = safe_sqrt(out.sin2);
    Float s, c;
    sincos(k_two_pi * v, s, c);
    out.local = {sine * c, sine * s, 1.0f - out.rise};
    return out;
}

inline Vec3 sample_sphere(Float u, Float v) {
    const Float z = 1.0f - 2.0f * u;
    const Float r = safe_sqrt(1.0f - z * z);
    Float s, c;
    sincos(k_two_pi * v, s, c);
    return {r * c, r * s, z};
}

inline constexpr float k_inv_four_pi = 0.25f * k_inv_pi;

/// Where light comes from all around: cosine around n, or uniform where the receiver has no side.
struct AllAround {
    Vec3 wi;
    Float pdf;
};
inline Mask has_side(LightReceiver at) { return length_squared(at.n) > Float(0.25f); }
inline Float pdf_all_around(LightReceiver at, Vec3 d) {
    return select(has_side(at), max(dot(at.n, d), 0.0f) * k_inv_pi, Float(k_inv_four_pi));
}
inline AllAround sample_all_around(LightReceiver at, Float u, Float v) {
    const Mask sided = has_side(at);
    const Frame frame(select(sided, at.n, Vec3{0.0f, 0.0f, 1.0f}));
    Float s, c;
    sincos(k_two_pi * v, s, c);
    const Float r = sqrt(u);
    const Vec3 cosine = frame.to_world({r * c, r * s, safe_sqrt(1.0f - u)});
    AllAround out;
    out.wi = select(sided, cosine, sample_sphere(u, v));
    out.pdf = pdf_all_around(at, out.wi);
    return out;
}

}  // namespace cardioid::CD_ISA_NS
