// SPDX-License-Identifier: GPL-3.0-or-later
// Refraction and glass (Walter et al. 2007). Radiance is not scaled by eta²: f·cos/pdf is Fresnel times masking.
#include "bsdf/families.h"
#include "bsdf/ggx.h"

namespace cardioid::CD_ISA_NS {

namespace {

Spectrum weight_of(const bsdf::Lobe& lobe, int i, Vec3 wo) {
    const Spectrum w = load_rgb(lobe.weight, i);
    return lobe.preserve_energy && lobe.kind == bsdf::LobeKind::ggx_glass ? w * energy_compensation(lobe, i, wo) : w;
}

/// Probability of choosing reflection.
Float reflect_chance(const InterfaceTerm& t) {
    const Float r = average(t.reflect), all_parts = r + average(t.transmit);
    return select(all_parts > Float(0.0f), r / max(all_parts, 1e-30f), Float(0.0f));
}

/// f·cos and density for facet h, over the Fresnel part and the chance of choosing it.
FacetTerms facet_terms(const GgxPoint& p, Vec3 in, Vec3 h, Float eta, Mask refracted) {
    const Float oh = abs(dot(p.o, h)), ih = abs(dot(in, h));
    // Along h: |o + eta·in| = |oh - eta·ih|, the length before normalising; o and in lie on opposite sides.
    const Float jacobian = select(refracted, sqr(eta) * oh * ih / max(sqr(oh - eta * ih), 1e-30f), Float(0.25f));
    const Float d = p.facets.d(h) * jacobian;
    return {d * p.g2_over_z(in, abs(in.z)), d * p.g1_over_z()};
}

}  // namespace

LobeEval eval_ggx_interface(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi, Vec3 ng) {
    if (all(ggx_is_delta(lobe, i))) return {Spectrum(0.0f), Float(0.0f)};
    const GgxPoint p = ggx_point(lobe, i, wo);
    const Float eta = load(lobe.eta + i), zero = 0.0f;
    const Vec3 in = p.frame.to_local(wi);
    const Mask refracted = in.z < zero;
    Vec3 h = normalize(p.o + in * select(refracted, eta, Float(1.0f)));
    h = h * copysign(1.0f, h.z);
    const Float oh = dot(p.o, h), side = dot(ng, wi);
    // A facet that faces away from either direction is never seen.
    const Mask facing = (oh > zero) & select(refracted, dot(in, h) < zero, mask_of(true));
    const Mask ok = (p.o.z > zero) & ((in.z > zero) ^ refracted) & facing & ((side * in.z) > zero) & ~p.delta;
    if (none(ok)) return {Spectrum(0.0f), zero};
    const InterfaceTerm fr = interface_term(lobe, i, saturate(oh));
    const Float chance = reflect_chance(fr);
    const FacetTerms t = facet_terms(p, in, h, eta, refracted);
    const Spectrum f = select(refracted, fr.transmit, fr.reflect) * weight_of(lobe, i, wo) * t.f_cos;
    const Float pdf = t.pdf * select(refracted, 1.0f - chance, chance);
    return {select(ok, f, Spectrum(0.0f)), select(ok, pdf, zero)};
}

LobeSample sample_ggx_interface(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 ng, Vec3 u, Mask active) {
    const GgxPoint p = ggx_point(lobe, i, wo);
    const Float eta = load(lobe.eta + i), zero = 0.0f;
    const Vec3 h = sample_facet(p, u);
    const Float oh = dot(p.o, h);
    const InterfaceTerm fr = interface_term(lobe, i, saturate(oh));
    const Float chance = reflect_chance(fr);
    const Mask refracted = u.z >= chance;
    const Float inv_eta = 1.0f / eta;
    const Vec3 through = h * (inv_eta * oh - fr.cos_t) - p.o * inv_eta;
    const Vec3 in = select(refracted, through, h * (2.0f * oh) - p.o);
    const Vec3 wi = p.frame.to_world(in);
    const Spectrum part = select(refracted, fr.transmit, fr.reflect);
    const Mask right_side = ((in.z < zero) ^ ~refracted) & ((dot(ng, wi) * in.z) > zero);
    const Mask ok = active & (p.o.z > zero) & right_side & (max_component(part) > zero);
    const FacetTerms t = sample_terms(p, [&] { return facet_terms(p, in, h, eta, refracted); });
    const Float pdf = t.pdf * select(refracted, 1.0f - chance, chance);
    const Spectrum f = part * weight_of(lobe, i, wo) * t.f_cos;
    return {wi,
            select(ok, f, Spectrum(0.0f)),
            select(ok, pdf, zero),
            ok,
            ok & p.delta,
            ok & refracted,
            select(refracted, eta, Float(1.0f))};
}

}  // namespace cardioid::CD_ISA_NS
