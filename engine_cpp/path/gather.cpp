// SPDX-License-Identifier: GPL-3.0-or-later
// Photons around x_d, the first vertex of a camera path where a D lobe was chosen (spec 2, gathering).
#include "path/bsdf_choice.h"
#include "path/media.h"
#include "path/photon_fields.h"
#include "photon/query.h"

namespace cardioid::CD_ISA_NS {

namespace {

/// Photons further than this share of the radius from the tangent plane lie on another surface.
constexpr float k_flatness = 0.3f;
/// Photons whose surface is turned by more than this (cosine) lie on another surface.
constexpr float k_least_cosine = 0.5f;

/// Bounces that a photon and the path to x_d have together must stay within the limits; the vertex next to the light does not count
/// by type, as on camera paths.
Mask within_limits(const scene::Settings& settings, Int camera, Int photon, bsdf::LobeKind kind, Mask transmits,
                   Mask direct) {
    const bool diffuse = bsdf::is_diffuse_kind(kind);
    const Int one(1), none(0);
    const Int d = select(direct | transmits, none, diffuse ? one : none);
    const Int g = select(direct | transmits, none, diffuse ? none : one);
    const Int t = select(transmits & ~direct, one, none);
    return (byte_of(camera, 1) + byte_of(photon, 1) + d <= Int(settings.max_diffuse_bounces)) &
           (byte_of(camera, 2) + byte_of(photon, 2) + g <= Int(settings.max_glossy_bounces)) &
           (byte_of(camera, 3) + byte_of(photon, 3) + t <= Int(settings.max_transmission_bounces));
}

/// D lobes of the vertex toward the light of the photons, and their density (of one D direction, the choice of D taken for granted).
struct GatherEval {
    Spectrum f_cos{0.0f};
    Float pdf = 0.0f;
};

GatherEval eval_d_lobes(const trace::SceneView& scene, const path::VertexChunk& chunk, int i, Vec3 wo, Vec3 ng,
                        const PhotonLanes& q, Mask active) {
    const scene::Settings& settings = scene.settings;
    GatherEval sum;
    const Int camera_depth = load(chunk.depth + i);
    const Mask direct = q.path_class == Int(static_cast<int>(path::PathClass::d2));
    const Mask transmits = dot(q.wp, ng) < Float(0.0f);
    for (int k = 0; k < chunk.lobes; ++k) {
        const bsdf::Lobe& lobe = chunk.lobe[k];
        Mask here = active & ~is_specular(lobe, i, settings.caustic_roughness);
        here &= within_limits(settings, camera_depth, q.depth, lobe.kind, transmits, direct);
        if (scene.is_limited) here &= (q.visibility & lobe_visibility(lobe.kind, q.wp, ng)) != Int(0);
        if (none(here)) continue;
        const LobeEval e = eval_lobe(lobe, i, wo, q.wp, ng);
        const Spectrum f = carried_value(chunk, lobe, i, wo, q.wp, ng, e.f_cos, mask_of(false), Transport::radiance,
                                         settings.physical_refraction);
        sum.f_cos = select(here, sum.f_cos + f, sum.f_cos);
        sum.pdf = select(here, sum.pdf + e.pdf * load(chunk.pick[k] + i), sum.pdf);
    }
    return sum;
}

/// Keeps the photons of a lane whose number, shifted by `first`, has none of the mask's bits.
void thin(path::GatherLists& lists, int lane, std::uint32_t first, std::uint32_t mask) {
    int kept = 0;
    for (int at = 0; at < lists.n[lane]; ++at) {
        const std::int32_t index = lists.photon[at][lane];
        if (((static_cast<std::uint32_t>(index) + first) & mask) == 0) lists.photon[kept++][lane] = index;
    }
    lists.n[lane] = kept;
}

}  // namespace

Float Tracer::gather_radius(const path::VertexChunk& chunk, int i, Float footprint, Mask here) {
    const path::PhotonPass& pass = *request.photons;
    const Vec3 p = cardioid::CD_ISA_NS::load3(chunk.position, i);
    // A pixel covers width² / cos of the surface; the disk takes the same area. Rounding at the hit bounds it from below.
    const Float cosine =
        abs(dot(cardioid::CD_ISA_NS::load3(chunk.normal_geometric, i), cardioid::CD_ISA_NS::load3(chunk.wo, i)));
    const Float least = 8.0f * offset_step(p, load(chunk.distance + i));
    Float radius = max(pass.radius * footprint / sqrt(max(cosine, 0.01f)), least);
    if (!pass.pixels) return radius;
    const Int path = load(chunk.path + i);
    for (std::uint32_t b = bits(here); b != 0; b &= b - 1) {
        const int k = std::countr_zero(b);
        photon::PixelStatistics& pixel =
            pass.pixels[(result.y[path[k]] - pass.y) * pass.stride + (result.x[path[k]] - pass.x)];
        if (pixel.radius <= 0) pixel.radius = radius[k];
        radius.v[k] = pixel.radius;
    }
    return radius;
}

Float Tracer::mark_gather(path::VertexChunk& chunk, int i, const Choice& c, Mask scatters, Float footprint,
                          Float merge) {
    const Int state = state_of(load(chunk.flags + i));
    const Mask here = scatters & c.took_d & (state == Int(static_cast<int>(path::State::specular)));
    store(chunk.gather + i, Float(0.0f));
    if (none(here)) return merge;
    Mask gathers = here;
    if (request.photons->pixels) {
        const Int path = select(here, load(chunk.path + i), Int(0));
        gathers &= cardioid::CD_ISA_NS::gather(result.sample, path) == Int(request.photons->sample);
    }
    Float probability_d = 0.0f;
    for (int k = 0; k < chunk.lobes; ++k) {
        const Mask specular = is_specular(chunk.lobe[k], i, scene.settings.caustic_roughness);
        probability_d += select(specular, Float(0.0f), load(chunk.pick[k] + i));
    }
    const Float inv_p = 1.0f / max(probability_d, 1e-20f);
    const Float radius = gather_radius(chunk, i, footprint, here);
    store(chunk.gather + i, select(gathers, inv_p, Float(0.0f)));
    store(chunk.radius + i, radius);
    const Vec3 ng = cardioid::CD_ISA_NS::load3(chunk.normal_geometric, i);
    const Float projected = max(abs(dot(ng, c.wi)), 1e-6f);
    return select(here, c.pdf * inv_p / (projected * k_pi * radius * radius), merge);
}

void Tracer::add_photons(const path::VertexChunk& chunk, int i, Spectrum (&sum)[path::k_classes]) {
    const path::PhotonPass& pass = *request.photons;
    path::GatherLists& lists = scratch.gather;
    const Int found = load(lists.n);
    const Float stride = to_float(load(lists.stride));
    const Vec3 wo = cardioid::CD_ISA_NS::load3(chunk.wo, i), ng = cardioid::CD_ISA_NS::load3(chunk.normal_geometric, i);
    const Float radius = load(chunk.radius + i), inv_p = load(chunk.gather + i);
    const Int camera_bounces = byte_of(load(chunk.depth + i), 0);
    int longest = 0;
    for (int k = 0; k < W; ++k) longest = lists.n[k] > longest ? lists.n[k] : longest;
    for (int at = 0; at < longest; ++at) {
        Mask lanes = Int(at) < found;
        const Int index = select(lanes, load(lists.photon[at]), Int(0));
        const PhotonLanes q = photon_lanes(pass.map.photons, index);
        lanes &= camera_bounces + byte_of(q.depth, 0) <= Int(scene.settings.max_bounces);
        if (chunk.media)
            lanes &= load(chunk.media->scatterings + i) + q.in_media <= Int(most_scatterings(scene.settings));
        const Float turned = dot(q.normal, ng);
        lanes &= abs(turned) > Float(k_least_cosine);
        // A photon behind the surface must not shine through because its own facet is tilted.
        lanes &= ~((turned > Float(0.0f)) ^ (dot(q.wp, ng) > Float(0.0f)));
        if (none(lanes)) continue;
        const GatherEval e = eval_d_lobes(scene, chunk, i, wo, ng, q, lanes);
        Float weight = stride / max(abs(dot(q.wp, q.normal)), 1e-4f);
        if (request.partition.blend_hits) {
            // As RayState::merge of the camera path that goes the same way; hits of lamps take the other share.
            const Float projected = max(abs(dot(ng, q.wp)), 1e-6f);
            const Float merge = e.pdf * inv_p / (projected * k_pi * radius * radius);
            const Float photons = q.density * pass.per_path;
            const Mask c1 = q.path_class == Int(static_cast<int>(path::PathClass::c1));
            weight = select(c1, weight * (photons / max(photons + merge, 1e-37f)), weight);
        }
        const Spectrum c = select(lanes, e.f_cos * q.flux * weight, Spectrum(0.0f));
        for (int k = 1; k < path::k_classes; ++k) sum[k] = select(q.path_class == Int(k), sum[k] + c, sum[k]);
    }
}

void Tracer::gather_photons(const path::VertexChunk& chunk, int i) {
    const path::PhotonPass& pass = *request.photons;
    const Float inv_p = load(chunk.gather + i);
    const Mask active = first_lanes(chunk.n - i) & (inv_p > Float(0.0f));
    if (none(active)) return;
    path::GatherLists& lists = scratch.gather;
    Spectrum sum[path::k_classes] = {};
    int found[W] = {};
    for (int k = 0; k < W; ++k) {
        lists.n[k] = 0;
        lists.stride[k] = 1;
    }
    // Where a list is thinned, which photons stay differs from vertex to vertex.
    const Int phase = hash(bits_of(load(chunk.position[0] + i)), bits_of(load(chunk.position[1] + i)));
    for (std::uint32_t b = bits(active); b != 0; b &= b - 1) {
        const int k = std::countr_zero(b);
        const float center[3] = {chunk.position[0][i + k], chunk.position[1][i + k], chunk.position[2][i + k]};
        const float n[3] = {chunk.normal_geometric[0][i + k], chunk.normal_geometric[1][i + k],
                            chunk.normal_geometric[2][i + k]};
        const float radius = chunk.radius[i + k];
        const auto first = static_cast<std::uint32_t>(phase[k]);
        std::uint32_t mask = 0;
        photon::for_each_photon(pass.map, center, radius, [&](std::int32_t index) {
            const float off = (pass.map.x[index] - center[0]) * n[0] + (pass.map.y[index] - center[1]) * n[1] +
                              (pass.map.z[index] - center[2]) * n[2];
            if (off > k_flatness * radius || off < -k_flatness * radius) return;
            ++found[k];
            if (((static_cast<std::uint32_t>(index) + first) & mask) != 0) return;
            if (lists.n[k] == path::GatherLists::capacity) {
                mask = 2 * mask + 1;
                thin(lists, k, first, mask);
                if (((static_cast<std::uint32_t>(index) + first) & mask) != 0) return;
            }
            // A list that is still full after thinning would need photons of equal numbers.
            lists.photon[lists.n[k]++][k] = index;
        });
        lists.stride[k] = static_cast<std::int32_t>(mask + 1);
        scratch.counters.evaluated += static_cast<std::uint64_t>(lists.n[k]);
        scratch.counters.gathered += static_cast<std::uint64_t>(found[k]);
        if (pass.gathered) {
            for (int at = 0; at < lists.n[k]; ++at)
                pass.gathered[lists.photon[at][k]].fetch_add(mask + 1, std::memory_order_relaxed);
        }
    }
    add_photons(chunk, i, sum);
    scratch.counters.gathers += static_cast<std::uint64_t>(count(active));
    add_estimate(chunk, i, sum, found, active);
}

void Tracer::add_estimate(const path::VertexChunk& chunk, int i, const Spectrum (&sum)[path::k_classes],
                          const int (&found)[W], Mask active) {
    const path::PhotonPass& pass = *request.photons;
    const Int path = select(active, load(chunk.path + i), Int(0));
    const Spectrum scale = load_rgb(chunk.throughput, i) * load(chunk.gather + i);
    if (!pass.pixels) {
        const Float radius = load(chunk.radius + i);
        const Float per_area = 1.0f / (k_pi * radius * radius * pass.emitted);
        for (int k = 1; k < path::k_classes; ++k)
            add_light(result, request.layers, Int(k), path, {sum[k] * scale * per_area}, active);
        return;
    }
    for (std::uint32_t b = bits(active); b != 0; b &= b - 1) {
        const int k = std::countr_zero(b);
        float phi[photon::k_photon_classes][3];
        for (int c = 1; c < path::k_classes; ++c) {
            const Spectrum s = sum[c] * scale;
            phi[c - 1][0] = s.r[k];
            phi[c - 1][1] = s.g[k];
            phi[c - 1][2] = s.b[k];
        }
        photon::update(pass.pixels[(result.y[path[k]] - pass.y) * pass.stride + (result.x[path[k]] - pass.x)],
                       static_cast<float>(found[k]), phi, pass.alpha);
    }
}

}  // namespace cardioid::CD_ISA_NS
