// SPDX-License-Identifier: GPL-3.0-or-later
#include "film/pixel_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace cardioid::film {

namespace {
double filter_value(scene::PixelFilter filter, double x, double width) {
    switch (filter) {
        case scene::PixelFilter::box: return 1;
        case scene::PixelFilter::gaussian: {
            const double v = 6 * x / width;
            return std::exp(-2 * v * v);
        }
        case scene::PixelFilter::blackman_harris: {
            const double v = 2 * std::numbers::pi * (x / width + 0.5);
            return 0.35875 - 0.48829 * std::cos(v) + 0.14128 * std::cos(2 * v) - 0.01168 * std::cos(3 * v);
        }
    }
    return 0;
}
}  // namespace

FilterTable make_filter_table(scene::PixelFilter filter, float width) {
    // Cycles' width is a nominal one: the support is twice as wide for Blackman-Harris, three times for the Gaussian.
    const double nominal = std::max(width, 0.01f);
    const double w = filter == scene::PixelFilter::box        ? 1.0
                     : filter == scene::PixelFilter::gaussian ? 3 * nominal
                                                              : 2 * nominal;
    constexpr int k_fine = 16 * k_filter_steps;
    std::vector<double> cdf(k_fine + 1, 0.0);
    for (int i = 0; i < k_fine; ++i) {
        const double x = ((i + 0.5) / k_fine - 0.5) * w;
        cdf[i + 1] = cdf[i] + std::max(filter_value(filter, x, w), 0.0);
    }
    FilterTable table{};
    int at = 0;
    for (int q = 0; q <= k_filter_steps; ++q) {
        const double target = cdf[k_fine] * q / k_filter_steps;
        while (at < k_fine - 1 && cdf[at + 1] < target) ++at;
        const double step = cdf[at + 1] - cdf[at];
        const double f = step > 0 ? std::clamp((target - cdf[at]) / step, 0.0, 1.0) : 0.0;
        table[q] = static_cast<float>(((at + f) / k_fine - 0.5) * w);
    }
    return table;
}

}  // namespace cardioid::film
