// SPDX-License-Identifier: GPL-3.0-or-later
#include "photon/guide.h"

#include <algorithm>

namespace cardioid::photon {

struct PhotonGuide::Storage {
    std::vector<double> cumulative;
};

PhotonGuide::PhotonGuide(std::vector<float> power) : storage_(std::make_unique<Storage>()) {
    double sum = 0;
    for (const float p : power) storage_->cumulative.push_back(sum += static_cast<double>(p));
}
PhotonGuide::~PhotonGuide() = default;
PhotonGuide::PhotonGuide(PhotonGuide&&) noexcept = default;
PhotonGuide& PhotonGuide::operator=(PhotonGuide&&) noexcept = default;

bool PhotonGuide::empty() const { return storage_->cumulative.empty() || storage_->cumulative.back() <= 0; }

Emission PhotonGuide::draw(float choice, const float (&u)[k_cube]) const {
    const auto& c = storage_->cumulative;
    const auto at = std::upper_bound(c.begin(), c.end(), static_cast<double>(choice) * c.back());
    Emission e;
    e.emitter = static_cast<std::int32_t>(std::min(at - c.begin(), std::ptrdiff_t(c.size()) - 1));
    std::copy(std::begin(u), std::end(u), e.u);
    e.density = density(e.emitter, u);
    return e;
}

float PhotonGuide::density(std::int32_t emitter, const float (&)[k_cube]) const {
    const auto& c = storage_->cumulative;
    const double before = emitter > 0 ? c[static_cast<std::size_t>(emitter) - 1] : 0;
    return static_cast<float>((c[static_cast<std::size_t>(emitter)] - before) / c.back());
}

void PhotonGuide::learn(const std::vector<Lesson>&) {}
float PhotonGuide::gain(std::int32_t) const { return 1; }
std::int64_t PhotonGuide::memory_bytes() const {
    return static_cast<std::int64_t>(storage_->cumulative.size() * sizeof(double));
}

}  // namespace cardioid::photon
