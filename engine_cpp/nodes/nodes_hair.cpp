// SPDX-License-Identifier: GPL-3.0-or-later
// Hair BSDF and Principled Hair. Strands come as tubes of triangles with the direction along them as an attribute; on other
// meshes that direction is an edge of the triangle, as in Cycles.
#include "nodes/node_helpers.h"

namespace cardioid::nodes {

namespace {

using bsdf::LobeKind;

struct Strand {
    Ref3 attribute;  ///< world; 0 where the mesh is no hair
    Ref is_hair;     ///< 1 or 0
};

Strand strand(NodeContext& c) {
    Builder& b = c.b;
    const Results t = c.attribute(k_curve_tangent);
    const Ref3 world = b.emit3(Op::transform, {t[0], t[1], t[2]},
                               transform_mode(Space::object, Quantity::vector, Direction::from_world));
    const Ref there = b.dot({t[0], t[1], t[2]}, {t[0], t[1], t[2]});
    return {world, b.emit(Op::greater_than, {there, b.constant(0)})};
}

Ref3 along(NodeContext& c, const Strand& s, ChunkRow otherwise) {
    const Ref3 edge = c.b.normalize(c.b.chunk3(otherwise)), t = s.attribute;
    return c.b.emit3(Op::normalize_or, {t.x, t.y, t.z, edge.x, edge.y, edge.z});
}

/// Cycles' curves are hit where rays enter them alone: the far side of a tube is not there. What is left of `weight`.
Ref3 open_far_side(NodeContext& c, const Strand& s, Ref3 weight) {
    const Ref back = c.b.multiply(c.b.chunk(ChunkRow::backfacing), s.is_hair);
    c.transparent(c.b.multiply(weight, back));
    return c.b.multiply(weight, c.b.one_minus(back));
}

void hair(NodeContext& c, Ref weight) {
    Builder& b = c.b;
    const Strand s = strand(c);
    const Ref3 color = b.maximum(c.color("Color", {0.8f, 0.8f, 0.8f}), b.constant(0));
    HairLobe l;
    l.kind =
        c.text("component", "Reflection") == "Transmission" ? LobeKind::hair_transmission : LobeKind::hair_reflection;
    l.weight = open_far_side(c, s, b.multiply(color, weight));
    l.normal = c.normal();
    l.alpha_x = c.number("RoughnessU", 0.1f);
    l.alpha_y = c.number("RoughnessV", 1);
    const Ref offset = b.subtract(b.constant(0), c.number("Offset", 0));
    if (c.linked("Tangent")) {
        l.tangent = b.normalize(c.vector("Tangent"));
        l.third = offset;
    } else {
        l.tangent = along(c, s, ChunkRow::dp_dv);
        l.third = b.multiply(offset, s.is_hair);
    }
    l.eta = b.constant(1);
    l.f0 = l.f90 = l.tint = b.constant(Float3{0, 0, 0});
    c.hair_lobe(l);
}

// -------------------------------------------------------------------------------------------------- Principled Hair

/// Absorption of a strand that looks like `color` (Chiang et al. 2016).
Ref3 absorption_of(NodeContext& c, Ref3 color, Ref radial_roughness) {
    Builder& b = c.b;
    Ref scale = b.constant(0.245f);
    for (const float k : {5.574f, -10.73f, 2.532f, -0.215f, 5.969f})
        scale = b.add(b.multiply(scale, radial_roughness), b.constant(k));
    return Builder::each(color, [&](Ref x) {
        const Ref log = b.emit(Op::logarithm, {b.maximum(x, b.constant(1e-10f)), b.constant(2.7182818f)});
        const Ref root = b.divide(log, scale);
        return b.multiply(root, root);
    });
}

/// 1 + 2(random - 0.5)·amount
Ref vary(NodeContext& c, Ref random, Ref amount) {
    const Ref swing = c.b.multiply(c.b.subtract(random, c.b.constant(0.5f)), amount);
    return c.b.add(c.b.constant(1), c.b.add(swing, swing));
}

Ref3 melanin_absorption(NodeContext& c, Ref random, Ref radial_roughness) {
    Builder& b = c.b;
    const Ref one = b.constant(1);
    const Ref varied = b.multiply(c.number("Melanin", 0.8f), vary(c, random, b.saturate(c.number("Random Color", 0))));
    const Ref left = b.maximum(b.subtract(one, varied), b.constant(0.0001f));
    const Ref melanin = b.subtract(b.constant(0), b.emit(Op::logarithm, {left, b.constant(2.7182818f)}));
    const Ref redness = c.number("Melanin Redness", 1);
    const Ref3 eumelanin =
        b.multiply(b.constant(Float3{0.506f, 0.841f, 1.653f}), b.multiply(melanin, b.one_minus(redness)));
    const Ref3 pheomelanin = b.multiply(b.constant(Float3{0.343f, 0.733f, 1.924f}), b.multiply(melanin, redness));
    return b.add(b.add(eumelanin, pheomelanin), absorption_of(c, c.color("Tint", {1, 1, 1}), radial_roughness));
}

/// Where the ray meets the strand's section, from one edge (-1) over the middle to the other (1).
Ref across(NodeContext& c, Ref3 tangent, Ref3 normal) {
    Builder& b = c.b;
    const Ref3 y = b.normalize(b.cross(tangent, b.chunk3(ChunkRow::wo)));
    const Ref3 z = b.normalize(b.cross(tangent, y));
    return b.dot(b.cross(normal, tangent), z);
}

void principled_hair(NodeContext& c, Ref weight) {
    Builder& b = c.b;
    const Strand s = strand(c);
    const bool huang = c.text("model", "CHIANG") == "HUANG";
    const Ref random = c.linked("Random") ? c.number("Random") : c.attribute(k_curve_random)[0];
    const Ref factor = vary(c, random, c.number("Random Roughness", 0));
    const Ref rough = b.multiply(c.number("Roughness", 0.3f), factor);
    const Ref radial = huang ? rough : b.multiply(c.number("Radial Roughness", 0.3f), factor);
    const std::string by = c.text("parametrization", "COLOR");
    HairLobe l;
    l.weight = open_far_side(c, s, b.broadcast(weight));
    l.normal = c.normal();
    l.tangent = along(c, s, ChunkRow::dp_du);
    l.alpha_x = rough;
    l.alpha_y = radial;
    l.third = b.one_minus(b.saturate(c.number("Coat", 0)));
    l.eta = c.number("IOR", 1.55f);
    l.f0 = by == "ABSORPTION" ? c.vector("Absorption Coefficient", {0.246f, 0.52f, 1.365f})
           : by == "MELANIN"  ? melanin_absorption(c, random, radial)
                              : absorption_of(c, c.color("Color", {0.017513f, 0.005763f, 0.002059f}), radial);
    const Ref zero = b.constant(0);
    l.f90 = {across(c, l.tangent, l.normal), c.number("Offset", 0.034907f), zero};
    l.tint = b.constant(Float3{1, 1, 1});
    if (huang) {
        const auto part = [&](const char* id) { return b.maximum(c.number(id, 1), zero); };
        l.tint = {part("R lobe"), part("TT lobe"), part("TRT lobe")};
    }
    c.hair_lobe(l);
}

constexpr NodeType k_nodes[] = {
    {"ShaderNodeBsdfHair", nullptr, hair, Support::approximated,
     "lamps light what Transmission sends to either side of the shading normal; Cycles evaluates the far side alone"},
    {"ShaderNodeBsdfHairPrincipled", nullptr, principled_hair, Support::approximated,
     "Coat is a little darker; the model Huang is rendered by Chiang's, with its factors of R, TT and TRT and round "
     "sections"},
};

}  // namespace

std::span<const NodeType> hair_nodes() { return k_nodes; }

}  // namespace cardioid::nodes
