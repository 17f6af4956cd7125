// SPDX-License-Identifier: GPL-3.0-or-later
// Light that rays found by themselves: emissive surfaces, lamps on the way, the world. MIS against next-event estimation.
#include "light/emit.h"
#include "path/emitter_point.h"
#include "path/fast_gi.h"
#include "path/media.h"

#include <bit>

namespace cardioid::CD_ISA_NS {

namespace {
/// Weight of a hit whose direction had density `pdf` (-1: nothing to weigh against), found by light sampling with `light_pdf`.
Float hit_weight(Float pdf, Float light_pdf) {
    return select(pdf < Float(0.0f), Float(1.0f), power_heuristic(pdf, light_pdf));
}
}  // namespace

Mask Tracer::shares_with_photons(Int ray, Mask active) const {
    if (request.partition.photons == 0) return mask_of(false);
    return active & ~in_set(state_of(gather(now->flags, ray)), request.partition.camera);
}

Float Tracer::caustic_share(Int ray, Float photon_density, Mask active) const {
    const Mask brought = active & (photon_density > Float(0.0f));
    const Mask c1 = state_of(gather(now->flags, ray)) == Int(static_cast<int>(path::State::caustic_hit));
    const Float merge = gather(now->merge, ray), photons = photon_density * request.photons->per_path;
    const Float blended = merge / max(merge + photons, 1e-37f);
    const Float share = select(c1 & mask_of(request.partition.blend_hits), blended, Float(0.0f));
    return select(brought, share, Float(1.0f));
}

void Tracer::deposit(Int ray, Spectrum radiance, Float share, Mask active) {
    const path::RayState& rays = *now;
    const Vec3 tp = load3(rays.throughput, ray);
    Spectrum c = Spectrum{tp.x, tp.y, tp.z} * radiance;
    // Light found by a hit belongs to the bounce before it.
    const Int bounce = byte_of(gather(rays.depth, ray), 0) - Int(1);
    c = c * clamp_factor(c, bounce, scene.settings.clamp_direct, scene.settings.clamp_indirect);
    const Int flags = gather(rays.flags, ray);
    const Int path_of = gather(rays.path, ray), state = state_of(flags);
    Light light{c * share};
    if (request.layers) {
        light.incident = demodulated(path_of, light.radiance);
        // 0 before x_d: k_no_layer.
        light.layer = scatterings_since_d(flags) - Int(1);
    }
    add_light(scratch.met, request.layers, state, path_of, light, active);
    if (!request.photons) return;
    const Mask hits = active & (state == Int(static_cast<int>(path::State::caustic_hit)));
    for (std::uint32_t b = bits(hits); b != 0; b &= b - 1) {
        const int k = std::countr_zero(b);
        result.caustic_hits[path_of[k]] += path::luminance(c.r[k], c.g[k], c.b[k]);
    }
}

void Tracer::add_surface_emission(int material, const std::int32_t* list) {
    const trace::MaterialView& m = scene.materials[material];
    const nodes::ShadingChunk& s = scratch.shading;
    const path::RayState& rays = *now;
    for (int i = 0; i < s.n; i += W) {
        const Mask lanes = first_lanes(s.n - i);
        const Spectrum e = load_rgb(scratch.surface.emission, i);
        Mask shines = lanes & ((e.r != Float(0.0f)) | (e.g != Float(0.0f)) | (e.b != Float(0.0f)));
        const Int ray = load(list + i);
        if (scene.any_holdout) {
            const Mask background = (gather(rays.flags, ray) & Int(path::k_flag_background)) != Int(0);
            shines &= ~(background & (gather(scene.instances.holdout, load(s.instance + i)) != Int(0)));
        }
        if (none(shines)) continue;
        const Float pdf = gather(rays.pdf, ray);
        Float weight = 1.0f;
        const Mask weigh = shines & (pdf >= Float(0.0f));
        if (m.emission_sampled && any(weigh)) {
            const LightReceiver from{load3(rays.origin, ray), load3(rays.from_normal, ray)};
            const Float light_pdf = pdf_triangle(*scene.lights, from, load(s.instance + i), load(s.triangle + i),
                                                 cardioid::CD_ISA_NS::load3(s.position, i),
                                                 cardioid::CD_ISA_NS::load3(s.normal_geometric, i), weigh);
            weight = select(weigh, hit_weight(pdf, light_pdf), Float(1.0f));
        }
        Float share = 1.0f;
        const Mask shared = shares_with_photons(ray, shines);
        if (any(shared)) {
            Int emitter;
            const Float density =
                triangle_emission_density(*scene.lights, load(s.instance + i), load(s.triangle + i), emitter, shared);
            const Float choice = gather(request.photons->emitter_density, max(emitter, Int(0)));
            share = caustic_share(ray, density * choice, shared);
        }
        deposit(ray, e * weight, share, shines);
    }
}

void Tracer::add_lamp_hits() {
    if (!scene.has_lights || hittable_lamps(*scene.lights) == 0) return;
    const path::RayState& rays = *now;
    for (int i = 0; i < rays.n; i += W) {
        const Mask lanes = first_lanes(rays.n - i);
        const Int ray = Int(i) + lane_index();
        const LightReceiver from{load3(rays.origin, i), load3(rays.from_normal, i)};
        const Vec3 d = load3(rays.direction, i);
        const Float t_max = load(scratch.hits.t + i), t_min = load(rays.t_min + i), pdf = load(rays.pdf + i);
        const Int seen_by = visibility_bit(load(rays.flags + i)), bounce = byte_of(load(rays.depth + i), 0) - Int(1);
        LampWalk walk(*scene.lights, from.p, d, t_max, lanes);
        for (int which = walk.next(); which >= 0; which = walk.next()) {
            const LampHit h = intersect_lamp(*scene.lights, which, from, d, t_max, lanes);
            // A ray that passed a transparent surface keeps its origin: lamps before t_min were found already.
            Mask hit =
                h.hit & (h.t >= t_min) & ((seen_by & Int(h.visibility)) != Int(0)) & (bounce <= Int(h.max_bounces));
            if (replaces_bounces(scene.settings)) {
                const Mask far = (h.t > Float(scene.settings.fast_gi_distance)) & (h.t < Float(1e30f));
                hit &= ~(far & is_short_ray(scene.settings, load(rays.depth + i)));
            }
            if (none(hit)) continue;
            Spectrum radiance = h.radiance;
            if (h.program >= 0) {
                ShadedPoint at;
                at.position = h.position;
                at.normal_geometric = at.normal = h.normal;
                at.wo = -d;
                at.depth = one_bounce_further(load(rays.depth + i));
                at.ray_length = h.t;
                place_on_lamp(scene, Int(scene.lights->hittable[which]), at, hit);
                radiance *= shade_points(*this, nodes::Purpose::emission, Int(h.program), at, hit);
            }
            if (scene.has_volumes)
                radiance *= transmittance(*this, load_media(rays, min(ray, Int(rays.n - 1))), from.p, d, t_min, h.t,
                                          bits_of(d.x), hit);
            Float weight = hit_weight(pdf, h.pdf);
            Float share = 1.0f;
            const Mask shared = shares_with_photons(ray, hit);
            if (any(shared)) {
                const int id = scene.lights->hittable[which];
                const Float density = lamp_emission_density(*scene.lights, id, from.p, d, shared);
                const Float choice = request.photons->emitter_density[id];
                share = caustic_share(ray, density * choice, shared);
            }
            deposit(ray, radiance * weight, share, hit);
        }
    }
}

void Tracer::add_world(const std::int32_t* list, int n) {
    const path::RayState& rays = *now;
    const bool film_hides_world = scene.settings.transparent_film;
    for (int i = 0; i < n; i += W) {
        const Mask lanes = first_lanes(n - i);
        const Int ray = load(list + i);
        const Int flags = gather(rays.flags, ray);
        const Mask background = lanes & ((flags & Int(path::k_flag_background)) != Int(0));
        Mask shines = lanes;
        if (film_hides_world) {
            const Vec3 tp = load3(rays.throughput, ray);
            const Float through = average(Spectrum{tp.x, tp.y, tp.z});
            const Int path = gather(rays.path, ray);
            for (std::uint32_t b = bits(background); b != 0; b &= b - 1) {
                const int k = std::countr_zero(b);
                result.alpha[path[k]] -= through[k];
            }
            shines &= ~background;
        }
        if (!scene.has_world) continue;
        shines &= (visibility_bit(flags) & Int(scene.world_visibility)) != Int(0);
        shines &= byte_of(gather(rays.depth, ray), 0) <= Int(scene.world_max_bounces);
        if (none(shines)) continue;
        const Vec3 d = load3(rays.direction, ray);
        Spectrum radiance{scene.world_constant.x, scene.world_constant.y, scene.world_constant.z};
        if (!scene.materials[scene.world_program].info.constant_emission) {
            ShadedPoint at;
            at.position = d;
            at.normal_geometric = at.normal = at.wo = -d;
            at.depth = one_bounce_further(gather(rays.depth, ray));
            at.flags = flags & Int(0xff);
            radiance = shade_points(*this, nodes::Purpose::emission, Int(scene.world_program), at, shines);
        }
        const Float pdf = gather(rays.pdf, ray);
        Mask weigh = shines & (pdf >= Float(0.0f));
        if (replaces_bounces(scene.settings)) {
            const Mask brief = is_short_ray(scene.settings, gather(rays.depth, ray));
            radiance = select(brief, radiance * scene.settings.fast_gi_factor, radiance);
            if (scene.lights->environment.constant) weigh &= ~brief;
        }
        Float weight = 1.0f;
        if (any(weigh)) {
            const LightReceiver from{load3(rays.origin, ray), load3(rays.from_normal, ray)};
            weight = select(weigh, hit_weight(pdf, pdf_environment(*scene.lights, from, d, weigh)), Float(1.0f));
        }
        Float share = 1.0f;
        const Mask shared = shares_with_photons(ray, shines);
        if (any(shared)) {
            const int id = scene.lights->environment.emitter;
            const Float density = environment_emission_density(*scene.lights, load3(rays.origin, ray), d, shared);
            const Float choice = id >= 0 ? Float(request.photons->emitter_density[id]) : Float(0.0f);
            share = caustic_share(ray, density * choice, shared);
        }
        deposit(ray, radiance * weight, share, shines);
    }
}

}  // namespace cardioid::CD_ISA_NS
