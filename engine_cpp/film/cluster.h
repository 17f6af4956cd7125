// SPDX-License-Identifier: GPL-3.0-or-later
// Clusters of incident light (thesis 6.2.1, spec 4).
#pragma once

#include <cstdint>

namespace cardioid::film {

/// Layers of incident light by how often it was scattered before x_d, the first surface that a path meets with a D
/// lobe.
inline constexpr int k_layers = 3;  ///< 0: straight from a lamp, 1: scattered once, 2: more often
inline constexpr int k_max_clusters = 8;

/// Luminances beyond this count as this where they are squared: sums of 2^24 such squares stay finite.
inline constexpr float k_largest_squared = 1e15f;

/// What one camera path brings to a layer.
struct LayerSample {
    float radiance[3] = {};  ///< R: added to the pixel
    float incident[3] = {};  ///< I: arriving at x_d, times its cosine; without the BSDF of x_d and what is before it
};

/// Samples of one pixel and layer whose luminance Y(I) is alike; lists ascend in it and are disjoint.
struct Cluster {
    float radiance[3] = {};      ///< ΣR
    float incident = 0;          ///< ΣY(I)
    float radiance_squared = 0;  ///< ΣY(R)²: the filter weighs means of R by their variance
    float min = 0, max = 0;      ///< of Y(I); both > 0
    std::uint32_t samples = 0;   ///< N
};
static_assert(sizeof(Cluster) == 32);

/// Rec.709, as simd's luminance() over lanes.
constexpr float luminance(const float (&c)[3]) { return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2]; }

}  // namespace cardioid::film
