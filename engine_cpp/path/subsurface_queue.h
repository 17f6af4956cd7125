// SPDX-License-Identifier: GPL-3.0-or-later
// Paths that have entered a surface and leave it elsewhere: plain arrays in a thread's scratch, one entry per path.
#pragma once

#include <cstdint>

namespace cardioid::path {

/// Rows of numbers of a walk, in the order in which they are stored.
enum WalkRow : int {
    walk_position,                         ///< xyz
    walk_direction = walk_position + 3,    ///< xyz; Burley: the geometric normal where light enters
    walk_throughput = walk_direction + 3,  ///< rgb
    walk_entry = walk_throughput + 3,      ///< xyz of the start
    walk_normal = walk_entry + 3,          ///< the smooth normal there, on the side that the path came from
    walk_extinction = walk_normal + 3,     ///< rgb per scene unit; Burley: d of the profile
    walk_albedo = walk_extinction + 3,     ///< rgb: of one scattering
    walk_anisotropy = walk_albedo + 3,     ///< mean cosine
    walk_opposite,  ///< depth of the surface on the other side; negative: not known, then -(least distance of the first ray)
    walk_rows
};

/// capacity: a path enters at most once in a bounce.
template <int capacity>
struct alignas(64) SubsurfaceQueue {
    int n = 0;
    float row[walk_rows][capacity];
    std::int32_t ray[capacity];       ///< index in the rays of this bounce
    std::int32_t instance[capacity];  ///< that alone is met inside
    std::int32_t kind[capacity];      ///< WalkKind bits
};
enum WalkKind : std::int32_t {
    walk_burley = 1,        ///< no walk: a point is chosen on a disk
    walk_fresnel_exit = 2,  ///< leaves through Principled v1's Fresnel
    walk_backfacing = 4,    ///< entered from the inside of the mesh
};

/// Where walks came out.
template <int capacity>
struct alignas(64) SubsurfaceExits {
    int n = 0;
    float position[3][capacity], normal_geometric[3][capacity], normal[3][capacity];  ///< on the outer side
    float throughput[3][capacity], u[capacity], v[capacity];
    std::int32_t ray[capacity], instance[capacity], triangle[capacity], kind[capacity];
};

}  // namespace cardioid::path
