// SPDX-License-Identifier: GPL-3.0-or-later
// From a hit to what shading needs: the material, normals and the triangle's frame, over W lanes.
#pragma once

#include "trace/packet.h"

namespace cardioid::CD_ISA_NS {

/// Material index of each hit lane; lanes without a hit must carry instance 0 and triangle 0.
inline Int material_of(const trace::SceneView& scene, Int instance, Int triangle) {
    const trace::InstanceArrays& in = scene.instances;
    const Int mask = gather(in.slot_mask, instance);
    const Int slot = gather(scene.slots, (gather(in.first_triangle, instance) + triangle) & mask) & mask;
    return gather(scene.slot_materials, gather(in.first_material, instance) + slot);
}

inline Vec3 unpack_normal(Int packed) {
    Float x = to_float(packed & Int(0xffff)) * (2.0f / 65534.0f) - 1.0f;
    Float y = to_float(packed >> 16) * (2.0f / 65534.0f) - 1.0f;
    const Float z = 1.0f - abs(x) - abs(y);
    const Float t = max(-z, 0.0f);
    x = x - copysign(t, x);
    y = y - copysign(t, y);
    return {x, y, z};
}

/// Rows of an Affine inside an array of structs: element (row, column) of instance i.
inline Float gather_affine(const Affine* first, std::size_t stride_bytes, Int instance, int element) {
    const float* base = first->m.data() + element;
    return gather(base, instance * Int(static_cast<std::int32_t>(stride_bytes / sizeof(float))));
}

/// Normals by the transpose of world-to-object.
inline Vec3 normal_to_world(const nodes::InstanceInfo* instances, Int instance, Vec3 n) {
    const Affine* m = &instances->world_to_object;
    const auto at = [&](int e) { return gather_affine(m, sizeof(nodes::InstanceInfo), instance, e); };
    return {at(0) * n.x + at(4) * n.y + at(8) * n.z, at(1) * n.x + at(5) * n.y + at(9) * n.z,
            at(2) * n.x + at(6) * n.y + at(10) * n.z};
}

inline Vec3 vector_to_world(const nodes::InstanceInfo* instances, Int instance, Vec3 d) {
    const Affine* m = &instances->object_to_world;
    const auto at = [&](int e) { return gather_affine(m, sizeof(nodes::InstanceInfo), instance, e); };
    return {at(0) * d.x + at(1) * d.y + at(2) * d.z, at(4) * d.x + at(5) * d.y + at(6) * d.z,
            at(8) * d.x + at(9) * d.y + at(10) * d.z};
}

struct SurfaceNormals {
    Vec3 ng, n;  ///< unit, on the side of wo
    Mask backfacing;
};

inline SurfaceNormals surface_normals(const trace::SceneView& scene, Int instance, Int triangle, Vec3 raw_ng, Float u,
                                      Float v, Vec3 wo) {
    const trace::InstanceArrays& in = scene.instances;
    const Mask baked = gather(in.baked, instance) != Int(0);
    const Mask smooth = gather(in.smooth, instance) != Int(0);
    Vec3 n = raw_ng;
    if (any(smooth)) {
        const Int corner = (gather(in.first_triangle, instance) + triangle) * Int(3);
        const Int first = select(smooth, corner, Int(0));
        const Vec3 n0 = normalize(unpack_normal(gather(scene.packed_normals, first)));
        const Vec3 n1 = normalize(unpack_normal(gather(scene.packed_normals, first + Int(1))));
        const Vec3 n2 = normalize(unpack_normal(gather(scene.packed_normals, first + Int(2))));
        n = select(smooth, n0 * (1.0f - u - v) + n1 * u + n2 * v, n);
    }
    Vec3 ng = raw_ng;
    if (!all(baked)) {
        ng = select(baked, ng, normal_to_world(scene.geometry.instances, instance, ng));
        n = select(baked, n, normal_to_world(scene.geometry.instances, instance, n));
    }
    const Mask flip = gather(in.flip, instance) != Int(0);
    ng = select(flip, -ng, ng);
    n = select(flip & ~smooth, -n, n);
    ng = normalize(ng);
    n = normalize(n);
    SurfaceNormals s;
    s.backfacing = dot(ng, wo) < Float(0.0f);
    s.ng = select(s.backfacing, -ng, ng);
    s.n = select(s.backfacing, -n, n);
    return s;
}

/// Edges of the hit triangle in world space.
inline void triangle_edges(const trace::SceneView& scene, Int instance, Int triangle, Vec3& edge1, Vec3& edge2) {
    const trace::InstanceArrays& in = scene.instances;
    const Int corner = (gather(in.first_triangle, instance) + triangle) * Int(3);
    const Int base = gather(in.first_vertex, instance);
    Vec3 p[3];
    for (int k = 0; k < 3; ++k) {
        const Int vertex = (base + gather(scene.geometry.triangles, corner + Int(k))) * Int(3);
        p[k] = {gather(scene.geometry.positions, vertex), gather(scene.geometry.positions + 1, vertex),
                gather(scene.geometry.positions + 2, vertex)};
    }
    edge1 = p[1] - p[0];
    edge2 = p[2] - p[0];
    const Mask baked = gather(in.baked, instance) != Int(0);
    if (!all(baked)) {
        edge1 = select(baked, edge1, vector_to_world(scene.geometry.instances, instance, edge1));
        edge2 = select(baked, edge2, vector_to_world(scene.geometry.instances, instance, edge2));
    }
}

/// How far off the surface rays start: grows with the position and the distance travelled, which carry the rounding error;
/// never depends on the size of the scene.
inline Float offset_step(Vec3 p, Float t) { return max(max(abs(p.x), abs(p.y)), max(abs(p.z), t)) * 4e-6f + 1e-12f; }

/// Start of a ray that leaves p on the side of `ng`.
inline Vec3 offset_origin(Vec3 p, Vec3 ng, Vec3 direction, Float t) {
    return p + ng * copysign(offset_step(p, t), dot(ng, direction));
}

}  // namespace cardioid::CD_ISA_NS
