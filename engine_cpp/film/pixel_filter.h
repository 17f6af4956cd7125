// SPDX-License-Identifier: GPL-3.0-or-later
// Pixel filters by importance sampling: a sample's place in the pixel is drawn from the filter, so each sample belongs to one
// pixel and all weights are 1. Shapes and widths as in Cycles.
#pragma once

#include "scene/scene_desc.h"

#include <array>

namespace cardioid::film {

inline constexpr int k_filter_steps = 1024;

/// Offsets in pixels from the pixel's centre by quantile; one more entry than steps, for interpolation.
using FilterTable = std::array<float, k_filter_steps + 1>;

/// `width` in pixels as in Cycles' settings: Blackman-Harris ends at ±width, the Gaussian at ±1.5 width; the box is always one
/// pixel wide.
FilterTable make_filter_table(scene::PixelFilter filter, float width);

}  // namespace cardioid::film
