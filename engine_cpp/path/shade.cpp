// SPDX-License-Identifier: GPL-3.0-or-later
// One chunk: rays that hit the same material. Runs its program, keeps the vertices as a record, samples where paths go on.
#include "path/bsdf_choice.h"
#include "trace/curvature.h"

namespace cardioid::CD_ISA_NS {

namespace {

void scale_rows(Row (&rows)[3], int i, Mask dark) {
    for (auto& row : rows) store(row + i, select(dark, Float(0.0f), load(row + i)));
}

/// Cycles' Reflective and Refractive Caustics switches: glossy lobes are dark for light that a diffuse lobe collects.
void drop_caustic_lobes(const scene::Settings& settings, bsdf::Lobe& lobe, int i, Mask after_diffuse) {
    using bsdf::LobeKind;
    const bool reflects = lobe.kind == LobeKind::ggx_reflection || lobe.kind == LobeKind::ggx_glass;
    if (reflects && !settings.reflective_caustics) scale_rows(lobe.weight, i, after_diffuse);
    if (lobe.kind == LobeKind::ggx_refraction && !settings.refractive_caustics)
        scale_rows(lobe.weight, i, after_diffuse);
    if (lobe.kind == LobeKind::ggx_glass && !settings.refractive_caustics)
        scale_rows(lobe.tint_transmission, i, after_diffuse);
}

/// Filter Glossy: after an unlikely bounce, near-mirrors are roughened.
void blur_glossy(bsdf::Lobe& lobe, int i, Float least_alpha) {
    if (bsdf::is_diffuse_kind(lobe.kind)) return;
    store(lobe.alpha_x + i, max(load(lobe.alpha_x + i), least_alpha));
    store(lobe.alpha_y + i, max(load(lobe.alpha_y + i), least_alpha));
}

/// Depth counters and flags after a scattering event.
struct NextPath {
    Int flags, depth;
};

NextPath advance(const scene::Settings& settings, Int flags, Int depth, const Choice& c) {
    NextPath n;
    n.depth = count_bounce(depth, c);
    const Int state = step_state(state_of(flags), c.specular), since_d = scatterings_since_d(flags);
    const Int layer = select((since_d > Int(0)) | ~c.specular, min(since_d + Int(1), Int(path::k_layers)), Int(0));
    const Mask last = over_limits(settings, n.depth);
    n.flags = ray_kind(c) | (state << path::k_state_shift) | (layer << path::k_layer_shift) |
              select(last, Int(path::k_flag_last), Int(0));
    if (settings.transparent_film && settings.transparent_glass) {
        // Clear glass lets the background's transparency through, as Cycles' Transparent Glass.
        const float roughness = settings.transparent_roughness;
        const Mask clear = c.transmitted & ~c.diffuse & (c.alpha <= Float(roughness * roughness));
        n.flags = n.flags | select(clear, flags & Int(path::k_flag_background), Int(0));
    }
    return n;
}

}  // namespace

path::VertexChunk* Tracer::new_record(int material) {
    const int lobes = scene.materials[material].info.lobes;
    for (int attempt = 0; attempt < 2; ++attempt) {
        const std::size_t mark = scratch.arena.mark();
        auto* chunk = scratch.arena.allocate<path::VertexChunk>(1);
        auto* lobe = scratch.arena.allocate<bsdf::Lobe>(static_cast<std::size_t>(lobes));
        auto* pick = scratch.arena.allocate<Row>(static_cast<std::size_t>(lobes));
        if (chunk && lobe && pick) {
            chunk->next = nullptr;
            chunk->lobe = lobe;
            chunk->pick = pick;
            return chunk;
        }
        // Full: evaluate what is recorded so far and start again.
        scratch.arena.reset(mark);
        add_direct_light();
    }
    return nullptr;
}

void Tracer::write_first_hit(const std::int32_t* list, int n) {
    const nodes::ShadingChunk& s = scratch.shading;
    const Affine& to_camera = scene.geometry.world_to_camera;
    for (int i = 0; i < n; ++i) {
        const int path = now->path[list[i]];
        if (result.depth[path] < 1e10f) continue;
        const Float3 p = to_camera.point({s.position[0][i], s.position[1][i], s.position[2][i]});
        result.depth[path] = -p.z;
        for (int c = 0; c < 3; ++c) result.normal[c][path] = s.normal[c][i];
    }
}

void Tracer::shade(int material, const std::int32_t* list, int n) {
    const trace::MaterialView& m = scene.materials[material];
    nodes::SurfaceOutput& out = scratch.surface;
    // First of all: a full arena is emptied by evaluating direct light, which uses the same scratch.
    path::VertexChunk* chunk = new_record(material);
    if (!chunk) return;
    fill_shading(material, list, n);
    out.lobe = chunk->lobe;
    run_program(*m.surface, scratch.shading, out, scratch.registers);
    scratch.counters.vertices += static_cast<std::uint64_t>(n);
    if ((now->flags[list[0]] & nodes::ray_camera) != 0) write_first_hit(list, n);
    if (m.info.has_emission) add_surface_emission(material, list);
    chunk->n = n;
    chunk->lobes = out.lobes;
    chunk->own_normals = chunk->all_sides = m.info.own_normals;
    for (int k = 0; k < out.lobes; ++k) chunk->all_sides |= bsdf::sends_light_through(out.lobe[k].kind);
    scatter(*chunk, list);
    if (scratch.log) log_vertices(*chunk, material);
    if (chunk->lobes > 0 && scene.has_lights) {
        *scratch.last_chunk = chunk;
        scratch.last_chunk = &chunk->next;
    }
}

void Tracer::log_vertices(const path::VertexChunk& chunk, int material) {
    path::PathLog& log = *scratch.log;
    for (int i = 0; i < chunk.n && log.n < log.capacity; ++i) {
        path::LoggedVertex& v = log.vertex[log.n++];
        v.path = chunk.path[i];
        v.material = material;
        v.instance = scratch.shading.instance[i];
        v.triangle = scratch.shading.triangle[i];
        v.flags = chunk.flags[i];
        v.depth = chunk.depth[i];
        v.distance = chunk.distance[i];
        v.lobes = chunk.lobes;
        for (int c = 0; c < 3; ++c) {
            v.position[c] = chunk.position[c][i];
            v.normal[c] = chunk.normal[c][i];
            v.throughput[c] = chunk.throughput[c][i];
        }
        for (int k = 0; k < chunk.lobes; ++k) {
            v.pick[k] = chunk.pick[k][i];
            v.kind[k] = chunk.lobe[k].kind;
        }
    }
}

void Tracer::apply_holdout(Int path, Spectrum throughput, Float holdout, Mask lanes) {
    lanes &= holdout > Float(0.0f);
    if (none(lanes)) return;
    const Float hole = average(throughput) * holdout;
    for (std::uint32_t b = bits(lanes); b != 0; b &= b - 1) {
        const int k = std::countr_zero(b);
        result.alpha[path[k]] -= hole[k];
    }
}

void Tracer::adjust_lobes(path::VertexChunk& chunk, int i, Int flags, Float min_pdf) {
    const scene::Settings& settings = scene.settings;
    const bool drop_caustics = !settings.reflective_caustics || !settings.refractive_caustics;
    if (!drop_caustics && settings.filter_glossy <= 0) return;
    const Mask after_diffuse = (flags & Int(nodes::ray_diffuse)) != Int(0);
    for (int k = 0; k < chunk.lobes; ++k) {
        bsdf::Lobe& lobe = chunk.lobe[k];
        if (drop_caustics) drop_caustic_lobes(settings, lobe, i, after_diffuse);
        if (settings.filter_glossy <= 0) continue;
        const Float blur_pdf = min_pdf * (1.0f / settings.filter_glossy);
        if (any(blur_pdf < Float(1.0f))) blur_glossy(lobe, i, 0.5f * safe_sqrt(1.0f - blur_pdf));
    }
}

/// Largest bend of a pixel's cone at one surface, in pixels.
constexpr float k_most_turn = 2.0f;

Float Tracer::spread_after(const path::VertexChunk& chunk, int i, const Choice& c, Int flags, Float width,
                           Float spread) const {
    const Float blurred = spread + c.blur;
    if (!request.photons) return blurred;
    const Mask bends = c.valid & c.specular & (state_of(flags) == Int(static_cast<int>(path::State::specular)));
    if (none(bends)) return blurred;
    const nodes::ShadingChunk& s = scratch.shading;
    const Mask backfacing = load(s.backfacing + i) > Float(0.5f);
    // A fillet shows all its surroundings in one pixel; a gather that wide would be slow and blur more than it cleans.
    const float most = k_most_turn * scene.camera.pixel_angle;
    const Float curvature = mean_curvature(scene, load(s.instance + i), load(s.triangle + i), backfacing, bends);
    const Float turn = clamp(width * curvature, -most, most);
    Float inv_eta = 1.0f;
    for (int k = 0; k < chunk.lobes; ++k) {
        if (bsdf::sends_light_through(chunk.lobe[k].kind))
            inv_eta = select(c.lobe == Int(k), 1.0f / load(chunk.lobe[k].eta + i), inv_eta);
    }
    // A mirror turns the ray by twice what the normal turns; Snell's law for small angles.
    const Float bent = select(c.transmitted, spread * inv_eta - turn * (1.0f - inv_eta), spread + 2.0f * turn);
    return select(bends, bent + c.blur, blurred);
}

void Tracer::scatter(path::VertexChunk& chunk, const std::int32_t* list) {
    const scene::Settings& settings = scene.settings;
    const nodes::ShadingChunk& s = scratch.shading;
    const nodes::SurfaceOutput& out = scratch.surface;
    const path::RayState& rays = *now;
    path::RayState& to = *next;
    const path::Partition& partition = request.partition;
    const path::ClassSet wanted =
        path::ClassSet(partition.camera | (partition.blend_hits ? bit(path::PathClass::c1) : 0));
    for (int i = 0; i < chunk.n; i += W) {
        const Mask lanes = first_lanes(chunk.n - i);
        const Int ray = load(list + i);
        const Int path = gather(rays.path, ray), flags = gather(rays.flags, ray), depth = gather(rays.depth, ray);
        const Int transparent = gather(rays.transparent, ray);
        const Vec3 tp = load3(rays.throughput, ray);
        const Spectrum throughput{tp.x, tp.y, tp.z};
        const Vec3 p = cardioid::CD_ISA_NS::load3(s.position, i),
                   ng = cardioid::CD_ISA_NS::load3(s.normal_geometric, i);
        const Vec3 n = cardioid::CD_ISA_NS::load3(s.normal, i), wo = cardioid::CD_ISA_NS::load3(s.wo, i);
        const Float t = load(s.ray_length + i);
        const Float min_pdf = gather(rays.min_pdf, ray);

        // A holdout cuts its hole into the view alone: bounced light meets the object itself, as in Cycles.
        const Mask background = (flags & Int(path::k_flag_background)) != Int(0);
        Mask held = mask_of(false);
        if (scene.any_holdout) held = background & (gather(scene.instances.holdout, load(s.instance + i)) != Int(0));
        apply_holdout(path, throughput, select(held, Float(1.0f), load(out.holdout + i)), lanes & background);

        adjust_lobes(chunk, i, flags, min_pdf);
        const Spectrum transparency = load_rgb(out.transparency, i);
        DetailSum detail;
        const bool wants_detail = request.layers && any(lanes & (scatterings_since_d(flags) == Int(0)));
        const Float pick_through =
            choose_by_albedo(chunk, i, wo, transparency, settings.caustic_roughness, wants_detail ? &detail : nullptr);

        const Mask last = (flags & Int(path::k_flag_last)) != Int(0);
        const Mask alive = lanes & ~held;
        const Mask scatters = alive & ~last;
        cardioid::CD_ISA_NS::store3(chunk.position, i, p);
        cardioid::CD_ISA_NS::store3(chunk.normal_geometric, i, ng);
        cardioid::CD_ISA_NS::store3(chunk.normal, i, n);
        cardioid::CD_ISA_NS::store3(chunk.wo, i, wo);
        store_rgb(chunk.throughput, i, select(scatters, throughput, Spectrum(0.0f)));
        store(chunk.distance + i, t);
        store(chunk.path + i, path);
        store(chunk.flags + i, flags);
        store(chunk.depth + i, depth);
        const Int event = byte_of(depth, 0) + transparent;
        store(chunk.event + i, event);

        const Int seed = gather(scratch.pixel_seed, path), index = gather(scratch.sample_index, path);
        const Vec2 u = sample_pair(seed, index, event_dimension(event, pair_bsdf));
        const Vec2 chance = sample_pair(seed, index, event_dimension(event, pair_chance));
        Choice c = sample_bsdf(chunk, pick_through, i, wo, ng, u, chance.y, settings, Transport::radiance, alive);
        c.valid &= scatters & (c.pdf > Float(0.0f));
        if (wants_detail) {
            add_features(chunk, i, detail, flags, scatters);
            mark_incident(chunk, i, c, flags, scatters);
        }
        const Float width = gather(rays.width, ray), spread = gather(rays.spread, ray);
        Float merge = gather(rays.merge, ray);
        if (request.photons) merge = mark_gather(chunk, i, c, scatters, footprint(width, spread, t), merge);

        Spectrum carried = throughput * c.f * (1.0f / max(c.pdf, 1e-37f));
        NextPath path_next = advance(settings, flags, depth, c);
        if (wanted != path::k_all_classes) c.valid &= can_reach(state_of(path_next.flags), wanted);
        // Roulette from the third vertex. The square root keeps more paths than it costs: 17 % less variance for 5 % more time in
        // the Cornell box.
        const Mask gamble = c.valid & (byte_of(path_next.depth, 0) > Int(2));
        const Float survive = select(gamble, min(sqrt(max_component(carried)), 0.95f), Float(1.0f));
        c.valid &= chance.x < survive;
        carried = carried * (1.0f / max(survive, 1e-37f));

        const Mask passes = c.through & (transparent < Int(settings.max_transparent_bounces));
        const Spectrum passed = throughput * transparency * (1.0f / max(pick_through, 1e-37f));
        const Mask go = c.valid | passes;
        if (none(go)) continue;
        // Rough specular lobes after a D are not connected to lamps, so that their hits count in full.
        const Mask unconnected =
            c.delta | (c.specular & (state_of(flags) != Int(static_cast<int>(path::State::specular))));
        const Vec3 from = chunk.all_sides ? Vec3{0.0f, 0.0f, 0.0f} : n;
        RayLaneState r;
        r.origin = select(passes, load3(rays.origin, ray), offset_origin(p, ng, c.wi, t));
        r.direction = select(passes, -wo, c.wi);
        r.t_min = select(passes, t + offset_step(p, t), Float(0.0f));
        r.throughput = select(passes, passed, carried);
        r.pdf = select(passes, gather(rays.pdf, ray), select(unconnected, Float(-1.0f), c.pdf));
        r.from_normal = select(passes, load3(rays.from_normal, ray), from);
        r.width = select(passes, width, width + spread * t);
        r.spread = select(passes, spread, spread_after(chunk, i, c, flags, width + spread * t, spread));
        r.min_pdf = select(passes | c.delta, min_pdf, min(min_pdf, c.pdf));
        r.merge = merge;
        r.path = path;
        r.flags = select(passes, flags, path_next.flags);
        r.depth = select(passes, depth, path_next.depth);
        r.transparent = transparent + select(passes, Int(1), Int(0));
        append_ray(to, r, go);
    }
}

}  // namespace cardioid::CD_ISA_NS
