// SPDX-License-Identifier: GPL-3.0-or-later
// Importance map of the world: brightness over a latitude-longitude grid, as cumulative distributions.
#pragma once

#include "light/light_table.h"

#include <vector>

namespace cardioid::light {

struct DirectionCdf {
    std::vector<float> conditional;  ///< (width + 1) per row, from 0 to 1
    std::vector<float> marginal;     ///< height + 1, from 0 to 1
};

/// Directions of light sampling leave the even part of the brightness to rays that lobes send: MIS compensation (Karlík, Šik,
/// Vévoda, Skřivan & Křivánek 2019). Both together still see all of the light.
struct EnvironmentMap {
    int width = 0, height = 0;  ///< 0: the world is black
    DirectionCdf seen;          ///< from receivers: what is brighter than the mean (see below)
    DirectionCdf sent;          ///< photons: the brightness
    std::vector<float> row_z;   ///< height + 1: z at the borders of rows, from 1 to -1
    float irradiance = 0;       ///< mean over the sphere of the brightness, times pi
};

/// `resolution`: columns; rows are half of them. Asks `eval` for 1 to 16 directions a cell (more where it is bright).
/// `compensate`: as WorldInput's.
EnvironmentMap make_environment_map(const EnvironmentEval& eval, int resolution, bool compensate);

/// Columns that a world asks for, within what memory allows.
int environment_resolution(const WorldInput& world);

}  // namespace cardioid::light
