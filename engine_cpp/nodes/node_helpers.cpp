// SPDX-License-Identifier: GPL-3.0-or-later
#include "nodes/node_helpers.h"

#include <cmath>

namespace cardioid::nodes {

namespace {

/// Rotation about x, then y, then z.
Affine euler(Float3 r) {
    const float cx = std::cos(r.x), sx = std::sin(r.x), cy = std::cos(r.y), sy = std::sin(r.y), cz = std::cos(r.z),
                sz = std::sin(r.z);
    Affine a;
    a.m = {cy * cz,
           sx * sy * cz - cx * sz,
           cx * sy * cz + sx * sz,
           0,
           cy * sz,
           sx * sy * sz + cx * cz,
           cx * sy * sz - sx * cz,
           0,
           -sy,
           sx * cy,
           cx * cy,
           0};
    return a;
}

Float3 list3(NodeContext& c, const char* name, float fallback) {
    const std::vector<double> v = c.list(name);
    const auto at = [&](std::size_t k) { return k < v.size() ? static_cast<float>(v[k]) : fallback; };
    return {at(0), at(1), at(2)};
}

Affine scaling(Float3 s) {
    Affine a;
    a.m[0] = s.x;
    a.m[5] = s.y;
    a.m[10] = s.z;
    return a;
}

/// Rows pick the axes named by the panel ("NONE" gives 0).
Affine axes(const std::string& names) {
    Affine a;
    a.m.fill(0);
    for (std::size_t row = 0; row < 3 && row < names.size(); ++row) {
        const std::size_t axis = std::string("XYZ").find(names[row]);
        if (axis != std::string::npos) a.m[row * 4 + axis] = 1;
    }
    return a;
}

Affine panel_matrix(NodeContext& c, const std::string& type) {
    const Affine rotate = euler(list3(c, "texture_mapping_rotation", 0));
    Float3 size = list3(c, "texture_mapping_scale", 1);
    Affine move;
    const Float3 t = list3(c, "texture_mapping_translation", 0);
    move.m[3] = t.x;
    move.m[7] = t.y;
    move.m[11] = t.z;
    const auto inverted = [](float s) { return s != 0 ? 1 / s : 0; };
    const Affine remap = axes(c.text("texture_mapping_axes", "XYZ"));
    if (type == "TEXTURE") return inverse(move * rotate * scaling(size)) * remap;
    if (type == "NORMAL") return rotate * scaling({inverted(size.x), inverted(size.y), inverted(size.z)}) * remap;
    return (type == "VECTOR" ? Affine{} : move) * rotate * scaling(size) * remap;
}

}  // namespace

Ref3 bumped_in_object_space(NodeContext& c, Ref3 n, Ref dx, Ref dy, Ref strength, Ref distance) {
    const Ref3 here = c.position();
    const auto step = [&](Shift axis) {
        return to_object(c, c.b.subtract(c.at(axis).position(), here), Quantity::vector);
    };
    const Ref3 local = to_object(c, n, Quantity::normal);
    return to_world(c, tilted(c, local, step(Shift::x), step(Shift::y), dx, dy, strength, distance), Quantity::normal);
}

Ref3 constant_affine(NodeContext& c, const Affine& a, Ref3 v, bool translate) {
    const auto row = [&](std::size_t k) {
        const Ref x = c.b.multiply(v.x, c.b.constant(a.m[k * 4])), y = c.b.multiply(v.y, c.b.constant(a.m[k * 4 + 1]));
        const Ref sum = c.b.add(c.b.add(x, y), c.b.multiply(v.z, c.b.constant(a.m[k * 4 + 2])));
        return translate ? c.b.add(sum, c.b.constant(a.m[k * 4 + 3])) : sum;
    };
    return {row(0), row(1), row(2)};
}

Ref3 texture_point(NodeContext& c, TextureDefault unlinked) {
    Ref3 p;
    if (c.linked("Vector"))
        p = c.vector("Vector");
    else if (unlinked == TextureDefault::uv)
        p = active_uv(c);
    else if (unlinked == TextureDefault::position)
        p = c.position();
    else
        p = c.generated();
    const std::string type = c.text("texture_mapping_type");
    if (type.empty()) return p;
    p = constant_affine(c, panel_matrix(c, type), p, true);
    return type == "NORMAL" ? c.b.normalize(p) : p;
}

}  // namespace cardioid::nodes
