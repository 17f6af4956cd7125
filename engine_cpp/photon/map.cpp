// SPDX-License-Identifier: GPL-3.0-or-later
#include "photon/photon.h"

#include <utility>

namespace cardioid::photon {

struct PhotonMap::Storage {
    std::vector<Photon> photons;
    PhotonMapView view;
};

PhotonMap::PhotonMap() : storage_(std::make_unique<Storage>()) {}
PhotonMap::~PhotonMap() = default;
PhotonMap::PhotonMap(PhotonMap&&) noexcept = default;
PhotonMap& PhotonMap::operator=(PhotonMap&&) noexcept = default;

void PhotonMap::build(std::vector<Photon> photons, Parallel, void*) {
    storage_->photons = std::move(photons);
    storage_->view.photons = storage_->photons.data();
    storage_->view.count = static_cast<std::int64_t>(storage_->photons.size());
}

const PhotonMapView& PhotonMap::view() const { return storage_->view; }

std::int64_t PhotonMap::memory_bytes() const {
    return static_cast<std::int64_t>(storage_->photons.capacity() * sizeof(Photon));
}

}  // namespace cardioid::photon
