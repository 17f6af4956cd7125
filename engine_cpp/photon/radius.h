// SPDX-License-Identifier: GPL-3.0-or-later
// Radii of the gathers: by the number of the pass alone (Knaus & Zwicker 2011), or by what a pixel has found (thesis 5.2–5.5).
#pragma once

#include <cstdint>

namespace cardioid::photon {

/// r² of sample `index` (0, 1, …) over r² of sample 0: Π_{j=1}^{index} (j + alpha)/(j + 1). The cost does not grow with the
/// index. 1 for alpha 1.
double memoryless_scale(std::int64_t index, double alpha);

inline constexpr int k_photon_classes = 4;

/// Statistics of one pixel in the per-pixel schedule. Radiance is tau / (emitted so far · pi · radius²).
struct PixelStatistics {
    float n = 0;                          ///< accumulated photons, thesis N
    float radius = 0;                     ///< 0: no hit point yet
    float tau[k_photon_classes][3] = {};  ///< flux by class: D2, D3, C1, C2
};

/// Takes the photons of a pass into account (thesis 5.2–5.4): `found` photons within the radius and their flux × throughput.
/// N + M = 0 changes nothing.
void update(PixelStatistics& pixel, float found, const float (&phi)[k_photon_classes][3], float alpha);

}  // namespace cardioid::photon
