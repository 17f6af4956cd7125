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
    int radius = 5;                           ///< the kernel is 2 · radius + 1 pixels wide
    bool layers[film::k_layers] = {};         ///< which are filtered; the others stay as they are
    float inverse_two_spread_squared = 0;     ///< 1/(2 s²) of the Gaussian over the distance in pixels
    float inverse_texture_width_squared = 0;  ///< cross-bilateral only
    float* scratch = nullptr;                 ///< scratch_floats() of them
    float* result[film::k_layers][3] = {};    ///< filtered radiance, area.width × area.height
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
