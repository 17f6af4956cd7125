// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/tiles.h"

#include <algorithm>

namespace cardioid::render {

namespace {
constexpr int k_largest_pass = 8;

film::Region tile_shape(int samples) {
    // width × height × samples = 1024, the size of a batch.
    if (samples <= 1) return {0, 0, 32, 32};
    if (samples <= 2) return {0, 0, 32, 16};
    if (samples <= 4) return {0, 0, 16, 16};
    return {0, 0, 16, 8};
}
}  // namespace

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
