// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes that tell about what is shaded: its object, particle, strand, the ray, the camera; and nodes that do nothing in Cycles.
#include "nodes/node_helpers.h"

namespace cardioid::nodes {

namespace {

void object_info(NodeContext& c) {
    const Results color = c.b.emit_all(Op::instance_value, {}, static_cast<std::uint32_t>(InstanceValue::color));
    c.vector_out("Location", instance3(c, InstanceValue::location));
    c.color_out("Color", rows3(color));
    c.number_out("Alpha", color[3]);
    c.number_out("Object Index", instance3(c, InstanceValue::pass_index).x);
    c.number_out("Material Index", instance3(c, InstanceValue::material_index).x);
    c.number_out("Random", instance3(c, InstanceValue::random).x);
}

void particle_info(NodeContext& c) {
    const auto number = [&](const char* id, const char* name) { c.number_out(id, c.instance_value(name)[0]); };
    const auto vector = [&](const char* id, const char* name) { c.vector_out(id, rows3(c.instance_value(name))); };
    number("Index", "particle:index");
    number("Random", "particle:random");
    number("Age", "particle:age");
    number("Lifetime", "particle:lifetime");
    number("Size", "particle:size");
    vector("Location", "particle:location");
    vector("Velocity", "particle:velocity");
    vector("Angular Velocity", "particle:angular_velocity");
}

void hair_info(NodeContext& c) {
    Builder& b = c.b;
    const Ref3 along = rows3(c.attribute(k_curve_tangent));
    const Ref is_strand = b.emit(Op::sign, {b.dot(along, along)});
    const Ref3 wo = b.chunk3(ChunkRow::wo);
    const Ref3 t = b.normalize(to_world(c, along, Quantity::vector));
    c.number_out("Is Strand", is_strand);
    c.number_out("Intercept", c.attribute(k_curve_intercept)[0]);
    c.number_out("Length", c.attribute(k_curve_length)[0]);
    c.number_out("Thickness", c.attribute(k_curve_thickness)[0]);
    c.number_out("Random", c.attribute(k_curve_random)[0]);
    // The direction across the strand that faces the ray.
    const Ref3 across = b.normalize(b.subtract(wo, b.multiply(t, b.dot(t, wo))));
    c.vector_out("Tangent Normal", b.multiply(across, is_strand));
}

/// There are no point clouds: as Cycles on any other geometry.
void point_info(NodeContext& c) {
    const Ref zero = c.b.constant(0);
    c.vector_out("Position", c.b.broadcast(zero));
    c.number_out("Radius", zero);
    c.number_out("Random", zero);
}

/// There are no volume grids: as Cycles on geometry without them.
void volume_info(NodeContext& c) {
    const Ref zero = c.b.constant(0);
    c.color_out("Color", c.b.broadcast(zero));
    for (const char* id : {"Density", "Flame", "Temperature"}) c.number_out(id, zero);
}

void light_path(NodeContext& c) {
    const auto out = [&](const char* id, RayValue v) { c.number_out(id, ray_value(c, v)); };
    out("Is Camera Ray", RayValue::is_camera);
    out("Is Shadow Ray", RayValue::is_shadow);
    out("Is Diffuse Ray", RayValue::is_diffuse);
    out("Is Glossy Ray", RayValue::is_glossy);
    out("Is Singular Ray", RayValue::is_singular);
    out("Is Reflection Ray", RayValue::is_reflection);
    out("Is Transmission Ray", RayValue::is_transmission);
    out("Is Volume Scatter Ray", RayValue::is_volume);
    out("Ray Length", RayValue::length);
    out("Ray Depth", RayValue::depth);
    out("Diffuse Depth", RayValue::diffuse_depth);
    out("Glossy Depth", RayValue::glossy_depth);
    out("Transparent Depth", RayValue::transparent_depth);
    out("Transmission Depth", RayValue::transmission_depth);
    c.number_out("Portal Depth", c.b.constant(0));
}

/// Cycles takes the direction of a world shader for a point here.
void camera_data(NodeContext& c) {
    const Ref3 q = c.position();
    const Ref3 p = c.b.emit3(Op::transform, {q.x, q.y, q.z},
                             transform_mode(Space::camera, Quantity::point, Direction::from_world));
    c.vector_out("View Vector", c.b.normalize(p));
    c.number_out("View Z Depth", p.z);
    c.number_out("View Distance", c.b.length(p));
}

/// Lamps that are infinitely far have an endless ray: then nothing is scaled, as it would overflow.
void light_falloff(NodeContext& c) {
    Builder& b = c.b;
    const Ref length = ray_value(c, RayValue::length), smooth = c.number("Smooth", 0);
    const Ref squared = b.multiply(length, length), plain = c.number("Strength", 100);
    const Ref endless = b.emit(Op::greater_than, {length, b.constant(1e18f)});
    const Ref softened = b.select_positive(smooth, b.divide(squared, b.add(smooth, squared)), b.constant(1));
    const Ref strength = b.is(smooth, 0) ? plain : b.multiply(plain, softened);
    const auto out = [&](const char* id, Ref v) { c.number_out(id, b.select_positive(endless, plain, v)); };
    out("Quadratic", strength);
    out("Linear", b.multiply(strength, length));
    out("Constant", b.multiply(strength, squared));
}

void wireframe(NodeContext& c) {
    const Ref zero = c.b.constant(0);
    const Ref3 step = c.shift() == Shift::none ? c.b.broadcast(zero) : c.step(c.shift());
    c.number_out("Fac", c.b.emit(Op::wireframe, {c.number("Size", 0.01f), step.x, step.y, step.z},
                                 c.flag("use_pixel_size") ? 1u : 0u));
}

void scene_time(NodeContext& c) {
    c.number_out("Seconds", c.b.constant(static_cast<float>(c.property("seconds"))));
    c.number_out("Frame", c.b.constant(static_cast<float>(c.property("frame"))));
}

/// Not a node of Cycles either: what it is linked to uses its default.
void nothing(NodeContext&) {}

constexpr NodeType k_nodes[] = {
    {"ShaderNodeObjectInfo", object_info, nullptr, Support::same, ""},
    {"ShaderNodeParticleInfo", particle_info, nullptr, Support::same, ""},
    {"ShaderNodeHairInfo", hair_info, nullptr, Support::approximated,
     "strands are tubes of triangles; Intercept, Length, Thickness and Random are theirs"},
    {"ShaderNodePointInfo", point_info, nullptr, Support::approximated, "there are no point clouds: always 0"},
    {"ShaderNodeVolumeInfo", volume_info, nullptr, Support::approximated, "there are no volume grids: always 0"},
    {"ShaderNodeLightPath", light_path, nullptr, Support::same, "Portal Depth is 0"},
    {"ShaderNodeCameraData", camera_data, nullptr, Support::same, ""},
    {"ShaderNodeLightFalloff", light_falloff, nullptr, Support::same, ""},
    {"ShaderNodeWireframe", wireframe, nullptr, Support::same, ""},
    {"ShaderNodeSceneTime", scene_time, nullptr, since_52(Support::same),
     "from params[\"seconds\"] and params[\"frame\"]"},
    {"ShaderNodeOutputAOV", nothing, nullptr, Support::same, "its passes are not written"},
    {"ShaderNodeShaderToRGB", nothing, nullptr, Support::same, "Eevee only; ignored, as in Cycles"},
    {"ShaderNodeEeveeSpecular", nothing, nullptr, Support::same, "Eevee only; ignored, as in Cycles"},
    {"ShaderNodeSqueeze", nothing, nullptr, Support::same, "ignored, as in Cycles"},
    {"ShaderNodeUVAlongStroke", nothing, nullptr, Support::same, "Freestyle only; ignored, as in Cycles"},
};

}  // namespace

std::span<const NodeType> info_nodes() { return k_nodes; }

}  // namespace cardioid::nodes
