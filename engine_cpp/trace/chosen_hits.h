// SPDX-License-Identifier: GPL-3.0-or-later
// Closest hits of one instance alone: rays step over what lies before it.
#pragma once

#include "trace/surface.h"

namespace cardioid::CD_ISA_NS {

/// Hits of other instances that a ray steps over before it gives up.
inline constexpr int k_most_steps_over = 64;

/// The closest hit of the instance that each lane wants, `only`; under 0: of any. Lanes without a hit have t 1e30, instance 0 and
/// triangle 0.
inline HitLanes intersect_only(const trace::SceneView& scene, RayLanes ray, Int only, Mask active) {
    HitLanes found;
    found.hit = mask_of(false);
    found.t = 1e30f;
    found.u = found.v = 0.0f;
    found.ng = {0.0f, 0.0f, 1.0f};
    found.triangle = found.instance = Int(0);
    for (int k = 0; k < k_most_steps_over && any(active); ++k) {
        const HitLanes h = intersect(scene.embree, ray, active, false);
        const Mask wanted = h.hit & ((only < Int(0)) | (only == h.instance));
        found.hit |= wanted;
        found.t = select(wanted, h.t, found.t);
        found.u = select(wanted, h.u, found.u);
        found.v = select(wanted, h.v, found.v);
        found.ng = select(wanted, h.ng, found.ng);
        found.triangle = select(wanted, h.triangle, found.triangle);
        found.instance = select(wanted, h.instance, found.instance);
        active = h.hit & ~wanted;
        ray.t_min = select(active, h.t + offset_step(ray.o + ray.d * h.t, h.t), ray.t_min);
        active &= ray.t_min <= ray.t_max;
    }
    return found;
}

}  // namespace cardioid::CD_ISA_NS
