// SPDX-License-Identifier: GPL-3.0-or-later
// What a shader asks of the hit point: attributes, its instance, spaces, the ray.
#include "nodes/kernel_scene.h"

#include <cstddef>

namespace cardioid::CD_ISA_NS {

using nodes::Direction;
using nodes::InstanceInfo;
using nodes::InstanceValue;
using nodes::Instruction;
using nodes::Quantity;
using nodes::RayValue;
using nodes::Space;

namespace {

constexpr int k_mesh_stride = static_cast<int>(sizeof(nodes::MeshInfo) / sizeof(float));

/// Elements of the attribute at the three corners of each lane's triangle.
struct Corners {
    Int a, b, c;
};

Corners corner_elements(const nodes::ShadingChunk& chunk, int i, Int domain, Int mesh) {
    const Int triangle = load(chunk.triangle + i);
    const Mask by_face = domain == Int(2);
    const Int first = triangle * Int(3);
    Corners e{select(by_face, triangle, first), select(by_face, triangle, first + Int(1)),
              select(by_face, triangle, first + Int(2))};
    const Mask by_point = domain == Int(0);
    if (none(by_point)) return e;
    const Int base =
        (gather(reinterpret_cast<const std::int32_t*>(chunk.geometry->meshes), mesh * Int(k_mesh_stride)) + triangle) *
        Int(3);
    e.a = select(by_point, gather(chunk.geometry->triangles, base), e.a);
    e.b = select(by_point, gather(chunk.geometry->triangles, base + Int(1)), e.b);
    e.c = select(by_point, gather(chunk.geometry->triangles, base + Int(2)), e.c);
    return e;
}

/// An attribute at the lanes' triangles; lanes whose mesh lacks it read element 0 and are not in `have`.
struct AttributeView {
    const float* data = nullptr;
    Mask have;
    Int offset{0}, channels{0};
    Corners e{0, 0, 0};

    AttributeView(const nodes::ShadingChunk& chunk, int i, int name, int least_channels) {
        const nodes::GeometryTables* g = chunk.geometry;
        have = load(chunk.instance + i) >= Int(0);
        if (g == nullptr || g->attributes == nullptr || name < 0 || name >= g->attribute_names) have = mask_of(false);
        if (none(have)) return;
        data = g->floats;
        const Int mesh = select(have, load(chunk.mesh + i), Int(0));
        const Int entry = (mesh * Int(g->attribute_names) + Int(name)) * Int(2);
        const auto* table = reinterpret_cast<const std::int32_t*>(g->attributes);
        const Int packed = gather(table + 1, entry);
        channels = (packed >> 8) & Int(0xff);
        have &= channels >= Int(least_channels);
        if (none(have)) return;
        offset = select(have, gather(table, entry), Int(0));
        e = corner_elements(chunk, i, packed & Int(0xff), mesh);
        e = {select(have, e.a, Int(0)), select(have, e.b, Int(0)), select(have, e.c, Int(0))};
        channels = select(have, channels, Int(0));
    }
    /// Channel k of one corner.
    Float corner(Int element, Int k) const { return gather(data, offset + element * channels + k); }
    /// Channel k, interpolated.
    Float at(Int k, Float u, Float v) const {
        return (1.0f - u - v) * corner(e.a, k) + u * corner(e.b, k) + v * corner(e.c, k);
    }
};

void store4(const Machine& m, const Instruction& in, int i, Vec3 v, Float w) {
    store_vec(m, in, 0, i, v);
    store(m.dst(in, 3) + i, w);
}

}  // namespace

/// A single channel is a grey colour, two are (u, v, 0), alpha is 1 where there is none.
void op_attribute(const Machine& m, const Instruction& in) {
    const Source u = m.arg(in, 0), v = m.arg(in, 1);
    for (int i = 0; i < m.end; i += W) {
        const AttributeView a(m.chunk, i, static_cast<int>(in.imm), 1);
        const Float missing = in.data == nodes::attribute_missing_clear ? 0.0f : 1.0f;
        if (none(a.have)) {
            store4(m, in, i, {0.0f, 0.0f, 0.0f}, missing);
            continue;
        }
        const Float s = u.at(i), t = v.at(i);
        const Mask single = a.channels == Int(1), many = a.channels >= Int(3), four = a.channels == Int(4);
        const Float x = a.at(Int(0), s, t), y = a.at(select(a.channels > Int(1), Int(1), Int(0)), s, t);
        Float z = select(single, x, Float(0.0f)), w = select(a.have, Float(1.0f), missing);
        if (any(many)) z = select(many, a.at(select(many, Int(2), Int(0)), s, t), z);
        if (any(four)) w = select(four, a.at(select(four, Int(3), Int(0)), s, t), w);
        Vec3 value = select(a.have, Vec3{x, y, z}, Vec3{0.0f, 0.0f, 0.0f});
        if (in.data == nodes::attribute_number)
            value.x = select(a.channels == Int(2), value.x, (value.x + value.y + value.z) * (1.0f / 3.0f));
        store4(m, in, i, value, w);
    }
}

void op_instance_value(const Machine& m, const Instruction& in) {
    const auto value = static_cast<InstanceValue>(in.imm);
    for (int i = 0; i < m.end; i += W) {
        const auto get = [&](std::size_t member, float fallback) {
            return instance_float(m.chunk, i, member, fallback);
        };
        const auto get3 = [&](std::size_t member, float fallback) {
            return Vec3{get(member, fallback), get(member + 4, fallback), get(member + 8, fallback)};
        };
        switch (value) {
            case InstanceValue::location: store4(m, in, i, get3(offsetof(InstanceInfo, location), 0), 1.0f); break;
            case InstanceValue::color:
                store4(m, in, i, get3(offsetof(InstanceInfo, color), 1), get(offsetof(InstanceInfo, color) + 12, 1));
                break;
            case InstanceValue::random:
                store4(m, in, i, {get(offsetof(InstanceInfo, random), 0), 0.0f, 0.0f}, 1.0f);
                break;
            case InstanceValue::pass_index:
                store4(m, in, i, {get(offsetof(InstanceInfo, pass_index), 0), 0.0f, 0.0f}, 1.0f);
                break;
            case InstanceValue::dupli_generated:
                store4(m, in, i, get3(offsetof(InstanceInfo, dupli_generated), 0), 1.0f);
                break;
            case InstanceValue::dupli_uv:
                store4(m, in, i,
                       {get(offsetof(InstanceInfo, dupli_uv), 0), get(offsetof(InstanceInfo, dupli_uv) + 4, 0), 0.0f},
                       1.0f);
                break;
            case InstanceValue::material_index:
                store4(m, in, i, {Float(static_cast<float>(m.chunk.material_pass_index)), 0.0f, 0.0f}, 1.0f);
                break;
        }
    }
}

namespace {

Vec3 apply(const LaneAffine& map, const LaneAffine& inverse, Quantity q, Vec3 v) {
    if (q == Quantity::point) return map.point(v);
    if (q == Quantity::vector) return map.vector(v);
    return inverse.transposed_vector(v);
}

/// Texture space box of the lanes' meshes: generated = (p - min) / size.
Vec3 to_generated(const nodes::ShadingChunk& chunk, int i, Vec3 p) {
    const Mask on_mesh = load(chunk.instance + i) >= Int(0);
    if (chunk.geometry == nullptr || chunk.geometry->meshes == nullptr || none(on_mesh)) return p;
    const float* base = reinterpret_cast<const float*>(chunk.geometry->meshes);
    const Int mesh = select(on_mesh, load(chunk.mesh + i), Int(0)) * Int(k_mesh_stride);
    const auto get = [&](std::size_t member) {
        return gather(base, mesh + Int(static_cast<int>(member / sizeof(float))));
    };
    const auto axis = [&](Float x, std::size_t k) {
        const Float size = get(offsetof(nodes::MeshInfo, generated_size) + k);
        return (x - get(offsetof(nodes::MeshInfo, generated_min) + k)) / select(size == Float(0.0f), Float(1.0f), size);
    };
    return select(on_mesh, Vec3{axis(p.x, 0), axis(p.y, 4), axis(p.z, 8)}, p);
}

}  // namespace

void op_transform(const Machine& m, const Instruction& in) {
    const auto space = static_cast<Space>(in.imm & 0xf);
    const auto quantity = static_cast<Quantity>(in.imm >> 4 & 0xf);
    const bool from_world = static_cast<Direction>(in.imm >> 8) == Direction::from_world;
    const Source3 v = m.arg3(in, 0);
    for (int i = 0; i < m.end; i += W) {
        LaneAffine to_local, to_world;
        if (space != Space::camera) {
            to_local = instance_affine(m.chunk, i, offsetof(InstanceInfo, world_to_object));
            to_world = instance_affine(m.chunk, i, offsetof(InstanceInfo, object_to_world));
        } else {
            const nodes::GeometryTables* g = m.chunk.geometry;
            to_local = g != nullptr ? uniform_affine(g->world_to_camera) : identity_affine();
            to_world = g != nullptr ? uniform_affine(g->camera_to_world) : identity_affine();
        }
        Vec3 p = v.at(i);
        // Shaders see a camera that looks along +z.
        if (space == Space::camera && !from_world) p.z = -p.z;
        Vec3 r = from_world ? apply(to_local, to_world, quantity, p) : apply(to_world, to_local, quantity, p);
        if (space == Space::camera && from_world) r.z = -r.z;
        if (quantity == Quantity::normal) r = normalize(r);
        if (space == Space::generated) r = to_generated(m.chunk, i, r);
        store_vec(m, in, 0, i, r);
    }
}

namespace {

/// Cycles' frame about the geometric normal, so that bump mapping sees the same points.
Vec3 frame_axis(Vec3 n) {
    const Mask same = (n.x == n.y) & (n.x == n.z);
    return normalize(Vec3{n.z - n.y, select(same, n.x + n.z, n.x - n.z), select(same, -n.y - n.x, n.y - n.x)});
}

}  // namespace

void op_surface_step(const Machine& m, const Instruction& in) {
    for (int i = 0; i < m.end; i += W) {
        const Vec3 n = load3(m.chunk.normal_geometric, i);
        const Vec3 a = frame_axis(n);
        store_vec(m, in, 0, i, (in.imm == 0 ? a : cross(n, a)) * load(m.chunk.footprint + i));
    }
}

void op_barycentric_step(const Machine& m, const Instruction& in) {
    const Source3 d = m.arg3(in, 0);
    for (int i = 0; i < m.end; i += W) {
        // Seen from behind, Cycles takes the triangle's edges the other way round, and the step with them.
        const Mask back = load(m.chunk.backfacing + i) > Float(0.0f);
        const Vec3 p = select(back, -d.at(i), d.at(i)), a = load3(m.chunk.dp_du, i), b = load3(m.chunk.dp_dv, i);
        const Float aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), pa = dot(p, a), pb = dot(p, b);
        const Float det = aa * bb - ab * ab;
        const Float inv = select(det > Float(0.0f), 1.0f / max(det, 1e-38f), Float(0.0f));
        store(m.dst(in, 0) + i, load(m.chunk.barycentric_u + i) + (bb * pa - ab * pb) * inv);
        store(m.dst(in, 1) + i, load(m.chunk.barycentric_v + i) + (aa * pb - ab * pa) * inv);
    }
}

void op_window(const Machine& m, const Instruction& in) {
    const Source3 p = m.arg3(in, 0);
    const nodes::GeometryTables* g = m.chunk.geometry;
    for (int i = 0; i < m.end; i += W) {
        if (g == nullptr) {
            store_vec(m, in, 0, i, {0.0f, 0.0f, 0.0f});
            continue;
        }
        const LaneAffine to_camera = uniform_affine(g->world_to_camera);
        const Vec3 q = in.imm != 0 ? to_camera.vector(p.at(i)) : to_camera.point(p.at(i));
        const float* plane = reinterpret_cast<const float*>(&g->view_plane);
        const Float inv = g->orthographic ? Float(1.0f) : -1.0f / select(abs(q.z) > Float(1e-20f), q.z, Float(-1e-20f));
        store_vec(m, in, 0, i,
                  {(q.x * inv - plane[0]) / Float(plane[1] - plane[0]),
                   (q.y * inv - plane[2]) / Float(plane[3] - plane[2]), 0.0f});
    }
}

/// Smooth tangents where the mesh has them. Else those of the triangle, in object space, where Blender has its tangents.
void op_uv_tangent(const Machine& m, const Instruction& in) {
    const Source su = m.arg(in, 0), sv = m.arg(in, 1);
    const Source3 normal = m.arg3(in, 2);
    for (int i = 0; i < m.end; i += W) {
        Vec3 tangent = {0.0f, 0.0f, 0.0f};
        Float sign = 0.0f;
        const AttributeView uv(m.chunk, i, static_cast<int>(in.data), 2);
        if (any(uv.have)) {
            const Float u0 = uv.corner(uv.e.a, 0), v0 = uv.corner(uv.e.a, 1);
            const Float u1 = uv.corner(uv.e.b, 0) - u0, v1 = uv.corner(uv.e.b, 1) - v0;
            const Float u2 = uv.corner(uv.e.c, 0) - u0, v2 = uv.corner(uv.e.c, 1) - v0;
            const Float det = u1 * v2 - u2 * v1, side = copysign(1.0f, det);
            const LaneAffine to_local = instance_affine(m.chunk, i, offsetof(InstanceInfo, world_to_object));
            const Vec3 t = to_local.vector((load3(m.chunk.dp_du, i) * v2 - load3(m.chunk.dp_dv, i) * v1) * side);
            const Vec3 n = normal.at(i);
            const Mask ok = uv.have & (det != Float(0.0f));
            tangent = select(ok, normalize(t - n * dot(n, t)), tangent);
            sign = select(ok, side, sign);
        }
        const AttributeView smooth(m.chunk, i, static_cast<int>(in.imm), 4);
        if (any(smooth.have)) {
            const Float u = su.at(i), v = sv.at(i);
            const Vec3 t = {smooth.at(Int(0), u, v), smooth.at(Int(1), u, v), smooth.at(Int(2), u, v)};
            tangent = select(smooth.have, t, tangent);
            sign = select(smooth.have, smooth.at(Int(3), u, v), sign);
        }
        store4(m, in, i, tangent, sign);
    }
}

void op_named_value(const Machine& m, const Instruction& in) {
    const nodes::GeometryTables* g = m.chunk.geometry;
    const int name = static_cast<int>(in.imm);
    for (int i = 0; i < m.end; i += W) {
        const Int instance = load(m.chunk.instance + i);
        const Mask have = instance >= Int(0);
        if (g == nullptr || g->instance_values.rows == nullptr || name < 0 || name >= g->instance_values.names ||
            none(have)) {
            store4(m, in, i, {0.0f, 0.0f, 0.0f}, 0.0f);
            continue;
        }
        const Int row = (max(instance, Int(0)) * Int(g->instance_values.names) + Int(name)) * Int(4);
        const auto get = [&](int k) {
            return select(have, gather(g->instance_values.rows, row + Int(k)), Float(0.0f));
        };
        store4(m, in, i, {get(0), get(1), get(2)}, get(3));
    }
}

/// Distance to the lines through the triangle's edges.
void op_wireframe(const Machine& m, const Instruction& in) {
    const Source width = m.arg(in, 0);
    const Source3 offset = m.arg3(in, 1);
    for (int i = 0; i < m.end; i += W) {
        const Vec3 a = load3(m.chunk.dp_du, i), b = load3(m.chunk.dp_dv, i);
        const Vec3 p = a * load(m.chunk.barycentric_u + i) + b * load(m.chunk.barycentric_v + i) + offset.at(i);
        Float half = width.at(i) * 0.5f;
        if (in.imm != 0) {
            const Vec3 n = load3(m.chunk.normal_geometric, i), wo = load3(m.chunk.wo, i);
            const Vec3 x = frame_axis(n), y = cross(n, x);
            const Float seen = length(x - wo * dot(x, wo)) + length(y - wo * dot(y, wo));
            half *= seen * 0.5f * load(m.chunk.footprint + i);
        }
        const auto near = [&](Vec3 from, Vec3 edge) {
            const Vec3 area = cross(edge, p - from);
            return dot(area, area) < dot(edge, edge) * half * half;
        };
        const Mask on = near({0.0f, 0.0f, 0.0f}, a) | near({0.0f, 0.0f, 0.0f}, b) | near(a, b - a);
        const Mask mesh = load(m.chunk.instance + i) >= Int(0);
        store(m.dst(in) + i, select(on & mesh, Float(1.0f), Float(0.0f)));
    }
}

void op_ray_value(const Machine& m, const Instruction& in) {
    const auto value = static_cast<RayValue>(in.imm);
    const nodes::ShadingChunk& c = m.chunk;
    const float* rows[] = {c.ray_length,   c.ray_depth,         c.diffuse_depth,
                           c.glossy_depth, c.transparent_depth, c.transmission_depth};
    for (int i = 0; i < m.end; i += W) {
        if (value >= RayValue::length) {
            store(m.dst(in) + i, load(rows[static_cast<int>(value) - static_cast<int>(RayValue::length)] + i));
            continue;
        }
        const Int flags = load(reinterpret_cast<const std::int32_t*>(c.ray_flags) + i);
        const Mask set = (flags & Int(1 << static_cast<int>(value))) != Int(0);
        store(m.dst(in) + i, select(set, Float(1.0f), Float(0.0f)));
    }
}

}  // namespace cardioid::CD_ISA_NS
