// SPDX-License-Identifier: GPL-3.0-or-later
// Cycles' Fast GI, Replace: after so many bounces rays see surfaces that shine within a distance and the sky beyond, times a
// factor; nothing is scattered there. Passages through glass do not count, the first glossy bounce neither.
#pragma once

#include "path/tracer.h"

namespace cardioid::CD_ISA_NS {

inline bool replaces_bounces(const scene::Settings& settings) {
    return settings.fast_gi == scene::FastGi::replace && settings.fast_gi_factor > 0;
}

/// Rays of this depth (RayState::depth, their own bounce counted) are the last, short ones.
inline Mask is_short_ray(const scene::Settings& settings, Int depth) {
    const Int glossy = select(byte_of(depth, 2) > Int(0), Int(1), Int(0));
    return byte_of(depth, 0) - byte_of(depth, 3) - glossy + Int(1) > Int(settings.fast_gi_bounces);
}

/// Visibility bits of the lobes whose ways on from a vertex of this depth are short: a world of one colour is left to them alone,
/// as in Cycles, which never samples it.
inline Int short_lobes(const scene::Settings& settings, Int depth) {
    const auto bit = [&](int byte, int visibility) {
        return select(is_short_ray(settings, depth + Int(1) + Int(1 << (8 * byte))), Int(visibility), Int(0));
    };
    const Int in_media = select(is_short_ray(settings, depth + Int(1)), Int(scene::visible_volume), Int(0));
    return in_media | bit(1, scene::visible_diffuse) | bit(2, scene::visible_glossy) |
           bit(3, scene::visible_transmission);
}

}  // namespace cardioid::CD_ISA_NS
