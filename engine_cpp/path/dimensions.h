// SPDX-License-Identifier: GPL-3.0-or-later
// Names of the random dimensions (pairs of numbers) of a path, from the camera or from a light.
#pragma once

#include "path/batch.h"
#include "simd/sampler.h"

namespace cardioid::CD_ISA_NS {

enum CameraPair : int { pair_pixel = 0, pair_lens = 1, pair_time = 2, pairs_before_events = 4 };
enum PhotonPair : int { pair_choice = 0, pair_emission_point = 1, pair_emission_direction = 2 };
/// Random numbers of the birth of photon `number` of a pass.
struct BirthNumbers {
    Int seed, index;  ///< for its later events, as sample_pair wants them
    Float choice;
    Vec2 point, direction;
};
inline BirthNumbers birth_numbers(std::uint32_t pass_seed, Int number) {
    const Int seed = hash(Int::of_bits(pass_seed)), index = reverse_bits(number);
    return {seed, index, sample_pair(seed, index, Int(pair_choice)).x,
            sample_pair(seed, index, Int(pair_emission_point)), sample_pair(seed, index, Int(pair_emission_direction))};
}

/// For every event of a path (bounce or transparent surface).
enum EventPair : int { pair_bsdf = 0, pair_light = 1, pair_chance = 2, pairs_per_event = 3 };

inline Int event_dimension(Int event, EventPair which) {
    return event * Int(pairs_per_event) + Int(pairs_before_events + static_cast<int>(which));
}

}  // namespace cardioid::CD_ISA_NS
