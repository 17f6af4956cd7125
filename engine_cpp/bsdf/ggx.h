// SPDX-License-Identifier: GPL-3.0-or-later
// GGX and Beckmann facets with Smith masking, in the frame of the shading normal. Sources: Walter et al. 2007, Heitz
// 2014 (masking), Dupuy & Benyoub 2023 (visible normals of GGX through spherical caps), Heitz & d'Eon 2014 with the root
// finding of Jakob 2014 (those of Beckmann).
#pragma once

#include "bsdf/fresnel.h"

namespace cardioid::CD_ISA_NS {

/// Abramowitz & Stegun 7.1.26, absolute error 1.5e-7; x ≥ 0.
inline Float erfc_positive(Float x) {
    const Float t = 1.0f / fma(x, 0.3275911f, 1.0f);
    Float p = fma(t, 1.061405429f, -1.453152027f);
    p = fma(p, t, 1.421413741f);
    p = fma(p, t, -0.284496736f);
    p = fma(p, t, 0.254829592f);
    return p * t * exp(-x * x);
}

/// The distribution of a lobe and its masking; one for all lanes but for its widths.
struct Facets {
    Float ax, ay;
    bsdf::Distribution kind = bsdf::Distribution::ggx;
    bool separable = false;

    /// Density of facet normals, per unit projected area. Written with h.x/ax so that it keeps its precision at small
    /// alpha.
    Float d(Vec3 h) const {
        const Float slope2 = sqr(h.x / ax) + sqr(h.y / ay);
        if (kind == bsdf::Distribution::beckmann) {
            const Float z2 = max(sqr(h.z), 1e-12f);
            return exp(-slope2 / z2) * k_inv_pi / (ax * ay * sqr(z2));
        }
        return k_inv_pi / (ax * ay * sqr(slope2 + sqr(h.z)));
    }
    /// GGX: |v.z|·sqrt(1 + alpha²tan²); Beckmann: |v.z|·(1 + 2Λ), exact (Cycles has a fit, 0.4 % off at
    /// most). Then G1(v) =
    /// 2|v.z|/(|v.z| + stretch(v)); no division, so grazing directions are harmless.
    Float stretch(Vec3 v) const {
        const Float r2 = sqr(ax * v.x) + sqr(ay * v.y), z = abs(v.z);
        if (kind != bsdf::Distribution::beckmann) return sqrt(r2 + sqr(z));
        // |v.z|·2Λ = r·(exp(-a²)/√π - a·erfc(a)), a = z/r the cotangent of the stretched direction.
        const Float r = sqrt(max(r2, 1e-20f)), a = min(z / r, 4.0f);
        return z + r * max(exp(-a * a) * 0.56418958f - a * erfc_positive(a), 0.0f);
    }

    /// A facet normal as seen from o (o.z > 0) with density D·G1(o)·<o,h>/o.z.
    Vec3 sample_visible(Vec3 o, Float u0, Float u1) const {
        const Vec3 v = normalize(Vec3{ax * o.x, ay * o.y, o.z});
        if (kind == bsdf::Distribution::beckmann) return sample_beckmann(v, u0, u1);
        Float s, c;
        sincos(k_two_pi * u0, s, c);
        const Float z = fma(1.0f - u1, 1.0f + v.z, -v.z);
        const Float r = safe_sqrt(1.0f - z * z);
        return normalize(Vec3{ax * fma(r, c, v.x), ay * fma(r, s, v.y), max(z + v.z, 1e-6f)});
    }

private:
    Vec3 sample_beckmann(Vec3 v, Float u0, Float u1) const;
};

using Ggx = Facets;

/// What evaluation and sampling of a microfacet lobe share.
struct GgxPoint {
    Frame frame;
    Facets facets;
    Vec3 o;  ///< wo in the frame
    Float stretch_o;
    Mask delta;

    Float g1_over_z() const { return 2.0f / (o.z + stretch_o); }
    /// Masking of both directions over o.z; `iz` = |in.z|.
    Float g2_over_z(Vec3 in, Float iz) const {
        const Float stretch_i = facets.stretch(in);
        if (facets.separable) return g1_over_z() * (2.0f * iz / max(iz + stretch_i, 1e-30f));
        // 1/(1 + Λo + Λi), each Λ from its stretch.
        return 2.0f * iz / max(stretch_o * iz + stretch_i * o.z, 1e-30f);
    }
};

inline Mask ggx_is_delta(const bsdf::Lobe& lobe, int i) {
    const Mask smooth = max(load(lobe.alpha_x + i), load(lobe.alpha_y + i)) <= Float(bsdf::k_delta_alpha);
    if (lobe.kind == bsdf::LobeKind::ggx_reflection) return smooth;
    return smooth | (abs(load(lobe.eta + i) - 1.0f) < Float(bsdf::k_delta_eta));
}

/// Follows the tangent in anisotropic lanes only: a lane's samples must not depend on its neighbours.
inline Frame ggx_frame(const bsdf::Lobe& lobe, int i, Float ax, Float ay) {
    const Mask anisotropic = ax != ay;
    Frame frame(load3(lobe.normal, i));
    if (any(anisotropic)) {
        const Frame along(frame.n, load3(lobe.tangent, i));
        frame.s = select(anisotropic, along.s, frame.s);
        frame.t = select(anisotropic, along.t, frame.t);
    }
    return frame;
}

inline GgxPoint ggx_point(const bsdf::Lobe& lobe, int i, Vec3 wo) {
    const Float ax = max(load(lobe.alpha_x + i), bsdf::k_delta_alpha),
                ay = max(load(lobe.alpha_y + i), bsdf::k_delta_alpha);
    const Facets facets{ax, ay, lobe.distribution, lobe.separable_masking};
    GgxPoint p{ggx_frame(lobe, i, ax, ay), facets, {}, {}, ggx_is_delta(lobe, i)};
    p.o = p.frame.to_local(wo);
    p.stretch_o = p.facets.stretch(p.o);
    return p;
}

/// A lobe's value and density without its Fresnel term.
struct FacetTerms {
    Float f_cos, pdf;
};

/// Ashikhmin–Shirley and GTR1, which are not sampled by visible normals (plain_facets.cpp).
inline bool has_visible_normals(const GgxPoint& p) {
    return p.facets.kind == bsdf::Distribution::ggx || p.facets.kind == bsdf::Distribution::beckmann;
}
FacetTerms plain_facet_terms(const GgxPoint& p, Vec3 in, Vec3 h);
Vec3 sample_plain_facet(const GgxPoint& p, Float u0, Float u1);

/// Facet normal of a sample; the shading normal where the lane is a delta.
inline Vec3 sample_facet(const GgxPoint& p, Vec3 u) {
    const Vec3 up = {0.0f, 0.0f, 1.0f};
    if (all(p.delta)) return up;
    if (!has_visible_normals(p)) return select(p.delta, up, sample_plain_facet(p, u.x, u.y));
    return select(p.delta, up, p.facets.sample_visible(p.o, u.x, u.y));
}

/// The terms of a sample: `rough()` outside the delta lanes, 1 in them.
template <class Rough>
FacetTerms sample_terms(const GgxPoint& p, Rough rough) {
    if (all(p.delta)) return {Float(1.0f), Float(1.0f)};
    const FacetTerms t = rough();
    return {select(p.delta, Float(1.0f), t.f_cos), select(p.delta, Float(1.0f), t.pdf)};
}

}  // namespace cardioid::CD_ISA_NS
