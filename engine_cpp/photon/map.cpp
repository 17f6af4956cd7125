// SPDX-License-Identifier: GPL-3.0-or-later
#include "photon/morton.h"
#include "photon/photon.h"

#include <utility>

namespace cardioid::photon {

namespace {

/// Cells of up to so many photons are not divided (measured, docs/photon-map.md).
constexpr std::uint32_t k_leaf = 16;
constexpr int k_shares = 16;

}  // namespace

struct PhotonMap::Storage {
    std::vector<Photon> photons;
    std::vector<float> x, y, z;
    std::vector<PhotonCell> cells;
    std::vector<MortonKey> keys, scratch;
    PhotonMapView view;

    void place(const std::vector<Photon>& from, const Workers& workers);
    void divide(std::size_t cell, int level);
    void build_cells();
};

/// Photons and their positions, in the order of the keys.
void PhotonMap::Storage::place(const std::vector<Photon>& from, const Workers& workers) {
    photons.resize(from.size());
    for (auto* axis : {&x, &y, &z}) axis->resize(from.size());
    workers.run(k_shares, [&](int s) {
        const Share share(from.size(), s, k_shares);
        for (std::size_t i = share.begin; i < share.end; ++i) {
            photons[i] = from[keys[i].index];
            x[i] = photons[i].position[0];
            y[i] = photons[i].position[1];
            z[i] = photons[i].position[2];
        }
    });
}

/// Appends the cell's children, whose edge is 2^level.
void PhotonMap::Storage::divide(std::size_t cell, int level) {
    const std::uint32_t begin = cells[cell].begin, end = cells[cell].end;
    const auto octant = [&](std::uint32_t i) { return octant_of(photons[i], view, keys[i].upper, level); };
    cells[cell].children = static_cast<std::uint32_t>(cells.size());
    for (std::uint32_t at = begin; at < end;) {
        const std::uint32_t o = octant(at);
        // Gallop, then bisect: first photon of the next octant.
        std::uint32_t inside = at, outside = end;
        for (std::uint32_t step = 1; inside + step < end; step *= 2) {
            if (octant(inside + step) != o) {
                outside = inside + step;
                break;
            }
            inside += step;
        }
        while (outside - inside > 1) {
            const std::uint32_t middle = inside + (outside - inside) / 2;
            (octant(middle) == o ? inside : outside) = middle;
        }
        cells.push_back({0, at, outside, 0});
        cells[cell].octants |= 1u << o;
        at = outside;
    }
}

/// Level by level, so that the upper ones, which every query reads, are together.
void PhotonMap::Storage::build_cells() {
    cells.clear();
    cells.push_back({0, 0, static_cast<std::uint32_t>(photons.size()), 0});
    std::size_t begin = 0;
    for (int level = 31; level >= 0 && begin < cells.size(); --level) {
        const std::size_t end = cells.size();
        for (std::size_t cell = begin; cell < end; ++cell) {
            if (cells[cell].end - cells[cell].begin > k_leaf) divide(cell, level);
        }
        begin = end;
    }
}

PhotonMap::PhotonMap() : storage_(std::make_unique<Storage>()) {}
PhotonMap::~PhotonMap() = default;
PhotonMap::PhotonMap(PhotonMap&&) noexcept = default;
PhotonMap& PhotonMap::operator=(PhotonMap&&) noexcept = default;

void PhotonMap::build(std::vector<Photon> photons, Parallel parallel, void* context) {
    Storage& s = *storage_;
    const Workers workers{parallel, context};
    s.view = {};
    sort_by_morton(photons, workers, s.view, s.keys, s.scratch);
    s.place(photons, workers);
    s.build_cells();
    s.view.photons = s.photons.data();
    s.view.x = s.x.data();
    s.view.y = s.y.data();
    s.view.z = s.z.data();
    s.view.cells = s.cells.data();
    s.view.count = static_cast<std::int64_t>(s.photons.size());
}

const PhotonMapView& PhotonMap::view() const { return storage_->view; }

std::int64_t PhotonMap::memory_bytes() const {
    const Storage& s = *storage_;
    const std::size_t bytes = s.photons.capacity() * sizeof(Photon) + 3 * s.x.capacity() * sizeof(float) +
                              s.cells.capacity() * sizeof(PhotonCell) +
                              (s.keys.capacity() + s.scratch.capacity()) * sizeof(MortonKey);
    return static_cast<std::int64_t>(bytes);
}

}  // namespace cardioid::photon
