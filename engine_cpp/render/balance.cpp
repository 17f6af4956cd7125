// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/balance.h"

#include <algorithm>
#include <cmath>

namespace cardioid::render {

namespace {

constexpr double k_least = 0.25, k_most = 8;
/// A pixel's squared relative difference counts up to this, or one firefly would decide.
constexpr double k_outlier = 4;
/// Samples of the training passes.
constexpr double k_samples[k_training_passes] = {1, 1, 2, 4};
/// Stratified camera paths converge faster than random ones; the gain seen from 1 to 3 samples is carried on to this many.
constexpr double k_horizon = 64;

/// Variance of one sample at the horizon, from the differences of passes 0, 1 and of passes 2, 3.
double effective_variance(double early, double late) {
    const double one = early / (1 / k_samples[0] + 1 / k_samples[1]);
    const double three = late / (1 / k_samples[2] + 1 / k_samples[3]);
    if (!(one > 0)) return three;
    const double gain = std::clamp(three / one, 0.3, 1.0);
    return one * std::pow(gain, std::log(k_horizon) / std::log(3.0));
}

}  // namespace

BalanceMeter::BalanceMeter(const film::Region& region) : region_(region) {
    const auto n = static_cast<std::size_t>(region.width) * static_cast<std::size_t>(region.height);
    for (auto& s : sums_) s.resize(n);
}

void BalanceMeter::add(int pass, int x, int y, float camera, float photons) {
    Sums& s = sums_[pass][static_cast<std::size_t>(y - region_.y) * region_.width + (x - region_.x)];
    const auto weight = static_cast<float>(1 / k_samples[pass]);
    s.camera += weight * camera;
    s.photons += weight * photons;
}

void BalanceMeter::differences(int first, double level_floor, double& camera, double& photons) const {
    camera = photons = 0;
    for (std::size_t i = 0; i < sums_[0].size(); ++i) {
        double level = level_floor;
        for (int p = 0; p < k_training_passes; ++p)
            level += static_cast<double>(sums_[p][i].camera + sums_[p][i].photons) / k_training_passes;
        const Sums &a = sums_[first][i], &b = sums_[first + 1][i];
        const double c = static_cast<double>(a.camera - b.camera) / level;
        const double p = static_cast<double>(a.photons - b.photons) / level;
        camera += std::min(c * c, k_outlier);
        photons += std::min(p * p, k_outlier);
    }
}

double BalanceMeter::factor(double camera_cost, double photon_cost) const {
    if (!(camera_cost > 0) || !(photon_cost > 0)) return 1;
    double mean = 0;
    for (const auto& pass : sums_) {
        for (const Sums& s : pass) mean += static_cast<double>(s.camera + s.photons);
    }
    mean /= k_training_passes * static_cast<double>(std::max<std::size_t>(sums_[0].size(), 1));
    if (!(mean > 0) || !std::isfinite(mean)) return 1;
    // Errors count relative to the pixel, dark ones as if they had a tenth of the mean more.
    double camera[2], photons[2];
    for (int half = 0; half < 2; ++half) differences(2 * half, 0.1 * mean, camera[half], photons[half]);
    const double v_camera = effective_variance(camera[0], camera[1]);
    const double v_photons = photons[1] / (1 / k_samples[2] + 1 / k_samples[3]);
    if (!(v_camera > 0)) return k_most;
    return std::clamp(std::sqrt(v_photons * camera_cost / (v_camera * photon_cost)), k_least, k_most);
}

}  // namespace cardioid::render
