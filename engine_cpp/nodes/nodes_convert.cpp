// SPDX-License-Identifier: GPL-3.0-or-later
// Taking colours and vectors apart and putting them together, ramps and curves.
#include "nodes/color_ramp.h"
#include "nodes/node_helpers.h"

namespace cardioid::nodes {

namespace {

void separate_xyz(NodeContext& c) {
    const Ref3 v = c.vector("Vector");
    c.number_out("X", v.x);
    c.number_out("Y", v.y);
    c.number_out("Z", v.z);
}

void combine_xyz(NodeContext& c) { c.vector_out("Vector", {c.number("X"), c.number("Y"), c.number("Z")}); }

Ref3 convert(NodeContext& c, Op op, Ref3 v) { return c.b.emit3(op, {v.x, v.y, v.z}); }

void separate_color(NodeContext& c) {
    const std::string mode = c.text("mode", "RGB");
    Ref3 v = c.color("Color", {0.8f, 0.8f, 0.8f});
    if (mode == "HSV") v = convert(c, Op::rgb_to_hsv, v);
    if (mode == "HSL") v = convert(c, Op::rgb_to_hsl, v);
    c.number_out("Red", v.x);
    c.number_out("Green", v.y);
    c.number_out("Blue", v.z);
}

void combine_color(NodeContext& c) {
    const std::string mode = c.text("mode", "RGB");
    Ref3 v = {c.number("Red"), c.number("Green"), c.number("Blue")};
    if (mode == "HSV") v = convert(c, Op::hsv_to_rgb, v);
    if (mode == "HSL") v = convert(c, Op::hsl_to_rgb, v);
    c.color_out("Color", v);
}

void separate_rgb(NodeContext& c) {
    const Ref3 v = c.color("Image", {0.8f, 0.8f, 0.8f});
    c.number_out("R", v.x);
    c.number_out("G", v.y);
    c.number_out("B", v.z);
}

void combine_rgb(NodeContext& c) { c.color_out("Image", {c.number("R"), c.number("G"), c.number("B")}); }

void separate_hsv(NodeContext& c) {
    const Ref3 v = convert(c, Op::rgb_to_hsv, c.color("Color", {0.8f, 0.8f, 0.8f}));
    c.number_out("H", v.x);
    c.number_out("S", v.y);
    c.number_out("V", v.z);
}

void combine_hsv(NodeContext& c) {
    c.color_out("Color", convert(c, Op::hsv_to_rgb, {c.number("H"), c.number("S"), c.number("V")}));
}

void rgb_to_bw(NodeContext& c) { c.number_out("Val", c.b.luminance(c.color("Color", {0.5f, 0.5f, 0.5f}))); }

void color_ramp(NodeContext& c) {
    const std::string interpolation = c.text("ramp_interpolation", "LINEAR");
    const int entries = c.property("version", 1) >= 2 ? k_most_entries : k_most_entries - 1;
    const std::vector<float> table = ramp_table(c.list("ramp"), interpolation, c.text("ramp_color_mode", "RGB"),
                                                c.text("ramp_hue", "NEAR"), entries);
    const Results r = c.b.emit_all(Op::ramp, {c.number("Fac", 0.5f)}, table_imm(entries, interpolation != "CONSTANT"),
                                   c.b.add_data(table));
    c.color_out("Color", {r[0], r[1], r[2]});
    c.number_out("Alpha", r[3]);
}

/// The curve of one channel at x; a missing table leaves x as it is.
Ref curve(NodeContext& c, const char* name, Ref x) {
    const std::vector<double> values = c.list(name);
    const int entries = static_cast<int>(std::min<std::size_t>(values.size(), k_most_entries + 1));
    if (entries < 2 || entries > k_most_entries) return x;
    const std::vector<float> table(values.begin(), values.end());
    const float low = static_cast<float>(c.property("curve_min", 0)),
                high = static_cast<float>(c.property("curve_max", 1));
    const Ref place = c.b.divide(c.b.subtract(x, c.b.constant(low)), c.b.constant(high - low));
    return c.b.emit(Op::curve, {place}, table_imm(entries, c.flag("curve_extrapolate")), c.b.add_data(table));
}

Ref blended(NodeContext& c, Ref a, Ref b, Ref fac) {
    return c.b.optimise() && c.b.is(fac, 1) ? b : c.b.emit(Op::blend, {a, b, fac});
}

void curves(NodeContext& c, const char* input, const char* output, const char* names[3], bool color) {
    const Ref fac = c.number("Fac", 1);
    const Ref3 v = c.vector(input);
    const Ref3 r = {blended(c, v.x, curve(c, names[0], v.x), fac), blended(c, v.y, curve(c, names[1], v.y), fac),
                    blended(c, v.z, curve(c, names[2], v.z), fac)};
    if (color)
        c.color_out(output, r);
    else
        c.vector_out(output, r);
}

void rgb_curves(NodeContext& c) {
    const char* names[] = {"curve_table_r", "curve_table_g", "curve_table_b"};
    curves(c, "Color", "Color", names, true);
}

void vector_curves(NodeContext& c) {
    const char* names[] = {"curve_table_x", "curve_table_y", "curve_table_z"};
    curves(c, "Vector", "Vector", names, false);
}

void float_curve(NodeContext& c) {
    const Ref x = c.number("Value", 1);
    c.number_out("Value", blended(c, x, curve(c, "curve_table_v", x), c.number(c.has("Factor") ? "Factor" : "Fac", 1)));
}

constexpr NodeType k_nodes[] = {
    {"ShaderNodeSeparateXYZ", separate_xyz, nullptr, Support::same, ""},
    {"ShaderNodeCombineXYZ", combine_xyz, nullptr, Support::same, ""},
    {"ShaderNodeSeparateColor", separate_color, nullptr, Support::same, ""},
    {"ShaderNodeCombineColor", combine_color, nullptr, Support::same, ""},
    {"ShaderNodeSeparateRGB", separate_rgb, nullptr, Support::same, ""},
    {"ShaderNodeCombineRGB", combine_rgb, nullptr, Support::same, ""},
    {"ShaderNodeSeparateHSV", separate_hsv, nullptr, Support::same, ""},
    {"ShaderNodeCombineHSV", combine_hsv, nullptr, Support::same, ""},
    {"ShaderNodeRGBToBW", rgb_to_bw, nullptr, Support::same, ""},
    {"ShaderNodeValToRGB", color_ramp, nullptr, Support::same, ""},
    {"ShaderNodeRGBCurve", rgb_curves, nullptr, Support::same, ""},
    {"ShaderNodeVectorCurve", vector_curves, nullptr, Support::same, ""},
    {"ShaderNodeFloatCurve", float_curve, nullptr, Support::same, ""},
};

}  // namespace

std::span<const NodeType> convert_nodes() { return k_nodes; }

}  // namespace cardioid::nodes
