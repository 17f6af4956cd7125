// SPDX-License-Identifier: GPL-3.0-or-later
// Broad lobes: translucent, Burley diffuse, velvet, both sheens, toon; and Oren–Nayar's value.
#include "bsdf/broad.h"
#include "bsdf/diffuse.h"

namespace cardioid::CD_ISA_NS {

namespace {

using bsdf::LobeKind;

/// Fujii's Oren–Nayar: the angular integral of its rough part; G(1) = 0, G(0) = k_fujii.
constexpr float k_fujii = 0.90412966f;       // π/2 - 2/3
constexpr float k_fujii_mean = 0.22772844f;  // (2π - 5.6)/3: mean of G
Float fujii_g(Float c) {
    const Float s = safe_sqrt(1.0f - c * c);
    const Float full = s * (acos(c) - 2.0f / 3.0f - s * c) + (2.0f / 3.0f) * (s / max(c, 1e-6f)) * (1.0f - s * s * s);
    return select(c < Float(1e-3f), k_fujii - c, full);
}

/// Disney diffuse (Burley 2012), or its retro-reflection alone.
Float burley(Float roughness, Float cos_o, Float cos_i, Float oi, bool retro_alone) {
    const Float fo = schlick_factor(cos_o), fi = schlick_factor(cos_i), rr = roughness * (oi + 1.0f);
    const Float retro = rr * (fo + fi + fo * fi * (rr - 1.0f));
    return retro_alone ? retro : (1.0f - 0.5f * fo) * (1.0f - 0.5f * fi) + retro;
}

/// A cone of constant light about an axis that fades out over `smooth`.
struct ToonCone {
    Float size, smooth, outer;  ///< angles; `outer` bounds what is sampled
    ToonCone(const bsdf::Lobe& lobe, int i) {
        constexpr float right_angle = 0.5f * k_pi;
        size = clamp(load(lobe.roughness + i), 1e-5f, 1.0f) * right_angle;
        smooth = saturate(load(lobe.alpha_x + i)) * right_angle;
        outer = min(size + smooth, right_angle);
    }
    /// 1 - cos(outer), exact for small angles.
    Float height() const { return 2.0f * sqr(sin(0.5f * outer)); }
    Float intensity(Float angle) const {
        const Float fading = select(smooth > Float(0.0f), 1.0f - (angle - size) / max(smooth, 1e-20f), Float(0.0f));
        return select(angle < size, Float(1.0f), max(fading, 0.0f));
    }
};

/// Axis of a toon lobe: the normal, or wo mirrored.
Vec3 toon_axis(const bsdf::Lobe& lobe, Vec3 n, Vec3 wo) {
    return lobe.kind == LobeKind::toon_glossy ? n * (2.0f * dot(n, wo)) - wo : n;
}

/// Velvet (Ashikhmin & Premože 2007), f·cos; sigma as in the node.
Float velvet(Float sigma, Vec3 n, Vec3 wo, Vec3 wi, Float cos_o, Float cos_i) {
    const Vec3 h = normalize(wo + wi);
    const Float nh = dot(n, h), oh = abs(dot(wo, h));
    const Float inv_sigma2 = 1.0f / sqr(max(sigma, 0.01f));
    const Float sin2 = max(1.0f - nh * nh, 1e-5f);
    const Float d = exp(-(nh * nh) / sin2 * inv_sigma2) * inv_sigma2 * k_inv_pi / sqr(sin2);
    const Float slope = 2.0f * max(nh / max(oh, 1e-5f), 1e-5f);
    const Float g = min(1.0f, min(slope * cos_o, slope * cos_i));
    return 0.25f * d * g / max(cos_o, 1e-5f);
}

/// Microfiber sheen as a linearly transformed cosine (Zeltner, Burley & Chiang 2022): rational fits to the
/// coefficients by MaterialX (Apache-2.0). x: cosine of wo, y: roughness.
struct SheenCosine {
    Float a, b;
};
SheenCosine sheen_cosine(Float x, Float y) {
    return {(2.58126f * x + 0.813703f * y) * y / (1.0f + 0.310327f * x * x + 2.60994f * x * y),
            safe_sqrt(1.0f - x) * (y - 1.0f) * y * y * y /
                (0.0000254053f + 1.71228f * x - 1.71506f * x * y + 1.34174f * y * y)};
}
Float sheen_albedo(Float x, Float y) {
    const Float s = y * (0.0206607f + 1.58491f * y) / (0.0379424f + y * (1.32227f + y));
    const Float m = y * (-0.193854f + y * (-1.14885f + y * (1.7932f - 0.95943f * y * y))) / (0.046391f + y);
    const Float o = y * (0.000654023f + (-0.0207818f + 0.119681f * y) * y) / (1.26264f + y * (-1.92021f + y));
    return saturate(exp(-0.5f * sqr((x - m) / s)) * 0.39894228f / s + o);
}
constexpr float k_least_sheen = 0.01f;

Float sheen_density(SheenCosine k, Vec3 in) {
    const Float length2 = sqr(k.a * in.x + k.b * in.z) + sqr(k.a * in.y) + sqr(in.z);
    return k_inv_pi * max(in.z, 0.0f) * sqr(k.a / max(length2, 1e-20f));
}

Float roughness_of_sheen(const bsdf::Lobe& lobe, int i) { return clamp(load(lobe.roughness + i), k_least_sheen, 1.0f); }

struct Value {
    Float f_cos, pdf;
};
/// Value and density; valid where dot(n, wi) has the side of the lobe.
Value broad_value(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi) {
    const Vec3 n = load3(lobe.normal, i);
    const Float cos_o = dot(n, wo), cos_i = dot(n, wi);
    switch (lobe.kind) {
        case LobeKind::translucent: return {-cos_i * k_inv_pi, -cos_i * k_inv_pi};
        case LobeKind::burley: {
            const Float pdf = cos_i * k_inv_pi;
            return {pdf * burley(load(lobe.roughness + i), cos_o, cos_i, dot(wo, wi), lobe.preserve_energy), pdf};
        }
        case LobeKind::velvet: {
            const Float f = velvet(load(lobe.roughness + i), n, wo, wi, cos_o, cos_i);
            return {f, Float(0.5f * k_inv_pi)};
        }
        case LobeKind::sheen_v1:
            return {schlick_factor(safe_sqrt(0.5f + 0.5f * dot(wo, wi))) * cos_i, cos_i * k_inv_pi};
        case LobeKind::sheen: {
            const Float x = saturate(cos_o), y = roughness_of_sheen(lobe, i);
            const Float pdf = sheen_density(sheen_cosine(x, y), Frame(n, wo).to_local(wi));
            return {pdf * sheen_albedo(x, y), pdf};
        }
        case LobeKind::toon_diffuse:
        case LobeKind::toon_glossy: {
            const ToonCone cone(lobe, i);
            const Vec3 axis = toon_axis(lobe, n, wo);
            // The chord keeps small angles exact.
            const Float angle = 2.0f * asin(min(0.5f * length(wi - axis), 1.0f));
            const Float pdf = select(angle < cone.outer, 0.5f * k_inv_pi / cone.height(), Float(0.0f));
            return {pdf * cone.intensity(angle), pdf};
        }
        default: return {Float(0.0f), Float(0.0f)};
    }
}

/// The side that the lobe scatters to, and wo in front where its formula needs that.
Mask broad_domain(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi, Vec3 ng) {
    const Vec3 n = load3(lobe.normal, i);
    const Float cos_i = dot(n, wi), side = dot(ng, wi), zero = 0.0f;
    if (lobe.kind == LobeKind::translucent) return (cos_i < zero) & (side < zero);
    const Mask ok = (cos_i > zero) & (side > zero);
    const bool from_below = lobe.kind == LobeKind::burley || lobe.kind == LobeKind::toon_diffuse;
    return from_below ? ok : ok & (dot(n, wo) > zero);
}

Vec3 broad_direction(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 u) {
    const Vec3 n = load3(lobe.normal, i);
    Float s, c, cosine;
    switch (lobe.kind) {
        case LobeKind::translucent: return sample_cosine(-n, u.x, u.y, cosine);
        case LobeKind::velvet: {
            sincos(k_two_pi * u.y, s, c);
            const Float r = safe_sqrt(1.0f - u.x * u.x);
            return Frame(n).to_world({r * c, r * s, u.x});
        }
        case LobeKind::sheen: {
            const SheenCosine k = sheen_cosine(saturate(dot(n, wo)), roughness_of_sheen(lobe, i));
            sincos(k_two_pi * u.y, s, c);
            const Float r = sqrt(u.x), z = sqrt(1.0f - u.x);
            return Frame(n, wo).to_world(normalize(Vec3{fma(r, c, -(z * k.b)), r * s, z * k.a}));
        }
        case LobeKind::toon_diffuse:
        case LobeKind::toon_glossy: {
            const Float down = u.x * ToonCone(lobe, i).height(), r = safe_sqrt(down * (2.0f - down));
            sincos(k_two_pi * u.y, s, c);
            return Frame(toon_axis(lobe, n, wo)).to_world({r * c, r * s, 1.0f - down});
        }
        default: return sample_cosine(n, u.x, u.y, cosine);
    }
}

}  // namespace

Spectrum oren_nayar(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi, Float cosine) {
    const Spectrum weight = load_rgb(lobe.weight, i);
    const Float sigma = saturate(load(lobe.roughness + i));
    const Float a = 1.0f / fma(sigma, k_fujii, k_pi);
    const Float cos_o = saturate(dot(load3(lobe.normal, i), wo)), cos_i = saturate(cosine);
    Float t = dot(wo, wi) - cos_i * cos_o;
    t = select(t > Float(0.0f), t / max(max(cos_i, cos_o), 1e-30f), t);
    const Float single = a * fma(sigma, t, 1.0f);
    if (!lobe.preserve_energy) return weight * (cos_i * max(single, 0.0f));
    // Energy that the single bounce loses, spread as a product of what each direction loses (Kulla & Conty; OpenPBR).
    const Float loss_mean = a * sigma * (k_fujii - k_fujii_mean);
    const Float loss = a * sigma * (k_fujii - fujii_g(cos_o)) * (k_fujii - fujii_g(cos_i)) / (k_fujii - k_fujii_mean);
    const Spectrum albedo = saturate(load_rgb(lobe.f0, i));
    const Spectrum multiple =
        divide(albedo * albedo * ((1.0f - loss_mean) * k_inv_pi * loss), one_minus(albedo * loss_mean));
    return weight * ((Spectrum(max(single, 0.0f)) + multiple) * cos_i);
}

LobeEval eval_broad(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi, Vec3 ng) {
    const Mask ok = broad_domain(lobe, i, wo, wi, ng);
    const Value v = broad_value(lobe, i, wo, wi);
    return {load_rgb(lobe.weight, i) * select(ok, v.f_cos, Float(0.0f)), select(ok, v.pdf, Float(0.0f))};
}

LobeSample sample_broad(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 ng, Vec3 u, Mask active) {
    const Vec3 wi = broad_direction(lobe, i, wo, u);
    const Value v = broad_value(lobe, i, wo, wi);
    // A toon's rim may round to the outside.
    const Mask ok = active & broad_domain(lobe, i, wo, wi, ng) & (v.pdf > Float(0.0f));
    const Mask transmitted = lobe.kind == LobeKind::translucent ? ok : mask_of(false);
    return {wi,
            load_rgb(lobe.weight, i) * select(ok, v.f_cos, Float(0.0f)),
            select(ok, v.pdf, Float(0.0f)),
            ok,
            mask_of(false),
            transmitted,
            Float(1.0f)};
}

Float broad_albedo(const bsdf::Lobe& lobe, int i, Vec3 wo) {
    const Float x = saturate(dot(load3(lobe.normal, i), wo));
    switch (lobe.kind) {
        case LobeKind::sheen: return sheen_albedo(x, roughness_of_sheen(lobe, i));
        // 3.4's own estimate: the value at the mirror direction of the normal.
        case LobeKind::sheen_v1: return schlick_factor(x) * x;
        default: return Float(1.0f);
    }
}

}  // namespace cardioid::CD_ISA_NS
