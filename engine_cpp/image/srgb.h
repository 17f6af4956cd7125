// SPDX-License-Identifier: GPL-3.0-or-later
// The sRGB transfer function (IEC 61966-2-1).
#pragma once

#include <array>
#include <cmath>

namespace cardioid::image {

/// Negative values become 0, values over 1 follow the curve.
inline float linear_from_srgb(float encoded) {
    if (encoded < 0.04045f) return encoded < 0 ? 0.0f : encoded * (1.0f / 12.92f);
    return std::pow((encoded + 0.055f) * (1.0f / 1.055f), 2.4f);
}

inline float srgb_from_linear(float linear) {
    if (linear < 0.0031308f) return linear < 0 ? 0.0f : linear * 12.92f;
    return 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

/// linear_from_srgb for lookups: on [0, 1] straight lines between 1024 points, within 4e-7 of the curve.
class SrgbTable {
public:
    SrgbTable() {
        for (int i = 0; i < k_size; ++i) {
            const double at = curve(double(i) / k_size), next = curve(double(i + 1) / k_size);
            segments_[static_cast<std::size_t>(i)] = {static_cast<float>(at), static_cast<float>(next - at)};
        }
    }
    float operator()(float encoded) const {
        if (!(encoded >= 0 && encoded < 1)) return linear_from_srgb(encoded);
        const float scaled = encoded * k_size;
        const int i = static_cast<int>(scaled);
        const Segment s = segments_[static_cast<std::size_t>(i)];
        return s.start + s.rise * (scaled - static_cast<float>(i));
    }

private:
    static constexpr int k_size = 1024;
    struct Segment {
        float start, rise;
    };
    static double curve(double x) { return x < 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }
    std::array<Segment, k_size> segments_;
};

}  // namespace cardioid::image
