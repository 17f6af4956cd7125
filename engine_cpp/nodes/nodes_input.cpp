// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes that only read: constants, attributes, coordinates, the hit, the ray.
#include "nodes/node_helpers.h"

namespace cardioid::nodes {

namespace {

Ref3 transformed(NodeContext& c, Ref3 v, Space space, Quantity quantity, Direction direction) {
    return c.b.emit3(Op::transform, {v.x, v.y, v.z}, transform_mode(space, quantity, direction));
}

void rgb(NodeContext& c) {
    const std::vector<double> v = c.list("value");
    const auto at = [&](std::size_t k) { return k < v.size() ? static_cast<float>(v[k]) : 0.0f; };
    c.color_out("Color", c.b.constant(Float3{at(0), at(1), at(2)}));
}

void value(NodeContext& c) { c.number_out("Value", c.b.constant(static_cast<float>(c.property("value")))); }

/// Coordinates of another object: the inverse of its matrix, a parameter.
Ref3 in_object_space(NodeContext& c) {
    const std::vector<double> m = c.list("object_matrix");
    if (m.size() < 12) return c.object_position();
    Affine a;
    for (std::size_t k = 0; k < 12; ++k) a.m[k] = static_cast<float>(m[k]);
    return constant_affine(c, inverse(a), c.position(), true);
}

Ref3 reflection(NodeContext& c) {
    const Ref3 n = c.normal(), wo = c.b.chunk3(ChunkRow::wo);
    if (c.kind() == GraphKind::world) return wo;
    return c.b.subtract(c.b.multiply(n, c.b.multiply(c.b.dot(n, wo), c.b.constant(2))), wo);
}

void texture_coordinate(NodeContext& c) {
    const Ref3 p = c.position();
    const bool world = c.kind() == GraphKind::world;
    const bool instancer = c.flag("from_instancer");
    c.vector_out("Generated", instancer ? instance3(c, InstanceValue::dupli_generated) : c.generated());
    c.vector_out("UV", instancer ? instance3(c, InstanceValue::dupli_uv) : active_uv(c));
    c.vector_out("Normal", transformed(c, c.normal(), Space::object, Quantity::normal, Direction::from_world));
    c.vector_out("Object", in_object_space(c));
    // The world is seen from the camera: its points are directions.
    c.vector_out("Camera",
                 transformed(c, p, Space::camera, world ? Quantity::vector : Quantity::point, Direction::from_world));
    c.vector_out("Window", c.b.emit3(Op::window, {p.x, p.y, p.z}, world));
    c.vector_out("Reflection", reflection(c));
}

void uv_map(NodeContext& c) {
    const std::string name = c.text("uv_map");
    if (c.flag("from_instancer"))
        c.vector_out("UV", instance3(c, InstanceValue::dupli_uv));
    else
        c.vector_out("UV", [&] {
            const Results r = c.attribute(name.empty() ? k_active_uv : name);
            return Ref3{r[0], r[1], c.b.constant(0)};
        }());
}

/// What an Attribute node of any type reads: x, y, z, w.
Results attribute_rows(NodeContext& c) {
    const std::string kind = c.text("attribute_type", "GEOMETRY"), name = c.text("attribute_name");
    const Ref zero = c.b.constant(0);
    if (kind == "OBJECT") return c.instance_value("object:" + name);
    if (kind == "INSTANCER") return c.instance_value("instancer:" + name);
    if (kind == "VIEW_LAYER") {
        const std::vector<double> v = c.list("value");
        Results r{};
        for (std::size_t k = 0; k < 4; ++k) r[k] = c.b.constant(k < v.size() ? static_cast<float>(v[k]) : 0.0f);
        return r;
    }
    return name.empty() ? Results{zero, zero, zero, c.b.constant(1)} : c.attribute(name);
}

void attribute(NodeContext& c) {
    const Results r = attribute_rows(c);
    c.color_out("Color", rows3(r));
    c.vector_out("Vector", rows3(r));
    const std::string name = c.text("attribute_name");
    const bool of_mesh = c.text("attribute_type", "GEOMETRY") == "GEOMETRY" && !name.empty();
    c.number_out("Fac", of_mesh ? c.attribute(name, attribute_number)[0] : c.b.average(rows3(r)));
    c.number_out("Alpha", r[3]);
}

void color_attribute(NodeContext& c) {
    const std::string name = c.text("layer_name");
    const Results r = c.attribute(name.empty() ? k_active_color : name, attribute_missing_clear);
    c.color_out("Color", rows3(r));
    c.number_out("Alpha", r[3]);
}

void geometry(NodeContext& c) {
    const Ref u = c.barycentric_u(), v = c.barycentric_v(), one = c.b.constant(1), zero = c.b.constant(0);
    c.vector_out("Position", c.position());
    c.vector_out("Normal", c.normal());
    c.vector_out("Tangent", default_tangent(c));
    c.vector_out("True Normal", c.b.chunk3(ChunkRow::normal_geometric));
    c.vector_out("Incoming", c.b.chunk3(ChunkRow::wo));
    c.vector_out("Parametric", {c.b.subtract(c.b.subtract(one, u), v), u, zero});
    c.number_out("Backfacing", c.b.chunk(ChunkRow::backfacing));
    c.number_out("Pointiness", c.attribute(k_pointiness)[0]);
    c.number_out("Random Per Island", c.attribute(k_random_island)[0]);
}

Ref facing_cosine(NodeContext& c) { return c.b.dot(c.b.chunk3(ChunkRow::wo), c.vector_or("Normal", c.normal())); }

void fresnel_node(NodeContext& c) {
    const Ref ior = c.number("IOR", 1.45f);
    c.number_out("Fac", fresnel(c, facing_cosine(c), sided_eta(c, ior)));
}

void layer_weight(NodeContext& c) {
    Builder& b = c.b;
    const Ref one = b.constant(1), half = b.constant(0.5f), blend = c.number("Blend", 0.5f), cosine = facing_cosine(c);
    const Ref eta = b.maximum(b.one_minus(blend), b.constant(1e-5f));
    c.number_out("Fresnel",
                 fresnel(c, cosine, b.select_positive(b.chunk(ChunkRow::backfacing), eta, b.divide(one, eta))));
    const Ref inside = b.emit(Op::clamp, {blend, b.constant(0), b.constant(1.0f - 1e-5f)});
    const Ref exponent = b.select_positive(b.subtract(half, inside), b.multiply(inside, b.constant(2)),
                                           b.divide(half, b.one_minus(inside)));
    const Ref f = b.emit(Op::absolute, {cosine});
    c.number_out("Facing", b.one_minus(b.is(blend, 0.5f) ? f : b.emit(Op::power, {f, exponent})));
}

constexpr NodeType k_nodes[] = {
    {"ShaderNodeRGB", rgb, nullptr, Support::same, ""},
    {"ShaderNodeValue", value, nullptr, Support::same, ""},
    {"ShaderNodeTexCoord", texture_coordinate, nullptr, Support::same,
     "Generated is the texture space box of the mesh"},
    {"ShaderNodeUVMap", uv_map, nullptr, Support::same, ""},
    {"ShaderNodeAttribute", attribute, nullptr, Support::same, ""},
    {"ShaderNodeVertexColor", color_attribute, nullptr, Support::same, ""},
    {"ShaderNodeNewGeometry", geometry, nullptr, Support::same, ""},
    {"ShaderNodeFresnel", fresnel_node, nullptr, Support::same, ""},
    {"ShaderNodeLayerWeight", layer_weight, nullptr, Support::same, ""},
};

}  // namespace

std::span<const NodeType> input_nodes() { return k_nodes; }

}  // namespace cardioid::nodes
