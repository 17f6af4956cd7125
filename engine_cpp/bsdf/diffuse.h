// SPDX-License-Identifier: GPL-3.0-or-later
// Lambert and Oren–Nayar, inline: the lobe that most vertices evaluate.
#pragma once

#include "bsdf/fresnel.h"
#include "bsdf/lobe_result.h"

namespace cardioid::CD_ISA_NS {

/// Under this sigma a diffuse lobe is Lambert's.
inline constexpr float k_lambert_sigma = 1e-5f;

/// Direction in the hemisphere of n with density cos/π; returns the cosine too.
inline Vec3 sample_cosine(Vec3 n, Float u0, Float u1, Float& cosine) {
    Float s, c;
    sincos(k_two_pi * u1, s, c);
    const Float r = sqrt(u0);
    cosine = sqrt(1.0f - u0);
    return Frame(n).to_world({r * c, r * s, cosine});
}

/// f·cos of the rough lanes; `cosine` = dot(n, wi) > 0. Out of line: Lambert stays a handful of instructions.
Spectrum oren_nayar(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi, Float cosine);

inline LobeEval eval_diffuse(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi, Vec3 ng) {
    const Float cosine = dot(load3(lobe.normal, i), wi);
    const Mask ok = (cosine > Float(0.0f)) & (dot(ng, wi) > Float(0.0f));
    const Float pdf = select(ok, cosine * k_inv_pi, Float(0.0f));
    if (any(load(lobe.roughness + i) > Float(k_lambert_sigma)))
        return {select(ok, oren_nayar(lobe, i, wo, wi, cosine), Spectrum(0.0f)), pdf};
    return {load_rgb(lobe.weight, i) * pdf, pdf};
}

inline LobeSample sample_diffuse(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 ng, Vec3 u, Mask active) {
    Float cosine;
    const Vec3 wi = sample_cosine(load3(lobe.normal, i), u.x, u.y, cosine);
    const Mask ok = active & (cosine > Float(0.0f)) & (dot(ng, wi) > Float(0.0f));
    const Float pdf = select(ok, cosine * k_inv_pi, Float(0.0f));
    Spectrum f = load_rgb(lobe.weight, i) * pdf;
    if (any(load(lobe.roughness + i) > Float(k_lambert_sigma)))
        f = select(ok, oren_nayar(lobe, i, wo, wi, cosine), Spectrum(0.0f));
    return {wi, f, pdf, ok, mask_of(false), mask_of(false), Float(1.0f)};
}

}  // namespace cardioid::CD_ISA_NS
