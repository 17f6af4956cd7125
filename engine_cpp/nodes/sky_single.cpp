// SPDX-License-Identifier: GPL-3.0-or-later
// Single scattering in the atmosphere after Nishita et al. 1993, with the constants, wavelengths and quadrature of Cycles.
#include "nodes/sky.h"

#include <algorithm>
#include <cmath>

namespace cardioid::nodes {

namespace {

constexpr float k_pi = 3.14159265358979f;
constexpr int k_wavelengths = 21;                    ///< 380 to 780 nm
constexpr float k_step = 20;                         ///< nm
constexpr int k_segments = 32;                       ///< of a ray
constexpr float k_earth = 6360e3f, k_top = 6420e3f;  ///< metres
constexpr float k_mie = 2e-5f, k_mie_extinction = 1.11f * k_mie, k_g = 0.76f;

/// Of the sun above the atmosphere, W m⁻² nm⁻¹.
constexpr float k_irradiance[] = {
    1.4575683f,  1.56596306f, 1.65148449f, 1.71496243f, 1.75797984f, 1.78256408f, 1.79095108f,
    1.7854155f,  1.76815555f, 1.7412207f,  1.70647127f, 1.66556087f, 1.61993437f, 1.57083597f,
    1.51932335f, 1.46628495f, 1.41245853f, 1.35844962f, 1.30474914f, 1.25174963f, 1.19975999f,
};
/// Scattering by air and absorption by ozone, m⁻¹.
constexpr float k_rayleigh[] = {
    5.42482009e-05f, 4.41854987e-05f, 3.63515191e-05f, 3.01792901e-05f, 2.52632023e-05f, 2.13085931e-05f,
    1.80983803e-05f, 1.54705713e-05f, 1.33028498e-05f, 1.15018478e-05f, 9.9955743e-06f,  8.72799974e-06f,
    7.65513701e-06f, 6.74217204e-06f, 5.96134126e-06f, 5.29034598e-06f, 4.71115688e-06f, 4.20910481e-06f,
    3.77218381e-06f, 3.39051255e-06f, 3.05591532e-06f,
};
constexpr float k_ozone[] = {
    3.2512685e-09f,  5.85395365e-09f, 1.97719116e-08f, 7.30956876e-08f, 2.00845615e-07f, 4.03839581e-07f,
    6.35513359e-07f, 9.67070412e-07f, 1.547974e-06f,   2.09038647e-06f, 2.46128056e-06f, 2.73551299e-06f,
    2.15125863e-06f, 1.59051841e-06f, 1.12356198e-06f, 7.35275515e-07f, 4.64501304e-07f, 3.30960799e-07f,
    2.25126123e-07f, 1.48791293e-07f, 1.68286234e-07f,
};
/// CIE XYZ responses.
constexpr float k_xyz[] = {
    0.001368f,    3.9e-05f,      0.006450001f, 0.01431f,     0.000396f,     0.06785001f, 0.13438f,      0.004f,
    0.6456f,      0.34828f,      0.023f,       1.74706f,     0.2908f,       0.06f,       1.6692f,       0.09564f,
    0.13902f,     0.8129501f,    0.0049f,      0.323f,       0.272f,        0.06327f,    0.71f,         0.07824999f,
    0.2904f,      0.954f,        0.0203f,      0.5945f,      0.995f,        0.0039f,     0.9163f,       0.87f,
    0.001650001f, 1.0622f,       0.631f,       0.0008f,      0.8544499f,    0.381f,      0.00019f,      0.4479f,
    0.175f,       2e-05f,        0.1649f,      0.061f,       0.f,           0.04677f,    0.017f,        0.f,
    0.01135916f,  0.004102f,     0.f,          0.002899327f, 0.001047f,     0.f,         0.0006900786f, 0.0002492f,
    0.f,          0.0001661505f, 6e-05f,       0.f,          4.150994e-05f, 1.499e-05f,  0.f,
};
/// Gauss–Laguerre over the ray, scaled so that its last node is in the atmosphere.
constexpr float k_nodes[] = {0.006811185292f, 0.03614807107f, 0.09004346519f, 0.1706680068f,
                             0.2818362161f,   0.4303406404f,  0.6296271457f,  0.9145252695f};
constexpr float k_weights[] = {0.01750893642f, 0.04135477391f, 0.06678839063f, 0.09507698807f,
                               0.1283416365f,  0.1707430204f,  0.2327233347f,  0.3562490486f};

struct Spectrum {
    float v[k_wavelengths] = {};
};

Float3 to_xyz(const Spectrum& s) {
    Float3 sum;
    for (int i = 0; i < k_wavelengths; ++i)
        sum = sum + Float3{k_xyz[3 * i], k_xyz[3 * i + 1], k_xyz[3 * i + 2]} * s.v[i];
    return sum * k_step;
}

float reach(Float3 p, Float3 d) {
    const float b = 2 * dot(d, p), c = dot(p, p) - k_top * k_top;
    return (-b + std::sqrt(b * b - 4 * c)) / 2;
}

bool meets_ground(Float3 p, Float3 d) {
    if (d.z >= 0) return false;
    const float b = 2 * dot(d, p), c = dot(p, p) - k_earth * k_earth;
    return b * b - 4 * c >= 0;
}

/// Relative densities of air, aerosols and ozone.
Float3 density(Float3 p) {
    const float h = std::sqrt(dot(p, p)) - k_earth;
    return {std::exp(-h / 8e3f), std::exp(-h / 1.2e3f), std::max(0.0f, 1 - std::abs(h - 25000) / 15000)};
}

Float3 optical_depth(Float3 p, Float3 d) {
    const float length = reach(p, d);
    Float3 sum;
    for (int i = 0; i < 8; ++i) sum = sum + density(p + d * (k_nodes[i] * length)) * k_weights[i];
    return sum * length;
}

Float3 scaled(Float3 a, Float3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

Spectrum scattered(Float3 d, Float3 sun, Float3 p, const Atmosphere& a) {
    const float length = reach(p, d) / k_segments, mu = dot(d, sun);
    const float air_phase = 3 / (16 * k_pi) * (1 + mu * mu);
    const float mie_phase = 3 * (1 - k_g * k_g) * (1 + mu * mu) /
                            (8 * k_pi * (2 + k_g * k_g) * std::pow(1 + k_g * k_g - 2 * k_g * mu, 1.5f));
    const Float3 amount{a.air, a.aerosol, a.ozone};
    Spectrum out;
    Float3 depth;
    p = p + d * (0.5f * length);
    for (int k = 0; k < k_segments; ++k, p = p + d * length) {
        const Float3 here = scaled(density(p), amount);
        depth = depth + here * length;
        if (meets_ground(p, sun)) continue;
        const Float3 total = depth + scaled(optical_depth(p, sun), amount);
        for (int i = 0; i < k_wavelengths; ++i) {
            const float lost = total.x * k_rayleigh[i] + total.y * k_mie_extinction + total.z * k_ozone[i];
            const float turned = air_phase * here.x * k_rayleigh[i] + mie_phase * here.y * k_mie;
            out.v[i] += std::exp(-lost) * turned * k_irradiance[i] * length;
        }
    }
    return out;
}

Float3 direction(float latitude, float longitude) {
    return {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude), std::sin(latitude)};
}

Float3 sun_xyz(float elevation, float solid_angle, const Atmosphere& a) {
    const Float3 depth = optical_depth({0, 0, k_earth + a.altitude}, direction(elevation, 0));
    Spectrum s;
    for (int i = 0; i < k_wavelengths; ++i)
        s.v[i] = k_irradiance[i] / solid_angle *
                 std::exp(-(k_rayleigh[i] * depth.x * a.air + k_mie_extinction * depth.y * a.aerosol));
    return to_xyz(s);
}

void put(SkyImage& image, int x, int y, Float3 xyz) {
    for (const int column : {x, image.width - 1 - x}) {
        float* to = image.xyz.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                            static_cast<std::size_t>(column));
        to[0] = xyz.x;
        to[1] = xyz.y;
        to[2] = xyz.z;
    }
}

float squared(float x) { return x * x; }

}  // namespace

SkyImage single_scattering(Atmosphere a, bool whole) {
    a.altitude = std::clamp(a.altitude, 1.0f, 59999.0f);
    SkyImage image(512, whole ? 256 : 128);
    const int low = whole ? image.height / 2 : 0, rows = image.height - low;
    const Float3 eye{0, 0, k_earth + a.altitude}, sun = direction(a.sun_elevation, 0);
    // Before Blender 5.0 the last row looks a little past the zenith.
    const float top = k_pi / 2 + (whole ? 0 : k_pi / 4 / static_cast<float>(rows));
    for (int y = 0; y < rows; ++y) {
        const float latitude = top * squared(static_cast<float>(y) / static_cast<float>(rows));
        for (int x = 0; x < image.width / 2; ++x) {
            const float longitude = 2 * k_pi / static_cast<float>(image.width) * static_cast<float>(x) - k_pi;
            put(image, x, low + y, to_xyz(scattered(direction(latitude, longitude), sun, eye, a)));
        }
    }
    for (int y = 0; y < low; ++y) {
        const float down = std::sin(k_pi / 2 * squared(static_cast<float>(y) / static_cast<float>(low) - 1));
        const float share = down < 0.4f ? 1 - 2.5f * down : 0, fade = share * share * share;
        for (int x = 0; x < image.width / 2; ++x) put(image, x, y, image.at(x, low) * fade);
    }
    return image;
}

SunDisc single_scattering_sun(Atmosphere a, float diameter, bool whole) {
    a.altitude = std::clamp(a.altitude, 1.0f, 59999.0f);
    const float half = diameter / 2, solid_angle = 2 * k_pi * (1 - std::cos(half));
    const float bottom = std::max(a.sun_elevation - half, 0.0f), top = std::max(a.sun_elevation + half, 0.0f);
    if (whole && top <= 0) return {};
    return {sun_xyz(bottom, solid_angle, a), sun_xyz(top, solid_angle, a)};
}

}  // namespace cardioid::nodes
