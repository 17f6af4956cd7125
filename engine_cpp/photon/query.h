// SPDX-License-Identifier: GPL-3.0-or-later
// Range queries. Header only: the kernels of every lane width compile it.
#pragma once

#include "photon/photon.h"

namespace cardioid::photon {

/// Calls visit(index into view.photons) for every photon within `radius` of the point (closed ball), in the order of the index:
/// the same for every thread and run. Never allocates.
template <class Visit>
inline void for_each_photon(const PhotonMapView& view, const float (&center)[3], float radius, Visit&& visit) {
    for (std::int64_t i = 0; i < view.count; ++i) {
        const float* p = view.photons[i].position;
        const float x = p[0] - center[0], y = p[1] - center[1], z = p[2] - center[2];
        if (x * x + y * y + z * z <= radius * radius) visit(static_cast<std::int32_t>(i));
    }
}

}  // namespace cardioid::photon
