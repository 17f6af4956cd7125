// SPDX-License-Identifier: GPL-3.0-or-later
// Textures with tables or methods of their own: Gabor.
#include "nodes/node_helpers.h"

namespace cardioid::nodes {

namespace {

void gabor(NodeContext& c) {
    const Ref3 p = c.b.multiply(texture_point(c, TextureDefault::generated), c.number("Scale", 5));
    const Ref3 axis = c.vector("Orientation 3D", {1.41421356f, 1.41421356f, 0});
    const Results r = c.b.emit_all(Op::gabor,
                                   {p.x, p.y, p.z, c.number("Frequency", 2), c.number("Anisotropy", 1),
                                    c.number("Orientation 2D", 0.78539816f), axis.x, axis.y, axis.z},
                                   c.text("gabor_type", "2D") == "3D" ? 3u : 2u);
    c.number_out("Value", r[0]);
    c.number_out("Phase", r[1]);
    c.number_out("Intensity", r[2]);
}

constexpr NodeType k_nodes[] = {
    {"ShaderNodeTexGabor", gabor, nullptr, since_45(Support::same), ""},
};

}  // namespace

std::span<const NodeType> special_nodes() { return k_nodes; }

}  // namespace cardioid::nodes
