// SPDX-License-Identifier: GPL-3.0-or-later
// Principled Hair after Chiang, Bitterli, Tappan & Burley 2016: reflection, transmission, one inner reflection and the rest,
// each a product of a longitudinal and an azimuthal part.
#include "bsdf/hair.h"

namespace cardioid::CD_ISA_NS {

namespace {

constexpr int k_orders = 3;  ///< R, TT, TRT; what is left is uniform in azimuth

Float bessel_i0(Float x) {
    const Float q = 0.25f * x * x;
    Float term = 1.0f, sum = 1.0f;
    for (int k = 1; k < 18; ++k) {
        term = term * q * (1.0f / static_cast<float>(k * k));
        sum += term;
    }
    return sum;
}
Float log_bessel_i0(Float x) {
    const Float y = 1.0f / max(x, 1.0f);
    const Float large = x - 0.5f * (1.8378770664f - log(y)) + y * (0.125f + 0.0625f * y);
    return select(x > Float(12.0f), large, log(bessel_i0(min(x, 12.0f))));
}

/// Density of sin θi around the tilted direction (sin_o, cos_o), with variance v.
Float longitudinal(Float sin_i, Float cos_i, Float sin_o, Float cos_o, Float v) {
    const Float inv = 1.0f / v, cos_part = cos_i * cos_o * inv, sin_part = sin_i * sin_o * inv;
    const Float narrow = exp(log_bessel_i0(cos_part) - sin_part - inv + log(inv));
    const Float wide_inv = min(inv, 10.0f);
    const Float sinh = 0.5f * (exp(wide_inv) - exp(-wide_inv));
    const Float wide = exp(-min(sin_part, 60.0f)) * bessel_i0(min(cos_part, 12.0f)) / (sinh * 2.0f * v);
    return select(v <= Float(0.1f), narrow, wide);
}

Float logistic_cdf(Float x, Float s) { return 1.0f / (1.0f + exp(min(-x / s, 80.0f))); }

Float trimmed_logistic(Float x, Float s) {
    const Float e = exp(-abs(x) / s);
    return e / (s * sqr(1.0f + e)) / max(1.0f - 2.0f * logistic_cdf(-k_pi, s), 1e-6f);
}
Float sample_trimmed_logistic(Float u, Float s) {
    const Float edge = logistic_cdf(-k_pi, s);
    const Float c = clamp(u * (1.0f - 2.0f * edge) + edge, 1e-7f, 1.0f - 1e-7f);
    return clamp(-(s * log(1.0f / c - 1.0f)), -k_pi, k_pi);
}

Float wrapped(Float a) { return a - k_two_pi * floor((a + k_pi) * (1.0f / k_two_pi)); }

Float pow20(Float x) {
    const Float x4 = sqr(sqr(x));
    return sqr(sqr(x4)) * x4;
}

/// What does not depend on the direction of light.
struct Strand {
    Vec3 x, y, z;  ///< along, and across with wo in the plane of x and z
    Float sin_o, cos_o, phi_o, gamma_o, gamma_t;
    Float s;                ///< of the azimuthal logistic
    Float v[k_orders + 1];  ///< longitudinal variances
    Spectrum attenuation[k_orders + 1];
    Float share[k_orders + 1];
    Float tilted_sin[k_orders + 1], tilted_cos[k_orders + 1];

    Strand(const bsdf::Lobe& lobe, int i, Vec3 wo) {
        x = load3(lobe.tangent, i);
        y = normalize(cross(x, wo));
        z = normalize(cross(x, y));
        sin_o = clamp(dot(wo, x), -1.0f, 1.0f);
        cos_o = cos_of_sin(sin_o);
        phi_o = atan2(dot(wo, z), dot(wo, y));
        set_widths(lobe, i);
        set_attenuation(lobe, i);
        set_tilts(-load(lobe.f90[1] + i));
    }

    Float turn(int p) const {
        return 2.0f * static_cast<float>(p) * gamma_t - 2.0f * gamma_o + static_cast<float>(p) * k_pi;
    }

private:
    void set_widths(const bsdf::Lobe& lobe, int i) {
        const Float rough = clamp(load(lobe.alpha_x + i), 0.001f, 1.0f),
                    across = clamp(load(lobe.alpha_y + i), 0.001f, 1.0f);
        const Float first = clamp(load(lobe.roughness + i) * rough, 0.001f, 1.0f);
        const auto variance = [](Float r) { return sqr(0.726f * r + 0.812f * r * r + 3.7f * pow20(r)); };
        s = (0.265f * across + 1.194f * across * across + 5.372f * pow20(across) * across * across) * 0.6266570687f;
        const Float base = variance(rough);
        v[0] = variance(first);
        v[1] = 0.25f * base;
        v[2] = v[3] = 4.0f * base;
    }
    void set_attenuation(const bsdf::Lobe& lobe, int i) {
        const Float eta = load(lobe.eta + i), h = clamp(load(lobe.f90[0] + i), -1.0f, 1.0f);
        gamma_o = asin(h);
        const Float sin_gt = clamp(h * cos_o / sqrt(max(eta * eta - sin_o * sin_o, 1e-6f)), -1.0f, 1.0f);
        gamma_t = asin(sin_gt);
        const Float cos_theta_t = cos_of_sin(sin_o / eta);
        const Spectrum through = exp_of(load_rgb(lobe.f0, i) * (-2.0f * cos_of_sin(sin_gt) / max(cos_theta_t, 1e-4f)));
        const Float f = fresnel_dielectric(cos_o * cos_of_sin(h), eta).reflect;
        attenuation[0] = Spectrum(f);
        attenuation[1] = through * sqr(1.0f - f);
        attenuation[2] = attenuation[1] * through * f;
        attenuation[3] = attenuation[2] * divide(through * f, max(one_minus(through * f), 1e-6f));
        // Principled Hair's factors of R, TT and TRT (model Huang); what follows TRT goes with it.
        const Spectrum factor = load_rgb(lobe.tint_transmission, i);
        attenuation[0] = attenuation[0] * factor.r;
        attenuation[1] = attenuation[1] * factor.g;
        attenuation[2] = attenuation[2] * factor.b;
        attenuation[3] = attenuation[3] * factor.b;
        Float total = 0.0f;
        for (int p = 0; p <= k_orders; ++p) total += share[p] = luminance(attenuation[p]);
        for (int p = 0; p <= k_orders; ++p) share[p] = share[p] / max(total, 1e-30f);
    }
    void set_tilts(Float tilt) {
        Float s1, c1, s2, c2, s4, c4;
        sincos(tilt, s1, c1);
        sincos(2.0f * tilt, s2, c2);
        sincos(4.0f * tilt, s4, c4);
        tilted_sin[0] = sin_o * c2 - cos_o * s2;
        tilted_cos[0] = abs(cos_o * c2 + sin_o * s2);
        tilted_sin[1] = sin_o * c1 + cos_o * s1;
        tilted_cos[1] = abs(cos_o * c1 - sin_o * s1);
        tilted_sin[2] = sin_o * c4 + cos_o * s4;
        tilted_cos[2] = abs(cos_o * c4 - sin_o * s4);
        tilted_sin[3] = sin_o;
        tilted_cos[3] = cos_o;
    }
};

}  // namespace

LobeEval eval_chiang(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi) {
    const Strand t(lobe, i, wo);
    const Float sin_i = clamp(dot(wi, t.x), -1.0f, 1.0f), cos_i = cos_of_sin(sin_i);
    const Float phi = atan2(dot(wi, t.z), dot(wi, t.y)) - t.phi_o;
    LobeEval e{Spectrum(0.0f), Float(0.0f)};
    for (int p = 0; p <= k_orders; ++p) {
        const Float across = p < k_orders ? trimmed_logistic(wrapped(phi - t.turn(p)), t.s) : Float(0.5f * k_inv_pi);
        const Float d = longitudinal(sin_i, cos_i, t.tilted_sin[p], t.tilted_cos[p], t.v[p]) * across;
        e.f_cos += t.attenuation[p] * d;
        e.pdf += t.share[p] * d;
    }
    return e;
}

Vec3 sample_chiang(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 u) {
    const Strand t(lobe, i, wo);
    Float low = 0.0f, rest = u.z, v = t.v[k_orders], sin_t = t.sin_o, cos_t = t.cos_o, turn = 0.0f;
    Mask open = mask_of(true), uniform = mask_of(true);
    for (int p = 0; p <= k_orders; ++p) {
        const Mask here = open & ((u.z < low + t.share[p]) | mask_of(p == k_orders));
        rest = select(here, (u.z - low) / max(t.share[p], 1e-20f), rest);
        v = select(here, t.v[p], v);
        sin_t = select(here, t.tilted_sin[p], sin_t);
        cos_t = select(here, t.tilted_cos[p], cos_t);
        if (p < k_orders) {
            turn = select(here, t.turn(p), turn);
            uniform = uniform & ~here;
        }
        open = open & ~here;
        low += t.share[p];
    }
    rest = clamp(rest, 1e-5f, 1.0f);
    const Float k = 1.0f + v * log(rest + (1.0f - rest) * exp(-2.0f / v));
    const Float sin_i = clamp(cos_of_sin(k) * cos(k_two_pi * u.y) * cos_t - k * sin_t, -1.0f, 1.0f);
    const Float phi = t.phi_o + select(uniform, k_two_pi * u.x, turn + sample_trimmed_logistic(u.x, t.s));
    Float s, c;
    sincos(phi, s, c);
    const Float cos_i = cos_of_sin(sin_i);
    return normalize(t.y * (cos_i * c) + t.z * (cos_i * s) + t.x * sin_i);
}

Spectrum chiang_albedo(const bsdf::Lobe& lobe, int i, Vec3 wo) {
    const Strand t(lobe, i, wo);
    Spectrum sum(0.0f);
    for (int p = 0; p <= k_orders; ++p) sum += t.attenuation[p];
    return sum;
}

}  // namespace cardioid::CD_ISA_NS
