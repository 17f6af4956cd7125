// SPDX-License-Identifier: GPL-3.0-or-later
// Reflection by facets whose normals are sampled as they lie, visible or not: Ashikhmin & Shirley 2000 (with the masking-free
// "pump" of that paper, as Cycles has it) and GTR1 (Burley 2012) with the masking of GGX of alpha 0.25.
#include "bsdf/ggx.h"

namespace cardioid::CD_ISA_NS {

namespace {

Float exponent_of(Float alpha) { return 2.0f / sqr(min(alpha, 1.0f)) - 2.0f; }

/// log(1 - x) without loss for small x.
Float log_one_minus(Float x) {
    const Float series = -x * (1.0f + x * (0.5f + x * (1.0f / 3.0f + x * 0.25f)));
    return select(x < Float(0.02f), series, log(max(1.0f - x, 1e-30f)));
}
/// 1 - exp(x) for x ≤ 0, without loss for small x.
Float one_minus_exp(Float x) {
    const Float series = -x * (1.0f + x * (0.5f + x * (1.0f / 6.0f + x * (1.0f / 24.0f))));
    return select(x > Float(-0.02f), series, 1.0f - exp(x));
}

FacetTerms ashikhmin_terms(const GgxPoint& p, Vec3 in, Vec3 h) {
    const Float nx = exponent_of(p.facets.ax), ny = exponent_of(p.facets.ay);
    const Float sin2 = max(sqr(h.x) + sqr(h.y), 1e-30f);
    const Float e = (nx * sqr(h.x) + ny * sqr(h.y)) / sin2;
    const Float lobe = exp(0.5f * e * log_one_minus(min(sin2, 1.0f)));
    const Float norm = sqrt((nx + 1.0f) * (ny + 1.0f)) * (0.125f * k_inv_pi);
    const Float oh = max(abs(dot(p.o, h)), 1e-6f);
    const Float pdf = norm * lobe / oh;
    return {pdf * in.z / max(max(p.o.z, in.z), 1e-6f), pdf};
}

constexpr float k_coat_alpha2 = 0.0625f;
Float coat_masking(Float z) { return 2.0f / (1.0f + sqrt(1.0f + k_coat_alpha2 * max(1.0f / sqr(z) - 1.0f, 0.0f))); }
Float gtr1_alpha2(const GgxPoint& p) { return sqr(min(p.facets.ax, 0.9999f)); }

FacetTerms gtr1_terms(const GgxPoint& p, Vec3 in, Vec3 h) {
    const Float a2 = gtr1_alpha2(p);
    const Float t = sqr(h.x) + sqr(h.y) + a2 * sqr(h.z);
    const Float d = (a2 - 1.0f) * k_inv_pi / (log(a2) * t);
    const Float o = max(p.o.z, 1e-6f);
    return {0.25f * d * coat_masking(o) * coat_masking(max(in.z, 1e-6f)) / o,
            0.25f * d * h.z / max(dot(p.o, h), 1e-6f)};
}

}  // namespace

FacetTerms plain_facet_terms(const GgxPoint& p, Vec3 in, Vec3 h) {
    return p.facets.kind == bsdf::Distribution::gtr1 ? gtr1_terms(p, in, h) : ashikhmin_terms(p, in, h);
}

Vec3 sample_plain_facet(const GgxPoint& p, Float u0, Float u1) {
    Float s, c;
    sincos(k_two_pi * u0, s, c);
    if (p.facets.kind == bsdf::Distribution::gtr1) {
        const Float a2 = gtr1_alpha2(p);
        const Float z2 = saturate(one_minus_exp((1.0f - u1) * log(a2)) / (1.0f - a2));
        const Float r = sqrt(1.0f - z2);
        return {r * c, r * s, sqrt(z2)};
    }
    const Float nx = exponent_of(p.facets.ax), ny = exponent_of(p.facets.ay);
    // An ellipse of azimuths: tan φ = sqrt((nx + 1)/(ny + 1))·tan 2πu.
    const Float x = c / sqrt(nx + 1.0f), y = s / sqrt(ny + 1.0f), inv = 1.0f / sqrt(x * x + y * y);
    const Float e = nx * sqr(x * inv) + ny * sqr(y * inv);
    const Float sin2 = saturate(one_minus_exp(2.0f * log(max(u1, 1e-12f)) / (e + 1.0f)));
    const Float r = sqrt(sin2) * inv;
    return {r * x, r * y, sqrt(1.0f - sin2)};
}

}  // namespace cardioid::CD_ISA_NS
