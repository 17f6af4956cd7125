// SPDX-License-Identifier: GPL-3.0-or-later
// The baseline (thesis 6.9): each layer's radiance averaged where texture, depth and normal are alike. It knows nothing of the
// light, so it blurs shadow edges, and textures finer than its width over D̂ leave it few pixels to average.
#pragma once

#include "filter/kernels.h"

namespace cardioid::filter {

/// Needs no scratch. Weights: Gaussians over the distance in pixels and over D̂, with geometry's. Kept radiance per sample taken.
FilterTile select_filter_cross_bilateral(int lanes);

}  // namespace cardioid::filter
