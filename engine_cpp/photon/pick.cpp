// SPDX-License-Identifier: GPL-3.0-or-later
#include "photon/pick.h"

#include <algorithm>
#include <cmath>

namespace cardioid::photon {

Pick::Pick(const std::vector<double>& weights) {
    double sum = 0;
    cumulative_.reserve(weights.size());
    for (const double w : weights) {
        if (w > 0 && std::isfinite(w)) sum += w;
        cumulative_.push_back(sum);
    }
    if (!(sum > 0) || !std::isfinite(sum)) {
        cumulative_.clear();
        return;
    }
    for (double& c : cumulative_) c /= sum;
    const double n = static_cast<double>(weights.size());
    first_.reserve(weights.size());
    std::uint32_t index = 0;
    for (std::size_t bucket = 0; bucket < weights.size(); ++bucket) {
        while (cumulative_[index] <= static_cast<double>(bucket) / n) ++index;
        first_.push_back(index);
    }
}

std::int32_t Pick::draw(double choice) const {
    const std::size_t bucket = static_cast<std::size_t>(choice * static_cast<double>(first_.size()));
    std::size_t index = first_[std::min(bucket, first_.size() - 1)];
    while (cumulative_[index] <= choice) ++index;
    return static_cast<std::int32_t>(index);
}

double Pick::probability(std::int32_t index) const {
    const auto i = static_cast<std::size_t>(index);
    return cumulative_[i] - (i > 0 ? cumulative_[i - 1] : 0.0);
}

std::size_t Pick::memory_bytes() const {
    return cumulative_.capacity() * sizeof(double) + first_.capacity() * sizeof(std::uint32_t);
}

}  // namespace cardioid::photon
