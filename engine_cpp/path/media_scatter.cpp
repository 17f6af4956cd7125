// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices of camera paths in media. Before x_d they change nothing in the path's class: photons are not stored in media, camera
// paths find all that lights them, and x_d is the first D vertex on a surface. After x_d they are D (docs/photons.md).
#include "path/bsdf_choice.h"
#include "path/media.h"

namespace cardioid::CD_ISA_NS {

void Tracer::scatter_in_media() {
    path::Scatterings& q = scratch.scatterings;
    std::int32_t list[k_chunk + 16];
    for (int begin = 0; begin < q.n; begin += k_chunk) {
        const int n = q.n - begin < k_chunk ? q.n - begin : k_chunk;
        for (int k = 0; k < n + 16; ++k) list[k] = begin + (k < n ? k : n - 1);
        scatter_medium_chunk(list, n);
    }
    q.n = 0;
}

void Tracer::scatter_medium_chunk(const std::int32_t* list, int n) {
    path::VertexChunk* chunk = new_record(0, true);
    if (!chunk) return;
    path::MediumRecord* medium = chunk->medium;
    chunk->n = n;
    chunk->lobes = 0;
    chunk->own_normals = false;
    chunk->all_sides = true;
    const path::Scatterings& q = scratch.scatterings;
    for (int i = 0; i < n; i += W) {
        const Int at = load(list + i), ray = gather(q.ray, at);
        const auto vec = [&](const auto& rows) {
            return Vec3{gather(rows[0], at), gather(rows[1], at), gather(rows[2], at)};
        };
        const Vec3 nothing{0.0f, 0.0f, 0.0f}, tp = vec(q.throughput);
        cardioid::CD_ISA_NS::store3(chunk->position, i, vec(q.position));
        cardioid::CD_ISA_NS::store3(chunk->normal_geometric, i, nothing);
        cardioid::CD_ISA_NS::store3(chunk->normal, i, nothing);
        cardioid::CD_ISA_NS::store3(chunk->wo, i, -load3(now->direction, ray));
        cardioid::CD_ISA_NS::store3(medium->parameter, i, vec(q.parameter));
        store(medium->kind + i, gather(q.kind, at));
        store_rgb(chunk->throughput, i, {tp.x, tp.y, tp.z});
        store(chunk->distance + i, gather(q.length, at));
        store(chunk->path + i, gather(now->path, ray));
        store(chunk->flags + i, gather(now->flags, ray));
        const Int depth = gather(now->depth, ray);
        store(chunk->depth + i, depth);
        store(chunk->event + i, event_of(depth, gather(now->transparent, ray)));
        store(chunk->gather + i, Float(0.0f));
        store_media(*chunk->media, i, load_media(*now, ray));
        send_on_from_medium(*chunk, i, ray, first_lanes(n - i));
    }
    chunk->media->surface_material = -1;
    if (!scene.has_lights) return;
    *scratch.last_chunk = chunk;
    scratch.last_chunk = &chunk->next;
}

void Tracer::send_on_from_medium(const path::VertexChunk& chunk, int i, Int ray, Mask lanes) {
    const scene::Settings& settings = scene.settings;
    const path::RayState& rays = *now;
    const Int flags = load(chunk.flags + i), path = load(chunk.path + i), event = load(chunk.event + i);
    const Int seed = gather(scratch.pixel_seed, path), index = gather(scratch.sample_index, path);
    const Vec2 u = sample_pair(seed, index, event_dimension(event, pair_bsdf));
    const Vec2 chance = sample_pair(seed, index, event_dimension(event, pair_chance));
    const PhaseSample s =
        sample_phases(load(chunk.medium->kind + i), cardioid::CD_ISA_NS::load3(chunk.medium->parameter, i),
                      cardioid::CD_ISA_NS::load3(chunk.wo, i), u, lanes);

    const Int state = state_in_medium(state_of(flags)), since_d = scatterings_since_d(flags);
    const Int layer = select(since_d > Int(0), min(since_d + Int(1), Int(path::k_layers)), Int(0));
    const Int depth = load(chunk.depth + i) + Int(1), transparent = gather(rays.transparent, ray) + Int(1 << 24);
    const Mask last =
        over_limits(settings, depth) | (scatterings_in_media(transparent) > Int(most_scatterings(settings)));
    Mask go = lanes & (s.value > Float(0.0f));
    if (wanted() != path::k_all_classes) go &= can_reach(state, wanted());
    const Spectrum carried = load_rgb(chunk.throughput, i);
    const Float survive = survival(carried, depth, go);
    go &= chance.x < survive;
    if (none(go)) return;
    const Float t = load(chunk.distance + i), spread = gather(rays.spread, ray);
    RayLaneState r;
    r.origin = cardioid::CD_ISA_NS::load3(chunk.position, i);
    r.direction = s.wi;
    r.t_min = 0.0f;
    r.throughput = carried * (1.0f / max(survive, 1e-37f));
    r.pdf = s.value;
    r.from_normal = {0.0f, 0.0f, 0.0f};
    r.width = gather(rays.width, ray) + spread * t;
    r.spread = spread + 0.3f;
    r.min_pdf = min(gather(rays.min_pdf, ray), s.value);
    r.merge = gather(rays.merge, ray);
    r.path = path;
    r.flags = Int(nodes::ray_volume) | (state << path::k_state_shift) | (layer << path::k_layer_shift) |
              (flags & Int(path::k_flag_after_diffuse)) | select(last, Int(path::k_flag_last), Int(0));
    r.depth = depth;
    r.transparent = transparent;
    append_media(*next, load_media(*chunk.media, i), go);
    append_ray(*next, r, go);
}

PhaseSample sample_phases(Int kind, Vec3 parameter, Vec3 wo, Vec2 u, Mask lanes) {
    PhaseSample found{{0.0f, 0.0f, 1.0f}, 0.0f};
    for (int k = 0; k < k_phase_kinds; ++k) {
        const Mask here = lanes & (kind == Int(k));
        if (none(here)) continue;
        const PhaseSample s = sample_phase(static_cast<bsdf::PhaseKind>(k), parameter, wo, u.x, u.y);
        found.wi = select(here, s.wi, found.wi);
        found.value = select(here, s.value, found.value);
    }
    return found;
}

Float eval_medium(const path::MediumRecord& m, int i, Vec3 wo, Vec3 wi, Mask lanes) {
    Float value = 0.0f;
    const Int kind = load(m.kind + i);
    const Vec3 parameter = load3(m.parameter, i);
    for (int k = 0; k < k_phase_kinds; ++k) {
        const Mask here = lanes & (kind == Int(k));
        if (any(here))
            value = select(here, eval_phase(static_cast<bsdf::PhaseKind>(k), parameter, -dot(wo, wi)), value);
    }
    return value;
}

}  // namespace cardioid::CD_ISA_NS
