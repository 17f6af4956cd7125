// SPDX-License-Identifier: GPL-3.0-or-later
// Running the filter on synthetic films, and sums over what it gives.
#pragma once

#include "filter/filter.h"
#include "filter/synthetic_film.h"

#include <gtest/gtest.h>

namespace cardioid::test {

using scene::FilterMethod;
using scene::FilterSettings;

/// `density` 0: nothing is rejected.
inline FilterSettings filter_settings(FilterMethod method, float density = 0, int size = 11) {
    FilterSettings s;
    s.use_filter = true;
    s.filter_method = method;
    s.firefly_density = density;
    s.filter_size = size;
    return s;
}

/// RGB, bottom row first.
struct Picture {
    int width = 0, height = 0;
    std::vector<float> rgb;
    float operator()(int x, int y, int channel = 1) const {
        return rgb[3 * (static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)) +
                   static_cast<std::size_t>(channel)];
    }
};

inline Picture raw(const film::Film& film) {
    film::Frame frame = film.make_frame();
    film.resolve(film.region(), frame);
    return {frame.width, frame.height, frame.find("Raw")->data};
}

inline Picture filtered(const film::Film& film, const FilterSettings& settings, int lanes = 0) {
    filter::Filtered f = filter::run(film, settings, filter::run_serially, lanes);
    EXPECT_TRUE(f.complete);
    return {f.width, f.height, std::move(f.shown)};
}

/// Largest difference, relative where values are above `floor`.
inline double difference(const Picture& a, const Picture& b, double floor = 1e-3) {
    EXPECT_EQ(a.rgb.size(), b.rgb.size());
    double most = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        const double d =
            std::abs(static_cast<double>(a.rgb[i]) - b.rgb[i]) / std::max<double>(floor, std::abs(b.rgb[i]));
        most = std::isfinite(d) ? std::max(most, d) : 1e30;
    }
    return most;
}

struct Moments {
    double mean = 0, variance = 0;
};

/// Of the green channel over a rectangle.
inline Moments moments(const Picture& p, int x0, int y0, int width, int height) {
    double sum = 0, squares = 0;
    for (int y = y0; y < y0 + height; ++y) {
        for (int x = x0; x < x0 + width; ++x) {
            sum += p(x, y);
            squares += static_cast<double>(p(x, y)) * p(x, y);
        }
    }
    const double n = static_cast<double>(width) * height, mean = sum / n;
    return {mean, squares / n - mean * mean};
}

inline Moments moments(const Picture& p) { return moments(p, 0, 0, p.width, p.height); }

/// Energy of a over that of b.
inline double energy_ratio(const Picture& a, const Picture& b) { return moments(a).mean / moments(b).mean; }

}  // namespace cardioid::test
