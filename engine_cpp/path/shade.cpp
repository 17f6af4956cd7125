// SPDX-License-Identifier: GPL-3.0-or-later
// One chunk: rays that hit the same material. Runs its program, keeps the vertices as a record, samples where paths go on.
#include "bsdf/kernels.h"
#include "path/tracer.h"

namespace cardioid::CD_ISA_NS {

namespace {

constexpr std::int32_t k_ray_flags = 0xff;

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

struct Choice {
    Vec3 wi;
    Spectrum f{0.0f};
    Float pdf = 0.0f;
    Mask valid, delta, transmitted, diffuse, specular, through;
    Float blur = 0.0f;   ///< how far the lobe widens the pixel's cone
    Float alpha = 1.0f;  ///< of a glossy lobe
    Int lobe;
};

/// Chooses a lobe by its albedo (or the way straight through) with u.x and samples it with what is left of u.x and u.y: each
/// lobe's share of a stratified sequence stays stratified. f and pdf are those of all lobes of the same class.
/// `side` chooses between reflection and refraction.
Choice sample_bsdf(const path::VertexChunk& chunk, const Float transparency_pick, int i, Vec3 wo, Vec3 ng, Vec2 u,
                   Float side, float caustic_roughness, Mask active) {
    Choice c;
    c.wi = ng;
    c.valid = c.delta = c.transmitted = c.diffuse = c.specular = mask_of(false);
    c.lobe = Int(-1);
    Float sum = 0.0f;
    for (int k = 0; k < chunk.lobes; ++k) {
        const bsdf::Lobe& lobe = chunk.lobe[k];
        const Float p = load(chunk.pick[k] + i);
        const Mask here = active & (u.x >= sum) & (u.x < sum + p);
        const Float rest = clamp((u.x - sum) / max(p, 1e-30f), 0.0f, 0.99999994f);
        sum += p;
        if (none(here)) continue;
        LobeSample s = sample_lobe(lobe, i, wo, ng, {rest, u.y, side}, here);
        if (chunk.own_normals && bsdf::is_diffuse_kind(lobe.kind))
            s.f_cos = s.f_cos * bump_shadow(chunk, lobe, i, s.wi);
        const Mask ok = here & s.valid;
        c.wi = select(ok, s.wi, c.wi);
        c.f = select(ok, s.f_cos, c.f);
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
        c.specular |= ok & is_specular(lobe, i, caustic_roughness);
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
        LobeEval e = eval_lobe(lobe, i, wo, c.wi, ng);
        if (chunk.own_normals && bsdf::is_diffuse_kind(lobe.kind))
            e.f_cos = e.f_cos * bump_shadow(chunk, lobe, i, c.wi);
        c.f = select(here, c.f + e.f_cos, c.f);
        c.pdf = select(here, c.pdf + e.pdf * load(chunk.pick[k] + i), c.pdf);
    }
    return c;
}

/// Depth counters and flags after a scattering event.
struct NextPath {
    Int flags, depth;
};

NextPath advance(const scene::Settings& settings, Int flags, Int depth, const Choice& c) {
    const Mask reflected = ~c.transmitted;
    const Int one_diffuse = select(reflected & c.diffuse, Int(1 << 8), Int(0));
    const Int one_glossy = select(reflected & ~c.diffuse, Int(1 << 16), Int(0));
    const Int one_transmission = select(c.transmitted, Int(1 << 24), Int(0));
    NextPath n;
    n.depth = depth + Int(1) + one_diffuse + one_glossy + one_transmission;
    const Mask last = (byte_of(n.depth, 0) > Int(settings.max_bounces)) |
                      (byte_of(n.depth, 1) > Int(settings.max_diffuse_bounces)) |
                      (byte_of(n.depth, 2) > Int(settings.max_glossy_bounces)) |
                      (byte_of(n.depth, 3) > Int(settings.max_transmission_bounces));
    Int kind = select(c.diffuse, Int(nodes::ray_diffuse), Int(nodes::ray_glossy));
    kind = select(c.delta, Int(nodes::ray_glossy | nodes::ray_singular), kind);
    kind = kind | select(c.transmitted, Int(nodes::ray_transmission), Int(nodes::ray_reflection));
    const Int state = step_state(state_of(flags), c.specular);
    n.flags = kind | (state << path::k_state_shift) | select(last, Int(path::k_flag_last), Int(0));
    if (settings.transparent_film && settings.transparent_glass) {
        // Clear glass lets the background's transparency through, as Cycles' Transparent Glass.
        const float roughness = settings.transparent_roughness;
        const Mask clear = c.transmitted & ~c.diffuse & (c.alpha <= Float(roughness * roughness));
        n.flags = n.flags | select(clear, flags & Int(path::k_flag_background), Int(0));
    }
    return n;
}

}  // namespace

void Tracer::fill_shading(int material, const std::int32_t* list, int n) {
    nodes::ShadingChunk& s = scratch.shading;
    const nodes::ProgramInfo& info = scene.materials[material].info;
    const path::RayState& rays = *now;
    const path::HitState& hits = scratch.hits;
    s.n = n;
    s.geometry = &scene.geometry;
    s.material_pass_index = scene.materials[material].pass_index;
    for (int i = 0; i < n; i += W) {
        const Int ray = load(list + i);
        const Int instance = gather(hits.instance, ray), triangle = gather(hits.triangle, ray);
        const Float t = gather(hits.t, ray), u = gather(hits.u, ray), v = gather(hits.v, ray);
        const Vec3 d = load3(rays.direction, ray);
        const Vec3 p = load3(rays.origin, ray) + d * t;
        const SurfaceNormals normals = surface_normals(scene, instance, triangle, load3(hits.ng, ray), u, v, -d);
        cardioid::CD_ISA_NS::store3(s.position, i, p);
        cardioid::CD_ISA_NS::store3(s.normal_geometric, i, normals.ng);
        cardioid::CD_ISA_NS::store3(s.normal, i, normals.n);
        cardioid::CD_ISA_NS::store3(s.wo, i, -d);
        store(s.ray_length + i, t);
        store(s.backfacing + i, select(normals.backfacing, Float(1.0f), Float(0.0f)));
        store(s.triangle + i, triangle);
        store(s.instance + i, instance);
        store(s.mesh + i, gather(scene.instances.mesh, instance));
        const Int flags = gather(rays.flags, ray);
        store(reinterpret_cast<std::int32_t*>(s.ray_flags) + i, flags & Int(k_ray_flags));
        store(s.footprint + i, gather(rays.width, ray) + gather(rays.spread, ray) * t);
        if (info.needs_triangle_frame || info.has_bump) {
            Vec3 e1, e2;
            triangle_edges(scene, instance, triangle, e1, e2);
            cardioid::CD_ISA_NS::store3(s.dp_du, i, e1);
            cardioid::CD_ISA_NS::store3(s.dp_dv, i, e2);
            store(s.barycentric_u + i, u);
            store(s.barycentric_v + i, v);
            store(s.time + i, Float(0.0f));
        }
        if (info.needs_light_path) {
            const Int depth = gather(rays.depth, ray);
            store(s.ray_depth + i, to_float(byte_of(depth, 0)));
            store(s.diffuse_depth + i, to_float(byte_of(depth, 1)));
            store(s.glossy_depth + i, to_float(byte_of(depth, 2)));
            store(s.transmission_depth + i, to_float(byte_of(depth, 3)));
            store(s.transparent_depth + i, to_float(gather(rays.transparent, ray)));
        }
    }
}

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

void Tracer::scatter(path::VertexChunk& chunk, const std::int32_t* list) {
    const scene::Settings& settings = scene.settings;
    const nodes::ShadingChunk& s = scratch.shading;
    const nodes::SurfaceOutput& out = scratch.surface;
    const path::RayState& rays = *now;
    path::RayState& to = *next;
    const bool drop_caustics = !settings.reflective_caustics || !settings.refractive_caustics;
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
        const Float holdout = select(held, Float(1.0f), load(out.holdout + i));
        if (any(lanes & background & (holdout > Float(0.0f)))) {
            const Float alpha = gather(result.alpha, path) - average(throughput) * holdout;
            for (int k = 0; k < W && i + k < chunk.n; ++k) {
                if (bits(background) >> k & 1u) result.alpha[path[k]] = alpha[k];
            }
        }

        // Probabilities of the lobes and of going straight through, by albedo.
        const Mask after_diffuse = (flags & Int(nodes::ray_diffuse)) != Int(0);
        const Spectrum transparency = load_rgb(out.transparency, i);
        Float total = 0.0f;
        for (int k = 0; k < chunk.lobes; ++k) {
            bsdf::Lobe& lobe = chunk.lobe[k];
            if (drop_caustics) drop_caustic_lobes(settings, lobe, i, after_diffuse);
            if (settings.filter_glossy > 0) {
                const Float blur_pdf = min_pdf * (1.0f / settings.filter_glossy);
                if (any(blur_pdf < Float(1.0f))) blur_glossy(lobe, i, 0.5f * safe_sqrt(1.0f - blur_pdf));
            }
            const Float albedo = max(average(lobe_albedo(lobe, i, wo)), 0.0f);
            store(chunk.pick[k] + i, albedo);
            total += albedo;
        }
        const Float albedo_through = max(average(transparency), 0.0f);
        total += albedo_through;
        const Float inv_total = select(total > Float(0.0f), 1.0f / total, Float(0.0f));
        for (int k = 0; k < chunk.lobes; ++k) store(chunk.pick[k] + i, load(chunk.pick[k] + i) * inv_total);

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
        Choice c =
            sample_bsdf(chunk, albedo_through * inv_total, i, wo, ng, u, chance.y, settings.caustic_roughness, alive);
        c.valid &= scatters & (c.pdf > Float(0.0f));

        Spectrum carried = throughput * c.f * (1.0f / max(c.pdf, 1e-37f));
        NextPath path_next = advance(settings, flags, depth, c);
        // Roulette from the third vertex.
        const Mask gamble = c.valid & (byte_of(path_next.depth, 0) > Int(2));
        const Float survive = select(gamble, min(max_component(carried), 0.95f), Float(1.0f));
        c.valid &= chance.x < survive;
        carried = carried * (1.0f / max(survive, 1e-37f));

        const Mask passes = c.through & (transparent < Int(settings.max_transparent_bounces));
        const Spectrum passed = throughput * transparency * (1.0f / max(albedo_through * inv_total, 1e-37f));
        const Mask go = c.valid | passes;
        if (none(go)) continue;
        const Vec3 origin = select(passes, load3(rays.origin, ray), offset_origin(p, ng, c.wi, t));
        const Vec3 direction = select(passes, -wo, c.wi);
        const Spectrum weight = select(passes, passed, carried);
        const Float width = gather(rays.width, ray), spread = gather(rays.spread, ray);
        const int k = to.n;
        append(to.origin[0], k, origin.x, go);
        append(to.origin[1], k, origin.y, go);
        append(to.origin[2], k, origin.z, go);
        append(to.direction[0], k, direction.x, go);
        append(to.direction[1], k, direction.y, go);
        append(to.direction[2], k, direction.z, go);
        append(to.t_min, k, select(passes, t + offset_step(p, t), Float(0.0f)), go);
        append(to.throughput[0], k, weight.r, go);
        append(to.throughput[1], k, weight.g, go);
        append(to.throughput[2], k, weight.b, go);
        // Rough specular lobes after a D are not connected to lamps, so that their hits count in full.
        const Mask unconnected =
            c.delta | (c.specular & (state_of(flags) != Int(static_cast<int>(path::State::specular))));
        append(to.pdf, k, select(passes, gather(rays.pdf, ray), select(unconnected, Float(-1.0f), c.pdf)), go);
        const Vec3 from = chunk.all_sides ? Vec3{0.0f, 0.0f, 0.0f} : n;
        const Vec3 from_normal = select(passes, load3(rays.from_normal, ray), from);
        append(to.from_normal[0], k, from_normal.x, go);
        append(to.from_normal[1], k, from_normal.y, go);
        append(to.from_normal[2], k, from_normal.z, go);
        append(to.width, k, select(passes, width, width + spread * t), go);
        append(to.spread, k, select(passes, spread, spread + c.blur), go);
        append(to.min_pdf, k, select(passes | c.delta, min_pdf, min(min_pdf, c.pdf)), go);
        compress_store(to.path + k, path, go);
        compress_store(to.flags + k, select(passes, flags, path_next.flags), go);
        compress_store(to.depth + k, select(passes, depth, path_next.depth), go);
        to.n += compress_store(to.transparent + k, transparent + select(passes, Int(1), Int(0)), go);
    }
}

}  // namespace cardioid::CD_ISA_NS
