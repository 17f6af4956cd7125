// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/balance.h"

#include <algorithm>
#include <cmath>

namespace cardioid::render {

namespace {
constexpr double k_most = 8;
/// A pixel's squared relative difference counts up to this, or one firefly would decide.
constexpr double k_outlier = 4;
}  // namespace

BalanceMeter::BalanceMeter(const film::Region& region) : region_(region) {
    const auto n = static_cast<std::size_t>(region.width) * static_cast<std::size_t>(region.height);
    for (auto& s : sums_) s.resize(n);
}

void BalanceMeter::add(int half, int x, int y, float camera, float photons) {
    Sums& s = sums_[half][static_cast<std::size_t>(y - region_.y) * region_.width + (x - region_.x)];
    s.camera += camera;
    s.photons += photons;
}

double BalanceMeter::factor(const int (&samples)[2], double camera_cost, double photon_cost) const {
    if (!(camera_cost > 0) || !(photon_cost > 0)) return 1;
    const double a = 1.0 / samples[0], b = 1.0 / samples[1];
    double mean = 0;
    for (std::size_t i = 0; i < sums_[0].size(); ++i)
        mean += 0.5 * (a * static_cast<double>(sums_[0][i].camera + sums_[0][i].photons) +
                       b * static_cast<double>(sums_[1][i].camera + sums_[1][i].photons));
    mean /= static_cast<double>(std::max<std::size_t>(sums_[0].size(), 1));
    if (!(mean > 0) || !std::isfinite(mean)) return 1;
    double camera = 0, photons = 0;
    for (std::size_t i = 0; i < sums_[0].size(); ++i) {
        const double c0 = a * static_cast<double>(sums_[0][i].camera), c1 = b * static_cast<double>(sums_[1][i].camera);
        const double p0 = a * static_cast<double>(sums_[0][i].photons),
                     p1 = b * static_cast<double>(sums_[1][i].photons);
        // Errors count relative to the pixel, dark ones as if they had a tenth of the mean.
        const double level = 0.5 * (c0 + c1 + p0 + p1) + 0.1 * mean;
        camera += std::min((c0 - c1) * (c0 - c1) / (level * level), k_outlier);
        photons += std::min((p0 - p1) * (p0 - p1) / (level * level), k_outlier);
    }
    if (!(camera > 0)) return k_most;
    return std::clamp(std::sqrt(photons * camera_cost / (camera * photon_cost)), 1 / k_most, k_most);
}

}  // namespace cardioid::render
