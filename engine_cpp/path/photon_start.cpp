// SPDX-License-Identifier: GPL-3.0-or-later
#include "light/emit.h"
#include "path/emitter_point.h"
#include "path/media.h"
#include "path/photons.h"
#include "photon/guide.h"

namespace cardioid::CD_ISA_NS {

namespace {

/// A packet of choices, drawn one by one.
struct EmissionLanes {
    Int emitter;
    Vec2 u_point, u_direction;
    Float density;
};

EmissionLanes draw_emissions(const photon::PhotonGuide& guide, const BirthNumbers& n) {
    alignas(64) std::int32_t emitter[W];
    alignas(64) float u[photon::k_cube][W], density[W];
    for (int k = 0; k < W; ++k) {
        const float place[photon::k_cube] = {n.point.x[k], n.point.y[k], n.direction.x[k], n.direction.y[k]};
        const photon::Emission e = guide.draw(n.choice[k], place);
        emitter[k] = e.emitter;
        density[k] = e.density;
        for (int d = 0; d < photon::k_cube; ++d) u[d][k] = e.u[d];
    }
    return {load(emitter), {load(u[0]), load(u[1])}, {load(u[2]), load(u[3])}, load(density)};
}

}  // namespace

void PhotonWalk::start() {
    path::RayState& rays = *now;
    rays.n = 0;
    for (int i = 0; i < request.count; i += W) {
        const Mask lanes = first_lanes(request.count - i);
        const Int number = Int::of_bits(request.first) + Int(i) + lane_index();
        const BirthNumbers numbers = birth_numbers(request.seed, number);
        store(scratch.pixel_seed + i, numbers.seed);
        store(scratch.sample_index + i, numbers.index);
        const EmissionLanes e = draw_emissions(*request.guide, numbers);
        const PhotonRay r = emit_photon(*scene.lights, e.emitter, e.u_point, e.u_direction, lanes);
        Mask go = lanes & r.valid & (e.density > Float(0.0f));
        Spectrum flux = r.flux * (1.0f / max(e.density, 1e-37f));
        const Mask programmed = go & (r.program >= Int(0));
        if (any(programmed)) {
            ShadedPoint at;
            at.position = select(r.infinite, -r.direction, r.origin);
            at.normal_geometric = at.normal = r.normal;
            at.wo = r.direction;
            at.instance = r.instance;
            at.triangle = r.triangle;
            at.u = r.barycentric_u;
            at.v = r.barycentric_v;
            const Mask lamps = programmed & (e.emitter < Int(scene.lights->lamp_count));
            if (any(lamps)) place_on_lamp(scene, e.emitter, at, lamps);
            const Mask triangles = programmed & (r.instance >= Int(0));
            if (any(triangles)) place_on_triangle(scene, at, triangles);
            const Spectrum emission = shade_points(*this, nodes::Purpose::emission, r.program, at, programmed);
            flux = select(programmed, flux * emission, flux);
        }
        const Float most = max(max(abs(flux.r), abs(flux.g)), abs(flux.b));
        go &= most > Float(0.0f);
        const Mask sane = is_finite(flux.r) & is_finite(flux.g) & is_finite(flux.b);
        scratch.counters.photons_dropped += static_cast<std::uint64_t>(count(go & ~sane));
        go &= sane;
        RayLaneState ray;
        ray.origin = select(r.infinite, r.origin, offset_origin(r.origin, r.normal, r.direction, 0.0f));
        ray.direction = r.direction;
        ray.from_normal = {0.0f, 0.0f, 0.0f};
        ray.throughput = flux;
        ray.t_min = ray.pdf = ray.spread = 0.0f;
        ray.width = r.t_min;
        ray.min_pdf = most;
        ray.merge = r.density * cardioid::CD_ISA_NS::gather(request.emitter_density, select(go, e.emitter, Int(0)));
        ray.path = Int(i) + lane_index();
        const Int seen_by =
            select(r.instance >= Int(0),
                   cardioid::CD_ISA_NS::gather(scene.instances.visibility, max(r.instance, Int(0))), r.visibility);
        ray.flags = Int(nodes::ray_diffuse | nodes::ray_reflection) | (seen_by << path::k_visibility_shift);
        // A lamp that ends early: its photons start with bounces behind them.
        ray.depth = max(Int(scene.settings.max_bounces) - r.max_bounces, Int(0));
        ray.transparent = Int(0);
        if (scene.has_volumes) {
            const MediaLanes media = media_around(scene, ray.origin, go);
            stop_infinite(ray.throughput, r, go);
            append_media(rays, media, go);
        }
        append(scratch.hits.t, rays.n, r.t_max, go);
        append_ray(rays, ray, go);
    }
}

void PhotonWalk::stop_infinite(Spectrum& flux, const PhotonRay& r, Mask lanes) {
    const Mask far = lanes & r.infinite;
    if (!scene.materials[scene.world_program].volume || none(far)) return;
    ShadedPoint at;
    at.position = r.origin;
    at.normal_geometric = at.normal = at.wo = -r.direction;
    const MediumLanes world = medium_at(*this, no_media(), at, 0.5f, far);
    const auto stop = [&](Float& f, Float extinction) { f = select(far & (extinction > Float(0.0f)), Float(0.0f), f); };
    stop(flux.r, world.extinction.r);
    stop(flux.g, world.extinction.g);
    stop(flux.b, world.extinction.b);
}

void PhotonWalk::drop_early_hits() {
    path::HitState& hits = scratch.hits;
    for (int i = 0; i < now->n; i += W) {
        const Mask early = load(hits.t + i) < load(now->width + i);
        store(hits.material + i, select(early, Int(scene.material_count), load(hits.material + i)));
    }
}

}  // namespace cardioid::CD_ISA_NS
