// SPDX-License-Identifier: GPL-3.0-or-later
// Coefficients of the skies of Preetham, Shirley and Smits (1999) and of Hosek and Wilkie (2012).
#include "nodes/hosek_table.h"
#include "nodes/sky.h"

#include <algorithm>
#include <cmath>

namespace cardioid::nodes {

namespace {

constexpr float k_pi = 3.14159265358979f;

float perez(const float* c, float theta, float gamma) {
    return (1 + c[0] * std::exp(c[1] / std::cos(theta))) *
           (1 + c[2] * std::exp(c[3] * gamma) + c[4] * std::cos(gamma) * std::cos(gamma));
}

/// Quintic Bézier curve over the sun's elevation, for one turbidity and albedo.
double over_elevation(const float* control, int stride, double t) {
    constexpr double binomial[] = {1, 5, 10, 10, 5, 1};
    double sum = 0;
    for (int k = 0; k < 6; ++k)
        sum += binomial[k] * std::pow(1 - t, 5 - k) * std::pow(t, k) * static_cast<double>(control[k * stride]);
    return sum;
}

/// One number of the data set: `entry` of `stride` for each control point.
double hosek_value(const float* data, int stride, int entry, double turbidity, double albedo, double t) {
    const int whole = std::clamp(static_cast<int>(turbidity), 1, 10);
    const double rest = std::clamp(turbidity - whole, 0.0, 1.0);
    double sum = 0;
    for (int a = 0; a < 2; ++a) {
        for (int k = 0; k < 2 && whole + k <= 10; ++k) {
            const double weight = (a == 0 ? 1 - albedo : albedo) * (k == 0 ? 1 - rest : rest);
            sum += weight * over_elevation(data + (a * 10 + whole - 1 + k) * 6 * stride + entry, stride, t);
        }
    }
    return sum;
}

}  // namespace

AnalyticSky preetham_sky(Float3 sun, float T) {
    AnalyticSky s{};
    const float theta = std::acos(std::clamp(sun.z, -1.0f, 1.0f)), t2 = theta * theta, t3 = t2 * theta, T2 = T * T;
    const float chi = (4.0f / 9 - T / 120) * (k_pi - 2 * theta);
    s[0] = std::atan2(sun.x, sun.y);
    s[1] = theta;
    s[2] = ((4.0453f * T - 4.9710f) * std::tan(chi) - 0.2155f * T + 2.4192f) * 0.06f;
    s[3] = (0.00166f * t3 - 0.00375f * t2 + 0.00209f * theta) * T2 +
           (-0.02903f * t3 + 0.06377f * t2 - 0.03202f * theta + 0.00394f) * T +
           (0.11693f * t3 - 0.21196f * t2 + 0.06052f * theta + 0.25886f);
    s[4] = (0.00275f * t3 - 0.00610f * t2 + 0.00317f * theta) * T2 +
           (-0.04214f * t3 + 0.08970f * t2 - 0.04153f * theta + 0.00516f) * T +
           (0.15346f * t3 - 0.26756f * t2 + 0.06670f * theta + 0.26688f);
    constexpr float k_slope[3][5] = {{0.1787f, -0.3554f, -0.0227f, 0.1206f, -0.0670f},
                                     {-0.0193f, -0.0665f, -0.0004f, -0.0641f, -0.0033f},
                                     {-0.0167f, -0.0950f, -0.0079f, -0.0441f, -0.0109f}};
    constexpr float k_base[3][5] = {{-1.4630f, 0.4275f, 5.3251f, -2.5771f, 0.3703f},
                                    {-0.2592f, 0.0008f, 0.2125f, -0.8989f, 0.0452f},
                                    {-0.2608f, 0.0092f, 0.2102f, -1.6537f, 0.0529f}};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        float* c = s.data() + 5 + 9 * channel;
        for (int k = 0; k < 5; ++k) c[k] = k_slope[channel][k] * T + k_base[channel][k];
        s[2 + channel] /= perez(c, 0, theta);
    }
    return s;
}

AnalyticSky hosek_sky(Float3 sun, float turbidity, float albedo) {
    AnalyticSky s{};
    const float theta = std::clamp(std::acos(std::clamp(sun.z, -1.0f, 1.0f)), 0.0f, k_pi / 2);
    s[0] = std::atan2(sun.x, sun.y);
    s[1] = theta;
    const double t = std::cbrt(static_cast<double>((k_pi / 2 - theta) / (k_pi / 2)));
    const double T = std::clamp(static_cast<double>(turbidity), 1.0, 10.0);
    for (int channel = 0; channel < 3; ++channel) {
        const auto c = static_cast<std::size_t>(channel);
        for (int k = 0; k < 9; ++k)
            s[5 + 9 * c + static_cast<std::size_t>(k)] = static_cast<float>(
                hosek_value(k_hosek_shape + 1080 * channel, 9, k, T, static_cast<double>(albedo), t));
        s[2 + c] =
            static_cast<float>(hosek_value(k_hosek_radiance + 120 * channel, 1, 0, T, static_cast<double>(albedo), t));
    }
    return s;
}

}  // namespace cardioid::nodes
