// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter/reject_kernel.h"

#include <algorithm>
#include <cmath>

namespace cardioid::filter {

namespace {
/// Pixels within `half` of `at` that lie in [0, size).
int span_inside(int at, int half, int size) { return std::min(at + half, size - 1) - std::max(at - half, 0) + 1; }
}  // namespace

RejectionKernel::RejectionKernel(const scene::FilterSettings& settings, int width, int height)
    : width_(width),
      height_(height),
      half_(std::max(settings.filter_size, 1) / 2),
      density_(static_cast<double>(settings.firefly_density) * static_cast<double>(settings.luminance_sensitivity)) {
    const int across = std::min(half_, width - 1), up = std::min(half_, height - 1);
    for (int dy = -up; dy <= up; ++dy) {
        for (int dx = -across; dx <= across; ++dx) {
            if (dx != 0 || dy != 0) steps_.push_back({dx, dy});
        }
    }
    const auto nearer = [](const Step& a, const Step& b) {
        return a.dx * a.dx + a.dy * a.dy < b.dx * b.dx + b.dy * b.dy;
    };
    std::stable_sort(steps_.begin(), steps_.end(), nearer);
}

bool RejectionKernel::inside(int x, int y) const {
    return x >= half_ && y >= half_ && x + half_ < width_ && y + half_ < height_;
}

std::int64_t RejectionKernel::needed(int x, int y) const {
    const double pixels = static_cast<double>(span_inside(x, half_, width_)) * span_inside(y, half_, height_);
    // Rounded, because d is given as a decimal: n = 4 must not become a little more than 4.
    const double n = std::min(density_ * pixels, 1e12);
    return static_cast<std::int64_t>(std::llround(n * 256)) * (k_evidence / 256);
}

}  // namespace cardioid::filter
