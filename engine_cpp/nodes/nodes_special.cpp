// SPDX-License-Identifier: GPL-3.0-or-later
// Textures with tables or methods of their own: Gabor, IES.
#include "nodes/ies.h"
#include "nodes/node_helpers.h"

#include <algorithm>
#include <fstream>

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

constexpr std::size_t k_most_ies = std::size_t{1} << 24;  ///< bytes of a photometric file

/// The text of the node, or of its file.
std::string ies_text(NodeContext& c) {
    if (c.text("mode", "INTERNAL") == "INTERNAL") return c.text("ies_text");
    std::ifstream file(c.text("filepath"), std::ios::binary);
    std::string text(k_most_ies, '\0');
    file.read(text.data(), static_cast<std::streamsize>(k_most_ies));
    text.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
    return text;
}

/// What Cycles gives for a file that it cannot read.
constexpr float k_no_ies = 100;

void ies(NodeContext& c) {
    const Ref strength = c.number("Strength", 1);
    const std::vector<float> table = parse_ies(ies_text(c));
    if (table.empty()) {
        c.warn("ies " + c.node.name, c.place() + ": the photometric file cannot be read");
        c.number_out("Fac", c.b.multiply(strength, c.b.constant(k_no_ies)));
        return;
    }
    Ref3 d = c.b.chunk3(ChunkRow::wo);
    if (c.linked("Vector"))
        d = c.vector("Vector");
    else if (c.kind() != GraphKind::world)
        d = to_object(c, d, Quantity::normal);
    // Blender 4.1 to 4.5 fade beyond the table's ends; before, every table went around the circle.
    const int version = static_cast<int>(c.property("version", 1));
    const std::uint32_t mode = version == 2 ? 0u : version > 2 ? ies_keeps_ends : ies_keeps_ends | ies_is_round;
    c.number_out("Fac", c.b.multiply(strength, c.b.emit(Op::ies, {d.x, d.y, d.z}, mode, c.b.add_data(table))));
}

constexpr NodeType k_nodes[] = {
    {"ShaderNodeTexIES", ies, nullptr, Support::same, ""},
    {"ShaderNodeTexGabor", gabor, nullptr, since_45(Support::same), ""},
};

}  // namespace

std::span<const NodeType> special_nodes() { return k_nodes; }

}  // namespace cardioid::nodes
