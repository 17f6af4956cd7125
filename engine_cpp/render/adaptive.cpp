// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/adaptive.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace cardioid::render {

namespace {

/// A pixel is active where it or one of its neighbours is: noise that one pixel shows is its neighbours' too.
std::vector<std::uint8_t> grown(const std::vector<std::uint8_t>& noisy, int width, int height) {
    std::vector<std::uint8_t> rows(noisy.size()), all(noisy.size());
    const auto at = [width](int x, int y) { return static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x); };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x)
            rows[at(x, y)] =
                noisy[at(std::max(x - 1, 0), y)] | noisy[at(x, y)] | noisy[at(std::min(x + 1, width - 1), y)];
    }
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x)
            all[at(x, y)] = rows[at(x, std::max(y - 1, 0))] | rows[at(x, y)] | rows[at(x, std::min(y + 1, height - 1))];
    }
    return all;
}

}  // namespace

Adaptive::Adaptive(const scene::Settings& settings, const film::Region& region)
    : region_(region), threshold_(settings.adaptive_threshold), count_(std::int64_t{region.width} * region.height) {
    if (!on()) return;
    // Cycles: 0.1 → 32, 0.01 → 64, 0.001 → 128.
    const float automatic = std::ceil(16 / std::pow(threshold_, 0.3f));
    min_samples_ =
        std::max(4, settings.adaptive_min_samples > 0 ? settings.adaptive_min_samples : static_cast<int>(automatic));
}

void Adaptive::update(const film::Film& film) {
    std::vector<std::uint8_t> noisy(static_cast<std::size_t>(region_.width) * static_cast<std::size_t>(region_.height));
    tbb::parallel_for(0, region_.height, [&](int y) {
        for (int x = 0; x < region_.width; ++x) {
            const bool quiet = film.noise(x, y) < k_scale * threshold_;
            noisy[static_cast<std::size_t>(y) * region_.width + static_cast<std::size_t>(x)] = !quiet;
        }
    });
    active_ = grown(noisy, region_.width, region_.height);
    count_ = std::count(active_.begin(), active_.end(), std::uint8_t{1});
}

}  // namespace cardioid::render
