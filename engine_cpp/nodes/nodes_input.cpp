// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes that only read: constants, attributes, the hit, the ray.
#include "nodes/node_helpers.h"

namespace cardioid::nodes {

namespace {

void rgb(NodeContext& c) {
    const std::vector<double> v = c.list("value");
    const auto at = [&](std::size_t k) { return k < v.size() ? static_cast<float>(v[k]) : 0.0f; };
    c.color_out("Color", c.b.constant(Float3{at(0), at(1), at(2)}));
}
void value(NodeContext& c) { c.number_out("Value", c.b.constant(static_cast<float>(c.property("value")))); }

constexpr NodeType k_nodes[] = {
    {"ShaderNodeRGB", rgb, nullptr, Support::same, ""},
    {"ShaderNodeValue", value, nullptr, Support::same, ""},
};

}  // namespace

std::span<const NodeType> input_nodes() { return k_nodes; }

}  // namespace cardioid::nodes
