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
    // Saturation is negative where the largest channel is.
    const auto coloured = [&](Ref saturation) { return b.emit(Op::absolute, {saturation}); };
    const auto between = [&](Ref u, Ref v) { return b.emit(Op::blend, {u, v, t}); };
    if (mode == "HUE")
        out = where(coloured(q.y), b.mix(x, convert(b, Op::hsv_to_rgb, {q.x, p.y, p.z}), t));
    else if (mode == "SATURATION")
        out = where(coloured(p.y), convert(b, Op::hsv_to_rgb, {p.x, between(p.y, q.y), p.z}));
    else if (mode == "VALUE")
        out = convert(b, Op::hsv_to_rgb, {p.x, p.y, between(p.z, q.z)});
    else if (mode == "COLOR")
        out = where(coloured(q.y), b.mix(x, convert(b, Op::hsv_to_rgb, {q.x, q.y, p.z}), t));
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

void blackbody(NodeContext& c) { c.color_out("Color", blackbody_color(c, c.number("Temperature", 1500))); }

/// CIE 1931 2° colour matching functions, 380 to 780 nm in steps of 5 nm.
constexpr float k_xyz_response[] = {
    0.0014f, 0.0000f, 0.0065f, 0.0022f, 0.0001f, 0.0105f, 0.0042f, 0.0001f, 0.0201f, 0.0076f, 0.0002f, 0.0362f, 0.0143f,
    0.0004f, 0.0679f, 0.0232f, 0.0006f, 0.1102f, 0.0435f, 0.0012f, 0.2074f, 0.0776f, 0.0022f, 0.3713f, 0.1344f, 0.0040f,
    0.6456f, 0.2148f, 0.0073f, 1.0391f, 0.2839f, 0.0116f, 1.3856f, 0.3285f, 0.0168f, 1.6230f, 0.3483f, 0.0230f, 1.7471f,
    0.3481f, 0.0298f, 1.7826f, 0.3362f, 0.0380f, 1.7721f, 0.3187f, 0.0480f, 1.7441f, 0.2908f, 0.0600f, 1.6692f, 0.2511f,
    0.0739f, 1.5281f, 0.1954f, 0.0910f, 1.2876f, 0.1421f, 0.1126f, 1.0419f, 0.0956f, 0.1390f, 0.8130f, 0.0580f, 0.1693f,
    0.6162f, 0.0320f, 0.2080f, 0.4652f, 0.0147f, 0.2586f, 0.3533f, 0.0049f, 0.3230f, 0.2720f, 0.0024f, 0.4073f, 0.2123f,
    0.0093f, 0.5030f, 0.1582f, 0.0291f, 0.6082f, 0.1117f, 0.0633f, 0.7100f, 0.0782f, 0.1096f, 0.7932f, 0.0573f, 0.1655f,
    0.8620f, 0.0422f, 0.2257f, 0.9149f, 0.0298f, 0.2904f, 0.9540f, 0.0203f, 0.3597f, 0.9803f, 0.0134f, 0.4334f, 0.9950f,
    0.0087f, 0.5121f, 1.0000f, 0.0057f, 0.5945f, 0.9950f, 0.0039f, 0.6784f, 0.9786f, 0.0027f, 0.7621f, 0.9520f, 0.0021f,
    0.8425f, 0.9154f, 0.0018f, 0.9163f, 0.8700f, 0.0017f, 0.9786f, 0.8163f, 0.0014f, 1.0263f, 0.7570f, 0.0011f, 1.0567f,
    0.6949f, 0.0010f, 1.0622f, 0.6310f, 0.0008f, 1.0456f, 0.5668f, 0.0006f, 1.0026f, 0.5030f, 0.0003f, 0.9384f, 0.4412f,
    0.0002f, 0.8544f, 0.3810f, 0.0002f, 0.7514f, 0.3210f, 0.0001f, 0.6424f, 0.2650f, 0.0000f, 0.5419f, 0.2170f, 0.0000f,
    0.4479f, 0.1750f, 0.0000f, 0.3608f, 0.1382f, 0.0000f, 0.2835f, 0.1070f, 0.0000f, 0.2187f, 0.0816f, 0.0000f, 0.1649f,
    0.0610f, 0.0000f, 0.1212f, 0.0446f, 0.0000f, 0.0874f, 0.0320f, 0.0000f, 0.0636f, 0.0232f, 0.0000f, 0.0468f, 0.0170f,
    0.0000f, 0.0329f, 0.0119f, 0.0000f, 0.0227f, 0.0082f, 0.0000f, 0.0158f, 0.0057f, 0.0000f, 0.0114f, 0.0041f, 0.0000f,
    0.0081f, 0.0029f, 0.0000f, 0.0058f, 0.0021f, 0.0000f, 0.0041f, 0.0015f, 0.0000f, 0.0029f, 0.0010f, 0.0000f, 0.0020f,
    0.0007f, 0.0000f, 0.0014f, 0.0005f, 0.0000f, 0.0010f, 0.0004f, 0.0000f, 0.0007f, 0.0002f, 0.0000f, 0.0005f, 0.0002f,
    0.0000f, 0.0003f, 0.0001f, 0.0000f, 0.0002f, 0.0001f, 0.0000f, 0.0002f, 0.0001f, 0.0000f, 0.0001f, 0.0000f, 0.0000f,
    0.0001f, 0.0000f, 0.0000f, 0.0001f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f,
};

void wavelength(NodeContext& c) {
    c.color_out("Color", c.b.emit3(Op::wavelength, {c.number("Wavelength", 500)}, 0, c.b.add_data(k_xyz_response)));
}

constexpr NodeType k_nodes[] = {
    {"ShaderNodeMixRGB", mix_rgb, nullptr, Support::same, ""},
    {"ShaderNodeMix", mix_any, nullptr, Support::same, ""},
    {"ShaderNodeHueSaturation", hue_saturation, nullptr, Support::same, ""},
    {"ShaderNodeBrightContrast", bright_contrast, nullptr, Support::same, ""},
    {"ShaderNodeGamma", gamma, nullptr, Support::same, ""},
    {"ShaderNodeInvert", invert, nullptr, Support::same, ""},
    {"ShaderNodeBlackbody", blackbody, nullptr, Support::same, ""},
    {"ShaderNodeWavelength", wavelength, nullptr, Support::same, ""},
};

}  // namespace

Ref3 blackbody_color(NodeContext& c, Ref temperature) {
    const Ref zero = c.b.constant(0);
    return c.b.emit3(Op::blackbody, {temperature, zero, zero}, 0, c.b.add_data(k_blackbody));
}

std::span<const NodeType> color_nodes() { return k_nodes; }

}  // namespace cardioid::nodes
