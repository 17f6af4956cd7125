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

/// A cubic cell of the octree over the photons' bounding cube; its photons are one run of the array.
struct PhotonCell {
    std::uint32_t children;  ///< index of the first child; those that exist follow one another in the order of octants
    std::uint32_t begin, end;  ///< its photons
    std::uint32_t octants;     ///< bit o: child o exists (bits of o: upper half in x, y, z); 0: a leaf
};

/// What queries read (photon/query.h). Photons are in the order of the octree's leaves (Morton order); positions are repeated
/// in arrays of their own, so that a query touches a photon only where it visits it.
struct PhotonMapView {
    const Photon* photons = nullptr;
    const float* x = nullptr;
    const float* y = nullptr;
    const float* z = nullptr;
    const PhotonCell* cells = nullptr;  ///< [0] is the root
    std::int64_t count = 0;
    double lower[3] = {};  ///< corner of the bounding cube
    float upper[3] = {};   ///< of the bounding box
    double scale = 0;      ///< finest cells (2⁻³² of the cube's edge) per metre; 0: all photons in one point
};

/// Photons of one pass. Queries are in photon/query.h.
class PhotonMap {
public:
    PhotonMap();
    ~PhotonMap();
    PhotonMap(PhotonMap&&) noexcept;
    PhotonMap& operator=(PhotonMap&&) noexcept;
    /// Takes the photons and sorts them into the index; positions are finite, at most 2³¹ - 1 photons. `parallel(n, body)` runs
    /// body(0) … body(n - 1), in any order and on any threads; null: on this one. The result does not depend on it. Buffers are
    /// kept for the next pass.
    using Parallel = void (*)(void* context, int n, void (*body)(void* argument, int i), void* argument);
    void build(std::vector<Photon> photons, Parallel parallel, void* context);
    const PhotonMapView& view() const;
    /// Buffers for building included.
    std::int64_t memory_bytes() const;

private:
    struct Storage;
    std::unique_ptr<Storage> storage_;
};

}  // namespace cardioid::photon
