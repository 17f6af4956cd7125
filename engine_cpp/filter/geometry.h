// SPDX-License-Identifier: GPL-3.0-or-later
// What all methods share over lanes: weights by geometry at x_d, and how results are stored.
#pragma once

#include "filter/kernels.h"
#include "simd/elementary.h"

namespace cardioid::CD_ISA_NS {

/// Normals that differ by this much (length of the difference) weigh 1/e.
inline constexpr float k_normal_width = 0.3f;
/// Depths are alike within this share of them, whatever the slope.
inline constexpr float k_depth_share = 1e-3f;

/// The lanes of a row that lie in the tile (`left` of them and of what follows): rows of results have no padding.
inline void store_row(float* to, Float value, int left) {
    for (int k = 0; k < W && k < left; ++k) to[k] = value[k];
}

/// Squared distance of two feature values, less what the spread of pixel p's own samples explains (pixels at edges hold both
/// sides, so that they may take from both), over that spread and the tolerance (after Rousselle et al. 2013).
inline Float feature_distance(Float squared, Float variance, Float tolerance_squared) {
    return max(squared - variance, 0.0f) / max(tolerance_squared + variance, 1e-30f);
}

/// Exponent (≥ 0) of the weight between W pixels from index p on and those from q on, (dx, dy) pixels away.
inline Float geometry_distance(const filter::Tile& t, int p, int q, int dx, int dy) {
    Float turned = 0.0f;
    for (const float* n : {t.normal[0], t.normal[1], t.normal[2]}) {
        const Float d = load(n + p) - load(n + q);
        turned = fma(d, d, turned);
    }
    const Float here = load(t.depth + p), away = load(t.depth + q) - here;
    const Float slope = load(t.gradient[0] + p) * Float(static_cast<float>(dx < 0 ? -dx : dx)) +
                        load(t.gradient[1] + p) * Float(static_cast<float>(dy < 0 ? -dy : dy));
    const Float tolerance = slope + abs(here) * k_depth_share;
    return feature_distance(turned, load(t.normal_variance + p), k_normal_width * k_normal_width) +
           feature_distance(away * away, load(t.depth_variance + p), tolerance * tolerance);
}

}  // namespace cardioid::CD_ISA_NS
