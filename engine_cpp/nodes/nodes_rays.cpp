// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes that look around: Ambient Occlusion, Bevel, Raycast.
#include "nodes/node_helpers.h"

#include <algorithm>

namespace cardioid::nodes {

namespace {

/// What Cycles takes where the distance is 0: the world's ambient occlusion distance, by Blender's default.
constexpr float k_world_distance = 10.0f;

std::uint32_t sample_count(NodeContext& c, double fallback) {
    return static_cast<std::uint32_t>(std::clamp(c.property("samples", fallback), 0.0, double{ray_samples_mask}));
}

void ambient_occlusion(NodeContext& c) {
    const Ref3 n = c.vector_or("Normal", c.normal());
    Ref distance = c.number("Distance", 1);
    if (!c.linked("Distance") && c.b.is(distance, 0)) distance = c.b.constant(k_world_distance);
    const std::uint32_t mode =
        sample_count(c, 16) | (c.flag("inside") ? rays_inside : 0u) | (c.flag("only_local") ? rays_local : 0u);
    const Ref open = c.b.emit(Op::ambient_occlusion, {distance, n.x, n.y, n.z}, mode);
    c.color_out("Color", c.b.multiply(c.color("Color", {1, 1, 1}), open));
    c.number_out("AO", open);
}

void bevel(NodeContext& c) {
    Builder& b = c.b;
    const Ref3 plain = c.normal();
    Ref3 n = b.emit3(Op::bevel, {c.number("Radius", 0.05f)}, sample_count(c, 4));
    if (c.linked("Normal")) n = b.normalize(b.add(c.vector("Normal"), b.subtract(n, plain)));
    c.vector_out("Normal", n);
}

void raycast(NodeContext& c) {
    Builder& b = c.b;
    const Ref3 from = c.vector_or("Position", c.position()), towards = c.vector_or("Direction", c.normal());
    const Results r =
        b.emit_all(Op::raycast, {from.x, from.y, from.z, towards.x, towards.y, towards.z, c.number("Length", 1)},
                   c.flag("only_local") ? rays_local : 0u);
    c.number_out("Is Hit", r[0]);
    c.number_out("Self Hit", r[1]);
    c.number_out("Hit Distance", r[2]);
    c.vector_out("Hit Position", b.multiply(b.add(from, b.multiply(towards, r[2])), r[0]));
    c.vector_out("Hit Normal", {r[3], r[4], r[5]});
}

constexpr NodeType k_nodes[] = {
    {"ShaderNodeAmbientOcclusion", ambient_occlusion, nullptr, Support::same,
     "a distance of 0 is 10, the default of the world's"},
    {"ShaderNodeBevel", bevel, nullptr, Support::same, ""},
    {"ShaderNodeRaycast", raycast, nullptr, since_52(Support::approximated), "no attributes of what is hit"},
};

}  // namespace

std::span<const NodeType> ray_nodes() { return k_nodes; }

}  // namespace cardioid::nodes
