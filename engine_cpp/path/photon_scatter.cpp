// SPDX-License-Identifier: GPL-3.0-or-later
#include "path/media.h"
#include "path/photon_fields.h"
#include "path/photons.h"

namespace cardioid::CD_ISA_NS {

namespace {

Int class_to_store(Int state) {
    Int c(0);
    for (int s = 0; s < path::k_photon_states; ++s) {
        const auto path_class = path::stored_class(static_cast<path::PhotonState>(s));
        c = select(state == Int(s), Int(static_cast<int>(path_class)), c);
    }
    return c;
}

/// Octahedral 2 × 16 bits, as trace/octahedral.h.
Int pack_direction(Vec3 d) {
    const Float s = 1.0f / max(abs(d.x) + abs(d.y) + abs(d.z), 1e-30f);
    const Float x = d.x * s, y = d.y * s;
    const Mask below = d.z < Float(0.0f);
    const Float px = select(below, copysign(1.0f - abs(y), x), x), py = select(below, copysign(1.0f - abs(x), y), y);
    const auto quantise = [](Float v) { return to_int(fma(clamp(v, -1.0f, 1.0f), 32767.0f, 32767.5f)); };
    return quantise(px) | (quantise(py) << 16);
}

/// Lanes where some D lobe could collect light.
Mask has_d_lobe(const path::VertexChunk& chunk, int i, float caustic_roughness) {
    Mask m = mask_of(false);
    for (int k = 0; k < chunk.lobes; ++k) {
        const bsdf::Lobe& lobe = chunk.lobe[k];
        const Spectrum w = load_rgb(lobe.weight, i);
        m |= ~is_specular(lobe, i, caustic_roughness) & (max_component(w) > Float(0.0f));
    }
    return m;
}

/// Bump depends on the width of a pixel: that of a camera ray straight to the point.
void set_footprint(const trace::CameraView& camera, nodes::ShadingChunk& s) {
    const Float3 eye = camera.desc.transform.translation();
    for (int i = 0; i < s.n; i += W) {
        const Vec3 d = cardioid::CD_ISA_NS::load3(s.position, i) - Vec3{eye.x, eye.y, eye.z};
        const bool ortho = camera.desc.kind == scene::CameraKind::orthographic;
        store(s.footprint + i, ortho ? Float(camera.pixel_x) : camera.pixel_x * length(d));
    }
}

/// Lanes whose lobe sees what the photon came from.
Mask sees_origin(const path::VertexChunk& chunk, const Choice& c, Int seen_by, Vec3 ng) {
    Mask seen = mask_of(true);
    for (int k = 0; k < chunk.lobes; ++k) {
        const Int bit = lobe_visibility(chunk.lobe[k].kind, c.wi, ng);
        seen = select(c.lobe == Int(k), (bit & seen_by) != Int(0), seen);
    }
    return seen;
}

}  // namespace

void PhotonWalk::keep(Int ray, int i, Int path_class, Mask lanes) {
    const path::RayState& rays = *now;
    const nodes::ShadingChunk& s = scratch.shading;
    const Int direction = pack_direction(cardioid::CD_ISA_NS::load3(s.wo, i));
    const Int normal = pack_direction(cardioid::CD_ISA_NS::load3(s.normal_geometric, i));
    for (std::uint32_t b = bits(lanes); b != 0; b &= b - 1) {
        const int k = std::countr_zero(b);
        const int r = ray[k];
        photon::Photon& q = request.stored[stored++];
        for (int c = 0; c < 3; ++c) {
            q.position[c] = s.position[c][i + k];
            q.flux[c] = rays.throughput[c][r];
        }
        q.direction = static_cast<std::uint32_t>(direction[k]);
        q.normal = static_cast<std::uint32_t>(normal[k]);
        q.depth = static_cast<std::uint32_t>(rays.depth[r]);
        q.density = rays.merge[r];
        q.source = request.first + static_cast<std::uint32_t>(rays.path[r]);
        const auto seen_by = static_cast<std::uint32_t>(rays.flags[r]) >> path::k_visibility_shift & 0xffu;
        const auto in_media = static_cast<std::uint32_t>(rays.transparent[r]) >> 24;
        q.path_class = static_cast<std::uint32_t>(path_class[k]) | seen_by << k_photon_visibility_shift |
                       in_media << k_photon_media_shift;
    }
}

void PhotonWalk::shade(int material, const std::int32_t* list, int n) {
    const trace::MaterialView& m = scene.materials[material];
    nodes::SurfaceOutput& out = scratch.surface;
    scratch.arena.reset();
    const auto lobes = static_cast<std::size_t>(room_for_lobes(m.info));
    auto* chunk = scratch.arena.allocate<path::VertexChunk>(1);
    auto* lobe = scratch.arena.allocate<bsdf::Lobe>(lobes);
    auto* pick = scratch.arena.allocate<Row>(lobes);
    fill_shading(material, list, n);
    if (m.info.has_bump) set_footprint(scene.camera, scratch.shading);
    out.lobe = lobe;
    run_program(*m.surface, scratch.shading, out, scratch.registers);
    if (m.info.sets_normal) take_bumped_normal(n);
    chunk->n = n;
    chunk->lobes = out.lobes;
    chunk->lobe = lobe;
    chunk->pick = pick;
    chunk->own_normals = m.info.own_normals;
    chunk->ggx_bump_shadow = m.info.ggx_bump_shadow;
    chunk->boundary = is_boundary(m);
    surface_medium = m.volume ? material : -1;
    // Camera paths take subsurface scattering after a diffuse bounce for diffuse; photons always do.
    if (m.info.has_subsurface) add_twins(*chunk, list, true);
    for (int c = 0; c < 3; ++c) {
        for (int i = 0; i < n; i += W) store(chunk->normal[c] + i, load(scratch.shading.normal[c] + i));
    }
    scatter(*chunk, list);
}

void PhotonWalk::scatter(path::VertexChunk& chunk, const std::int32_t* list) {
    const scene::Settings& settings = scene.settings;
    const nodes::ShadingChunk& s = scratch.shading;
    const path::RayState& rays = *now;
    for (int i = 0; i < chunk.n; i += W) {
        const Mask lanes = first_lanes(chunk.n - i);
        const Int ray = load(list + i);
        const Int path = cardioid::CD_ISA_NS::gather(rays.path, ray),
                  flags = cardioid::CD_ISA_NS::gather(rays.flags, ray);
        const Int depth = cardioid::CD_ISA_NS::gather(rays.depth, ray), state = state_of(flags);
        const Int transparent = cardioid::CD_ISA_NS::gather(rays.transparent, ray);
        const Vec3 tp = load3(rays.throughput, ray);
        const Spectrum flux{tp.x, tp.y, tp.z};
        const Vec3 p = cardioid::CD_ISA_NS::load3(s.position, i),
                   ng = cardioid::CD_ISA_NS::load3(s.normal_geometric, i), wo = cardioid::CD_ISA_NS::load3(s.wo, i);
        const Float t = load(s.ray_length + i);

        // Before roulette and before a way on is chosen: the full flux that arrives.
        const Int path_class = class_to_store(state);
        const Mask stores =
            lanes & in_set(path_class, request.classes) & has_d_lobe(chunk, i, settings.caustic_roughness);
        if (any(stores)) keep(ray, i, path_class, stores);

        const Spectrum transparency = load_rgb(scratch.surface.transparency, i);
        const Float pick_through = choose_by_albedo(chunk, i, wo, transparency);
        const Int event = event_of(depth, transparent);
        const Int seed = cardioid::CD_ISA_NS::gather(scratch.pixel_seed, path),
                  index = cardioid::CD_ISA_NS::gather(scratch.sample_index, path);
        const Vec2 u = sample_pair(seed, index, event_dimension(event, pair_bsdf));
        const Vec2 chance = sample_pair(seed, index, event_dimension(event, pair_chance));
        Choice c = sample_bsdf(chunk, pick_through, i, wo, ng, u, chance.y, settings, Transport::flux, lanes);
        c.valid &= c.pdf > Float(0.0f);

        const Int next_state = step_photon(state, c.specular);
        c.valid &= may_be_stored(next_state, request.classes);
        const Int seen_by = (flags >> path::k_visibility_shift) & Int(0xff);
        if (scene.is_limited) c.valid &= sees_origin(chunk, c, seen_by, ng);
        // The vertex next to the light does not count by type, as on camera paths.
        const Mask first = state == Int(static_cast<int>(path::PhotonState::start));
        const Int next_depth = select(first, depth + Int(1), count_bounce(depth, c));
        c.valid &= ~over_limits(settings, next_depth);

        Spectrum carried = flux * c.f * (1.0f / max(c.pdf, 1e-37f));
        const Float most = max(max(abs(carried.r), abs(carried.g)), abs(carried.b));
        // Roulette from the third vertex, by the share of the flux at birth that is left.
        const Mask gamble = c.valid & (byte_of(next_depth, 0) > Int(2));
        const Float birth = cardioid::CD_ISA_NS::gather(rays.min_pdf, ray);
        const Float survive = select(gamble, min(most / max(birth, 1e-37f), 0.95f), Float(1.0f));
        c.valid &= chance.x < survive;
        carried = carried * (1.0f / max(survive, 1e-37f));
        c.valid &= most > Float(0.0f);
        const Mask sane = is_finite(carried.r) & is_finite(carried.g) & is_finite(carried.b);
        scratch.counters.photons_dropped += static_cast<std::uint64_t>(count(c.valid & ~sane));
        c.valid &= sane;

        const Mask passes = lanes & c.through &
                            (chunk.boundary ? bounds_passed(transparent) < Int(k_most_bounds)
                                            : surfaces_passed(transparent) < Int(settings.max_transparent_bounces));
        const Spectrum passed = flux * transparency * (1.0f / max(pick_through, 1e-37f));
        const Mask go = c.valid | passes;
        if (none(go)) continue;
        const Int own = cardioid::CD_ISA_NS::gather(scene.instances.visibility, load(s.instance + i));
        RayLaneState r;
        r.origin = select(passes, load3(rays.origin, ray), offset_origin(p, ng, c.wi, t));
        r.direction = select(passes, -wo, c.wi);
        r.from_normal = {0.0f, 0.0f, 0.0f};
        r.t_min = select(passes, t + offset_step(p, t), Float(0.0f));
        r.throughput = select(passes, passed, carried);
        r.pdf = r.width = r.spread = 0.0f;
        r.min_pdf = birth;
        r.merge = cardioid::CD_ISA_NS::gather(rays.merge, ray);
        r.path = path;
        r.flags = select(passes, flags,
                         Int(nodes::ray_diffuse | nodes::ray_reflection) | (next_state << path::k_state_shift) |
                             (own << path::k_visibility_shift));
        r.depth = select(passes, depth, next_depth);
        r.transparent = transparent + select(passes, Int(chunk.boundary ? 1 << 16 : 1), Int(0));
        if (scene.has_volumes) {
            MediaLanes media = load_media(rays, ray);
            if (surface_medium >= 0)
                cross_surface(media, load(s.instance + i), Int(surface_medium), load(s.backfacing + i) > Float(0.5f),
                              passes | (c.valid & c.transmitted));
            append_media(*next, media, go);
        }
        append_ray(*next, r, go);
    }
}

}  // namespace cardioid::CD_ISA_NS
