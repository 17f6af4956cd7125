// SPDX-License-Identifier: GPL-3.0-or-later
// Where light enters (read from the camera): what a path does that chose a subsurface lobe.
#include "bsdf/ggx.h"
#include "path/bsdf_choice.h"
#include "path/subsurface.h"

namespace cardioid::CD_ISA_NS {

namespace {

/// Under this radius a channel is diffuse, as in Cycles.
constexpr float k_least_radius = 1e-8f;
/// Albedos of one scattering under this are raised and the throughput lowered instead, as in Cycles: guiding has no use there.
constexpr float k_least_albedo = 0.2f;

Float polynomial(const float (&c)[8], Float x) {
    Float sum = c[7];
    for (int k = 6; k >= 0; --k) sum = fma(sum, x, c[k]);
    return sum;
}

/// Albedo of one scattering that gives a half space the albedo `a`, by mean cosine g: the fit of Wrenninge, Villemin and Hery 2017
/// ("Path Traced Subsurface Scattering using Anisotropic Phase Functions and Non-Exponential Free Flights"), as in Cycles.
struct AlbedoFit {
    Float a, b, c, d, e, f;
};
AlbedoFit albedo_fit(Float g) {
    constexpr float a[8] = {1.8260523782f,   -1.28451056436f, -1.79904629312f, 9.19393289202f,
                            -22.8215585862f, 32.0234874259f,  -23.6264803333f, 7.21067002658f};
    constexpr float b[8] = {0,
                            31.1491581433f,
                            -201.847017512f,
                            841.576016723f,
                            -2018.09288505f,
                            2731.71560286f,
                            -1935.41424244f,
                            559.009054474f};
    constexpr float c[8] = {1.09686102424f, -0.394704063468f, 1.05258115941f, -8.83963712726f,
                            28.8643230661f, -46.8802913581f,  38.5402837518f, -12.7181042538f};
    constexpr float d[8] = {0.496310210422f, 0.360146581622f, -2.15139309747f, 17.8896899217f,
                            -55.2984010333f, 82.065982243f,   -58.5106008578f, 15.8478295021f};
    constexpr float e[8] = {0,
                            76.7316253952f,
                            -594.356773233f,
                            2448.8834203f,
                            -5576.68528998f,
                            7116.60171912f,
                            -4763.54467887f,
                            1303.5318055f};
    constexpr float f[8] = {2.40602999408f, -2.51814844609f, 9.18494908356f, -79.2191708682f,
                            259.082868209f, -403.613804597f, 302.85712436f,  -87.4370473567f};
    return {polynomial(a, g), 4.98511194385f + 0.127355959438f * exp(polynomial(b, g)),   polynomial(c, g),
            polynomial(d, g), 4.23190299701f + 0.00310603949088f * exp(polynomial(e, g)), polynomial(f, g)};
}
Float single_albedo(const AlbedoFit& k, Float albedo) {
    const Float a = max(albedo, 1e-9f), blend = sqrt(sqrt(a));
    return clamp((1.0f - blend) * k.a * pow(atan(k.b * a), k.c) + blend * k.d * pow(atan(k.e * a), k.f), 0.0f,
                 0.999999f);
}

Float over(Float a, Float b) { return select(b > Float(0.0f), a / max(b, 1e-30f), Float(0.0f)); }

/// Extinction and albedo of one scattering; divides the throughput by the albedo, which the walk brings in.
void set_coefficients(WalkLanes& w, Spectrum albedo, Spectrum radius) {
    const AlbedoFit fit = albedo_fit(w.anisotropy);
    const auto channel = [&](Float a, Float r, Float& sigma, Float& alpha, Float& throughput) {
        sigma = 1.0f / (max(r, 1e-16f) * (1.0f - w.anisotropy));
        alpha = single_albedo(fit, a);
        throughput = over(throughput, a) * min(alpha * (1.0f / k_least_albedo), 1.0f);
        alpha = max(alpha, k_least_albedo);
    };
    channel(albedo.r, radius.r, w.extinction.r, w.albedo.r, w.throughput.r);
    channel(albedo.g, radius.g, w.extinction.g, w.albedo.g, w.throughput.g);
    channel(albedo.b, radius.b, w.extinction.b, w.albedo.b, w.throughput.b);
}

/// Direction into the object, by the lobe's `fresnel` (bsdf/lobe.h).
Vec3 entry_direction(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec2 u, Mask& ok) {
    const Vec3 n = load3(lobe.normal, i);
    Float cosine;
    if (lobe.fresnel == bsdf::Fresnel::none) return sample_cosine(-n, u.x, u.y, cosine);
    const bool half = lobe.fresnel == bsdf::Fresnel::schlick;
    const Mask scattered = mask_of(half) & (u.x < Float(0.5f));
    if (half) u.x = min(select(scattered, 2.0f * u.x, 2.0f * u.x - 1.0f), 0.99999994f);
    // The direction alone of a rough refraction (Cycles): its single-scattering loss is left out.
    const Frame frame(n);
    const Float alpha = max(half ? Float(1.0f) : load(lobe.alpha_x + i), bsdf::k_delta_alpha);
    const Vec3 o = frame.to_local(wo);
    ok &= scattered | (o.z > Float(0.0f));
    const Vec3 h = frame.to_world(Ggx{alpha, alpha}.sample_visible({o.x, o.y, max(o.z, 1e-6f)}, u.x, u.y));
    const Float ratio = 1.0f / clamp(load(lobe.eta + i), 1.01f, 3.8f), cos_h = dot(h, wo);
    const Float cos_t = safe_sqrt(1.0f - ratio * ratio * (1.0f - cos_h * cos_h));
    const Vec3 refracted = normalize(wo * -ratio + h * (ratio * cos_h - cos_t));
    return half ? select(scattered, sample_cosine(-n, u.x, u.y, cosine), refracted) : refracted;
}

}  // namespace

void Walk::add_twins(path::VertexChunk& chunk, const std::int32_t* list, bool all_diffuse) {
    const int lobes = chunk.lobes;
    for (int k = 0; k < lobes; ++k) {
        bsdf::Lobe& lobe = chunk.lobe[k];
        if (!bsdf::is_subsurface(lobe.kind)) continue;
        bsdf::Lobe& twin = chunk.lobe[chunk.lobes++];
        const bool principled_v1 = lobe.alpha_y[0] > 0.5f;
        twin.kind = principled_v1 ? bsdf::LobeKind::burley : bsdf::LobeKind::diffuse;
        twin.fresnel = bsdf::Fresnel::none;
        twin.preserve_energy = false;
        for (int i = 0; i < chunk.n; i += W) {
            const Int flags = gather(now->flags, load(list + i));
            const Mask diffuse = mask_of(all_diffuse) | ((flags & Int(path::k_flag_after_diffuse)) != Int(0));
            for (int c = 0; c < 3; ++c) {
                const Mask here = diffuse | (load(lobe.f90[c] + i) < Float(k_least_radius));
                const Float weight = load(lobe.weight[c] + i);
                store(twin.weight[c] + i, select(here, weight, Float(0.0f)));
                store(lobe.weight[c] + i, select(here, Float(0.0f), weight));
                store(twin.normal[c] + i, load(lobe.normal[c] + i));
            }
            store(twin.roughness + i, Float(0.0f));
        }
    }
}

void Tracer::enter_subsurface(const path::VertexChunk& chunk, int i, Int ray, const Choice& c, Mask entering) {
    const Vec3 p = cardioid::CD_ISA_NS::load3(chunk.position, i),
               ng = cardioid::CD_ISA_NS::load3(chunk.normal_geometric, i), wo = cardioid::CD_ISA_NS::load3(chunk.wo, i);
    for (int k = 0; k < chunk.lobes; ++k) {
        const bsdf::Lobe& lobe = chunk.lobe[k];
        if (!bsdf::is_subsurface(lobe.kind)) continue;
        Mask here = entering & (c.lobe == Int(k));
        if (none(here)) continue;
        const Float pick = max(load(chunk.pick[k] + i), 1e-20f);
        WalkLanes w;
        w.throughput = load_rgb(chunk.throughput, i) * load_rgb(lobe.weight, i) * (1.0f / pick);
        w.anisotropy = clamp(load(lobe.roughness + i), 0.0f, 0.9f);
        w.opposite = -offset_step(p, load(chunk.distance + i));
        w.entry = p;
        w.normal = cardioid::CD_ISA_NS::load3(chunk.normal, i);
        const bool burley = lobe.preserve_energy;
        if (burley) {
            w.extinction = load_rgb(lobe.f90, i);
            w.albedo = Spectrum(0.0f);
            w.direction = ng;
            w.position = p;
        } else {
            set_coefficients(w, load_rgb(lobe.f0, i), load_rgb(lobe.f90, i));
            w.direction = entry_direction(lobe, i, wo, c.rest, here);
            here &= dot(ng, w.direction) < Float(0.0f);
            w.position = p;
        }
        here &= max_component(w.throughput) > Float(0.0f);
        w.ray = ray;
        w.instance = load(scratch.shading.instance + i);
        const Int backfacing =
            select(load(scratch.shading.backfacing + i) > Float(0.5f), Int(path::walk_backfacing), Int(0));
        w.kind =
            backfacing | Int((burley ? path::walk_burley : 0) | (lobe.alpha_y[0] > 0.5f ? path::walk_fresnel_exit : 0));
        append_walk(burley ? scratch.disks : scratch.walks, w, here);
    }
}

}  // namespace cardioid::CD_ISA_NS
