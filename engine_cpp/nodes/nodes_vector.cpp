// SPDX-License-Identifier: GPL-3.0-or-later
// Mapping, rotations, spaces; normals: Normal Map, Bump, Tangent, Displacement.
#include "nodes/node_helpers.h"

#include <algorithm>

namespace cardioid::nodes {

namespace {

/// Rows of the rotation about x, then y, then z.
struct Rotation {
    Ref3 row[3];
};

Rotation euler(NodeContext& c, Ref3 angles) {
    Builder& b = c.b;
    const auto cosine = [&](Ref a) { return b.emit(Op::cosine, {a}); };
    const auto sine = [&](Ref a) { return b.emit(Op::sine, {a}); };
    const Ref cx = cosine(angles.x), cy = cosine(angles.y), cz = cosine(angles.z), sx = sine(angles.x),
              sy = sine(angles.y), sz = sine(angles.z);
    const auto m = [&](Ref x, Ref y) { return b.multiply(x, y); };
    Rotation r;
    r.row[0] = {m(cy, cz), b.subtract(m(m(sy, sx), cz), m(cx, sz)), b.add(m(m(sy, cx), cz), m(sx, sz))};
    r.row[1] = {m(cy, sz), b.add(m(m(sy, sx), sz), m(cx, cz)), b.subtract(m(m(sy, cx), sz), m(sx, cz))};
    r.row[2] = {m(sy, b.constant(-1)), m(cy, sx), m(cy, cx)};
    return r;
}

Ref3 turn(NodeContext& c, const Rotation& r, Ref3 v) {
    const auto row = [&](Ref3 a) {
        return c.b.add(c.b.add(c.b.multiply(a.x, v.x), c.b.multiply(a.y, v.y)), c.b.multiply(a.z, v.z));
    };
    return {row(r.row[0]), row(r.row[1]), row(r.row[2])};
}

Rotation transposed(const Rotation& r) {
    return {{{r.row[0].x, r.row[1].x, r.row[2].x},
             {r.row[0].y, r.row[1].y, r.row[2].y},
             {r.row[0].z, r.row[1].z, r.row[2].z}}};
}

Ref3 divided(NodeContext& c, Ref3 a, Ref3 b) {
    return Builder::each(a, b, [&](Ref x, Ref y) { return c.b.divide(x, y); });
}

void mapping(NodeContext& c) {
    Builder& b = c.b;
    const Ref3 v = c.vector("Vector"), location = c.vector("Location"), scale = c.vector("Scale", {1, 1, 1});
    const Rotation r = euler(c, c.vector("Rotation"));
    const std::string type = c.text("vector_type", "POINT");
    if (type == "TEXTURE")
        c.vector_out("Vector", divided(c, turn(c, transposed(r), b.subtract(v, location)), scale));
    else if (type == "VECTOR")
        c.vector_out("Vector", turn(c, r, b.multiply(v, scale)));
    else if (type == "NORMAL")
        c.vector_out("Vector", b.normalize(turn(c, r, divided(c, v, scale))));
    else
        c.vector_out("Vector", b.add(turn(c, r, b.multiply(v, scale)), location));
}

void vector_rotate(NodeContext& c) {
    Builder& b = c.b;
    const Ref3 v = c.vector("Vector"), center = c.vector("Center");
    const Ref3 arm = b.subtract(v, center);
    const bool invert = c.flag("invert");
    const std::string type = c.text("rotation_type", "AXIS_ANGLE");
    if (type == "EULER_XYZ") {
        const Rotation r = euler(c, c.vector("Rotation"));
        c.vector_out("Vector", b.add(turn(c, invert ? transposed(r) : r, arm), center));
        return;
    }
    const Ref angle = b.multiply(c.number("Angle"), b.constant(invert ? -1.0f : 1.0f));
    Ref3 axis = b.constant(Float3{static_cast<float>(type == "X_AXIS"), static_cast<float>(type == "Y_AXIS"),
                                  static_cast<float>(type == "Z_AXIS")});
    if (type == "AXIS_ANGLE") axis = c.vector("Axis", {0, 0, 1});
    // Without an axis nothing turns.
    const Ref length = b.length(axis);
    const Ref3 turned = b.add(rotated(c, arm, b.normalize(axis), angle), center);
    c.vector_out("Vector", Builder::each(turned, v, [&](Ref x, Ref y) { return b.select_positive(length, x, y); }));
}

void vector_transform(NodeContext& c) {
    const std::string type = c.text("vector_type", "VECTOR"), from = c.text("convert_from", "WORLD"),
                      to = c.text("convert_to", "OBJECT");
    // Since Blender 4.4 normals are transformed as such, and stay as they are where nothing is to be done.
    const bool true_normal = type == "NORMAL" && c.property("version", 1) >= 2;
    const Quantity q = type == "POINT" ? Quantity::point : true_normal ? Quantity::normal : Quantity::vector;
    const auto space = [](const std::string& name) { return name == "CAMERA" ? Space::camera : Space::object; };
    Ref3 v = c.vector("Vector", {0.5f, 0.5f, 0.5f});
    if (from != to) {
        if (from != "WORLD")
            v = c.b.emit3(Op::transform, {v.x, v.y, v.z}, transform_mode(space(from), q, Direction::to_world));
        if (to != "WORLD")
            v = c.b.emit3(Op::transform, {v.x, v.y, v.z}, transform_mode(space(to), q, Direction::from_world));
    }
    c.vector_out("Vector", type == "NORMAL" && !true_normal ? c.b.normalize(v) : v);
}

void normal(NodeContext& c) {
    const std::vector<double> v = c.list("value");
    const auto at = [&](std::size_t k, float fallback) { return k < v.size() ? static_cast<float>(v[k]) : fallback; };
    const Ref3 direction = c.b.constant(normalize(Float3{at(0, 0), at(1, 0), at(2, 1)}));
    c.vector_out("Normal", direction);
    c.number_out("Dot", c.b.dot(direction, c.b.normalize(c.vector("Normal", {0, 0, 1}))));
}

/// Turned over on the back of a surface.
Ref3 sided(NodeContext& c, Ref3 v) {
    return Builder::each(v, [&](Ref x) {
        return c.b.select_positive(c.b.chunk(ChunkRow::backfacing), c.b.multiply(x, c.b.constant(-1)), x);
    });
}

Ref3 transformed(NodeContext& c, Ref3 v, Quantity quantity, Direction direction) {
    return c.b.emit3(Op::transform, {v.x, v.y, v.z}, transform_mode(Space::object, quantity, direction));
}

/// Tangent of a UV map for an object-space normal, with the sign of the bitangent.
Results uv_tangent(NodeContext& c, const std::string& name, Ref3 normal) {
    const std::string map = name.empty() ? k_active_uv : name;
    return c.b.emit_all(Op::uv_tangent, {c.barycentric_u(), c.barycentric_v(), normal.x, normal.y, normal.z},
                        c.attribute_id(k_tangent_prefix + map), c.attribute_id(map));
}

/// A tangent-space colour in world space, seen from the front of the surface.
Ref3 tangent_mapped(NodeContext& c, Ref3 color, Ref3 n) {
    Builder& b = c.b;
    const Ref3 front = sided(c, n), local = transformed(c, front, Quantity::normal, Direction::from_world);
    const Results t = uv_tangent(c, c.text("uv_map"), local);
    const Ref3 tangent = {t[0], t[1], t[2]}, bitangent = b.multiply(b.cross(local, tangent), t[3]);
    const Ref3 sum =
        b.add(b.add(b.multiply(tangent, color.x), b.multiply(bitangent, color.y)), b.multiply(local, color.z));
    // Where the mesh has no such map the normal stays.
    const Ref have = b.emit(Op::absolute, {t[3]});
    return Builder::each(transformed(c, sum, Quantity::normal, Direction::to_world), front,
                         [&](Ref x, Ref y) { return b.select_positive(have, x, y); });
}

void normal_map(NodeContext& c) {
    Builder& b = c.b;
    const std::string space = c.text("space", "TANGENT");
    const Ref half = b.constant(0.5f), two = b.constant(2), minus = b.constant(-1);
    const Ref strength = c.number("Strength", 1);
    Ref3 color =
        Builder::each(c.color("Color", {0.5f, 0.5f, 1}), [&](Ref x) { return b.multiply(b.subtract(x, half), two); });
    if (c.text("convention") == "DIRECTX") color.y = b.multiply(color.y, minus);
    // Since Blender 4.0 the strength flattens the map itself.
    const bool flattened = space == "TANGENT" && c.property("version", 1) >= 2;
    if (flattened)
        color = {b.multiply(color.x, strength), b.multiply(color.y, strength),
                 b.mix(b.constant(1), color.z, b.saturate(strength))};
    const Ref3 n = c.normal();
    Ref3 mapped;
    if (space == "TANGENT") {
        mapped = tangent_mapped(c, color, n);
    } else {
        if (space.starts_with("BLENDER")) color = {color.x, b.multiply(color.y, minus), b.multiply(color.z, minus)};
        const bool object = space == "OBJECT" || space == "BLENDER_OBJECT";
        mapped = object ? transformed(c, color, Quantity::normal, Direction::to_world) : b.normalize(color);
    }
    mapped = sided(c, mapped);
    if (!flattened && !b.is(strength, 1)) mapped = b.normalize(b.mix(n, mapped, b.maximum(strength, b.constant(0))));
    c.vector_out("Normal", b.emit3(Op::normalize_or, {mapped.x, mapped.y, mapped.z, n.x, n.y, n.z}));
}

/// Pixels that a step of the bump is long: the socket of Blender 4.5 and later, whose links are ignored there.
float filter_width(NodeContext& c) {
    const auto it = c.node.inputs.find("Filter Width");
    if (it == c.node.inputs.end()) return 1;
    return it->second.linked() ? 0.1f : std::max(it->second.value[0], 1e-5f);
}

void bump(NodeContext& c) {
    Builder& b = c.b;
    const Ref3 n = c.vector_or("Normal", c.normal());
    if (!c.linked("Height") || c.shift() != Shift::none) {
        c.vector_out("Normal", n);
        return;
    }
    const float before = c.set_step(filter_width(c));
    const Ref distance = b.multiply(c.number("Distance", 1), b.constant(c.flag("invert") ? -1.0f : 1.0f));
    const Ref height = c.number_at("Height", Shift::none, 1), x = c.number_at("Height", Shift::x, 1),
              y = c.number_at("Height", Shift::y, 1);
    const Ref3 tilted = bumped(c, n, b.subtract(x, height), b.subtract(y, height), c.number("Strength", 1), distance);
    c.set_step(before);
    // Before Blender 3.6 the node itself kept reflections above the surface; later the shaders do.
    const bool bend = c.property("version", 1) < 2;
    c.vector_out("Normal", bend ? b.emit3(Op::bend_normal, {tilted.x, tilted.y, tilted.z}) : tilted);
}

void tangent(NodeContext& c) {
    Builder& b = c.b;
    if (c.text("direction_type", "RADIAL") == "UV_MAP") {
        const Results t = uv_tangent(c, c.text("uv_map"),
                                     transformed(c, sided(c, c.normal()), Quantity::normal, Direction::from_world));
        c.vector_out("Tangent", tangent_around(c, {t[0], t[1], t[2]}));
        return;
    }
    const Ref half = b.constant(0.5f), zero = b.constant(0);
    const Ref3 g = c.generated();
    const Ref3 p = Builder::each(g, [&](Ref v) { return b.subtract(v, half); });
    const auto minus = [&](Ref v) { return b.multiply(v, b.constant(-1)); };
    const std::string axis = c.text("axis", "Z");
    Ref3 around = {minus(p.y), p.x, zero};
    if (axis == "X") around = {zero, minus(p.z), p.y};
    if (axis == "Y") around = {minus(p.z), zero, p.x};
    c.vector_out("Tangent", tangent_around(c, around));
}

void displacement(NodeContext& c) {
    Builder& b = c.b;
    const Ref height = b.multiply(b.subtract(c.number("Height", 0), c.number("Midlevel", 0.5f)), c.number("Scale", 1));
    const Ref3 n = c.vector_or("Normal", c.normal());
    if (c.text("space", "OBJECT") == "WORLD") {
        c.vector_out("Displacement", b.multiply(n, height));
        return;
    }
    const Ref3 moved = b.multiply(transformed(c, n, Quantity::normal, Direction::from_world), height);
    c.vector_out("Displacement", transformed(c, moved, Quantity::vector, Direction::to_world));
}

void vector_displacement(NodeContext& c) {
    Builder& b = c.b;
    const Ref midlevel = c.number("Midlevel", 0), scale = c.number("Scale", 1);
    const std::string space = c.text("space", "TANGENT");
    Ref3 d = Builder::each(c.color("Vector"), [&](Ref x) { return b.multiply(b.subtract(x, midlevel), scale); });
    if (space == "TANGENT") {
        const Ref3 n = transformed(c, c.normal(), Quantity::normal, Direction::from_world);
        const Results t = uv_tangent(c, "", n);
        const Ref3 along = {t[0], t[1], t[2]};
        const Ref3 across = b.multiply(b.normalize(b.cross(n, along)), t[3]);
        d = b.add(b.add(b.multiply(along, d.x), b.multiply(n, d.y)), b.multiply(across, d.z));
    }
    c.vector_out("Displacement", space == "WORLD" ? d : transformed(c, d, Quantity::vector, Direction::to_world));
}

constexpr NodeType k_nodes[] = {
    {"ShaderNodeMapping", mapping, nullptr, Support::same, ""},
    {"ShaderNodeVectorRotate", vector_rotate, nullptr, Support::same, ""},
    {"ShaderNodeVectorTransform", vector_transform, nullptr, Support::same, ""},
    {"ShaderNodeNormal", normal, nullptr, Support::same, ""},
    {"ShaderNodeNormalMap", normal_map, nullptr, Support::same,
     "the smooth normal that the map turns is unit; on a displaced surface it is the displaced one"},
    {"ShaderNodeBump", bump, nullptr, Support::same, "a Bump in the height of another one is flat at the two steps"},
    {"ShaderNodeTangent", tangent, nullptr, Support::same, ""},
    {"ShaderNodeDisplacement", displacement, nullptr, Support::same, ""},
    {"ShaderNodeVectorDisplacement", vector_displacement, nullptr, Support::same, ""},
};

}  // namespace

std::span<const NodeType> vector_nodes() { return k_nodes; }

}  // namespace cardioid::nodes
