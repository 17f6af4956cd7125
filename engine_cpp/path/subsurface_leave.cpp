// SPDX-License-Identifier: GPL-3.0-or-later
// Where walks end: a Lambert vertex on the other point, with direct light, gathered photons and a way on. It and the entry are one
// vertex of the path (spec 1).
#include "path/bsdf_choice.h"
#include "path/media.h"
#include "path/subsurface.h"

#include <bit>

namespace cardioid::CD_ISA_NS {

namespace {

/// Random dimensions of exits: those of events that no path reaches.
constexpr std::int32_t k_exit_event = 1 << 16;

/// Normals that bump and normal maps make where walks came out.
void bend_exits(Tracer& t) {
    path::Scratch& scratch = t.scratch;
    path::SubsurfaceExit& e = scratch.exits;
    for (int i = 0; i < e.n; i += W) {
        const Mask lanes = first_lanes(e.n - i);
        ShadedPoint at;
        const auto vec = [&](const auto& rows) {
            return Vec3{load(rows[0] + i), load(rows[1] + i), load(rows[2] + i)};
        };
        at.position = vec(e.position);
        at.normal_geometric = vec(e.normal_geometric);
        at.normal = at.wo = vec(e.normal);
        at.instance = select(lanes, load(e.instance + i), Int(0));
        at.triangle = select(lanes, load(e.triangle + i), Int(0));
        at.u = load(e.u + i);
        at.v = load(e.v + i);
        const Int material = material_of(t.scene, at.instance, at.triangle),
                  ray = select(lanes, load(e.ray + i), Int(0));
        const Float width =
            footprint(gather(t.now->width, ray), gather(t.now->spread, ray), gather(scratch.hits.t, ray));
        Vec3 bent = at.normal;
        for (std::uint32_t left = bits(lanes); left != 0;) {
            const int first = std::countr_zero(left), id = material[first];
            const Mask here = lanes_with(material, id, lanes);
            left &= ~bits(here);
            const nodes::ProgramInfo& info = t.scene.materials[id].info;
            if (!info.own_normals || !info.has_subsurface) continue;
            const std::size_t mark = scratch.arena.mark();
            nodes::SurfaceOutput& out = scratch.surface;
            out.lobe = scratch.arena.allocate<bsdf::Lobe>(static_cast<std::size_t>(info.lobes));
            if (!out.lobe) continue;
            run_surface(t, id, at, width, out, here, first);
            Vec3 sum{0.0f, 0.0f, 0.0f};
            for (int k = 0; k < out.lobes; ++k) {
                if (!bsdf::is_subsurface(out.lobe[k].kind)) continue;
                const Float weight = max(average(load_rgb(out.lobe[k].weight, 0)), 0.0f);
                sum = sum + cardioid::CD_ISA_NS::load3(out.lobe[k].normal, 0) * weight;
            }
            bent = select(here & (length_squared(sum) > Float(0.0f)), normalize(sum), bent);
            scratch.arena.reset(mark);
        }
        store(e.normal[0] + i, bent.x);
        store(e.normal[1] + i, bent.y);
        store(e.normal[2] + i, bent.z);
    }
}

/// A Lambert lobe around the wo of the chunk.
void fill_lambert(path::VertexChunk& chunk, bool fresnel) {
    bsdf::Lobe& lobe = chunk.lobe[0];
    // Principled v1's exit is its diffuse lobe seen from above, where the entry's Fresnel is none.
    lobe.kind = fresnel ? bsdf::LobeKind::burley : bsdf::LobeKind::diffuse;
    lobe.fresnel = bsdf::Fresnel::none;
    lobe.preserve_energy = false;
    for (int i = 0; i < chunk.n; i += W) {
        store_rgb(lobe.weight, i, Spectrum(1.0f));
        cardioid::CD_ISA_NS::store3(lobe.normal, i, cardioid::CD_ISA_NS::load3(chunk.wo, i));
        store(lobe.roughness + i, Float(0.0f));
        store(chunk.pick[0] + i, Float(1.0f));
    }
}

}  // namespace

void Tracer::leave_subsurface() {
    bend_exits(*this);
    std::int32_t list[k_chunk + 16];
    for (const bool fresnel : {false, true}) {
        int n = 0;
        const auto flush = [&] {
            if (n == 0) return;
            for (int k = n; k < n + 16; ++k) list[k] = list[n - 1];
            leave_chunk(list, n, fresnel);
            n = 0;
        };
        for (int e = 0; e < scratch.exits.n; ++e) {
            if (((scratch.exits.kind[e] & path::walk_fresnel_exit) != 0) != fresnel) continue;
            list[n++] = e;
            if (n == k_chunk) flush();
        }
        flush();
    }
    scratch.exits.n = 0;
}

void Tracer::leave_chunk(const std::int32_t* exits, int n, bool fresnel) {
    path::VertexChunk* chunk = new_record(1);
    if (!chunk) return;
    const path::SubsurfaceExit& e = scratch.exits;
    const path::RayState& rays = *now;
    chunk->n = n;
    chunk->lobes = 1;
    chunk->own_normals = chunk->all_sides = false;
    for (int i = 0; i < n; i += W) {
        const Int at = load(exits + i), ray = gather(e.ray, at);
        const auto vec = [&](const auto& rows) {
            return Vec3{gather(rows[0], at), gather(rows[1], at), gather(rows[2], at)};
        };
        const Vec3 p = vec(e.position), normal = vec(e.normal), tp = vec(e.throughput);
        cardioid::CD_ISA_NS::store3(chunk->position, i, p);
        cardioid::CD_ISA_NS::store3(chunk->normal_geometric, i, vec(e.normal_geometric));
        cardioid::CD_ISA_NS::store3(chunk->normal, i, normal);
        // As if seen from straight above.
        cardioid::CD_ISA_NS::store3(chunk->wo, i, normal);
        store_rgb(chunk->throughput, i, {tp.x, tp.y, tp.z});
        store(chunk->distance + i, gather(scratch.hits.t, ray));
        store(chunk->path + i, gather(rays.path, ray));
        store(chunk->flags + i, gather(rays.flags, ray));
        const Int depth = gather(rays.depth, ray);
        store(chunk->depth + i, depth);
        store(chunk->event + i, event_of(depth, gather(rays.transparent, ray)) + Int(k_exit_event));
        if (scene.has_volumes) record_media(*chunk, i, ray);
        store(chunk->gather + i, Float(0.0f));
        store(chunk->radius + i, Float(0.0f));
        store(chunk->instance + i, Int(-1));
    }
    fill_lambert(*chunk, fresnel);
    for (int i = 0; i < n; i += W) {
        const Mask lanes = first_lanes(n - i);
        const Int path = load(chunk->path + i), event = load(chunk->event + i);
        const Int seed = gather(scratch.pixel_seed, path), index = gather(scratch.sample_index, path);
        const Vec2 u = sample_pair(seed, index, event_dimension(event, pair_bsdf));
        const Vec2 chance = sample_pair(seed, index, event_dimension(event, pair_chance));
        Choice c = sample_bsdf(*chunk, 0.0f, i, cardioid::CD_ISA_NS::load3(chunk->wo, i),
                               cardioid::CD_ISA_NS::load3(chunk->normal_geometric, i), u, chance.y, scene.settings,
                               Transport::radiance, lanes);
        c.valid &= c.pdf > Float(0.0f);
        send_on(*chunk, i, gather(e.ray, load(exits + i)), c, lanes, chance.x, Spectrum(0.0f));
    }
    keep_record(chunk);
}

}  // namespace cardioid::CD_ISA_NS
