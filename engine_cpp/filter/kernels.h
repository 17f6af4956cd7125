// SPDX-License-Identifier: GPL-3.0-or-later
// What a tile's kernels are told and give; they are compiled for each lane width.
#pragma once

#include "filter/tile.h"
#include "scene/filter_settings.h"

#include <vector>

namespace cardioid::filter {

/// Pixels of the patch around a pixel whose means are compared, to each side.
inline constexpr int k_patch = 2;

struct KernelRequest {
    const Tile* tile = nullptr;
    int radius = 5;  ///< the kernel has 2 · radius + 1 taps to a side …
    int step = 1;    ///< … and this many pixels from tap to tap (1 but in the default's second pass)
    bool layers[film::k_layers] = {};         ///< which are filtered; the others stay as they are
    float inverse_two_spread_squared = 0;     ///< 1/(2 s²) of the Gaussian over the distance in pixels
    float inverse_texture_width_squared = 0;  ///< cross-bilateral only
    float* scratch = nullptr;                 ///< scratch_floats() of them
    /// Pixel (0, 0) of the tile in planes with rows of `stride`: filtered radiance; and what only the default gives.
    float* result[film::k_layers][3] = {};
    float* variance[film::k_layers][3] = {};
    float* detail[3] = {};
    int stride = 0;
};

using FilterTile = void (*)(const KernelRequest&);

/// Floats that a kernel needs for a tile.
std::size_t scratch_floats(const Tile& tile);

/// Averages light over pixels whose patches agree within their noise.
FilterTile select_filter_similar(int lanes);

/// Gaussian over the distance × normal × depth, for each pixel of the kernel: (2 · radius + 1)² planes of area.width ×
/// area.height, rows of dy first.
using GeometryWeights = void (*)(const KernelRequest&, float* weights);
GeometryWeights select_geometry_weights(int lanes);

}  // namespace cardioid::filter
