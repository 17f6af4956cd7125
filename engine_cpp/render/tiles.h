// SPDX-License-Identifier: GPL-3.0-or-later
// How a pass is cut into batches: tiles whose pixels × samples fill one batch.
#pragma once

#include "film/film.h"

#include <vector>

namespace cardioid::render {

/// Samples a pixel in each pass: small at first, so that a picture is there at once, then 8, which keeps the samples of a
/// pixel next to each other in a batch.
std::vector<int> pass_sizes(int samples);

/// Tiles of the region for a pass with `samples` a pixel, in rows from the top of the picture.
std::vector<film::Region> tiles(const film::Region& region, int samples);

}  // namespace cardioid::render
