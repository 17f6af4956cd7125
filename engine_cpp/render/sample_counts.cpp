// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/sample_counts.h"

namespace cardioid::render {

namespace {
constexpr const char* k_name = "Debug Sample Count";
}

void add_sample_counts(film::Frame& frame) {
    const std::size_t pixels = static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
    frame.passes.push_back({k_name, 1, std::vector<float>(pixels, 0.0f)});
}

void show_sample_counts(const film::Film& film, const film::Region& part, film::Frame& frame) {
    film::Pass& last = frame.passes.back();
    if (last.name != k_name) return;
    const film::Region region = film.region();
    for (int y = part.y - region.y; y < part.y - region.y + part.height; ++y) {
        float* row = &last.data[static_cast<std::size_t>(y) * region.width];
        for (int x = part.x - region.x; x < part.x - region.x + part.width; ++x)
            row[x] = static_cast<float>(film.samples(x, y));
    }
}

}  // namespace cardioid::render
