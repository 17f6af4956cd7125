// SPDX-License-Identifier: GPL-3.0-or-later
#include "photon/radius.h"

#include <algorithm>
#include <cmath>

namespace cardioid::photon {

namespace {

/// Γ(n + 1 + alpha)/Γ(n + 2) (Tricomi & Erdélyi 1951); relative error below 1e-9 from n = 64 on. A difference of log-gammas
/// would lose digits as n grows.
double gamma_ratio(double n, double alpha) {
    const double w = n + 1 + 0.5 * alpha, d = alpha - 1;
    return std::pow(w, d) * (1 - (d - 1) * d * (d + 1) / (24 * w * w));
}

}  // namespace

double memoryless_scale(std::int64_t index, double alpha) {
    constexpr std::int64_t k_product = 64;
    double scale = 1;
    for (std::int64_t j = 1; j <= std::min(index, k_product); ++j) {
        scale *= (static_cast<double>(j) + alpha) / (static_cast<double>(j) + 1);
    }
    if (index <= k_product) return scale;
    return scale * gamma_ratio(static_cast<double>(index), alpha) / gamma_ratio(static_cast<double>(k_product), alpha);
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
