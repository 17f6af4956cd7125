// SPDX-License-Identifier: GPL-3.0-or-later
// The hair kinds, and those of the Hair BSDF: reflection and transmission about a strand with a Cauchy lobe along it (after
// Marschner et al. 2003, as Cycles has them).
#include "bsdf/hair.h"
#include "bsdf/families.h"

namespace cardioid::CD_ISA_NS {

namespace {

using bsdf::LobeKind;

constexpr float k_right_angle = 0.5f * k_pi;

/// A strand seen along wo, and the Cauchy distribution of the tilt halfway between the directions.
struct Fibre {
    Vec3 tangent, side, across;
    Float theta_o, width, offset, low, high, azimuth;

    Fibre(const bsdf::Lobe& lobe, int i, Vec3 wo) {
        tangent = normalize(load3(lobe.tangent, i));
        const Float z = dot(tangent, wo);
        side = normalize(wo - tangent * z);
        across = cross(side, tangent);
        theta_o = k_right_angle - acos(z);
        width = clamp(load(lobe.alpha_x + i), 0.001f, 1.0f);
        azimuth = clamp(load(lobe.alpha_y + i), 0.001f, 1.0f);
        offset = load(lobe.roughness + i);
        high = atan((0.5f * (k_right_angle + theta_o) - offset) / width);
        low = atan((0.5f * (theta_o - k_right_angle) - offset) / width);
    }
    Float along(Float theta_i) const {
        const Float t = 0.5f * (theta_i + theta_o) - offset;
        return width / (2.0f * (t * t + width * width) * max(high - low, 1e-6f) * max(cos(theta_i), 1e-6f));
    }
};

Float fibre_density(const Fibre& f, Vec3 wi, bool through) {
    const Float z = clamp(dot(f.tangent, wi), -1.0f, 1.0f);
    const Float theta = k_right_angle - acos(z);
    const Float cos_phi = clamp(dot(normalize(wi - f.tangent * z), f.side), -1.0f, 1.0f);
    const Float phi = acos(cos_phi), zero = 0.0f;
    const Mask end = k_right_angle - abs(theta) < Float(0.001f);
    Float around;
    Mask ok = ~end;
    if (through) {
        const Float p = k_pi - phi;
        around = f.azimuth / (2.0f * atan(k_right_angle / f.azimuth) * (p * p + f.azimuth * f.azimuth));
        ok &= cos_phi < zero;
    } else {
        around = cos(0.5f * min(phi / f.azimuth, k_pi)) * 0.25f / f.azimuth;
        ok &= phi < k_pi * f.azimuth;
    }
    return select(ok, around * f.along(theta), zero);
}

Vec3 sample_fibre(const Fibre& f, Vec3 u, bool through) {
    const Float t = f.width * tan(fma(u.x, f.high - f.low, f.low));
    const Float theta = 2.0f * (t + f.offset) - f.theta_o;
    const Float phi = through ? f.azimuth * tan(2.0f * atan(k_right_angle / f.azimuth) * (u.y - 0.5f)) + k_pi
                              : 2.0f * asin(1.0f - 2.0f * u.y) * f.azimuth;
    Float st, ct, sp, cp;
    sincos(theta, st, ct);
    sincos(phi, sp, cp);
    return normalize(f.side * (cp * ct) - f.across * (sp * ct) + f.tangent * st);
}

LobeEval unweighted(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi) {
    if (lobe.kind == LobeKind::hair_chiang) return eval_chiang(lobe, i, wo, wi);
    const bool through = lobe.kind == LobeKind::hair_transmission;
    // Cycles drops what lies on the other side of the shading normal for light samples alone; here a lobe is one.
    const Float value = fibre_density(Fibre(lobe, i, wo), wi, through);
    return {Spectrum(value), value};
}

}  // namespace

LobeEval eval_hair(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi) {
    LobeEval e = unweighted(lobe, i, wo, wi);
    e.f_cos = e.f_cos * load_rgb(lobe.weight, i);
    return e;
}

LobeSample sample_hair(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 ng, Vec3 u, Mask active) {
    const Vec3 wi = lobe.kind == LobeKind::hair_chiang
                        ? sample_chiang(lobe, i, wo, u)
                        : sample_fibre(Fibre(lobe, i, wo), u, lobe.kind == LobeKind::hair_transmission);
    const LobeEval e = eval_hair(lobe, i, wo, wi);
    const Mask ok = active & (e.pdf > Float(0.0f)), none = mask_of(false);
    return {wi,
            select(ok, e.f_cos, Spectrum(0.0f)),
            select(ok, e.pdf, Float(0.0f)),
            ok,
            none,
            ok & (dot(ng, wi) < Float(0.0f)),
            Float(1.0f)};
}

Spectrum hair_albedo(const bsdf::Lobe& lobe, int i, Vec3 wo) {
    return lobe.kind == LobeKind::hair_chiang ? chiang_albedo(lobe, i, wo) : Spectrum(1.0f);
}

}  // namespace cardioid::CD_ISA_NS
