// SPDX-License-Identifier: GPL-3.0-or-later
// How a smooth-shaded surface bends at a triangle: what reflection and refraction do to the width of a pixel's cone.
#pragma once

#include "trace/surface.h"

namespace cardioid::CD_ISA_NS {

/// Mean change of the smooth normal per unit of length along the triangle's edges (1/m), positive where the surface bulges
/// toward the side that is seen; 0 for flat shading. `backfacing`: the side that is seen is the back.
inline Float mean_curvature(const trace::SceneView& scene, Int instance, Int triangle, Mask backfacing, Mask active) {
    const trace::InstanceArrays& in = scene.instances;
    const Mask smooth = active & (gather(in.smooth, instance) != Int(0));
    if (none(smooth)) return 0.0f;
    const Int corner = select(smooth, (gather(in.first_triangle, instance) + triangle) * Int(3), Int(0));
    Vec3 n[3];
    for (int k = 0; k < 3; ++k) {
        n[k] = unpack_normal(gather(scene.packed_normals, corner + Int(k)));
        if (!all(gather(in.baked, instance) != Int(0))) {
            const Vec3 world = normal_to_world(scene.geometry.instances, instance, n[k]);
            n[k] = select(gather(in.baked, instance) != Int(0), n[k], world);
        }
        n[k] = normalize(n[k]);
    }
    Vec3 e1, e2;
    triangle_edges(scene, instance, triangle, e1, e2);
    const Vec3 e3 = e2 - e1;
    const auto bend = [](Vec3 dn, Vec3 edge) { return dot(dn, edge) / max(length_squared(edge), 1e-37f); };
    const Float mean = (bend(n[1] - n[0], e1) + bend(n[2] - n[0], e2) + bend(n[2] - n[1], e3)) * (1.0f / 3.0f);
    return select(smooth, select(backfacing, -mean, mean), Float(0.0f));
}

}  // namespace cardioid::CD_ISA_NS
