// SPDX-License-Identifier: GPL-3.0-or-later
// Sky Texture, all models of Blender 3.4 to 5.2.
#include "nodes/node_helpers.h"
#include "nodes/sky.h"
#include "nodes/sky_data.h"

#include <algorithm>
#include <cmath>

namespace cardioid::nodes {

namespace {

constexpr float k_pi = 3.14159265358979f;

float number(NodeContext& c, const char* name, float fallback) {
    const auto v = static_cast<float>(c.property(name, static_cast<double>(fallback)));
    return std::isfinite(v) ? v : fallback;
}

/// The sun's elevation in [-π/2, π/2] and its rotation as Cycles turns it.
void sun_angles(NodeContext& c, float& elevation, float& rotation) {
    elevation = std::fmod(number(c, "sun_elevation", 0.2617994f), 2 * k_pi);
    rotation = number(c, "sun_rotation", 0);
    if (std::abs(elevation) >= k_pi) elevation -= std::copysign(2 * k_pi, elevation);
    if (std::abs(elevation) >= k_pi / 2) {
        elevation = std::copysign(k_pi, elevation) - elevation;
        rotation += k_pi;
    }
    rotation = std::fmod(rotation, 2 * k_pi);
    rotation = 2 * k_pi - (rotation < 0 ? rotation + 2 * k_pi : rotation);
}

std::vector<float> sky_picture(NodeContext& c, const std::string& type) {
    const bool multiple = type == "MULTIPLE_SCATTERING", whole = multiple || type == "SINGLE_SCATTERING";
    Atmosphere a;
    float rotation = 0;
    sun_angles(c, a.sun_elevation, rotation);
    a.altitude = number(c, "altitude", whole ? 100.0f : 1.0f);
    a.air = number(c, "air_density", 1);
    a.aerosol = number(c, whole ? "aerosol_density" : "dust_density", 1);
    a.ozone = number(c, "ozone_density", 1);
    const float size = std::max(number(c, "sun_size", 0.009512f), 0.0005f);
    const SkyImage image = multiple ? multiple_scattering(a) : single_scattering(a, whole);
    const SunDisc sun = multiple ? multiple_scattering_sun(a, size) : single_scattering_sun(a, size, whole);
    constexpr float earth = 6371;  // km
    const float ground = std::asin(std::min(earth / (earth + a.altitude / 1000), 1.0f)) - k_pi / 2;
    std::vector<float> data = {sun.bottom.x,
                               sun.bottom.y,
                               sun.bottom.z,
                               sun.top.x,
                               sun.top.y,
                               sun.top.z,
                               a.sun_elevation,
                               rotation,
                               c.flag("sun_disc", true) ? size : -1.0f,
                               number(c, "sun_intensity", 1),
                               ground,
                               static_cast<float>(image.width),
                               static_cast<float>(image.height),
                               -std::cos(a.sun_elevation) * std::sin(rotation),
                               std::cos(a.sun_elevation) * std::cos(rotation),
                               std::sin(a.sun_elevation)};
    data.insert(data.end(), image.xyz.begin(), image.xyz.end());
    return data;
}

AnalyticSky analytic(NodeContext& c, bool hosek) {
    const std::vector<double> v = c.list("sun_direction");
    const auto at = [&](std::size_t k, float fallback) { return k < v.size() ? static_cast<float>(v[k]) : fallback; };
    const Float3 sun = normalize(Float3{at(0, 0), at(1, 0), at(2, 1)});
    const float turbidity = number(c, "turbidity", 2.2f);
    return hosek ? hosek_sky(sun, turbidity, number(c, "ground_albedo", 0.3f)) : preetham_sky(sun, turbidity);
}

void sky(NodeContext& c) {
    const Ref3 d = texture_point(c, TextureDefault::generated);
    const std::string type = c.text("sky_type", "NISHITA");
    if (type == "PREETHAM" || type == "HOSEK_WILKIE") {
        const bool hosek = type == "HOSEK_WILKIE";
        c.color_out("Color", c.b.emit3(Op::sky_model, {d.x, d.y, d.z}, hosek, c.b.add_data(analytic(c, hosek))));
        return;
    }
    const std::vector<float> data = sky_picture(c, type);
    c.color_out("Color", c.b.emit3(Op::sky_image, {d.x, d.y, d.z}, type != "NISHITA", c.b.add_data(data)));
}

constexpr NodeType k_nodes[] = {
    {"ShaderNodeTexSky", sky, nullptr, Support::same, ""},
};

}  // namespace

std::span<const NodeType> sky_nodes() { return k_nodes; }

std::vector<SkySun> sky_suns(const Program& program) {
    std::vector<SkySun> found;
    for (const Instruction& in : program.code) {
        if (in.op != Op::sky_image) continue;
        const float* data = program.data.data() + in.data;
        if (data[sky_diameter] <= 0) continue;
        SkySun sun;
        sun.direction = {data[sky_sun], data[sky_sun + 1], data[sky_sun + 2]};
        sun.half_angle = 0.5f * data[sky_diameter];
        const float mean = 0.5f * (data[sky_bottom + 1] + data[sky_top + 1]) * data[sky_intensity] * 0.8f;
        sun.power = mean * 2 * k_pi * (1 - std::cos(sun.half_angle));
        if (sun.power > 0) found.push_back(sun);
    }
    return found;
}

}  // namespace cardioid::nodes
