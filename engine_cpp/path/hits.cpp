// SPDX-License-Identifier: GPL-3.0-or-later
#include "path/fast_gi.h"

namespace cardioid::CD_ISA_NS {

void Walk::find_hits(bool coherent, int visibility, bool bounded) {
    path::RayState& rays = *now;
    path::HitState& hits = scratch.hits;
    const Int missed(scene.material_count);
    for (int i = 0; i < rays.n; i += W) {
        const Mask active = first_lanes(rays.n - i);
        RayLanes ray;
        ray.o = load3(rays.origin, i);
        ray.d = load3(rays.direction, i);
        ray.t_min = load(rays.t_min + i);
        ray.t_max = bounded ? load(hits.t + i) : Float(1e30f);
        if (!bounded && visibility == 0 && replaces_bounces(scene.settings)) {
            const Mask brief = is_short_ray(scene.settings, load(rays.depth + i));
            ray.t_max = select(brief, Float(scene.settings.fast_gi_distance), ray.t_max);
        }
        ray.time = 0.0f;
        ray.mask = visibility != 0 ? Int(visibility) : visibility_bit(load(rays.flags + i));
        if (scratch.ray_log)
            log_rays(*scratch.ray_log, ray, active, coherent ? path::ray_kind_coherent : path::ray_kind_bounce);
        const HitLanes h = intersect(scene.embree, ray, active, coherent);
        const Int instance = select(h.hit, h.instance, Int(0));
        const Int triangle = select(h.hit, h.triangle, Int(0));
        store(hits.t + i, select(h.hit, h.t, Float(1e30f)));
        store(hits.u + i, h.u);
        store(hits.v + i, h.v);
        store3(hits.ng, i, h.ng);
        store(hits.instance + i, instance);
        store(hits.triangle + i, triangle);
        store(hits.material + i, select(h.hit, material_of(scene, instance, triangle), missed));
    }
}

void Walk::sort_by_material() {
    const int bins = scene.material_count + 1;
    std::int32_t* end = scratch.bins;
    for (int b = 0; b <= bins; ++b) end[b] = 0;
    const int n = now->n;
    const std::int32_t* material = scratch.hits.material;
    // Rays that ended in a medium are at no surface.
    for (int i = 0; i < n; ++i) {
        if (material[i] >= 0) ++end[material[i] + 1];
    }
    for (int b = 1; b <= bins; ++b) end[b] += end[b - 1];
    for (int i = 0; i < n; ++i) {
        if (material[i] >= 0) scratch.order[end[material[i]]++] = i;
    }
}

}  // namespace cardioid::CD_ISA_NS
