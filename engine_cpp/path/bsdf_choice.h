// SPDX-License-Identifier: GPL-3.0-or-later
// Where a path goes on from a vertex: a lobe is chosen by its albedo, and value and density are those of all lobes of its class
// (spec 1, mixed surfaces). Camera paths and photons share it.
#pragma once

#include "bsdf/kernels.h"
#include "path/bump_shadow.h"

namespace cardioid::CD_ISA_NS {

struct Choice {
    Vec3 wi;
    Spectrum f{0.0f};
    Float pdf = 0.0f;
    Mask valid, delta, transmitted, diffuse, specular, through;
    Mask took_d;         ///< a D lobe was chosen, whether or not it gave a direction
    Mask below;          ///< a subsurface lobe was chosen: there is no direction, the path leaves elsewhere
    Vec2 rest;           ///< where `below`: what is left of the random numbers
    Float blur = 0.0f;   ///< how far the lobe widens the pixel's cone
    Float alpha = 1.0f;  ///< of a glossy lobe
    Int lobe;
};

/// Which end the path comes from: refraction and bent normals treat radiance and flux differently.
enum class Transport : bool { radiance, flux };

/// Light that a lobe refracts is scaled by 1/eta², either where radiance is carried or where flux is (spec 1, adjoints).
inline Float refraction_scale(const bsdf::Lobe& lobe, int i, Vec3 wi, Vec3 ng, bool scaled) {
    if (!scaled || !bsdf::refracts(lobe.kind)) return 1.0f;
    const Float eta = load(lobe.eta + i);
    return select(dot(wi, ng) < Float(0.0f), 1.0f / (eta * eta), Float(1.0f));
}

/// Shadow Terminator, Shading Offset: reflected light fades before it comes from the horizon.
inline Float narrowed(const path::VertexChunk& chunk, const bsdf::Lobe& lobe, int i, Vec3 wi, Vec3 ng) {
    const Float cosine = dot(wi, load3(lobe.normal, i)), times = load(chunk.narrowing + i);
    const Float angle = atan2(safe_sqrt(1.0f - cosine * cosine), cosine);
    Float s, c;
    sincos(angle * times, s, c);
    const Float factor = max(c, 0.0f) / select(abs(cosine) > Float(1e-6f), cosine, Float(1e-6f));
    const Mask shifts = (times > Float(1.0f)) & (dot(wi, ng) > Float(0.0f));
    return select(shifts, select(angle * times < Float(k_pi), factor, Float(0.0f)), Float(1.0f));
}

/// Value of a lobe in direction wi for what is carried, f·|cos| with the factors that belong to it.
/// Flux: the lobe seen from the other end, f(wi → wo)·|cos_s(wo)|·|cos_g(wi)| / |cos_g(wo)| (Veach 1997, 5.3).
inline Spectrum carried_value(const path::VertexChunk& chunk, const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi, Vec3 ng,
                              Spectrum f_cos, Mask delta, Transport transport, bool physical) {
    const bool bends = chunk.own_normals && bsdf::is_diffuse_kind(lobe.kind);
    if (transport == Transport::radiance) {
        if (chunk.dark_glass_reflection && lobe.kind == bsdf::LobeKind::ggx_glass) {
            const Mask after_diffuse = (load(chunk.flags + i) & Int(nodes::ray_diffuse)) != Int(0);
            f_cos = select(after_diffuse & (dot(wi, ng) > Float(0.0f)), Spectrum(0.0f), f_cos);
        }
        if (chunk.narrows) f_cos = f_cos * narrowed(chunk, lobe, i, wi, ng);
        if (bends) f_cos = f_cos * bump_shadow(chunk, lobe, i, wi);
        return f_cos * refraction_scale(lobe, i, wi, ng, physical);
    }
    const Vec3 n = load3(lobe.normal, i);
    const Float geometric = abs(dot(ng, wi)) / max(abs(dot(ng, wo)), 1e-6f);
    const Float turned = abs(dot(n, wo)) / max(abs(dot(n, wi)), 1e-6f);
    const Mask swap = ~delta & (dot(wi, ng) >= Float(0.0f));
    Spectrum value = f_cos * turned;
    if (any(swap)) value = select(swap, eval_lobe(lobe, i, wi, wo, ng).f_cos, value);
    if (bends) value = value * bump_shadow(chunk, lobe, i, wo);
    return value * (geometric * refraction_scale(lobe, i, wi, ng, !physical));
}

/// Chooses a lobe by its albedo (or the way straight through) with u.x and samples it with what is left of u.x and u.y: each
/// lobe's share of a stratified sequence stays stratified. `side` chooses between reflection and refraction.
inline Choice sample_bsdf(const path::VertexChunk& chunk, const Float transparency_pick, int i, Vec3 wo, Vec3 ng,
                          Vec2 u, Float side, const scene::Settings& settings, Transport transport, Mask active) {
    const float caustic_roughness = settings.caustic_roughness;
    const bool physical = settings.physical_refraction;
    Choice c;
    c.wi = ng;
    c.valid = c.delta = c.transmitted = c.diffuse = c.specular = c.took_d = c.below = mask_of(false);
    c.rest = u;
    c.lobe = Int(-1);
    Float sum = 0.0f;
    for (int k = 0; k < chunk.lobes; ++k) {
        const bsdf::Lobe& lobe = chunk.lobe[k];
        const Float p = load(chunk.pick[k] + i);
        const Mask here = active & (u.x >= sum) & (u.x < sum + p);
        const Float rest = clamp((u.x - sum) / max(p, 1e-30f), 0.0f, 0.99999994f);
        sum += p;
        if (none(here)) continue;
        if (bsdf::is_subsurface(lobe.kind)) {
            c.below |= here;
            c.took_d |= here;
            c.rest.x = select(here, rest, c.rest.x);
            c.lobe = select(here, Int(k), c.lobe);
            continue;
        }
        const Mask specular = is_specular(lobe, i, caustic_roughness);
        const LobeSample s = sample_lobe(lobe, i, wo, ng, {rest, u.y, side}, here);
        const Spectrum f = carried_value(chunk, lobe, i, wo, s.wi, ng, s.f_cos, s.delta, transport, physical);
        const Mask ok = here & s.valid;
        c.wi = select(ok, s.wi, c.wi);
        c.f = select(ok, f, c.f);
        c.pdf = select(ok, s.pdf * p, c.pdf);
        c.valid |= ok;
        c.delta |= ok & s.delta;
        c.transmitted |= ok & s.transmitted;
        if (bsdf::is_diffuse_kind(lobe.kind)) {
            c.diffuse |= ok;
            c.blur = select(ok, Float(0.3f), c.blur);
        } else {
            c.alpha = select(ok, load(lobe.alpha_x + i), c.alpha);
            c.blur = select(ok, 0.3f * c.alpha, c.blur);
        }
        c.specular |= ok & specular;
        c.took_d |= here & ~specular;
        c.lobe = select(ok, Int(k), c.lobe);
    }
    c.through = active & (u.x >= sum) & (u.x < sum + transparency_pick);
    if (chunk.lobes < 2) return c;
    const Mask mix = c.valid & ~c.delta;
    if (none(mix)) return c;
    for (int k = 0; k < chunk.lobes; ++k) {
        const bsdf::Lobe& lobe = chunk.lobe[k];
        const Mask same_class = ~(is_specular(lobe, i, caustic_roughness) ^ c.specular);
        const Mask here = mix & same_class & (c.lobe != Int(k));
        if (none(here)) continue;
        const LobeEval e = eval_lobe(lobe, i, wo, c.wi, ng);
        const Spectrum f = carried_value(chunk, lobe, i, wo, c.wi, ng, e.f_cos, mask_of(false), transport, physical);
        c.f = select(here, c.f + f, c.f);
        c.pdf = select(here, c.pdf + e.pdf * load(chunk.pick[k] + i), c.pdf);
    }
    return c;
}

/// D lobes of a vertex together.
struct DetailSum {
    Spectrum albedo{0.0f};
    Vec3 normal{0.0f, 0.0f, 0.0f};  ///< × luminance of the lobe's albedo
};

/// Fills chunk.pick with the lobes' shares of the albedo, transparency included; returns the share of going straight through.
inline Float choose_by_albedo(path::VertexChunk& chunk, int i, Vec3 wo, Spectrum transparency,
                              float caustic_roughness = 0, DetailSum* detail = nullptr) {
    Float total = 0.0f;
    for (int k = 0; k < chunk.lobes; ++k) {
        const bsdf::Lobe& lobe = chunk.lobe[k];
        const Spectrum color = lobe_albedo(lobe, i, wo);
        const Float albedo = max(average(color), 0.0f);
        store(chunk.pick[k] + i, albedo);
        total += albedo;
        if (!detail) continue;
        const Spectrum d = select(is_specular(lobe, i, caustic_roughness), Spectrum(0.0f), color);
        detail->albedo += d;
        detail->normal = detail->normal + load3(lobe.normal, i) * luminance(d);
    }
    const Float through = max(average(transparency), 0.0f);
    total += through;
    const Float inv_total = select(total > Float(0.0f), 1.0f / total, Float(0.0f));
    for (int k = 0; k < chunk.lobes; ++k) store(chunk.pick[k] + i, load(chunk.pick[k] + i) * inv_total);
    return through * inv_total;
}

/// RayState::depth after a scattering event.
inline Int count_bounce(Int depth, const Choice& c) {
    const Mask reflected = ~c.transmitted;
    const Int one_diffuse = select(reflected & c.diffuse, Int(1 << 8), Int(0));
    const Int one_glossy = select(reflected & ~c.diffuse, Int(1 << 16), Int(0));
    const Int one_transmission = select(c.transmitted, Int(1 << 24), Int(0));
    return depth + Int(1) + one_diffuse + one_glossy + one_transmission;
}

inline Mask over_limits(const scene::Settings& settings, Int depth) {
    return (byte_of(depth, 0) > Int(settings.max_bounces)) | (byte_of(depth, 1) > Int(settings.max_diffuse_bounces)) |
           (byte_of(depth, 2) > Int(settings.max_glossy_bounces)) |
           (byte_of(depth, 3) > Int(settings.max_transmission_bounces));
}

/// nodes::RayFlag of the ray that leaves.
inline Int ray_kind(const Choice& c) {
    Int kind = select(c.diffuse, Int(nodes::ray_diffuse), Int(nodes::ray_glossy));
    kind = select(c.delta, Int(nodes::ray_glossy | nodes::ray_singular), kind);
    return kind | select(c.transmitted, Int(nodes::ray_transmission), Int(nodes::ray_reflection));
}

}  // namespace cardioid::CD_ISA_NS
