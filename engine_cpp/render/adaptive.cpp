// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/adaptive.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

float HalfSums::error(float exposure) const {
    if (half_samples == 0 || half_samples == samples) return std::numeric_limits<float>::infinity();
    float difference = 0, intensity = 0;
    for (int k = 0; k < 3; ++k) {
        const float mean = all[k] / static_cast<float>(samples);
        difference += std::fabs(mean - half[k] / static_cast<float>(half_samples));
        intensity += mean;
    }
    intensity *= exposure;
    // What is brighter than white may be as noisy as white.
    const float level = intensity < 1 ? std::sqrt(intensity) : intensity;
    return difference * exposure / (1e-4f + level);
}

Adaptive::Adaptive(const scene::Settings& settings, const film::Region& region)
    : region_(region),
      threshold_(settings.adaptive_threshold),
      exposure_(settings.exposure),
      count_(std::int64_t{region.width} * region.height) {
    if (!on()) return;
    sums_.resize(static_cast<std::size_t>(count_));
    // Cycles: 0.1 → 32, 0.01 → 64, 0.001 → 128.
    const int automatic = static_cast<int>(std::ceil(16 / std::pow(threshold_, 0.3f)));
    min_samples_ = std::max(4, settings.adaptive_min_samples > 0 ? settings.adaptive_min_samples : automatic);
}

void Adaptive::add(int x, int y, const film::Sample& sample, int number) {
    HalfSums& s =
        sums_[static_cast<std::size_t>(y - region_.y) * region_.width + static_cast<std::size_t>(x - region_.x)];
    const bool half = in_second_half(static_cast<std::uint32_t>(number));
    ++s.samples;
    s.half_samples += half;
    for (int k = 0; k < 3; ++k) {
        float sum = 0;
        for (const auto& c : sample.radiance) sum += c[k];
        s.all[k] += sum;
        if (half) s.half[k] += sum;
    }
}

void Adaptive::update() {
    std::vector<std::uint8_t> noisy(sums_.size());
    tbb::parallel_for(0, region_.height, [&](int y) {
        const std::size_t row = static_cast<std::size_t>(y) * region_.width;
        for (std::size_t i = row; i < row + region_.width; ++i) {
            const bool quiet = sums_[i].error(exposure_) < k_scale * threshold_;
            noisy[i] = !quiet;
        }
    });
    active_ = grown(noisy, region_.width, region_.height);
    count_ = std::count(active_.begin(), active_.end(), std::uint8_t{1});
}

double Adaptive::mean_samples() const {
    std::uint64_t sum = 0;
    for (const HalfSums& s : sums_) sum += s.samples;
    return static_cast<double>(sum) / static_cast<double>(std::max<std::size_t>(sums_.size(), 1));
}

std::int64_t Adaptive::memory_bytes() const {
    return static_cast<std::int64_t>(sums_.size() * sizeof(HalfSums) + active_.size());
}

}  // namespace cardioid::render
