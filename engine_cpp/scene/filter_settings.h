// SPDX-License-Identifier: GPL-3.0-or-later
// How noise leaves the picture (docs/filter.md). A part of Settings, and all that may change after a render.
#pragma once

#include <cstdint>

namespace cardioid::scene {

enum class FilterMethod : std::uint8_t {
    none,             ///< outlier rejection alone
    clusters,         ///< groups of clusters, likelihood ratio of counts, means within their noise: the default
    thesis,           ///< thesis 6.3.2–6.3.3 as printed where it is consistent (spec 6)
    cross_bilateral,  ///< the baseline (thesis 6.9): radiance, with texture, depth and normal buffers
};

inline constexpr int k_largest_filter = 63;

struct FilterSettings {
    bool use_filter = false;  ///< false: the picture is the raw one, bit for bit
    FilterMethod filter_method = FilterMethod::clusters;
    /// d of thesis 6.3.1: a cluster needs n = d σ² μ like samples around it. 0: nothing is rejected.
    float firefly_density = 0.0661157f;
    float luminance_sensitivity = 0.5f;  ///< μ in [0, 0.99]: luminances within this share are alike
    int filter_size = 11;                ///< σ: width of the kernel in pixels, odd, at most k_largest_filter
    bool filter_direct = true;           ///< layer 1: light that lamps send to x_d
    bool filter_indirect = true;         ///< layer 2: scattered once before x_d
    bool filter_deep = true;             ///< layer 3: the rest
    float texture_width = 0.1f;          ///< cross-bilateral only: standard deviation over the texture buffer
};

}  // namespace cardioid::scene
