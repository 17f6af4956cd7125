// SPDX-License-Identifier: GPL-3.0-or-later
// How a pass is cut into batches: tiles whose pixels × samples fill one batch.
#pragma once

#include "film/film.h"

#include <vector>

namespace cardioid::render {

/// Tiles of the region for a pass with `samples` a pixel, in rows from the top of the picture.
std::vector<film::Region> tiles(const film::Region& region, int samples);

}  // namespace cardioid::render
