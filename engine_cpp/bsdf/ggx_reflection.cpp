// SPDX-License-Identifier: GPL-3.0-or-later
#include "bsdf/families.h"
#include "bsdf/ggx.h"

namespace cardioid::CD_ISA_NS {

namespace {

Spectrum weight_of(const bsdf::Lobe& lobe, int i, Vec3 wo) {
    const Spectrum w = load_rgb(lobe.weight, i);
    return lobe.preserve_energy ? w * energy_compensation(lobe, i, wo) : w;
}

/// f·cos = F·D·G2/(4 o.z) and its density D·G1/(4 o.z), both over F.
FacetTerms reflect_terms(const GgxPoint& p, Vec3 in, Vec3 h) {
    if (!has_visible_normals(p)) return plain_facet_terms(p, in, h);
    const Float d = 0.25f * p.facets.d(h);
    return {d * p.g2_over_z(in, in.z), d * p.g1_over_z()};
}

}  // namespace

LobeEval eval_ggx_reflection(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi, Vec3 ng) {
    if (all(ggx_is_delta(lobe, i))) return {Spectrum(0.0f), Float(0.0f)};
    const GgxPoint p = ggx_point(lobe, i, wo);
    const Vec3 in = p.frame.to_local(wi);
    const Vec3 h = normalize(p.o + in);
    const Float zero = 0.0f;
    const Mask ok = (p.o.z > zero) & (in.z > zero) & (dot(ng, wi) > zero) & ~p.delta;
    if (none(ok)) return {Spectrum(0.0f), zero};
    const FacetTerms t = reflect_terms(p, in, h);
    const Spectrum f = reflectance(lobe, i, saturate(dot(p.o, h))) * weight_of(lobe, i, wo) * t.f_cos;
    return {select(ok, f, Spectrum(0.0f)), select(ok, t.pdf, zero)};
}

LobeSample sample_ggx_reflection(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 ng, Vec3 u, Mask active) {
    const GgxPoint p = ggx_point(lobe, i, wo);
    const Float zero = 0.0f;
    const Vec3 h = sample_facet(p, u);
    const Float oh = dot(p.o, h);
    const Vec3 in = h * (2.0f * oh) - p.o;
    const Vec3 wi = p.frame.to_world(in);
    const Mask ok = active & (p.o.z > zero) & (in.z > zero) & (dot(ng, wi) > zero);
    const FacetTerms t = sample_terms(p, [&] { return reflect_terms(p, in, h); });
    const Spectrum f = reflectance(lobe, i, saturate(oh)) * weight_of(lobe, i, wo) * t.f_cos;
    return {wi, select(ok, f, Spectrum(0.0f)), select(ok, t.pdf, zero), ok, ok & p.delta, mask_of(false), Float(1.0f)};
}

}  // namespace cardioid::CD_ISA_NS
