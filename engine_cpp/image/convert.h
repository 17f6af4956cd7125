// SPDX-License-Identifier: GPL-3.0-or-later
// Rows as a source delivers them → tiles as the sampler reads them.
#pragma once

#include "image/color.h"
#include "image/source.h"
#include "image/tile_cache.h"

namespace cardioid::image {

struct Conversion {
    SourceInfo source;
    ColorSpace space;
    bool ignore_alpha = false;  ///< alpha becomes 1
    bool multiply =
        false;  ///< colours are multiplied by alpha in the file's own numbers, which truncates, as in Cycles
    bool associated =
        false;  ///< colours arrive multiplied by alpha: divided for the conversion of colours, then multiplied
};

/// How texels are kept: as they come, or as scene-linear halves (floats from floats) if colours must be converted.
void choose_format(Texture& texture, const Conversion& conversion);

/// Texels of the rectangle whose first delivered row is its top. `stride`: texels from one delivered row to the next.
/// Fills the tile from its bottom left. Non-finite texels become 0; returns how many.
std::size_t fill_tile(std::byte* tile, const Texture& texture, const Conversion& conversion, const std::byte* texels,
                      std::size_t stride, int width, int height);

}  // namespace cardioid::image
