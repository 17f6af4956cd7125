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
/// Camera paths must have found the photons' light but for this share before photons are given up.
constexpr double k_agreement = 0.05;

/// Blur is no variance, and later samples are better stratified: photons must promise more than this to be kept.
constexpr double k_doubt = 1.5;

/// Variance of one sample at the horizon, from the differences of passes 0, 1 and of passes 2, 3.
double effective_variance(double early, double late) {
    const double one = early / (1 / k_samples[0] + 1 / k_samples[1]);
    const double three = late / (1 / k_samples[2] + 1 / k_samples[3]);
    if (!(one > 0)) return three;
    const double gain = std::clamp(three / one, 0.3, 1.0);
    return one * std::pow(gain, std::log(k_horizon) / std::log(3.0));
}

double squared(double x) { return x * x; }

}  // namespace

BalanceMeter::BalanceMeter(const film::Region& region) : region_(region) {
    const auto n = static_cast<std::size_t>(region.width) * static_cast<std::size_t>(region.height);
    for (auto& s : sums_) s.resize(n);
}

void BalanceMeter::add(int pass, int x, int y, const Halves& path) {
    Halves& s = sums_[pass][static_cast<std::size_t>(y - region_.y) * region_.width + (x - region_.x)];
    const auto weight = static_cast<float>(1 / k_samples[pass]);
    s.camera += weight * path.camera;
    s.photons += weight * path.photons;
    s.hits += weight * path.hits;
}

BalanceMeter::Variances BalanceMeter::differences(int first, double level_floor) const {
    Variances v;
    for (std::size_t i = 0; i < sums_[0].size(); ++i) {
        double level = level_floor;
        for (const auto& pass : sums_)
            level += static_cast<double>(pass[i].camera + pass[i].photons) / k_training_passes;
        const Halves &a = sums_[first][i], &b = sums_[first + 1][i];
        v.camera += std::min(squared(static_cast<double>(a.camera - b.camera) / level), k_outlier);
        v.photons += std::min(squared(static_cast<double>(a.photons - b.photons) / level), k_outlier);
        // Fireflies are what photons are for: they count in full.
        v.hits += squared(static_cast<double>(a.hits - b.hits) / level);
    }
    return v;
}

double BalanceMeter::mean(float Halves::*part) const {
    double sum = 0;
    for (const auto& pass : sums_) {
        for (const Halves& s : pass) sum += static_cast<double>(s.*part);
    }
    return sum / (k_training_passes * static_cast<double>(std::max<std::size_t>(sums_[0].size(), 1)));
}

bool BalanceMeter::hits_find_everything() const {
    const double hits = mean(&Halves::hits), photons = mean(&Halves::photons);
    return std::fabs(hits - photons) <= k_agreement * photons;
}

double BalanceMeter::factor(double camera_cost, double gather_cost, double photon_cost) const {
    if (!(camera_cost > 0) || !(photon_cost > 0)) return 1;
    const double level = mean(&Halves::camera) + mean(&Halves::photons);
    if (!(level > 0) || !std::isfinite(level)) return 1;
    // Errors count relative to the pixel, dark ones as if they had a tenth of the mean more.
    const Variances early = differences(0, 0.1 * level), late = differences(2, 0.1 * level);
    const double v_camera = effective_variance(early.camera, late.camera);
    const double v_photons = late.photons / (1 / k_samples[2] + 1 / k_samples[3]);
    const double v_hits = effective_variance(early.hits, late.hits);
    if (!(v_camera > 0)) return k_most;
    const double fixed = camera_cost + gather_cost;
    const double f = std::clamp(std::sqrt(v_photons * fixed / (v_camera * photon_cost)), k_least, k_most);
    const double with_photons = (v_camera + v_photons / f) * (fixed + f * photon_cost);
    if (hits_find_everything() && (v_camera + v_hits) * camera_cost < k_doubt * with_photons) return 0;
    return f;
}

}  // namespace cardioid::render
