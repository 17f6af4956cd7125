// SPDX-License-Identifier: GPL-3.0-or-later
// Fresnel terms over lanes. `c` is the cosine between direction and (micro)normal, in [0, 1].
#pragma once

#include "bsdf/lobe.h"
#include "simd/vec.h"

namespace cardioid::CD_ISA_NS {

inline Float sqr(Float x) { return x * x; }
inline Float pow5(Float x) { return sqr(sqr(x)) * x; }
inline Float mix(Float a, Float b, Float t) { return fma(b - a, t, a); }
inline Spectrum mix(Spectrum a, Spectrum b, Float t) { return {mix(a.r, b.r, t), mix(a.g, b.g, t), mix(a.b, b.b, t)}; }
inline Spectrum one_minus(Spectrum a) { return {1.0f - a.r, 1.0f - a.g, 1.0f - a.b}; }
inline Spectrum saturate(Spectrum a) { return {saturate(a.r), saturate(a.g), saturate(a.b)}; }
inline Spectrum divide(Spectrum a, Spectrum b) { return {a.r / b.r, a.g / b.g, a.b / b.b}; }
inline Spectrum max(Spectrum a, Float b) { return {max(a.r, b), max(a.g, b), max(a.b, b)}; }
inline Float schlick_factor(Float c) { return pow5(saturate(1.0f - c)); }

struct DielectricTerm {
    Float reflect;  ///< unpolarised reflectance
    Float cos_t;    ///< cosine of the refracted direction, ≥ 0; 0 at total reflection
};

/// eta: index behind the surface over the index in front of it.
inline DielectricTerm fresnel_dielectric(Float c, Float eta) {
    const Float eta2 = eta * eta;
    const Float g2 = eta2 - 1.0f + c * c;
    const Float g = safe_sqrt(g2);
    const Float r_s = (c - g) / max(c + g, 1e-30f);
    const Float r_p = (eta2 * c - g) / max(eta2 * c + g, 1e-30f);
    const Float f = 0.5f * fma(r_s, r_s, r_p * r_p);
    return {select(g2 > Float(0.0f), f, Float(1.0f)), g / eta};
}

/// Reflectance at normal incidence; the same for eta and 1/eta.
inline Float f0_of_eta(Float eta) { return sqr((eta - 1.0f) / (eta + 1.0f)); }

/// Where `f` lies between its value at normal incidence and 1.
inline Float schlick_position(Float f, Float eta) {
    const Float f0 = f0_of_eta(eta);
    return saturate((f - f0) / max(1.0f - f0, 1e-6f));
}

/// Kutz et al. 2021 ("Novel aspects of the Adobe Standard Material"): the factor of -c(1-c)^6 that scales Schlick's
/// value at cos = 1/7 by `tint`.
inline Spectrum f82_factor(Spectrum f0, Spectrum tint) {
    constexpr float f = 6.0f / 7.0f, f5 = f * f * f * f * f;
    return mix(f0, Spectrum(1.0f), f5) * (7.0f / (f5 * f)) * one_minus(tint);
}

inline Spectrum fresnel_f82(Float c, Spectrum f0, Spectrum tint) {
    const Float s = saturate(1.0f - c), s5 = pow5(s);
    return saturate(mix(f0, Spectrum(1.0f), s5) - f82_factor(f0, tint) * (c * s5 * s));
}

/// Complex index n + ik against air, unpolarised (Born & Wolf 14.4.1).
inline Float fresnel_conductor(Float c, Float n, Float k) {
    const Float c2 = c * c, s2 = 1.0f - c2;
    const Float d = n * n - k * k - s2;
    const Float ab = sqrt(d * d + 4.0f * n * n * k * k);
    const Float a = safe_sqrt(0.5f * (ab + d));
    const Float r_s = (ab + c2 - 2.0f * a * c) / max(ab + c2 + 2.0f * a * c, 1e-30f);
    const Float q = c2 * ab + s2 * s2, p = 2.0f * a * c * s2;
    return saturate(0.5f * r_s * (1.0f + (q - p) / max(q + p, 1e-30f)));
}
inline Spectrum fresnel_conductor(Float c, Spectrum n, Spectrum k) {
    return {fresnel_conductor(c, n.r, k.r), fresnel_conductor(c, n.g, k.g), fresnel_conductor(c, n.b, k.b)};
}

/// Films thinner than this (nm) are none.
inline constexpr float k_least_film = 0.1f;

/// Reflectance of a lobe with thin_film; lanes without a film have `plain` (thin_film.cpp).
Spectrum film_reflectance(const bsdf::Lobe& lobe, int i, Float c, Spectrum plain);

/// Reflectance of a lobe of reflection alone, films left out.
inline Spectrum plain_reflectance(const bsdf::Lobe& lobe, int i, Float c) {
    using bsdf::Fresnel;
    switch (lobe.fresnel) {
        case Fresnel::none: return Spectrum(1.0f);
        case Fresnel::dielectric: return Spectrum(fresnel_dielectric(c, load(lobe.eta + i)).reflect);
        case Fresnel::schlick:
        case Fresnel::principled_v1: {
            const Float eta = load(lobe.eta + i);
            const Float s = schlick_position(fresnel_dielectric(c, eta).reflect, eta);
            return mix(load_rgb(lobe.f0, i), load_rgb(lobe.f90, i), s);
        }
        case Fresnel::f82: return fresnel_f82(c, load_rgb(lobe.f0, i), load_rgb(lobe.f90, i));
        case Fresnel::conductor: return fresnel_conductor(c, load_rgb(lobe.f0, i), load_rgb(lobe.f90, i));
    }
    return Spectrum(0.0f);
}

inline Spectrum reflectance(const bsdf::Lobe& lobe, int i, Float c) {
    const Spectrum plain = plain_reflectance(lobe, i, c);
    return lobe.thin_film ? film_reflectance(lobe, i, c, plain) : plain;
}

struct InterfaceTerm {
    Spectrum reflect, transmit;
    Float cos_t;
};

/// Both sides of a lobe that refracts, tint_transmission included.
inline InterfaceTerm interface_term(const bsdf::Lobe& lobe, int i, Float c) {
    using bsdf::Fresnel;
    const Float eta = load(lobe.eta + i);
    const DielectricTerm d = fresnel_dielectric(c, eta);
    if (lobe.kind == bsdf::LobeKind::ggx_refraction) {
        const Float through =
            lobe.fresnel == Fresnel::none ? select(d.cos_t > Float(0.0f), Float(1.0f), Float(0.0f)) : 1.0f - d.reflect;
        return {Spectrum(0.0f), Spectrum(through), d.cos_t};
    }
    const bool remapped = lobe.fresnel == Fresnel::schlick || lobe.fresnel == Fresnel::principled_v1;
    Spectrum f = remapped ? saturate(mix(load_rgb(lobe.f0, i), load_rgb(lobe.f90, i), schlick_position(d.reflect, eta)))
                          : Spectrum(d.reflect);
    if (lobe.thin_film) f = film_reflectance(lobe, i, c, f);
    const Spectrum t =
        select(d.cos_t > Float(0.0f), one_minus(f) * load_rgb(lobe.tint_transmission, i), Spectrum(0.0f));
    return {f, t, d.cos_t};
}

}  // namespace cardioid::CD_ISA_NS
