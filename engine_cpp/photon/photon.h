// SPDX-License-Identifier: GPL-3.0-or-later
// A photon where it landed, and the photons of one pass with their spatial index. Written once, then read-only.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace cardioid::photon {

/// 48 bytes. Units: metres, watts.
struct Photon {
    float position[3];
    float flux[3];             ///< W that arrives, for one photon of the pass
    std::uint32_t direction;   ///< unit, toward where it came from; octahedral, trace/octahedral.h
    std::uint32_t normal;      ///< geometric, on the side that it arrived on; octahedral
    std::uint32_t depth;       ///< bounces before it landed: total | diffuse << 8 | glossy << 16 | transmission << 24
    float density;             ///< of its emission, for MIS (path/gather.cpp); the emitter's choice included
    std::uint32_t source;      ///< number of the emission in its pass
    std::uint32_t path_class;  ///< path::PathClass
};
static_assert(sizeof(Photon) == 48);

/// What queries read; see index.h.
struct PhotonMapView {
    const Photon* photons = nullptr;  ///< in the order of the index
    std::int64_t count = 0;
    /// The index: see index.h.
    const void* index = nullptr;
};

/// Photons of one pass. Queries are in photon/query.h.
class PhotonMap {
public:
    PhotonMap();
    ~PhotonMap();
    PhotonMap(PhotonMap&&) noexcept;
    PhotonMap& operator=(PhotonMap&&) noexcept;
    /// Takes the photons and sorts them into the index. `parallel(n, body)` runs body(0) … body(n - 1), in any order and on any
    /// threads; the result does not depend on it.
    using Parallel = void (*)(void* context, int n, void (*body)(void* argument, int i), void* argument);
    void build(std::vector<Photon> photons, Parallel parallel, void* context);
    const PhotonMapView& view() const;
    std::int64_t memory_bytes() const;

private:
    struct Storage;
    std::unique_ptr<Storage> storage_;
};

}  // namespace cardioid::photon
