// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/tiles.h"

#include "path/batch.h"

#include <algorithm>
#include <utility>

namespace cardioid::render {

namespace {
constexpr int k_widest = 64;

film::Region tile_shape(int samples) {
    // width × height × samples = 1024, the size of a batch.
    if (samples <= 1) return {0, 0, 32, 32};
    if (samples <= 2) return {0, 0, 32, 16};
    if (samples <= 4) return {0, 0, 16, 16};
    return {0, 0, 16, 8};
}

class ActiveTiles {
public:
    ActiveTiles(const film::Region& region, int samples, const std::vector<std::uint8_t>& active)
        : region_(region), samples_(samples), active_(active) {}

    /// `shape` may reach over the region's edge, so that halves of it are always multiples of 8.
    void add(const film::Region& shape) {
        const film::Region inside = clipped(shape);
        if (inside.width <= 0 || inside.height <= 0) return;
        const int n = count(inside);
        if (n == 0) return;
        if (n * samples_ <= path::k_batch) {
            list_.push_back(inside);
            return;
        }
        film::Region first = shape, second = shape;
        if (shape.width > shape.height) {
            first.width = second.width = shape.width / 2;
            second.x += first.width;
        } else {
            first.height = second.height = shape.height / 2;
            first.y += first.height;
        }
        add(first);
        add(second);
    }
    std::vector<film::Region> take() { return std::move(list_); }

private:
    film::Region clipped(const film::Region& r) const {
        return {r.x, r.y, std::min(r.width, region_.x + region_.width - r.x),
                std::min(r.height, region_.y + region_.height - r.y)};
    }
    int count(const film::Region& r) const {
        int n = 0;
        for (int y = r.y - region_.y; y < r.y - region_.y + r.height; ++y) {
            const auto row = active_.begin() + static_cast<std::ptrdiff_t>(y) * region_.width + (r.x - region_.x);
            n += static_cast<int>(std::count(row, row + r.width, std::uint8_t{1}));
        }
        return n;
    }

    const film::Region& region_;
    int samples_;
    const std::vector<std::uint8_t>& active_;
    std::vector<film::Region> list_;
};
}  // namespace

std::vector<film::Region> active_tiles(const film::Region& region, int samples,
                                       const std::vector<std::uint8_t>& active) {
    ActiveTiles tiles(region, samples, active);
    const int rows = (region.height + k_widest - 1) / k_widest;
    for (int row = rows - 1; row >= 0; --row) {
        for (int x = region.x; x < region.x + region.width; x += k_widest)
            tiles.add({x, region.y + row * k_widest, k_widest, k_widest});
    }
    return tiles.take();
}

std::vector<film::Region> tiles(const film::Region& region, int samples) {
    const film::Region shape = tile_shape(samples);
    std::vector<film::Region> list;
    const int rows = (region.height + shape.height - 1) / shape.height;
    for (int row = rows - 1; row >= 0; --row) {
        const int y = region.y + row * shape.height;
        for (int x = region.x; x < region.x + region.width; x += shape.width) {
            list.push_back({x, y, std::min(shape.width, region.x + region.width - x),
                            std::min(shape.height, region.y + region.height - y)});
        }
    }
    return list;
}

}  // namespace cardioid::render
