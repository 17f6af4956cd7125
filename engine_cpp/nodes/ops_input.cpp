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
    Corners e{select(by_face, triangle, first), select(by_face, triangle, first + Int(1)), select(by_face, triangle, first + Int(2))};
    const Mask by_point = domain == Int(0);
    if (none(by_point)) return e;
    const Int base = (gather(reinterpret_cast<const std::int32_t*>(chunk.geometry->meshes), mesh * Int(k_mesh_stride)) + triangle) * Int(3);
    e.a = select(by_point, gather(chunk.geometry->triangles, base), e.a);
    e.b = select(by_point, gather(chunk.geometry->triangles, base + Int(1)), e.b);
    e.c = select(by_point, gather(chunk.geometry->triangles, base + Int(2)), e.c);
    return e;
}

/// One channel, interpolated.
Float channel(const float* data, const Corners& e, Int offset, Int channels, Int k, Float u, Float v) {
    const Float a = gather(data, offset + e.a * channels + k);
    const Float b = gather(data, offset + e.b * channels + k);
    const Float c = gather(data, offset + e.c * channels + k);
    return (1.0f - u - v) * a + u * b + v * c;
}

void store4(const Machine& m, const Instruction& in, int i, Vec3 v, Float w) {
    store_vec(m, in, 0, i, v);
    store(m.dst(in, 3) + i, w);
}

}  // namespace

void op_attribute(const Machine& m, const Instruction& in) {
    const Source u = m.arg(in, 0), v = m.arg(in, 1);
    const nodes::GeometryTables* g = m.chunk.geometry;
    const bool have_table = g != nullptr && g->attributes != nullptr && static_cast<int>(in.imm) < g->attribute_names;
    for (int i = 0; i < m.end; i += W) {
        const Mask on_mesh = load(m.chunk.instance + i) >= Int(0);
        if (!have_table || none(on_mesh)) {
            store4(m, in, i, {0.0f, 0.0f, 0.0f}, 1.0f);
            continue;
        }
        const Int mesh = select(on_mesh, load(m.chunk.mesh + i), Int(0));
        const Int entry = (mesh * Int(g->attribute_names) + Int(static_cast<int>(in.imm))) * Int(2);
        const auto* table = reinterpret_cast<const std::int32_t*>(g->attributes);
        const Int packed = gather(table + 1, entry);
        const Int channels = select(on_mesh, (packed >> 8) & Int(0xff), Int(0));
        const Mask have = channels > Int(0);
        if (none(have)) {
            store4(m, in, i, {0.0f, 0.0f, 0.0f}, 1.0f);
            continue;
        }
        const Int offset = gather(table, entry);
        Corners e = corner_elements(m.chunk, i, packed & Int(0xff), mesh);
        e = {select(have, e.a, Int(0)), select(have, e.b, Int(0)), select(have, e.c, Int(0))};
        const Int start = select(have, offset, Int(0));
        const Float s = u.at(i), t = v.at(i);
        const Float x = channel(g->floats, e, start, channels, Int(0), s, t);
        const Float y = channel(g->floats, e, start, channels, max(min(channels - Int(1), Int(1)), Int(0)), s, t);
        const Mask single = channels == Int(1), many = channels >= Int(3), four = channels == Int(4);
        Float z = select(single, x, Float(0.0f)), w = 1.0f;
        if (any(many)) z = select(many, channel(g->floats, e, start, channels, select(many, Int(2), Int(0)), s, t), z);
        if (any(four)) w = select(four, channel(g->floats, e, start, channels, select(four, Int(3), Int(0)), s, t), w);
        store4(m, in, i, {select(have, x, 0.0f), select(have, y, 0.0f), select(have, z, 0.0f)}, w);
    }
}

void op_instance_value(const Machine& m, const Instruction& in) {
    const auto value = static_cast<InstanceValue>(in.imm);
    for (int i = 0; i < m.end; i += W) {
        const auto get = [&](std::size_t member, float fallback) { return instance_float(m.chunk, i, member, fallback); };
        const auto get3 = [&](std::size_t member, float fallback) {
            return Vec3{get(member, fallback), get(member + 4, fallback), get(member + 8, fallback)};
        };
        switch (value) {
            case InstanceValue::location: store4(m, in, i, get3(offsetof(InstanceInfo, location), 0), 1.0f); break;
            case InstanceValue::color:
                store4(m, in, i, get3(offsetof(InstanceInfo, color), 1), get(offsetof(InstanceInfo, color) + 12, 1));
                break;
            case InstanceValue::random: store4(m, in, i, {get(offsetof(InstanceInfo, random), 0), 0.0f, 0.0f}, 1.0f); break;
            case InstanceValue::pass_index: store4(m, in, i, {get(offsetof(InstanceInfo, pass_index), 0), 0.0f, 0.0f}, 1.0f); break;
            case InstanceValue::dupli_generated: store4(m, in, i, get3(offsetof(InstanceInfo, dupli_generated), 0), 1.0f); break;
            case InstanceValue::dupli_uv:
                store4(m, in, i, {get(offsetof(InstanceInfo, dupli_uv), 0), get(offsetof(InstanceInfo, dupli_uv) + 4, 0), 0.0f}, 1.0f);
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
    const auto get = [&](std::size_t member) { return gather(base, mesh + Int(static_cast<int>(member / sizeof(float)))); };
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
            static const Affine identity{};
            const nodes::GeometryTables* g = m.chunk.geometry;
            to_local = uniform_affine(g != nullptr ? g->world_to_camera : identity);
            to_world = uniform_affine(g != nullptr ? g->camera_to_world : identity);
        }
        Vec3 r = from_world ? apply(to_local, to_world, quantity, v.at(i)) : apply(to_world, to_local, quantity, v.at(i));
        if (space == Space::generated) r = to_generated(m.chunk, i, r);
        store_vec(m, in, 0, i, r);
    }
}

/// Cycles' frame about the geometric normal, so that bump mapping sees the same points.
void op_surface_step(const Machine& m, const Instruction& in) {
    for (int i = 0; i < m.end; i += W) {
        const Vec3 n = load3(m.chunk.normal_geometric, i);
        const Mask same = (n.x == n.y) & (n.x == n.z);
        const Vec3 a = normalize(Vec3{n.z - n.y, select(same, n.x + n.z, n.x - n.z), select(same, -n.y - n.x, n.y - n.x)});
        store_vec(m, in, 0, i, (in.imm == 0 ? a : cross(n, a)) * load(m.chunk.footprint + i));
    }
}

void op_barycentric_step(const Machine& m, const Instruction& in) {
    const Source3 d = m.arg3(in, 0);
    for (int i = 0; i < m.end; i += W) {
        const Vec3 p = d.at(i), a = load3(m.chunk.dp_du, i), b = load3(m.chunk.dp_dv, i);
        const Float aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), pa = dot(p, a), pb = dot(p, b);
        const Float det = aa * bb - ab * ab;
        const Float inv = select(det > Float(0.0f), 1.0f / max(det, 1e-38f), Float(0.0f));
        store(m.dst(in, 0) + i, load(m.chunk.barycentric_u + i) + (bb * pa - ab * pb) * inv);
        store(m.dst(in, 1) + i, load(m.chunk.barycentric_v + i) + (aa * pb - ab * pa) * inv);
    }
}

void op_ray_value(const Machine& m, const Instruction& in) {
    const auto value = static_cast<RayValue>(in.imm);
    const nodes::ShadingChunk& c = m.chunk;
    const float* rows[] = {c.ray_length, c.ray_depth, c.diffuse_depth, c.glossy_depth, c.transparent_depth, c.transmission_depth};
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
