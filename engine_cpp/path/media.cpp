// SPDX-License-Identifier: GPL-3.0-or-later
#include "path/media.h"
#include "path/subsurface.h"

#include <bit>

namespace cardioid::CD_ISA_NS {

void cross_surface(MediaLanes& media, Int instance, Int material, Mask backfacing, Mask lanes) {
    Mask known[path::k_media], anywhere = mask_of(false);
    for (int k = 0; k < path::k_media; ++k) {
        known[k] = lanes & (media.instance[k] == instance) & (media.material[k] == material);
        anywhere |= known[k];
    }
    Mask enters = lanes & ~backfacing & ~anywhere, moves = mask_of(false);
    for (int k = 0; k < path::k_media; ++k) {
        moves |= known[k] & backfacing;
        const bool end = k + 1 == path::k_media;
        const Int next_instance = end ? Int(-1) : media.instance[end ? k : k + 1];
        const Int next_material = end ? Int(-1) : media.material[end ? k : k + 1];
        const Mask here = enters & (media.material[k] < Int(0));
        media.instance[k] = select(here, instance, select(moves, next_instance, media.instance[k]));
        media.material[k] = select(here, material, select(moves, next_material, media.material[k]));
        enters &= ~here;
    }
}

Mask has_medium(const trace::SceneView& scene, Int material, Mask lanes) {
    Mask found = mask_of(false);
    for (std::uint32_t left = bits(lanes); left != 0;) {
        const int id = material[std::countr_zero(left)];
        const Mask here = lanes_with(material, id, lanes);
        left &= ~bits(here);
        if (scene.materials[id].volume) found |= here;
    }
    return found;
}

Mask only_bounds(const trace::SceneView& scene, Int material, Mask with_medium) {
    Mask found = mask_of(false);
    for (std::uint32_t left = bits(with_medium); left != 0;) {
        const int id = material[std::countr_zero(left)];
        const Mask here = lanes_with(material, id, with_medium);
        left &= ~bits(here);
        if (is_boundary(scene.materials[id])) found |= here;
    }
    return found;
}

namespace {

/// Adds the medium of one program to the lanes.
void add_medium(MediumLanes& sum, Float& total, const nodes::VolumeOutput& v, Float choice, Mask here) {
    const Spectrum absorption = load_rgb(v.absorption, 0);
    Spectrum scattering(0.0f);
    for (int p = 0; p < v.phases; ++p) {
        const nodes::MediumPhase& phase = v.phase[p];
        const Spectrum s = load_rgb(phase.scatter, 0);
        scattering += s;
        const Float size = select(here, max(average(s), 0.0f), Float(0.0f));
        total += size;
        // A reservoir: whatever the order, each is kept in proportion to its size. The choice must not depend on the phases before.
        const Float u = unit_float(hash(bits_of(choice) + bits_of(total)));
        const Mask keep = here & (u * total < size);
        sum.kind = select(keep, Int(static_cast<int>(phase.kind)), sum.kind);
        const Vec3 parameter{load(phase.parameter[0]), load(phase.parameter[1]), load(phase.parameter[2])};
        sum.parameter = select(keep, parameter, sum.parameter);
        sum.chosen = select(keep, s * (1.0f / max(size, 1e-30f)), sum.chosen);
    }
    const Spectrum none(0.0f);
    sum.scattering += select(here, scattering, none);
    sum.extinction += select(here, scattering + absorption, none);
    sum.emission += select(here, load_rgb(v.emission, 0), none);
}

}  // namespace

MediumLanes medium_at(Walk& walk, const MediaLanes& media, const ShadedPoint& at, Float choice, Mask active) {
    MediumLanes sum;
    Float total = 0.0f;
    const int world = walk.scene.world_program;
    if (walk.scene.materials[world].volume && any(active)) {
        ShadedPoint point = at;
        point.instance = Int(-1);
        add_medium(sum, total, volume_points(walk, world, point, active, std::countr_zero(bits(active))), choice,
                   active);
    }
    for (int k = 0; k < path::k_media; ++k) {
        const Mask filled = active & (media.material[k] >= Int(0));
        if (none(filled)) break;
        ShadedPoint point = at;
        point.instance = media.instance[k];
        for (std::uint32_t left = bits(filled); left != 0;) {
            const int first = std::countr_zero(left);
            const int id = media.material[k][first];
            const Mask here = lanes_with(media.material[k], id, filled);
            left &= ~bits(here);
            add_medium(sum, total, volume_points(walk, id, point, here, first), choice, here);
        }
    }
    sum.chosen = sum.chosen * total;
    return sum;
}

Float medium_step(const trace::SceneView& scene, const MediaLanes& media, Mask active) {
    const trace::MaterialView& world = scene.materials[scene.world_program];
    Float step = world.volume && !world.info.constant_volume ? 1.0f : 1e30f;
    for (int k = 0; k < path::k_media; ++k) {
        const Mask filled = active & (media.material[k] >= Int(0));
        for (std::uint32_t b = bits(filled); b != 0; b &= b - 1) {
            const int lane = std::countr_zero(b);
            if (scene.materials[media.material[k][lane]].info.constant_volume) continue;
            const int instance = media.instance[k][lane];
            const auto& m = scene.geometry.instances[instance].object_to_world.m;
            const Float3 size = scene.geometry.meshes[scene.instances.mesh[instance]].generated_size;
            float sum = 0;
            for (std::size_t row = 0; row < 3; ++row)
                sum += __builtin_fabsf(m[4 * row] * size.x) + __builtin_fabsf(m[4 * row + 1] * size.y) +
                       __builtin_fabsf(m[4 * row + 2] * size.z);
            const float own = sum / 30;
            if (own > 0 && own < step[lane]) step.v[lane] = own;
        }
    }
    return step;
}

Spectrum transmittance(Walk& walk, const MediaLanes& media, Vec3 o, Vec3 d, Float t0, Float t1, Int number,
                       Mask active) {
    active &= in_medium(walk.scene, media) & (t1 > t0);
    Spectrum depth(0.0f);
    if (none(active)) return Spectrum(1.0f);
    const Float jitter = unit_float(hash(number));
    Float step = medium_step(walk.scene, media, active);
    step = select(step < Float(1e29f), max(step, (t1 - t0) * (1.0f / k_most_steps)), t1 - t0);
    const Mask inside = active;
    Float from = t0;
    for (int k = 0; k <= k_most_steps && any(active); ++k) {
        const Float to = select(active, min(t0 + step * static_cast<float>(k + 1), t1), from);
        ShadedPoint at;
        at.position = o + d * fma(to - from, jitter, from);
        at.normal_geometric = at.normal = at.wo = -d;
        at.flags = Int(nodes::ray_shadow);
        const MediumLanes m = medium_at(walk, media, at, 0.5f, active);
        depth += select(active, m.extinction * (to - from), Spectrum(0.0f));
        from = to;
        active &= to < t1;
    }
    return select(inside, exp_minus(depth, 1.0f), Spectrum(1.0f));
}

MediaLanes media_around(const trace::SceneView& scene, Vec3 p, Mask active) {
    /// Surfaces above a point that are looked at.
    constexpr int k_most_above = 64, k_most_entered = 8;
    MediaLanes media = no_media();
    Int entered[k_most_entered];
    for (Int& e : entered) e = Int(-1);
    RayLanes ray{p, {0.0f, 0.0f, 1.0f}, 0.0f, 1e30f, 0.0f, Int(scene::visible_camera)};
    for (int step = 0; step < k_most_above && any(active); ++step) {
        const HitLanes h = intersect(scene.embree, ray, active, false);
        active &= h.hit;
        if (none(active)) break;
        const Int instance = select(active, h.instance, Int(0)), triangle = select(active, h.triangle, Int(0));
        const Int material = material_of(scene, instance, triangle);
        const Mask bounds = has_medium(scene, material, active);
        const Mask back = surface_normals(scene, instance, triangle, h.ng, h.u, h.v, -ray.d).backfacing;
        // What the ray has entered itself is not around the point when it is left.
        Mask own = bounds & back, fresh = bounds & ~back;
        for (Int& e : entered) {
            own &= e != instance;
            const Mask here = fresh & (e < Int(0));
            e = select(here, instance, e);
            fresh &= ~here & (e != instance);
        }
        for (const Int& known : media.instance) own &= known != instance;
        cross_surface(media, instance, material, mask_of(false), own);
        ray.t_min = select(active, h.t * 1.000001f + offset_step(p, h.t), ray.t_min);
    }
    return media;
}

}  // namespace cardioid::CD_ISA_NS
