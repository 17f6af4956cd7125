// SPDX-License-Identifier: GPL-3.0-or-later
// Colour arithmetic: Mix with all blend modes, Hue/Saturation, Bright/Contrast, Gamma, Invert, Blackbody.
#include "nodes/node_helpers.h"

namespace cardioid::nodes {

namespace {

Ref3 convert(Builder& b, Op op, Ref3 v) { return b.emit3(op, {v.x, v.y, v.z}); }

/// Blend modes that treat channels alike.
bool blend_channel(Builder& b, const std::string& mode, Ref x, Ref y, Ref t, Ref& out) {
    const Ref one = b.constant(1);
    if (mode == "MIX")
        out = b.mix(x, y, t);
    else if (mode == "ADD")
        out = b.mix(x, b.add(x, y), t);
    else if (mode == "MULTIPLY")
        out = b.mix(x, b.multiply(x, y), t);
    else if (mode == "SUBTRACT")
        out = b.mix(x, b.subtract(x, y), t);
    else if (mode == "SCREEN")
        out = b.subtract(one,
                         b.multiply(b.add(b.subtract(one, t), b.multiply(t, b.subtract(one, y))), b.subtract(one, x)));
    else if (mode == "DIFFERENCE")
        out = b.mix(x, b.emit(Op::absolute, {b.subtract(x, y)}), t);
    else if (mode == "EXCLUSION") {
        const Ref both = b.multiply(b.multiply(x, y), b.constant(2));
        out = b.maximum(b.mix(x, b.subtract(b.add(x, y), both), t), b.constant(0));
    } else if (mode == "DARKEN")
        out = b.mix(x, b.minimum(x, y), t);
    else if (mode == "LIGHTEN")
        out = b.mix(x, b.maximum(x, y), t);
    else if (mode == "OVERLAY")
        out = b.emit(Op::mix_overlay, {x, y, t});
    else if (mode == "DIVIDE")
        out = b.emit(Op::mix_divide, {x, y, t});
    else if (mode == "DODGE")
        out = b.emit(Op::mix_dodge, {x, y, t});
    else if (mode == "BURN")
        out = b.emit(Op::mix_burn, {x, y, t});
    else if (mode == "LINEAR_LIGHT")
        out = b.add(x, b.multiply(t, b.subtract(b.multiply(b.constant(2), y), one)));
    else if (mode == "SOFT_LIGHT") {
        const Ref rest = b.subtract(one, x), screen = b.subtract(one, b.multiply(b.subtract(one, y), rest));
        const Ref soft = b.add(b.multiply(b.multiply(rest, y), x), b.multiply(x, screen));
        out = b.add(b.multiply(b.subtract(one, t), x), b.multiply(t, soft));
    } else
        return false;
    return true;
}

/// Blend modes on hue, saturation and value.
bool blend_hsv(Builder& b, const std::string& mode, Ref3 x, Ref3 y, Ref t, Ref3& out) {
    const Ref3 p = convert(b, Op::rgb_to_hsv, x), q = convert(b, Op::rgb_to_hsv, y);
    const auto where = [&](Ref condition, Ref3 yes) {
        return Builder::each(yes, x, [&](Ref u, Ref v) { return b.select_positive(condition, u, v); });
    };
    const auto between = [&](Ref u, Ref v) { return b.emit(Op::blend, {u, v, t}); };
    if (mode == "HUE")
        out = where(q.y, b.mix(x, convert(b, Op::hsv_to_rgb, {q.x, p.y, p.z}), t));
    else if (mode == "SATURATION")
        out = where(p.y, convert(b, Op::hsv_to_rgb, {p.x, between(p.y, q.y), p.z}));
    else if (mode == "VALUE")
        out = convert(b, Op::hsv_to_rgb, {p.x, p.y, between(p.z, q.z)});
    else if (mode == "COLOR")
        out = where(q.y, b.mix(x, convert(b, Op::hsv_to_rgb, {q.x, q.y, p.z}), t));
    else
        return false;
    return true;
}

Ref3 blend(NodeContext& c, const std::string& mode, Ref3 x, Ref3 y, Ref t) {
    Ref3 out;
    if (blend_channel(c.b, mode, x.x, y.x, t, out.x)) {
        blend_channel(c.b, mode, x.y, y.y, t, out.y);
        blend_channel(c.b, mode, x.z, y.z, t, out.z);
        return out;
    }
    if (blend_hsv(c.b, mode, x, y, t, out)) return out;
    c.warn("blend " + mode, c.place() + ": blend mode " + mode + " is not supported; it mixes");
    return c.b.mix(x, y, t);
}

void mix_rgb(NodeContext& c) {
    const Ref t = c.b.saturate(c.number("Fac", 0.5f));
    const Ref3 r = blend(c, c.text("blend_type", "MIX"), c.color("Color1", {0.5f, 0.5f, 0.5f}),
                         c.color("Color2", {0.5f, 0.5f, 0.5f}), t);
    c.color_out("Color", c.flag("use_clamp") ? c.b.saturate(r) : r);
}

void mix_any(NodeContext& c) {
    Builder& b = c.b;
    const std::string type = c.text("data_type", "FLOAT");
    const bool clamp = c.flag("clamp_factor", true);
    const Ref plain = c.number("Factor_Float", 0.5f), t = clamp ? b.saturate(plain) : plain;
    if (type == "RGBA") {
        const Ref3 r = blend(c, c.text("blend_type", "MIX"), c.color("A_Color", {0.5f, 0.5f, 0.5f}),
                             c.color("B_Color", {0.5f, 0.5f, 0.5f}), t);
        c.color_out("Result_Color", c.flag("clamp_result") ? b.saturate(r) : r);
    } else if (type == "VECTOR") {
        const Ref3 x = c.vector("A_Vector"), y = c.vector("B_Vector");
        Ref3 f = b.broadcast(t);
        if (c.text("factor_mode", "UNIFORM") == "NON_UNIFORM") {
            f = c.vector("Factor_Vector", {0.5f, 0.5f, 0.5f});
            if (clamp) f = b.saturate(f);
        }
        c.vector_out("Result_Vector", {b.emit(Op::blend, {x.x, y.x, f.x}), b.emit(Op::blend, {x.y, y.y, f.y}),
                                       b.emit(Op::blend, {x.z, y.z, f.z})});
    } else {
        c.number_out("Result_Float", b.emit(Op::blend, {c.number("A_Float"), c.number("B_Float"), t}));
    }
}

void hue_saturation(NodeContext& c) {
    Builder& b = c.b;
    const Ref one = b.constant(1);
    const Ref3 in = c.color("Color", {0.8f, 0.8f, 0.8f});
    const Ref3 hsv = convert(b, Op::rgb_to_hsv, in);
    const Ref hue = b.emit(Op::modulo, {b.add(b.add(hsv.x, c.number("Hue", 0.5f)), b.constant(0.5f)), one});
    const Ref saturation = b.saturate(b.multiply(hsv.y, c.number("Saturation", 1)));
    const Ref3 out = convert(b, Op::hsv_to_rgb, {hue, saturation, b.multiply(hsv.z, c.number("Value", 1))});
    const Ref fac = c.number("Fac", 1);
    c.color_out("Color", b.maximum(Builder::each(in, out,
                                                 [&](Ref u, Ref v) {
                                                     return b.emit(Op::blend, {u, v, fac});
                                                 }),
                                   b.constant(0)));
}

void bright_contrast(NodeContext& c) {
    Builder& b = c.b;
    const Ref contrast = c.number("Contrast", 0);
    const Ref slope = b.add(b.constant(1), contrast);
    const Ref level = b.subtract(c.number("Bright", 0), b.multiply(contrast, b.constant(0.5f)));
    c.color_out("Color", b.maximum(Builder::each(c.color("Color", {1, 1, 1}),
                                                 [&](Ref x) {
                                                     return b.emit(Op::multiply_add, {slope, x, level});
                                                 }),
                                   b.constant(0)));
}

/// Negative channels stay as they are.
void gamma(NodeContext& c) {
    Builder& b = c.b;
    const Ref g = c.number("Gamma", 1);
    const Ref is_zero = b.subtract(b.constant(1), b.emit(Op::absolute, {b.emit(Op::sign, {g})}));
    c.color_out("Color", Builder::each(c.color("Color", {1, 1, 1}), [&](Ref x) {
                    const Ref raised = b.select_positive(x, b.emit(Op::power, {x, g}), x);
                    return b.select_positive(is_zero, b.constant(1), raised);
                }));
}

void invert(NodeContext& c) {
    Builder& b = c.b;
    const Ref fac = c.number("Fac", 1);
    c.color_out("Color", Builder::each(c.color("Color"), [&](Ref x) {
                    return b.emit(Op::blend, {x, b.subtract(b.constant(1), x), fac});
                }));
}

/// Seven ranges of temperature, each r and g as a/t + bt + c and b as a cubic: the fit that Blender uses.
constexpr float k_blackbody[] = {
    1.61919106e+03f,  -2.05010916e-03f, 5.02995757e+00f,  -4.88999748e+02f, 6.04330754e-04f,  -7.55807526e-02f,
    5.96945309e-11f,  -4.85742887e-08f, -9.70622247e-05f, -4.07936148e-03f, 2.48845471e+03f,  -1.11330907e-03f,
    3.22621544e+00f,  -7.55994277e+02f, 3.16730098e-04f,  4.78306139e-01f,  2.40430366e-11f,  5.55021075e-08f,
    -1.98503712e-04f, 2.89312858e-02f,  3.34143193e+03f,  -4.86551192e-04f, 1.76486769e+00f,  -1.02363977e+03f,
    1.20223470e-04f,  9.36662319e-01f,  -1.40949732e-11f, 1.89878968e-07f,  -3.56632824e-04f, 9.10767778e-02f,
    4.09461742e+03f,  -1.27446582e-04f, 7.25731635e-01f,  -1.26571316e+03f, 4.87340896e-06f,  1.27054498e+00f,
    -3.61460868e-11f, 2.84822009e-07f,  -4.93211319e-04f, 1.56723440e-01f,  4.67028036e+03f,  2.91258199e-05f,
    1.26703442e-01f,  -1.42529332e+03f, -4.01150431e-05f, 1.43972784e+00f,  -1.97075738e-11f, 1.75359352e-07f,
    -2.50542825e-04f, -2.22783266e-02f, 4.59509185e+03f,  2.87495649e-05f,  1.50345020e-01f,  -1.17554822e+03f,
    -2.16378048e-05f, 1.30408023e+00f,  -1.61997957e-13f, -1.64216008e-08f, 3.86216271e-04f,  -7.38077418e-01f,
    3.78717450e+03f,  9.35907826e-06f,  3.99075871e-01f,  -5.00799571e+02f, -4.59832026e-06f, 1.09098763e+00f,
    6.72650283e-13f,  -2.73078809e-08f, 4.24098264e-04f,  -7.52335691e-01f,
};

void blackbody(NodeContext& c) {
    const Ref t = c.number("Temperature", 1500), zero = c.b.constant(0);
    c.color_out("Color", c.b.emit3(Op::blackbody, {t, zero, zero}, 0, c.b.add_data(k_blackbody)));
}

constexpr NodeType k_nodes[] = {
    {"ShaderNodeMixRGB", mix_rgb, nullptr, Support::same, ""},
    {"ShaderNodeMix", mix_any, nullptr, Support::same, "rotations are not mixed"},
    {"ShaderNodeHueSaturation", hue_saturation, nullptr, Support::same, ""},
    {"ShaderNodeBrightContrast", bright_contrast, nullptr, Support::same, ""},
    {"ShaderNodeGamma", gamma, nullptr, Support::same, ""},
    {"ShaderNodeInvert", invert, nullptr, Support::same, ""},
    {"ShaderNodeBlackbody", blackbody, nullptr, Support::same, ""},
};

}  // namespace

std::span<const NodeType> color_nodes() { return k_nodes; }

}  // namespace cardioid::nodes
