// SPDX-License-Identifier: GPL-3.0-or-later
#include "nodes/color_ramp.h"

#include "nodes/op_modes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cardioid::nodes {

namespace {

using Color = std::array<float, 4>;

struct Stop {
    float position;
    Color color;
};

Color to_hsv(const Color& c) {
    const float high = std::max({c[0], c[1], c[2]}), low = std::min({c[0], c[1], c[2]}), d = high - low;
    if (high == 0 || d == 0) return {0, 0, high, c[3]};
    float h = 0;
    if (c[0] == high)
        h = (c[1] - c[2]) / d;
    else if (c[1] == high)
        h = 2 + (c[2] - c[0]) / d;
    else
        h = 4 + (c[0] - c[1]) / d;
    return {h < 0 ? h / 6 + 1 : h / 6, d / high, high, c[3]};
}

Color from_hsv(const Color& c) {
    const auto part = [&](float shift) {
        const float k = std::abs(std::fmod(c[0] * 6 + shift, 6.0f) - 3) - 1;
        return ((std::clamp(k, 0.0f, 1.0f) - 1) * c[1] + 1) * c[2];
    };
    return {part(0), part(4), part(2), c[3]};
}

Color to_hsl(const Color& c) {
    const float high = std::max({c[0], c[1], c[2]}), low = std::min({c[0], c[1], c[2]}), d = high - low;
    const float l = std::min(1.0f, (high + low) / 2);
    if (d == 0) return {0, 0, l, c[3]};
    return {to_hsv(c)[0], l > 0.5f ? d / (2 - high - low) : d / (high + low), l, c[3]};
}

Color from_hsl(const Color& c) {
    const float chroma = (1 - std::abs(2 * c[2] - 1)) * c[1];
    const Color pure = from_hsv({c[0], 1, 1, 1});
    return {(pure[0] - 0.5f) * chroma + c[2], (pure[1] - 0.5f) * chroma + c[2], (pure[2] - 0.5f) * chroma + c[2], c[3]};
}

/// From hue a (t = 0) to hue b along the way that the ramp asks for.
float mix_hue(float a, float b, float t, const std::string& way) {
    const auto straight = [&](float x, float y) {
        const float h = x + t * (y - x);
        return h - std::floor(h);
    };
    if (way == "FAR" && a != b) {
        if (a < b && b - a < 0.5f) return straight(a + 1, b);
        if (a > b && b - a > -0.5f) return straight(a, b + 1);
        return straight(a, b);
    }
    // Blender counts from the right stop to the left one.
    if (way == "CCW") return a < b ? straight(a + 1, b) : straight(a, b);
    if (way == "CW") return a > b ? straight(a, b + 1) : straight(a, b);
    if (a < b && b - a > 0.5f) return straight(a + 1, b);
    if (a > b && b - a < -0.5f) return straight(a, b + 1);
    return straight(a, b);
}

Color mix(const Color& a, const Color& b, float t, const std::string& mode, const std::string& hue) {
    const auto straight = [&](const Color& x, const Color& y) {
        Color r;
        for (std::size_t k = 0; k < 4; ++k) r[k] = x[k] + t * (y[k] - x[k]);
        return r;
    };
    if (mode == "HSV" || mode == "HSL") {
        const bool hsv = mode == "HSV";
        const Color x = hsv ? to_hsv(a) : to_hsl(a), y = hsv ? to_hsv(b) : to_hsl(b);
        Color r = straight(x, y);
        r[0] = mix_hue(x[0], y[0], t, hue);
        return hsv ? from_hsv(r) : from_hsl(r);
    }
    return straight(a, b);
}

std::array<float, 4> cardinal_weights(float t) {
    constexpr float k = 0.71f;
    const float t2 = t * t, t3 = t2 * t;
    return {-k * t3 + 2 * k * t2 - k * t, (2 - k) * t3 + (k - 3) * t2 + 1, (k - 2) * t3 + (3 - 2 * k) * t2 + k * t,
            k * t3 - k * t2};
}

std::array<float, 4> bspline_weights(float t) {
    const float t2 = t * t, t3 = t2 * t;
    return {-0.16666666f * t3 + 0.5f * t2 - 0.5f * t + 0.16666666f, 0.5f * t3 - t2 + 0.6666667f,
            -0.5f * t3 + 0.5f * t2 + 0.5f * t + 0.16666666f, 0.16666666f * t3};
}

class Ramp {
public:
    Ramp(std::vector<Stop> stops, const std::string& interpolation, const std::string& mode, const std::string& hue)
        : stops_(std::move(stops)), interpolation_(interpolation), mode_(mode), hue_(hue) {}

    Color at(float x) const {
        if (stops_.size() == 1) return stops_[0].color;
        const bool spline = mode_ == "RGB" && (interpolation_ == "B_SPLINE" || interpolation_ == "CARDINAL");
        if (x <= stops_[0].position && !spline) return stops_[0].color;
        std::size_t next = 0;
        while (next < stops_.size() && stops_[next].position <= x) ++next;
        // Beyond an end the last colour goes on; splines bend toward it.
        const Stop left = next == 0 ? Stop{0, stops_[0].color} : stops_[next - 1];
        const Stop right = next == stops_.size() ? Stop{1, stops_.back().color} : stops_[next];
        if (!spline && next == stops_.size()) return left.color;
        if (interpolation_ == "CONSTANT") return left.color;
        const float width = right.position - left.position;
        float t = width != 0 ? (x - left.position) / width : (next == stops_.size() ? 0.0f : 1.0f);
        if (spline) return spline_at(next, left, right, t);
        if (interpolation_ == "EASE") t = t * t * (3 - 2 * t);
        return mix(left.color, right.color, t, mode_, hue_);
    }

private:
    Color spline_at(std::size_t next, const Stop& left, const Stop& right, float t) const {
        const Color& before = next >= 2 ? stops_[next - 2].color : left.color;
        const Color& after = next + 1 < stops_.size() ? stops_[next + 1].color : right.color;
        const auto w = interpolation_ == "CARDINAL" ? cardinal_weights(std::clamp(t, 0.0f, 1.0f))
                                                    : bspline_weights(std::clamp(t, 0.0f, 1.0f));
        Color r;
        for (std::size_t k = 0; k < 4; ++k)
            r[k] = std::clamp(w[0] * before[k] + w[1] * left.color[k] + w[2] * right.color[k] + w[3] * after[k], 0.0f,
                              1.0f);
        return r;
    }

    std::vector<Stop> stops_;
    std::string interpolation_, mode_, hue_;
};

}  // namespace

std::vector<float> ramp_table(const std::vector<double>& values, const std::string& interpolation,
                              const std::string& color_mode, const std::string& hue, int entries) {
    std::vector<Stop> stops;
    for (std::size_t k = 0; k + 5 <= values.size(); k += 5) {
        const auto at = [&](std::size_t i) { return static_cast<float>(values[k + i]); };
        stops.push_back({at(0), {at(1), at(2), at(3), at(4)}});
    }
    if (stops.empty()) stops = {{0, {0, 0, 0, 1}}, {1, {1, 1, 1, 1}}};
    std::stable_sort(stops.begin(), stops.end(), [](const Stop& a, const Stop& b) { return a.position < b.position; });
    const Ramp ramp(std::move(stops), interpolation, color_mode, hue);
    std::vector<float> table;
    table.reserve(static_cast<std::size_t>(entries) * 4);
    for (int i = 0; i < entries; ++i) {
        const Color c = ramp.at(static_cast<float>(i) / static_cast<float>(entries - 1));
        table.insert(table.end(), c.begin(), c.end());
    }
    return table;
}

}  // namespace cardioid::nodes
