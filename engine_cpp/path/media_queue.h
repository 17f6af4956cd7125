// SPDX-License-Identifier: GPL-3.0-or-later
// Media that rays are inside of, and paths that scatter in them: plain arrays in a thread's scratch.
#pragma once

#include "math/types.h"

#include <cstdint>

namespace cardioid::path {

/// Media that a ray can be in at a time, apart from the world's; more are not entered.
inline constexpr int k_media = 4;

/// Where paths scatter in media.
template <int capacity>
struct alignas(64) ScatterQueue {
    int n = 0;
    float position[3][capacity], throughput[3][capacity], length[capacity];
    float parameter[3][capacity];
    std::int32_t kind[capacity];  ///< bsdf::PhaseKind
    std::int32_t ray[capacity];   ///< index in the rays of this bounce
};

/// Phase functions of a chunk whose vertices are in media.
struct alignas(64) MediumRecord {
    std::int32_t kind[k_chunk];  ///< bsdf::PhaseKind
    Row parameter[3];
};

/// Media around the vertices of a chunk, and the one that its surface bounds.
struct alignas(64) MediaRecord {
    std::int32_t instance[k_media][k_chunk], material[k_media][k_chunk];
    std::int32_t surface_instance[k_chunk], backfacing[k_chunk];
    std::int32_t scatterings[k_chunk];  ///< in media, of the path so far
    int surface_material = -1;          ///< that has a medium; -1: light that is sent through stays in the same media
};

}  // namespace cardioid::path
