// SPDX-License-Identifier: GPL-3.0-or-later
#include "photon/radius.h"

#include <cmath>

namespace cardioid::photon {

double memoryless_scale(std::int64_t index, double alpha) {
    if (index <= 0) return 1;
    const auto n = static_cast<double>(index);
    return std::exp(std::lgamma(n + 1 + alpha) - std::lgamma(1 + alpha) - std::lgamma(n + 2));
}

void update(PixelStatistics& pixel, float found, const float (&phi)[k_photon_classes][3], float alpha) {
    const float before = pixel.n + found;
    if (before <= 0) return;
    const float after = pixel.n + alpha * found;
    const float ratio = after / before;
    pixel.radius *= std::sqrt(ratio);
    pixel.n = after;
    for (int c = 0; c < k_photon_classes; ++c) {
        for (int k = 0; k < 3; ++k) pixel.tau[c][k] = (pixel.tau[c][k] + phi[c][k]) * ratio;
    }
}

}  // namespace cardioid::photon
