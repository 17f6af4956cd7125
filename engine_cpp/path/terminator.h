// SPDX-License-Identifier: GPL-3.0-or-later
// Shadow Terminator offsets of objects. Geometry: near the terminator shadow rays start on a curved surface through the
// triangle's corners and normals, so that a coarse smooth mesh does not show its faces. Shading: VertexChunk::narrowing.
#pragma once

#include "path/tracer.h"

namespace cardioid::CD_ISA_NS {

/// Writes what a record needs of the shading chunk for both offsets.
inline void keep_terminator(const trace::SceneView& scene, const nodes::ShadingChunk& s, path::VertexChunk& chunk,
                            int i) {
    const Int instance = load(s.instance + i);
    if (scene.lifts_shadow_rays) {
        store(chunk.instance + i, instance);
        store(chunk.triangle + i, load(s.triangle + i));
        store(chunk.barycentric_u + i, load(s.barycentric_u + i));
        store(chunk.barycentric_v + i, load(s.barycentric_v + i));
    }
    if (!scene.narrows_diffuse) return;
    chunk.narrows = true;
    const Float offset = gather(scene.instances.terminator_shading, instance);
    store(chunk.narrowing + i, 1.0f / (1.0f - 0.5f * offset));
}

/// How high above the face, along the smooth normal, Cycles' surface is at (u, v); `side`: the geometric normal on the light's
/// side. `normal` is that direction, not unit.
inline Vec3 curved_offset(const trace::SceneView& scene, Int instance, Int triangle, Float u, Float v, Vec3 side) {
    const trace::InstanceArrays& in = scene.instances;
    const Int corner = (gather(in.first_triangle, instance) + triangle) * Int(3),
              base = gather(in.first_vertex, instance);
    Vec3 p[3], n[3];
    for (int k = 0; k < 3; ++k) {
        const Int vertex = (base + gather(scene.geometry.triangles, corner + Int(k))) * Int(3);
        p[k] = {gather(scene.geometry.positions, vertex), gather(scene.geometry.positions + 1, vertex),
                gather(scene.geometry.positions + 2, vertex)};
        n[k] = normalize(unpack_normal(gather(scene.packed_normals, corner + Int(k))));
    }
    const Float w = 1.0f - u - v;
    const Vec3 at = p[0] * w + p[1] * u + p[2] * v;
    Vec3 normal = n[0] * w + n[1] * u + n[2] * v;
    const Mask baked = gather(in.baked, instance) != Int(0);
    if (!all(baked)) normal = select(baked, normal, vector_to_world(scene.geometry.instances, instance, normal));
    const Float a = dot(n[2] - n[0], p[0] - p[2]), b = dot(n[2] - n[1], p[1] - p[2]), c = dot(n[1] - n[0], p[1] - p[0]);
    const Float parabola = 0.5f * (a * w * (w - 1.0f) + (a + b + c) * w * u + b * u * (u - 1.0f));
    // The tangent planes of the corners bound it from outside, on the side of the light.
    const Float sign = select(dot(normal, side) > Float(0.0f), Float(1.0f), Float(-1.0f));
    const auto plane = [&](int k) {
        const Vec3& first = p[(k + 1) % 3];
        const Vec3& second = p[(k + 2) % 3];
        const Float reach = max(max(sign * dot(first - p[k], n[k]), sign * dot(second - p[k], n[k])), 0.0f);
        return max(sign * dot(p[k] - at, n[k]) + reach, 0.0f);
    };
    const Float envelope = min(min(plane(0), plane(1)), plane(2));
    return normal * (sign * max(envelope, sign * parabola));
}

/// The side of the surface that lobes are seen from for light sampling: where shadow rays are lifted, a face that turns away from
/// the light is lit as its smooth normal is.
inline Vec3 terminator_side(const trace::SceneView& scene, const path::VertexChunk& chunk, int i) {
    const Int instance = load(chunk.instance + i);
    const Mask known = instance >= Int(0);
    const Float cutoff = gather(scene.instances.terminator_geometry, select(known, instance, Int(0)));
    return select(known & (cutoff > Float(0.0f)), load3(chunk.normal, i), load3(chunk.normal_geometric, i));
}

/// From the vertex to where its shadow ray in direction wi starts.
inline Vec3 shadow_lift(const trace::SceneView& scene, const path::VertexChunk& chunk, int i, Vec3 wi, Mask active) {
    const Vec3 none_{0.0f, 0.0f, 0.0f};
    const Int instance = load(chunk.instance + i);
    Mask lifts = active & (instance >= Int(0));
    if (none(lifts)) return none_;
    const Int index = select(lifts, instance, Int(0));
    const Float cutoff = gather(scene.instances.terminator_geometry, index);
    const Float cosine = dot(load3(chunk.normal, i), wi);
    const Vec3 ng = load3(chunk.normal_geometric, i);
    const Vec3 side = select(cosine < Float(0.0f), -ng, ng);
    const Float nl = abs(cosine), gl = dot(side, wi), inv = 1.0f / max(cutoff, 1e-6f);
    const Float amount = saturate(select(nl < cutoff, 2.0f - (gl + nl) * inv, 1.0f - gl * inv));
    lifts &= (cutoff > Float(0.0f)) & (amount > Float(0.0f));
    if (none(lifts)) return none_;
    const Int triangle = select(lifts, load(chunk.triangle + i), Int(0));
    const Vec3 offset =
        curved_offset(scene, index, triangle, load(chunk.barycentric_u + i), load(chunk.barycentric_v + i), side);
    return select(lifts, offset * amount, none_);
}

}  // namespace cardioid::CD_ISA_NS
