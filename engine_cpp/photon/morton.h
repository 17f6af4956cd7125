// SPDX-License-Identifier: GPL-3.0-or-later
// Photons in Morton order: coordinates of 32 bits, the upper 21 of each interleaved in one sorting key, the lower 11 in another
// that only photons of equal upper keys look at.
#pragma once

#include "photon/photon.h"

#include <cstdint>
#include <vector>

namespace cardioid::photon {

/// Runs body(0) … body(n - 1) as PhotonMap::build was told to.
struct Workers {
    PhotonMap::Parallel parallel = nullptr;
    void* context = nullptr;
    template <class Body>
    void run(int n, const Body& body) const {
        const auto call = [](void* argument, int i) { (*static_cast<const Body*>(argument))(i); };
        void* argument = const_cast<void*>(static_cast<const void*>(&body));
        if (parallel) return parallel(context, n, call, argument);
        for (int i = 0; i < n; ++i) body(i);
    }
};

/// Share `i` of `n` of `count` things.
struct Share {
    std::size_t begin, end;
    Share(std::size_t count, int i, int n)
        : begin(count * static_cast<std::size_t>(i) / static_cast<std::size_t>(n)),
          end(count * static_cast<std::size_t>(i + 1) / static_cast<std::size_t>(n)) {}
};

struct MortonKey {
    std::uint64_t upper;  ///< 63 bits
    std::uint32_t index;  ///< of the photon
};

/// Which octant of its cell with edge 2^(level + 1) the photon is in. `upper`: its key.
std::uint32_t octant_of(const Photon& photon, const PhotonMapView& view, std::uint64_t upper, int level);

/// Fills `keys` in Morton order; equal places stay in the order of the photons. Sets the view's cube. `scratch` is overwritten.
void sort_by_morton(const std::vector<Photon>& photons, const Workers& workers, PhotonMapView& view,
                    std::vector<MortonKey>& keys, std::vector<MortonKey>& scratch);

}  // namespace cardioid::photon
