// SPDX-License-Identifier: GPL-3.0-or-later
// Procedural textures.
#include "nodes/node_helpers.h"

namespace cardioid::nodes {

namespace {

Ref3 scaled_point(NodeContext& c, float scale) {
    return c.b.multiply(texture_point(c, TextureDefault::generated), c.number("Scale", scale));
}

std::uint32_t dimensions(NodeContext& c, const char* property, const char* fallback) {
    const std::string d = c.text(property, fallback);
    return d.empty() || d[0] < '1' || d[0] > '4' ? 3u : static_cast<std::uint32_t>(d[0] - '0');
}

/// x, y, z, w of a texture in 1 to 4 dimensions; one dimension is w.
struct Point4 {
    Ref x, y, z, w;
};
Point4 point4(NodeContext& c, std::uint32_t d, Ref3 v, Ref w) {
    const Ref zero = c.b.constant(0);
    if (d == 1) return {w, zero, zero, zero};
    return {v.x, v.y, d >= 3 ? v.z : zero, d == 4 ? w : zero};
}

void checker(NodeContext& c) {
    const Ref3 p = scaled_point(c, 5);
    const Ref f = c.b.emit(Op::checker, {p.x, p.y, p.z});
    const Ref3 a = c.color("Color1", {0.8f, 0.8f, 0.8f}), b = c.color("Color2", {0.2f, 0.2f, 0.2f});
    c.color_out("Color", Builder::each(a, b, [&](Ref x, Ref y) { return c.b.select_positive(f, x, y); }));
    c.number_out("Fac", f);
}

void brick(NodeContext& c) {
    Builder& b = c.b;
    const Ref3 p = scaled_point(c, 5);
    const auto number = [&](const char* name, double fallback) {
        return static_cast<float>(c.property(name, fallback));
    };
    const float pattern[] = {number("offset", 0.5), number("offset_frequency", 2), number("squash", 1),
                             number("squash_frequency", 2)};
    const Results r = b.emit_all(Op::brick,
                                 {p.x, p.y, p.z, c.number("Mortar Size", 0.02f), c.number("Mortar Smooth", 0),
                                  c.number("Bias", 0), c.number("Brick Width", 0.5f), c.number("Row Height", 0.25f)},
                                 0, b.add_data(pattern));
    const Ref3 bricks =
        Builder::each(c.color("Color1", {0.8f, 0.8f, 0.8f}), c.color("Color2", {0.2f, 0.2f, 0.2f}), [&](Ref x, Ref y) {
            return b.emit(Op::blend, {x, y, r[0]});
        });
    c.color_out("Color", Builder::each(bricks, c.color("Mortar"), [&](Ref x, Ref y) {
                    return b.emit(Op::blend, {x, y, r[1]});
                }));
    c.number_out("Fac", r[1]);
}

void gradient(NodeContext& c) {
    Builder& b = c.b;
    const Ref3 p = texture_point(c, TextureDefault::generated);
    const std::string type = c.text("gradient_type", "LINEAR");
    const Ref zero = b.constant(0);
    Ref f = p.x;
    if (type == "QUADRATIC") {
        const Ref r = b.maximum(p.x, zero);
        f = b.multiply(r, r);
    } else if (type == "EASING") {
        const Ref r = b.saturate(p.x), t = b.multiply(r, r);
        f = b.subtract(b.multiply(b.constant(3), t), b.multiply(b.multiply(b.constant(2), t), r));
    } else if (type == "DIAGONAL") {
        f = b.multiply(b.add(p.x, p.y), b.constant(0.5f));
    } else if (type == "RADIAL") {
        f = b.add(b.multiply(b.emit(Op::arctan2, {p.y, p.x}), b.constant(0.15915494309f)), b.constant(0.5f));
    } else if (type == "SPHERICAL" || type == "QUADRATIC_SPHERE") {
        const Ref r = b.maximum(b.subtract(b.constant(0.999999f), b.length(p)), zero);
        f = type == "SPHERICAL" ? r : b.multiply(r, r);
    }
    f = b.saturate(f);
    c.color_out("Color", b.broadcast(f));
    c.number_out("Fac", f);
}

void magic(NodeContext& c) {
    const Ref3 p = texture_point(c, TextureDefault::generated);
    const auto depth = static_cast<std::uint32_t>(c.property("turbulence_depth", 2));
    const Ref3 r = c.b.emit3(Op::magic, {p.x, p.y, p.z, c.number("Scale", 5), c.number("Distortion", 1)}, depth);
    c.color_out("Color", r);
    c.number_out("Fac", c.b.average(r));
}

void white_noise(NodeContext& c) {
    const std::uint32_t d = dimensions(c, "noise_dimensions", "3D");
    const Point4 p = point4(c, d, texture_point(c, TextureDefault::generated), c.number("W"));
    const Ref3 r = c.b.emit3(Op::white_noise, {p.x, p.y, p.z, p.w}, d);
    c.number_out("Value", r.x);
    c.color_out("Color", r);
}

NoiseType noise_type(const std::string& name) {
    if (name == "MULTIFRACTAL") return NoiseType::multifractal;
    if (name == "HETERO_TERRAIN") return NoiseType::hetero_terrain;
    if (name == "HYBRID_MULTIFRACTAL") return NoiseType::hybrid_multifractal;
    return name == "RIDGED_MULTIFRACTAL" ? NoiseType::ridged_multifractal : NoiseType::fbm;
}

std::uint32_t noise_mode(std::uint32_t d, NoiseType type, std::uint32_t flags) {
    return d | static_cast<std::uint32_t>(type) << noise_type_shift | flags;
}

void noise(NodeContext& c) {
    Builder& b = c.b;
    const std::uint32_t d = dimensions(c, "noise_dimensions", "3D");
    const Point4 p = point4(c, d, scaled_point(c, 5), b.multiply(c.number("W"), c.number("Scale", 5)));
    const Ref detail = b.emit(Op::clamp, {c.number("Detail", 2), b.constant(0), b.constant(15)});
    // Before 4.0 there is no lacunarity, and roughness ends at 1.
    const Ref rough = c.number("Roughness", 0.5f);
    const Ref roughness = c.has("Lacunarity") ? b.maximum(rough, b.constant(0)) : b.saturate(rough);
    const std::uint32_t flags =
        (c.flag("normalize", true) ? noise_normalize : 0u) | (c.used("Color") ? noise_color : 0u);
    const Results r = b.emit_all(Op::noise,
                                 {p.x, p.y, p.z, p.w, detail, roughness, c.number("Lacunarity", 2),
                                  c.number("Offset", 0), c.number("Gain", 1), c.number("Distortion", 0)},
                                 noise_mode(d, noise_type(c.text("noise_type", "FBM")), flags));
    c.number_out("Fac", r[0]);
    c.color_out("Color", {r[0], r[1], r[2]});
}

void musgrave(NodeContext& c) {
    Builder& b = c.b;
    const std::uint32_t d = dimensions(c, "musgrave_dimensions", "3D");
    const Point4 p = point4(c, d, scaled_point(c, 5), b.multiply(c.number("W"), c.number("Scale", 5)));
    const Ref small = b.constant(1e-5f), zero = b.constant(0);
    const Ref octaves = b.emit(Op::clamp, {c.number("Detail", 2), zero, b.constant(15)});
    const Ref lacunarity = b.maximum(c.number("Lacunarity", 2), small);
    const Ref dimension = b.maximum(c.number("Dimension", 2), small);
    const Ref roughness = b.emit(Op::power, {lacunarity, b.multiply(dimension, b.constant(-1))});
    const NoiseType type = noise_type(c.text("musgrave_type", "FBM"));
    const Results r = b.emit_all(
        Op::noise,
        {p.x, p.y, p.z, p.w, octaves, roughness, lacunarity, c.number("Offset", 0), c.number("Gain", 1), zero},
        noise_mode(d, type, noise_musgrave));
    c.number_out("Fac", r[0]);
}

/// Distance along the bands or rings of a wave, in units of its period / 2π.
Ref wave_place(NodeContext& c, Ref3 p) {
    Builder& b = c.b;
    const Ref twenty = b.constant(20), zero = b.constant(0);
    if (c.text("wave_type", "BANDS") == "BANDS") {
        const std::string way = c.text("bands_direction", "X");
        if (way == "DIAGONAL") return b.multiply(b.add(b.add(p.x, p.y), p.z), b.constant(10));
        return b.multiply(way == "X" ? p.x : way == "Y" ? p.y : p.z, twenty);
    }
    const std::string way = c.text("rings_direction", "X");
    if (way == "X") p.x = zero;
    if (way == "Y") p.y = zero;
    if (way == "Z") p.z = zero;
    return b.multiply(b.length(p), twenty);
}

void wave(NodeContext& c) {
    Builder& b = c.b;
    const Ref one = b.constant(1), half = b.constant(0.5f), zero = b.constant(0);
    const Ref3 p = Builder::each(
        scaled_point(c, 5), [&](Ref x) { return b.multiply(b.add(x, b.constant(0.000001f)), b.constant(0.999999f)); });
    Ref n = b.add(wave_place(c, p), c.number("Phase Offset", 0));
    const Ref distortion = c.number("Distortion", 0);
    if (!b.is(distortion, 0)) {
        const Ref3 q = b.multiply(p, c.number("Detail Scale", 1));
        const Ref detail = b.emit(Op::clamp, {c.number("Detail", 2), zero, b.constant(15)});
        const Ref f = b.emit(Op::noise,
                             {q.x, q.y, q.z, zero, detail, b.saturate(c.number("Detail Roughness", 0.5f)),
                              b.constant(2), zero, one, zero},
                             noise_mode(3, NoiseType::fbm, noise_normalize));
        n = b.add(n, b.multiply(distortion, b.subtract(b.multiply(f, b.constant(2)), one)));
    }
    const std::string profile = c.text("wave_profile", "SIN");
    Ref f;
    if (profile == "SIN") {
        f = b.add(half, b.multiply(half, b.emit(Op::sine, {b.subtract(n, b.constant(1.5707963267948966f))})));
    } else {
        const Ref turns = b.multiply(n, b.constant(0.15915494309f));
        f = profile == "SAW"
                ? b.emit(Op::fraction, {turns})
                : b.multiply(b.emit(Op::absolute, {b.subtract(turns, b.emit(Op::round, {turns}))}), b.constant(2));
    }
    c.color_out("Color", b.broadcast(f));
    c.number_out("Fac", f);
}

CellFeature cell_feature(const std::string& name) {
    if (name == "F2") return CellFeature::f2;
    if (name == "SMOOTH_F1") return CellFeature::smooth_f1;
    if (name == "DISTANCE_TO_EDGE") return CellFeature::edge;
    return name == "N_SPHERE_RADIUS" ? CellFeature::radius : CellFeature::f1;
}

CellMetric cell_metric(const std::string& name) {
    if (name == "MANHATTAN") return CellMetric::manhattan;
    if (name == "CHEBYCHEV") return CellMetric::chebychev;
    return name == "MINKOWSKI" ? CellMetric::minkowski : CellMetric::euclidean;
}

void voronoi(NodeContext& c) {
    Builder& b = c.b;
    const std::uint32_t d = dimensions(c, "voronoi_dimensions", "3D");
    const Ref scale = c.number("Scale", 5), zero = b.constant(0), one = b.constant(1);
    const Point4 p =
        point4(c, d, b.multiply(texture_point(c, TextureDefault::generated), scale), b.multiply(c.number("W"), scale));
    const CellFeature feature = cell_feature(c.text("feature", "F1"));
    std::uint32_t mode = d | static_cast<std::uint32_t>(feature) << cell_feature_shift;
    mode |= static_cast<std::uint32_t>(cell_metric(c.text("distance", "EUCLIDEAN"))) << cell_metric_shift;
    if (c.flag("normalize")) mode |= cell_normalize;
    if (c.property("version", 1) >= 2) mode |= cell_pcg;
    if (c.used("Color")) mode |= cell_color;
    // Before 4.0 there is no detail.
    const Ref detail = b.emit(Op::clamp, {c.number("Detail", 0), zero, b.constant(15)});
    const Ref smoothness =
        b.emit(Op::clamp, {b.multiply(c.number("Smoothness", 1), b.constant(0.5f)), zero, b.constant(0.5f)});
    const Results r = b.emit_all(Op::voronoi,
                                 {p.x, p.y, p.z, p.w, detail, b.saturate(c.number("Roughness", 0.5f)),
                                  c.number("Lacunarity", 2), smoothness, c.number("Exponent", 0.5f),
                                  b.saturate(c.number("Randomness", 1)), feature == CellFeature::radius ? one : scale},
                                 mode);
    c.number_out("Distance", r[0]);
    c.number_out("Radius", r[0]);
    c.color_out("Color", {r[1], r[2], r[3]});
    c.vector_out("Position", d == 1 ? b.broadcast(zero) : Ref3{r[4], r[5], r[6]});
    c.number_out("W", d == 1 ? r[4] : r[7]);
}

constexpr NodeType k_nodes[] = {
    {"ShaderNodeTexChecker", checker, nullptr, Support::same, ""},
    {"ShaderNodeTexBrick", brick, nullptr, Support::same, ""},
    {"ShaderNodeTexGradient", gradient, nullptr, Support::same, ""},
    {"ShaderNodeTexMagic", magic, nullptr, Support::same, ""},
    {"ShaderNodeTexWhiteNoise", white_noise, nullptr, Support::same, ""},
    {"ShaderNodeTexNoise", noise, nullptr, Support::same, "all types of 4.1 and later, and the noise of 3.4"},
    {"ShaderNodeTexMusgrave", musgrave, nullptr, Support::same, ""},
    {"ShaderNodeTexVoronoi", voronoi, nullptr, Support::same,
     "with the octaves of 4.0 and later; the hash of 5.0 where params[\"version\"] is 2"},
    {"ShaderNodeTexWave", wave, nullptr, Support::same, ""},
};

}  // namespace

std::span<const NodeType> texture_nodes() { return k_nodes; }

}  // namespace cardioid::nodes
