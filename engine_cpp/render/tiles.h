// SPDX-License-Identifier: GPL-3.0-or-later
// How a pass is cut into batches: tiles whose pixels × samples fill one batch.
#pragma once

#include "film/film.h"

#include <cstdint>
#include <vector>

namespace cardioid::render {

/// Tiles of the region for a pass with `samples` a pixel, in rows from the top of the picture.
std::vector<film::Region> tiles(const film::Region& region, int samples);

/// The same where only some pixels go on (`active` by rows from the region's corner): rectangles of at most 64 × 64 pixels, larger
/// where few are active, that hold every active pixel once. Corners are multiples of 8 from the region's.
std::vector<film::Region> active_tiles(const film::Region& region, int samples,
                                       const std::vector<std::uint8_t>& active);

}  // namespace cardioid::render
