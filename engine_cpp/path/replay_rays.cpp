// SPDX-License-Identifier: GPL-3.0-or-later
#include "path/tracer.h"

namespace cardioid::CD_ISA_NS {

std::uint64_t replay_rays(RTCSceneTy* scene, const path::RayLog& log) {
    std::uint64_t hits = 0;
    for (std::size_t i = 0; i + W <= log.n; i += W) {
        const auto field = [&](int f) { return load(log.field[f] + i); };
        RayLanes ray;
        ray.o = {field(0), field(1), field(2)};
        ray.d = {field(3), field(4), field(5)};
        ray.t_min = field(6);
        ray.t_max = field(7);
        ray.time = 0.0f;
        ray.mask = load(log.mask + i);
        const Mask active = ray.t_max >= ray.t_min;
        if (log.kind[i] == path::ray_kind_shadow) {
            hits += static_cast<std::uint64_t>(count(occluded(scene, ray, active)));
        } else {
            hits += static_cast<std::uint64_t>(
                count(intersect(scene, ray, active, log.kind[i] == path::ray_kind_coherent).hit));
        }
    }
    return hits;
}

}  // namespace cardioid::CD_ISA_NS
