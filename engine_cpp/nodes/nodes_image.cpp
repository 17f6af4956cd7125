// SPDX-License-Identifier: GPL-3.0-or-later
// Image and environment textures.
#include "nodes/node_helpers.h"

#include "image/image_store.h"

namespace cardioid::nodes {

namespace {

std::uint32_t interpolation_of(NodeContext& c) {
    const std::string name = c.text("interpolation", "Linear");
    if (name == "Closest") return static_cast<std::uint32_t>(image::Interpolation::closest);
    if (name == "Cubic" || name == "Smart") return static_cast<std::uint32_t>(image::Interpolation::cubic);
    return static_cast<std::uint32_t>(image::Interpolation::linear);
}

std::uint32_t extension_of(NodeContext& c) {
    const std::string name = c.text("extension", "REPEAT");
    if (name == "EXTEND") return static_cast<std::uint32_t>(image::Extension::extend);
    if (name == "CLIP") return static_cast<std::uint32_t>(image::Extension::clip);
    if (name == "MIRROR") return static_cast<std::uint32_t>(image::Extension::mirror);
    return static_cast<std::uint32_t>(image::Extension::repeat);
}

/// params["tiles"]: number and image of each tile whose image is there.
std::vector<float> tiles_of(NodeContext& c) {
    const std::vector<double> pairs = c.list("tiles");
    std::vector<float> found{0};
    for (std::size_t k = 0; k + 1 < pairs.size() && c.images() != nullptr; k += 2) {
        if (!(pairs[k + 1] >= 0 && pairs[k + 1] < c.images()->size())) continue;
        found.push_back(static_cast<float>(pairs[k]));
        found.push_back(static_cast<float>(static_cast<int>(pairs[k + 1])));
        ++found[0];
    }
    return found;
}

/// imm of the image ops, or -1 when there is no image.
std::int64_t image_mode(NodeContext& c, std::uint32_t extension, image::AlphaUse alpha) {
    const auto index = static_cast<std::int64_t>(c.property("image", -1));
    const bool tiled = !c.list("tiles").empty();
    if (c.images() == nullptr || (!tiled && (index < 0 || index >= c.images()->size()))) return -1;
    return (tiled ? 0 : index) | static_cast<std::int64_t>(interpolation_of(c)) << 24 |
           static_cast<std::int64_t>(alpha) << 27 | static_cast<std::int64_t>(extension) << 28;
}

Results lookup(NodeContext& c, std::int64_t mode, Ref u, Ref v) {
    const std::vector<float> tiles = tiles_of(c);
    if (tiles.size() > 1)
        return c.b.emit_all(Op::image_tiles, {u, v}, static_cast<std::uint32_t>(mode), c.b.add_data(tiles));
    return c.b.emit_all(Op::image, {u, v}, static_cast<std::uint32_t>(mode));
}

void outputs(NodeContext& c, Ref3 color, Ref alpha) {
    c.color_out("Color", color);
    c.number_out("Alpha", alpha);
}

/// A node without an image is magenta in Cycles, like one whose image is lost (which the image room sees to).
bool no_image(NodeContext& c, std::int64_t mode) {
    if (mode >= 0) return false;
    outputs(c, c.b.constant(Float3{1, 0, 1}), c.b.constant(1));
    return true;
}

Ref3 from_unit_box(NodeContext& c, Ref3 p) {
    const Ref half = c.b.constant(0.5f), two = c.b.constant(2);
    return c.b.each(p, [&](Ref x) { return c.b.multiply(c.b.subtract(x, half), two); });
}

void box(NodeContext& c, std::int64_t mode, Ref3 p) {
    const Ref3 n = c.normal();
    const Ref3 local = c.b.emit3(Op::transform, {n.x, n.y, n.z},
                                 transform_mode(Space::object, Quantity::normal, Direction::from_world));
    const Ref3 w = c.b.emit3(
        Op::box_weights, {local.x, local.y, local.z, c.b.constant(static_cast<float>(c.property("projection_blend")))});
    // The side that faces the other way is mirrored, so that no texture is flipped.
    const auto flip = [&](Ref sign, Ref x) { return c.b.select_positive(sign, c.b.one_minus(x), x); };
    const Ref minus_x = c.b.multiply(local.x, c.b.constant(-1));
    const Results rx = lookup(c, mode, flip(minus_x, p.y), p.z);
    const Results ry = lookup(c, mode, flip(local.y, p.x), p.z);
    const Results rz = lookup(c, mode, flip(local.z, p.y), p.x);
    Ref sum[4];
    for (std::size_t k = 0; k < 4; ++k)
        sum[k] = c.b.add(c.b.add(c.b.multiply(rx[k], w.x), c.b.multiply(ry[k], w.y)), c.b.multiply(rz[k], w.z));
    outputs(c, {sum[0], sum[1], sum[2]}, sum[3]);
}

void image_texture(NodeContext& c) {
    const std::int64_t mode =
        image_mode(c, extension_of(c), c.used("Alpha") ? image::AlphaUse::straight : image::AlphaUse::associated);
    if (no_image(c, mode)) return;
    const Ref3 p = texture_point(c, TextureDefault::uv);
    const std::string projection = c.text("projection", "FLAT");
    if (projection == "BOX") {
        box(c, mode, p);
        return;
    }
    Ref u = p.x, v = p.y;
    if (projection == "SPHERE" || projection == "TUBE") {
        const Ref3 q = from_unit_box(c, p);
        const Results r = c.b.emit_all(projection == "SPHERE" ? Op::map_sphere : Op::map_tube, {q.x, q.y, q.z});
        u = r[0];
        v = r[1];
    }
    const Results r = lookup(c, mode, u, v);
    outputs(c, {r[0], r[1], r[2]}, r[3]);
}

void environment_texture(NodeContext& c) {
    const std::int64_t mode =
        image_mode(c, static_cast<std::uint32_t>(image::Extension::repeat), image::AlphaUse::associated);
    if (no_image(c, mode)) return;
    const Ref3 d = c.b.normalize(texture_point(c, TextureDefault::position));
    const bool ball = c.text("projection", "EQUIRECTANGULAR") == "MIRROR_BALL";
    const Results uv = c.b.emit_all(ball ? Op::map_mirror_ball : Op::map_equirectangular, {d.x, d.y, d.z});
    const Results r = lookup(c, mode, uv[0], uv[1]);
    outputs(c, {r[0], r[1], r[2]}, r[3]);
}

constexpr NodeType k_nodes[] = {
    {"ShaderNodeTexImage", image_texture, nullptr, Support::same, "cubic interpolation as the image room has it"},
    {"ShaderNodeTexEnvironment", environment_texture, nullptr, Support::same, ""},
};

}  // namespace

std::span<const NodeType> image_nodes() { return k_nodes; }

}  // namespace cardioid::nodes
