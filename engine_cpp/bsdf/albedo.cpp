// SPDX-License-Identifier: GPL-3.0-or-later
// Directional albedos and multiple-scattering compensation (Kulla & Conty 2017, in Cycles' form: the single-scattering
// lobe is scaled by 1/E, with a colour for the Fresnel losses of repeated bounces).
#include "bsdf/broad.h"
#include "bsdf/ggx.h"
#include "bsdf/kernels.h"
#include "bsdf/table_lookup.h"

namespace cardioid::CD_ISA_NS {

namespace {

using bsdf::Fresnel;
using bsdf::LobeKind;

struct GgxCoordinates {
    Float roughness, m;
};
GgxCoordinates coordinates(const bsdf::Lobe& lobe, int i, Vec3 wo) {
    const Float cosine = saturate(dot(load3(lobe.normal, i), wo));
    return {roughness_of(load(lobe.alpha_x + i), load(lobe.alpha_y + i)), sqrt(cosine)};
}

/// Cosine-weighted mean of the dielectric term (fit of Kulla & Conty 2017).
Float mean_dielectric(Float eta) {
    const Float below = 0.997118f + eta * (0.1014f - eta * (0.965241f + eta * 0.130607f));
    return select(eta < Float(1.0f), below, (eta - 1.0f) / (4.08567f + 1.00071f * eta));
}

/// Mean Fresnel reflectance over all directions: what one more bounce between facets keeps.
Spectrum mean_reflectance(const bsdf::Lobe& lobe, int i) {
    const Spectrum f0 = load_rgb(lobe.f0, i);
    if (lobe.kind == LobeKind::ggx_glass)
        return lobe.fresnel == Fresnel::none || lobe.fresnel == Fresnel::dielectric
                   ? f0
                   : load_rgb(lobe.tint_transmission, i);
    switch (lobe.fresnel) {
        case Fresnel::none: return f0;
        case Fresnel::dielectric: return Spectrum(mean_dielectric(load(lobe.eta + i)));
        case Fresnel::schlick:
        case Fresnel::principled_v1: {
            const Float eta = load(lobe.eta + i);
            return mix(f0, load_rgb(lobe.f90, i), schlick_position(mean_dielectric(eta), eta));
        }
        case Fresnel::f82:
            return saturate(mix(f0, Spectrum(1.0f), 1.0f / 21.0f) -
                            f82_factor(f0, load_rgb(lobe.f90, i)) * (1.0f / 126.0f));
        case Fresnel::conductor: {
            // The F82 model through the reflectances at 0° and 82°, whose mean is known.
            constexpr float f = 6.0f / 7.0f, f5 = f * f * f * f * f;
            const Spectrum k = load_rgb(lobe.f90, i), head_on = fresnel_conductor(1.0f, f0, k);
            const Spectrum b =
                (mix(head_on, Spectrum(1.0f), f5) - fresnel_conductor(1.0f / 7.0f, f0, k)) * (7.0f / (f5 * f));
            return saturate(mix(head_on, Spectrum(1.0f), 1.0f / 21.0f) - b * (1.0f / 126.0f));
        }
    }
    return Spectrum(1.0f);
}

struct Albedo {
    Float directional, mean;
};
Albedo single_scattering(const bsdf::Lobe& lobe, int i, Vec3 wo) {
    using namespace cardioid::bsdf;
    const GgxCoordinates c = coordinates(lobe, i, wo);
    if (lobe.kind == LobeKind::ggx_reflection) {
        const TableAxis r(c.roughness, k_albedo_size), m(c.m, k_albedo_size);
        return {lookup2(k_ggx_albedo, k_albedo_size, r, m), lookup1(k_ggx_mean_albedo, r)};
    }
    const Float eta = load(lobe.eta + i);
    const Mask inverse = eta < Float(1.0f);
    const TableAxis r(c.roughness, k_glass_size), m(c.m, k_glass_size), z(index_coordinate(eta), k_glass_size);
    Albedo a{lookup3(k_glass_albedo, k_glass_size, k_glass_size, r, m, z),
             lookup2(k_glass_mean_albedo, k_glass_size, r, z)};
    if (any(inverse)) {
        a.directional =
            select(inverse, lookup3(k_glass_albedo_inverse, k_glass_size, k_glass_size, r, m, z), a.directional);
        a.mean = select(inverse, lookup2(k_glass_mean_albedo_inverse, k_glass_size, r, z), a.mean);
    }
    return a;
}

/// Position between f0 and f90 of the mean Fresnel term over visible facets.
Float mean_schlick_position(const bsdf::Lobe& lobe, int i, Vec3 wo) {
    using namespace cardioid::bsdf;
    const GgxCoordinates c = coordinates(lobe, i, wo);
    const TableAxis r(c.roughness, k_glass_size), m(c.m, k_glass_size);
    if (lobe.fresnel == Fresnel::f82) return lookup2(k_schlick_power5, k_glass_size, r, m);
    const TableAxis z(index_coordinate(load(lobe.eta + i)), k_glass_size);
    return lookup3(k_schlick_dielectric, k_glass_size, k_glass_size, r, m, z);
}

/// Reflected part for facets that lose nothing between them.
Spectrum ggx_reflectance(const bsdf::Lobe& lobe, int i, Vec3 wo) {
    const Float cosine = saturate(dot(load3(lobe.normal, i), wo));
    const Spectrum smooth = reflectance(lobe, i, cosine);
    // As in Cycles, which has no table for films either.
    if (lobe.thin_film) return smooth;
    switch (lobe.fresnel) {
        case Fresnel::dielectric: {
            const Float eta = load(lobe.eta + i);
            const Float rough = mix(f0_of_eta(eta), 1.0f, mean_schlick_position(lobe, i, wo));
            return select(eta > Float(1.0f), Spectrum(rough), smooth);
        }
        case Fresnel::schlick:
        case Fresnel::principled_v1:
            return mix(load_rgb(lobe.f0, i), load_rgb(lobe.f90, i), mean_schlick_position(lobe, i, wo));
        case Fresnel::f82: return mix(load_rgb(lobe.f0, i), Spectrum(1.0f), mean_schlick_position(lobe, i, wo));
        default: return smooth;
    }
}

/// Glass of an index near 1 loses nearly all single scattering at grazing angles; under this albedo it stays dark
/// rather than to be scaled a hundredfold.
constexpr float k_least_albedo = 0.25f;

/// Factor of weight that makes up for the light lost between facets, coloured by the Fresnel term of the extra bounces.
Spectrum compensation(const bsdf::Lobe& lobe, int i, Albedo a) {
    const Float missing = (1.0f - a.directional) / max(a.directional, k_least_albedo);
    const Spectrum f = saturate(mean_reflectance(lobe, i));
    const Spectrum f_multiple = divide(f * a.mean, max(one_minus(f * (1.0f - a.mean)), 1e-3f));
    return Spectrum(1.0f) + f_multiple * missing;
}

/// What the colour of repeated bounces leaves of a white compensated lobe.
Spectrum darkening(const bsdf::Lobe& lobe, int i, Vec3 wo) {
    const Albedo a = single_scattering(lobe, i, wo);
    return compensation(lobe, i, a) * a.directional;
}

Spectrum ggx_albedo(const bsdf::Lobe& lobe, int i, Vec3 wo) {
    Spectrum a;
    if (lobe.kind == LobeKind::ggx_reflection) {
        a = ggx_reflectance(lobe, i, wo);
    } else {
        const InterfaceTerm t = interface_term(lobe, i, saturate(dot(load3(lobe.normal, i), wo)));
        a = t.reflect + t.transmit;
    }
    return lobe.preserve_energy && lobe.kind != LobeKind::ggx_refraction ? a * darkening(lobe, i, wo) : a;
}

/// Rough size of Burley's retro-reflection: it only chooses between lobes.
Float retro_albedo(const bsdf::Lobe& lobe, int i, Vec3 wo) {
    const Float grazing = schlick_factor(saturate(dot(load3(lobe.normal, i), wo)));
    return load(lobe.roughness + i) * (0.05f + grazing);
}

}  // namespace

Spectrum energy_compensation(const bsdf::Lobe& lobe, int i, Vec3 wo) {
    return compensation(lobe, i, single_scattering(lobe, i, wo));
}

Spectrum lobe_albedo(const bsdf::Lobe& lobe, int i, Vec3 wo) {
    const Spectrum w = load_rgb(lobe.weight, i);
    switch (lobe.kind) {
        case LobeKind::diffuse:
        case LobeKind::translucent:
        case LobeKind::subsurface: return w;
        case LobeKind::burley: return lobe.preserve_energy ? w * retro_albedo(lobe, i, wo) : w;
        case LobeKind::hair_reflection:
        case LobeKind::hair_transmission:
        case LobeKind::hair_chiang:
        case LobeKind::hair_huang: return w * hair_albedo(lobe, i, wo);
        case LobeKind::ggx_reflection:
        case LobeKind::ggx_refraction:
        case LobeKind::ggx_glass: return w * ggx_albedo(lobe, i, wo);
        default: return w * broad_albedo(lobe, i, wo);
    }
}

Mask is_delta(const bsdf::Lobe& lobe, int i) {
    switch (lobe.kind) {
        case LobeKind::ggx_reflection:
        case LobeKind::ggx_refraction:
        case LobeKind::ggx_glass: return ggx_is_delta(lobe, i);
        default: return mask_of(false);
    }
}

Mask is_specular(const bsdf::Lobe& lobe, int i, float caustic_roughness) {
    switch (lobe.kind) {
        case LobeKind::ggx_reflection:
        case LobeKind::ggx_refraction:
        case LobeKind::ggx_glass: {
            const Float alpha = max(load(lobe.alpha_x + i), load(lobe.alpha_y + i));
            return ggx_is_delta(lobe, i) | (alpha <= Float(caustic_roughness * caustic_roughness));
        }
        default: return mask_of(false);
    }
}

}  // namespace cardioid::CD_ISA_NS
