// SPDX-License-Identifier: GPL-3.0-or-later
// A batch of photons: from the lamps, over any number of bounces, stored where camera paths may gather them (spec 1, photon side).
#pragma once

#include "path/bsdf_choice.h"

namespace cardioid::CD_ISA_NS {

/// path::step over lanes, from the light.
inline Int step_photon(Int state, Mask specular) {
    Int after = state;
    for (int s = 0; s < path::k_photon_states; ++s) {
        const auto from = static_cast<path::PhotonState>(s);
        const Int on = select(specular, Int(static_cast<int>(path::step(from, true))),
                              Int(static_cast<int>(path::step(from, false))));
        after = select(state == Int(s), on, after);
    }
    return after;
}

/// Lanes that may still be stored as one of the classes.
inline Mask may_be_stored(Int state, path::ClassSet classes) {
    Mask m = mask_of(false);
    for (int s = 0; s < path::k_photon_states; ++s) {
        if ((path::reachable(static_cast<path::PhotonState>(s)) & classes) != 0) m |= state == Int(s);
    }
    return m;
}

struct PhotonRay;

struct PhotonWalk : Walk {
    const path::PhotonRequest& request;
    int stored = 0;
    int surface_medium = -1;  ///< material of the chunk at hand, if it has a medium

    // photon_start.cpp
    void start();
    /// Photons that land before their light begins (light/emit.h) are gone.
    void drop_early_hits();

    // photon_scatter.cpp
    void shade(int material, const std::int32_t* rays, int n);
    void scatter(path::VertexChunk& chunk, const std::int32_t* rays);
    /// Nothing arrives from infinitely far through a world that has a medium.
    void stop_infinite(Spectrum& flux, const PhotonRay& r, Mask lanes);

    // photon_media.cpp
    void cross_media();
    void scatter_in_media();
    void send_on_from_medium(int i, Mask lanes);

    /// Keeps the flux that arrives at the lanes' vertices.
    void keep(Int ray, int i, Int path_class, Mask lanes);
};

}  // namespace cardioid::CD_ISA_NS
