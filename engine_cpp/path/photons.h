// SPDX-License-Identifier: GPL-3.0-or-later
// A batch of photons: from the lamps, over any number of bounces, stored where camera paths may gather them (spec 1, photon side).
#pragma once

#include "path/bsdf_choice.h"

namespace cardioid::CD_ISA_NS {

struct PhotonWalk : Walk {
    const path::PhotonRequest& request;
    int stored = 0;

    // photon_start.cpp
    void start();
    /// Photons that land before their light begins (light/emit.h) are gone.
    void drop_early_hits();

    // photon_scatter.cpp
    void shade(int material, const std::int32_t* rays, int n);
    void scatter(path::VertexChunk& chunk, const std::int32_t* rays);
    /// Keeps the flux that arrives at the lanes' vertices.
    void keep(Int ray, int i, Int path_class, Mask lanes);
};

}  // namespace cardioid::CD_ISA_NS
