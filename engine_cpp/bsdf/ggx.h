// SPDX-License-Identifier: GPL-3.0-or-later
// The GGX distribution with height-correlated Smith masking, in the frame of the shading normal. Sources: Walter et
// al. 2007, Heitz 2014 (masking), Dupuy & Benyoub 2023 (visible normals through spherical caps).
#pragma once

#include "bsdf/fresnel.h"

namespace cardioid::CD_ISA_NS {

struct Ggx {
    Float ax, ay;

    /// Density of facet normals, per unit projected area. Written with h.x/ax so that it keeps its precision at small
    /// alpha.
    Float d(Vec3 h) const {
        const Float t = sqr(h.x / ax) + sqr(h.y / ay) + sqr(h.z);
        return k_inv_pi / (ax * ay * sqr(t));
    }
    /// |v.z|·sqrt(1 + alpha²tan²): G1(v) = 2|v.z| / (|v.z| + stretch(v)); no division, so grazing directions are
    /// harmless.
    Float stretch(Vec3 v) const { return sqrt(sqr(ax * v.x) + sqr(ay * v.y) + sqr(v.z)); }

    /// A facet normal as seen from o (o.z > 0) with density D·G1(o)·<o,h>/o.z.
    Vec3 sample_visible(Vec3 o, Float u0, Float u1) const {
        const Vec3 v = normalize(Vec3{ax * o.x, ay * o.y, o.z});
        Float s, c;
        sincos(k_two_pi * u0, s, c);
        const Float z = fma(1.0f - u1, 1.0f + v.z, -v.z);
        const Float r = safe_sqrt(1.0f - z * z);
        return normalize(Vec3{ax * fma(r, c, v.x), ay * fma(r, s, v.y), max(z + v.z, 1e-6f)});
    }
};

/// What evaluation and sampling of a GGX lobe share.
struct GgxPoint {
    Frame frame;
    Ggx ggx;
    Vec3 o;  ///< wo in the frame
    Float stretch_o;
    Mask delta;
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
    GgxPoint p{ggx_frame(lobe, i, ax, ay), {ax, ay}, {}, {}, ggx_is_delta(lobe, i)};
    p.o = p.frame.to_local(wo);
    p.stretch_o = p.ggx.stretch(p.o);
    return p;
}

/// Facet normal of a sample; the shading normal where the lane is a delta.
inline Vec3 sample_facet(const GgxPoint& p, Vec3 u) {
    const Vec3 up = {0.0f, 0.0f, 1.0f};
    if (all(p.delta)) return up;
    return select(p.delta, up, p.ggx.sample_visible(p.o, u.x, u.y));
}

/// A lobe's value and density without its Fresnel term.
struct FacetTerms {
    Float f_cos, pdf;
};

/// The terms of a sample: `rough()` outside the delta lanes, 1 in them.
template <class Rough>
FacetTerms sample_terms(const GgxPoint& p, Rough rough) {
    if (all(p.delta)) return {Float(1.0f), Float(1.0f)};
    const FacetTerms t = rough();
    return {select(p.delta, Float(1.0f), t.f_cos), select(p.delta, Float(1.0f), t.pdf)};
}

}  // namespace cardioid::CD_ISA_NS
