// SPDX-License-Identifier: GPL-3.0-or-later
// Visible normals of Beckmann's distribution (Heitz & d'Eon 2014): the slope along wo from its inverted distribution, by
// Newton's steps inside a bracket (Jakob 2014), the other from a Gaussian.
#include "bsdf/ggx.h"

namespace cardioid::CD_ISA_NS {

namespace {

/// Giles 2010, relative error 4e-6 in (-1, 1).
Float inverse_erf(Float x) {
    x = clamp(x, -0.9999999f, 0.9999999f);
    const Float w = -log((1.0f - x) * (1.0f + x));
    const Float a = w - 2.5f, b = sqrt(max(w, 5.0f)) - 3.0f;
    Float p = fma(a, 2.81022636e-08f, 3.43273939e-07f);
    p = fma(p, a, -3.5233877e-06f);
    p = fma(p, a, -4.39150654e-06f);
    p = fma(p, a, 0.00021858087f);
    p = fma(p, a, -0.00125372503f);
    p = fma(p, a, -0.00417768164f);
    p = fma(p, a, 0.246640727f);
    p = fma(p, a, 1.50140941f);
    Float q = fma(b, -0.000200214257f, 0.000100950558f);
    q = fma(q, b, 0.00134934322f);
    q = fma(q, b, -0.00367342844f);
    q = fma(q, b, 0.00573950773f);
    q = fma(q, b, -0.0076224613f);
    q = fma(q, b, 0.00943887047f);
    q = fma(q, b, 1.00167406f);
    q = fma(q, b, 2.83297682f);
    return x * select(w < Float(5.0f), p, q);
}

}  // namespace

Vec3 Facets::sample_beckmann(Vec3 v, Float u0, Float u1) const {
    constexpr float k_inv_sqrt_pi = 0.56418958354f;
    const Float cosine = max(v.z, 1e-4f), sine = sqrt(sqr(v.x) + sqr(v.y));
    const Float tangent = sine / cosine, cotangent = cosine / max(sine, 1e-6f);
    const Float edge = 1.0f - erfc_positive(cotangent), k = tangent * k_inv_sqrt_pi;
    const Float goal = u0 * (1.0f + edge + k * exp(-cotangent * cotangent));
    // 1 + b + k·exp(-erf⁻¹(b)²) rises from 0 at b = -1 to its maximum at b = edge.
    Float low = -1.0f, high = edge, b = 0.5f * (edge - 1.0f), slope = 0.0f;
    for (int step = 0; step < 24; ++step) {
        slope = inverse_erf(b);
        const Float f = 1.0f + b + k * exp(-slope * slope) - goal;
        const Mask over = f > Float(0.0f);
        high = select(over, b, high);
        low = select(over, low, b);
        const Float next = b - f / max(1.0f - slope * tangent, 1e-6f);
        const Mask inside = (next > low) & (next < high);
        const Float y = select(inside, next, 0.5f * (low + high));
        const Mask done = abs(y - b) < Float(2e-7f);
        b = y;
        if (all(done)) break;
    }
    slope = inverse_erf(b);
    const Float across = inverse_erf(2.0f * u1 - 1.0f);
    const Mask tilted = sine > Float(1e-6f);
    const Float c = select(tilted, v.x / max(sine, 1e-6f), Float(1.0f)),
                s = select(tilted, v.y / max(sine, 1e-6f), Float(0.0f));
    return normalize(Vec3{-ax * (c * slope - s * across), -ay * (s * slope + c * across), Float(1.0f)});
}

}  // namespace cardioid::CD_ISA_NS
