// SPDX-License-Identifier: GPL-3.0-or-later
// Photons of the map, one per lane.
#pragma once

#include "photon/photon.h"
#include "trace/surface.h"

namespace cardioid::CD_ISA_NS {

struct PhotonLanes {
    Vec3 wp;      ///< unit, toward where the photon came from
    Vec3 normal;  ///< geometric, where it landed
    Spectrum flux;
    Float density;
    Int depth, path_class, visibility;  ///< visibility: scene::Visibility bits of what it came from
    Int in_media;                       ///< scatterings in media
};

/// Photon::path_class also holds what the photon's last segment is visible to, and how often it was scattered in media.
inline constexpr int k_photon_visibility_shift = 8, k_photon_media_shift = 16;

inline PhotonLanes photon_lanes(const photon::Photon* photons, Int index) {
    const float* base = reinterpret_cast<const float*>(photons);
    const auto* numbers = reinterpret_cast<const std::int32_t*>(photons);
    const Int at = index * Int(static_cast<std::int32_t>(sizeof(photon::Photon) / sizeof(float)));
    PhotonLanes q;
    q.flux = {gather(base + 3, at), gather(base + 4, at), gather(base + 5, at)};
    q.wp = normalize(unpack_normal(gather(numbers + 6, at)));
    q.normal = normalize(unpack_normal(gather(numbers + 7, at)));
    q.depth = gather(numbers + 8, at);
    q.density = gather(base + 9, at);
    const Int packed = gather(numbers + 11, at);
    q.path_class = packed & Int((1 << k_photon_visibility_shift) - 1);
    q.visibility = (packed >> k_photon_visibility_shift) & Int(0xff);
    q.in_media = packed >> k_photon_media_shift;
    return q;
}

}  // namespace cardioid::CD_ISA_NS
