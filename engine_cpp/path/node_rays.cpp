// SPDX-License-Identifier: GPL-3.0-or-later
#include "path/node_rays.h"

#include "trace/chosen_hits.h"

namespace cardioid::CD_ISA_NS {

void node_closest(const void* scene_view, const nodes::NodeRays& rays, nodes::NodeHits& hits, int lanes) {
    const auto& scene = *static_cast<const trace::SceneView*>(scene_view);
    const auto opaque = static_cast<std::int32_t>(trace::mask_shadow_opaque);
    for (int i = 0; i < lanes; i += W) {
        const Int only = load(rays.only + i);
        const RayLanes ray = {load3(rays.origin, i),
                              load3(rays.direction, i),
                              load(rays.t_min + i),
                              load(rays.t_max + i),
                              0.0f,
                              select(only == Int(-2), Int(opaque), Int(-1))};
        const HitLanes h = intersect_only(scene, ray, only, ray.t_max >= ray.t_min);
        store(hits.t + i, h.t);
        store(hits.instance + i, select(h.hit, h.instance, Int(-1)));
        if (none(h.hit)) {
            store3(hits.normal, i, h.ng);
            store3(hits.normal_geometric, i, h.ng);
            continue;
        }
        const SurfaceNormals n = surface_normals(scene, h.instance, h.triangle, h.ng, h.u, h.v, -ray.d);
        store3(hits.normal, i, select(n.backfacing, -n.n, n.n));
        store3(hits.normal_geometric, i, select(n.backfacing, -n.ng, n.ng));
    }
}

/// Below this density of a path's directions Cycles bevels no more.
constexpr float k_blurred = 8.0f;

Int node_seed(const Walk& walk, Int ray) {
    const Int path = gather(walk.now->path, ray);
    const Int event = event_of(gather(walk.now->depth, ray), gather(walk.now->transparent, ray));
    const Int sample = hash(gather(walk.scratch.pixel_seed, path), gather(walk.scratch.sample_index, path));
    const Int seed = hash(sample, event) & Int(0x7fffffff);
    const Mask blurred = gather(walk.now->min_pdf, ray) < Float(k_blurred);
    return select(blurred, seed | Int::of_bits(0x80000000u), seed);
}

}  // namespace cardioid::CD_ISA_NS
