// SPDX-License-Identifier: GPL-3.0-or-later
// Names of the random dimensions (pairs of numbers) of a path, from the camera or from a light.
#pragma once

#include "path/batch.h"
#include "simd/sampler.h"

namespace cardioid::CD_ISA_NS {

enum CameraPair : int { pair_pixel = 0, pair_lens = 1, pair_time = 2, pairs_before_events = 4 };
enum PhotonPair : int { pair_choice = 0, pair_emission_point = 1, pair_emission_direction = 2 };
/// For every event of a path (bounce or transparent surface).
enum EventPair : int { pair_bsdf = 0, pair_light = 1, pair_chance = 2, pairs_per_event = 3 };

inline Int event_dimension(Int event, EventPair which) {
    return event * Int(pairs_per_event) + Int(pairs_before_events + static_cast<int>(which));
}

}  // namespace cardioid::CD_ISA_NS
