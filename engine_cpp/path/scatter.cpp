// SPDX-License-Identifier: GPL-3.0-or-later
// Where paths go on from the vertices of a chunk.
#include "path/bsdf_choice.h"
#include "path/fast_gi.h"
#include "path/media.h"
#include "path/terminator.h"
#include "trace/curvature.h"

namespace cardioid::CD_ISA_NS {

namespace {

/// Depth counters and flags after a scattering event.
struct NextPath {
    Int flags, depth;
};

NextPath advance(const scene::Settings& settings, Int flags, Int depth, const Choice& c) {
    NextPath n;
    n.depth = count_bounce(depth, c);
    const Int state = step_state(state_of(flags), c.specular), since_d = scatterings_since_d(flags);
    const Int layer = select((since_d > Int(0)) | ~c.specular, min(since_d + Int(1), Int(path::k_layers)), Int(0));
    Mask last = over_limits(settings, n.depth);
    if (replaces_bounces(settings)) last |= is_short_ray(settings, n.depth);
    n.flags = ray_kind(c) | (state << path::k_state_shift) | (layer << path::k_layer_shift) |
              select(last, Int(path::k_flag_last), Int(0)) |
              select(c.diffuse, Int(path::k_flag_after_diffuse), flags & Int(path::k_flag_after_diffuse));
    if (settings.transparent_film && settings.transparent_glass) {
        // Clear glass lets the background's transparency through, as Cycles' Transparent Glass.
        const float roughness = settings.transparent_roughness;
        const Mask clear = c.transmitted & ~c.diffuse & (c.alpha <= Float(roughness * roughness));
        n.flags = n.flags | select(clear, flags & Int(path::k_flag_background), Int(0));
    }
    return n;
}

}  // namespace

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
        if (bsdf::refracts(chunk.lobe[k].kind))
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
        const Float t = gather(scratch.hits.t, ray);
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
        const Int event = event_of(depth, transparent);
        store(chunk.event + i, event);
        keep_terminator(scene, s, chunk, i);

        const Int seed = gather(scratch.pixel_seed, path), index = gather(scratch.sample_index, path);
        const Vec2 u = sample_pair(seed, index, event_dimension(event, pair_bsdf));
        const Vec2 chance = sample_pair(seed, index, event_dimension(event, pair_chance));
        Choice c = sample_bsdf(chunk, pick_through, i, wo, ng, u, chance.y, settings, Transport::radiance, alive);
        c.valid &= scatters & (c.pdf > Float(0.0f));
        if (scene.has_volumes) record_media(chunk, i, ray);
        if (wants_detail) add_features(chunk, i, detail, flags, scatters);
        if (any(c.below)) enter_subsurface(chunk, i, ray, c, scatters);
        const Spectrum passed = throughput * transparency * (1.0f / max(pick_through, 1e-37f));
        send_on(chunk, i, ray, c, scatters, chance.x, passed);
    }
}

void Tracer::record_media(path::VertexChunk& chunk, int i, Int ray) {
    path::MediaRecord& media = *chunk.media;
    store_media(media, i, load_media(*now, ray));
    store(media.scatterings + i, scatterings_in_media(gather(now->transparent, ray)));
    store(media.surface_instance + i, load(scratch.shading.instance + i));
    store(media.backfacing + i, select(load(scratch.shading.backfacing + i) > Float(0.5f), Int(1), Int(0)));
}

void Tracer::send_on(path::VertexChunk& chunk, int i, Int ray, Choice& c, Mask scatters, Float chance,
                     Spectrum passed) {
    const scene::Settings& settings = scene.settings;
    const path::RayState& rays = *now;
    const Int flags = load(chunk.flags + i), depth = load(chunk.depth + i), transparent = gather(rays.transparent, ray);
    const Float t = load(chunk.distance + i), min_pdf = gather(rays.min_pdf, ray);
    const Vec3 p = cardioid::CD_ISA_NS::load3(chunk.position, i),
               ng = cardioid::CD_ISA_NS::load3(chunk.normal_geometric, i), wo = cardioid::CD_ISA_NS::load3(chunk.wo, i),
               n = cardioid::CD_ISA_NS::load3(chunk.normal, i);
    if (request.layers) mark_incident(chunk, i, c, flags, scatters);
    const Float width = gather(rays.width, ray), spread = gather(rays.spread, ray);
    Float merge = gather(rays.merge, ray);
    if (request.photons) merge = mark_gather(chunk, i, c, scatters, footprint(width, spread, t), merge);

    Spectrum carried = load_rgb(chunk.throughput, i) * c.f * (1.0f / max(c.pdf, 1e-37f));
    NextPath path_next = advance(settings, flags, depth, c);
    if (wanted() != path::k_all_classes) c.valid &= can_reach(state_of(path_next.flags), wanted());
    const Float survive = survival(carried, path_next.depth, c.valid);
    c.valid &= chance < survive;
    carried = carried * (1.0f / max(survive, 1e-37f));

    const Mask passes =
        c.through & (chunk.boundary ? bounds_passed(transparent) < Int(k_most_bounds)
                                    : surfaces_passed(transparent) < Int(settings.max_transparent_bounces));
    const Mask go = c.valid | passes;
    if (none(go)) return;
    // Rough specular lobes after a D are not connected to lamps, so that their hits count in full.
    const Mask unconnected = c.delta | (c.specular & (state_of(flags) != Int(static_cast<int>(path::State::specular))));
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
    r.path = load(chunk.path + i);
    r.flags = select(passes, flags, path_next.flags);
    r.depth = select(passes, depth, path_next.depth);
    r.transparent = transparent + select(passes, Int(chunk.boundary ? 1 << 16 : 1), Int(0));
    if (scene.has_volumes) {
        MediaLanes media = load_media(*chunk.media, i);
        if (chunk.media->surface_material >= 0)
            cross_surface(media, load(chunk.media->surface_instance + i), Int(chunk.media->surface_material),
                          load(chunk.media->backfacing + i) != Int(0), passes | (c.valid & c.transmitted));
        append_media(*next, media, go);
    }
    append_ray(*next, r, go);
}

}  // namespace cardioid::CD_ISA_NS
