// SPDX-License-Identifier: GPL-3.0-or-later
// Multiple scattering in the atmosphere: four wavelengths and an analytic fit of the higher orders, after Fernando García
// Liñán (fgarlin.com, "Spectral sky", 2024; MIT licence), with the constants of Cycles. Kilometres.
#include "nodes/sky.h"

#include <algorithm>
#include <cmath>

namespace cardioid::nodes {

namespace {

constexpr float k_pi = 3.14159265358979f;
constexpr float k_earth = 6371, k_thickness = 100, k_top = k_earth + k_thickness;
constexpr int k_steps = 64, k_table_x = 256, k_table_y = 64;
constexpr float k_g = 0.8f;

/// 630, 560, 490, 430 nm.
struct Four {
    float v[4];
    template <class F>
    static Four of(F f) {
        return {{f(0), f(1), f(2), f(3)}};
    }
};
Four operator+(Four a, Four b) {
    return Four::of([&](int i) { return a.v[i] + b.v[i]; });
}
Four operator*(Four a, Four b) {
    return Four::of([&](int i) { return a.v[i] * b.v[i]; });
}
Four operator*(Four a, float s) {
    return Four::of([&](int i) { return a.v[i] * s; });
}
Four operator/(Four a, Four b) {
    return Four::of([&](int i) { return a.v[i] / b.v[i]; });
}
Four mix(Four a, Four b, float t) { return a * (1 - t) + b * t; }
Four transmitted(Four depth) {
    return Four::of([&](int i) { return std::exp(-depth.v[i]); });
}

constexpr Four k_sun{{1.679f, 1.828f, 1.986f, 1.307f}};
constexpr Four k_molecules{{6.605e-3f, 1.067e-2f, 1.842e-2f, 3.156e-2f}};
constexpr Four k_ozone{{3.472e-25f, 3.914e-25f, 1.349e-25f, 11.03e-27f}};
constexpr float k_dobson = 334.5f;
constexpr Four k_aerosol_absorption{{2.8722e-24f, 4.6168e-24f, 7.9706e-24f, 1.3578e-23f}};
constexpr Four k_aerosol_scattering{{1.5908e-22f, 1.7711e-22f, 2.0942e-22f, 2.4033e-22f}};
constexpr float k_aerosol_base = 1.3681e20f, k_aerosol_background = 2e6f, k_aerosol_height = 0.73f;

Float3 to_xyz(Four s) {
    constexpr Float3 rows[] = {{53.386917738564668f, 22.981337506691025f, 0.0f},
                               {43.904844466369358f, 71.347795700053394f, 0.10250686796574131f},
                               {1.6137278251608962f, 18.422960591455485f, 31.742921188390806f},
                               {20.762668673810577f, 2.3614213523314369f, 110.48009643252140f}};
    Float3 sum;
    for (int i = 0; i < 4; ++i) sum = sum + rows[i] * s.v[i];
    return sum;
}

/// Distance to a sphere about the origin; negative: behind or missed.
float reach(Float3 p, Float3 d, float radius) {
    const float b = dot(p, d), c = dot(p, p) - radius * radius, q = b * b - c;
    if ((c > 0 && b > 0) || q < 0) return -1;
    return q >= b * b ? -b + std::sqrt(q) : -b - std::sqrt(q);
}

Float3 towards_sun(float cosine) { return {-std::sqrt(1 - cosine * cosine), 0, cosine}; }

struct Coefficients {
    Four molecules, aerosol, extinction;  ///< scattering, and the whole
};

class Sky {
public:
    explicit Sky(const Atmosphere& a) : a_(a) {}

    Coefficients at(float h) const {
        const float log_h = std::log(std::max(h, 1e-4f)), q = log_h - 3.22261f;
        const float ozone = 3.78547397e20f * std::exp(-q * q * 5.55555555f - log_h);
        const float dust =
            k_aerosol_base * (std::exp(-h / k_aerosol_height) + k_aerosol_background / k_aerosol_base) * a_.aerosol;
        Coefficients c;
        c.molecules = k_molecules * (std::exp(-0.07771971f * std::pow(h, 1.16364243f)) * a_.air);
        c.aerosol = k_aerosol_scattering * dust;
        c.extinction = c.molecules + c.aerosol + k_aerosol_absorption * dust + k_ozone * k_dobson * ozone * a_.ozone;
        return c;
    }

    /// From a height (0…1) through the atmosphere.
    Four transmittance(float cosine, float height) const {
        const Float3 d = towards_sun(cosine), p{0, 0, k_earth + (k_top - k_earth) * height};
        const float step = reach(p, d, k_top) / k_steps;
        Four depth{};
        for (int k = 0; k < k_steps; ++k) {
            const Float3 q = p + d * ((static_cast<float>(k) + 0.5f) * step);
            depth = depth + at(std::max(std::sqrt(dot(q, q)) - k_earth, 0.0f)).extinction * step;
        }
        return transmitted(depth);
    }

    void fill_table() {
        table_.resize(std::size_t{k_table_x} * k_table_y);
        for (int y = 0; y < k_table_y; ++y)
            for (int x = 0; x < k_table_x; ++x)
                table_[static_cast<std::size_t>(y * k_table_x + x)] = transmittance(
                    static_cast<float>(x) / (k_table_x - 1) * 2 - 1, static_cast<float>(y) / (k_table_y - 1));
    }

    Four scattered(Float3 sun, Float3 p, Float3 d, float length) const {
        const float cosine = -dot(d, sun), bend = 1 + k_g * k_g + 2 * k_g * cosine;
        const float molecules = 3 / (16 * k_pi) * (1 + cosine * cosine);
        const float aerosol = (1 - k_g * k_g) / (4 * k_pi * bend * std::sqrt(bend));
        const float dt = length / k_steps;
        Four sum{}, left{{1, 1, 1, 1}};
        for (int k = 0; k < k_steps; ++k) {
            const Float3 q = p + d * ((static_cast<float>(k) + 0.5f) * dt);
            const float radius = std::sqrt(dot(q, q)), h = std::max(radius - k_earth, 0.0f), height = h / k_thickness;
            const float up = dot(q, sun) / radius;
            const Coefficients c = at(h);
            const Four direct = look_up(up, height), higher = higher_orders(up, height, radius);
            const Four source =
                k_sun * (c.molecules * (direct * molecules + higher) + c.aerosol * (direct * aerosol + higher));
            const Four step = transmitted(c.extinction * dt);
            const Four inside =
                Four::of([&](int i) { return source.v[i] * (1 - step.v[i]) / std::max(c.extinction.v[i], 1e-7f); });
            sum = sum + left * inside;
            left = left * step;
        }
        return sum;
    }

private:
    Four look_up(float cosine, float height) const {
        const float x = (k_table_x - 1) * std::clamp(cosine * 0.5f + 0.5f, 0.0f, 1.0f);
        const float y = (k_table_y - 1) * std::clamp(height, 0.0f, 1.0f);
        const int x1 = static_cast<int>(x), y1 = static_cast<int>(y);
        const int x2 = std::min(x1 + 1, k_table_x - 1), y2 = std::min(y1 + 1, k_table_y - 1);
        const auto entry = [&](int i, int j) { return table_[static_cast<std::size_t>(j * k_table_x + i)]; };
        const float fx = x - static_cast<float>(x1), fy = y - static_cast<float>(y1);
        return mix(mix(entry(x1, y1), entry(x2, y1), fx), mix(entry(x1, y2), entry(x2, y2), fx), fy);
    }

    /// Light from the ground, and the fit of what was scattered several times.
    Four higher_orders(float cosine, float height, float radius) const {
        constexpr float albedo = 0.3f;
        constexpr Four fit{{0.217f, 0.347f, 0.594f, 1.0f}};
        const float share = k_earth / radius;
        const float ground_angle = 2 * k_pi * (1 - std::sqrt(std::max(1 - share * share, 0.0f)));
        const Four from_ground = look_up(1, 0) / look_up(1, height);
        const Four ground = look_up(cosine, 0) * from_ground * (ground_angle * albedo / (4 * k_pi * k_pi) * cosine);
        return ground + fit * (0.02f / (1 + 5 * std::exp(-17.92f * cosine)));
    }

    Atmosphere a_;
    std::vector<Four> table_;
};

}  // namespace

SkyImage multiple_scattering(Atmosphere a) {
    Sky sky(a);
    sky.fill_table();
    SkyImage image(512, 256);
    const Float3 sun = towards_sun(std::cos(k_pi / 2 - a.sun_elevation));
    const Float3 eye{0, 0, k_earth + std::clamp(a.altitude, 1.0f, 99999.0f) / 1000};
    for (int y = 0; y < image.height; ++y) {
        const float l = (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height) * 2 - 1;
        const float elevation = std::copysign(l * l, l) * k_pi / 2;
        for (int x = 0; x < image.width / 2; ++x) {
            const float azimuth = 2 * k_pi * (static_cast<float>(x) + 0.5f) / static_cast<float>(image.width);
            const Float3 d{std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                           std::sin(elevation)};
            const float ground = reach(eye, d, k_earth);
            const Float3 xyz = to_xyz(sky.scattered(sun, eye, d, ground < 0 ? reach(eye, d, k_top) : ground));
            for (const int column : {x, image.width - 1 - x}) {
                float* to = image.xyz.data() + 3 * static_cast<std::size_t>(y * image.width + column);
                to[0] = xyz.x;
                to[1] = xyz.y;
                to[2] = xyz.z;
            }
        }
    }
    return image;
}

SunDisc multiple_scattering_sun(Atmosphere a, float diameter) {
    const Sky sky(a);
    const float half = diameter / 2, solid_angle = 2 * k_pi * (1 - std::cos(half));
    const float height = std::clamp(a.altitude, 1.0f, 99999.0f) / 1000 / k_thickness;
    const auto xyz = [&](float elevation) {
        return to_xyz(k_sun * sky.transmittance(std::cos(k_pi / 2 - elevation), height) * (1 / solid_angle));
    };
    return {xyz(a.sun_elevation - half), xyz(a.sun_elevation + half)};
}

}  // namespace cardioid::nodes
