// SPDX-License-Identifier: GPL-3.0-or-later
// Range queries. Header only: the kernels of every lane width compile it. Nothing in it is shared between them by the linker.
#pragma once

#include "photon/photon.h"

namespace cardioid::photon {

namespace detail {

/// Coordinate in finest cells. Monotone: what is between two points is between their coordinates, whatever the rounding.
[[gnu::always_inline]] inline std::uint32_t to_cells(double offset, double scale) {
    const double v = offset * scale;
    return v > 0 ? (v < 4294967295.0 ? static_cast<std::uint32_t>(v) : 4294967295u) : 0u;
}

/// Octants of the cell at `corner` that the box of cells [low, high] overlaps; `half` is the edge of an octant.
[[gnu::always_inline]] inline std::uint32_t overlapped(const std::uint32_t (&corner)[3], std::uint32_t half,
                                                       const std::uint32_t (&low)[3], const std::uint32_t (&high)[3]) {
    const std::uint32_t x = corner[0] + half, y = corner[1] + half, z = corner[2] + half;
    const std::uint32_t in_x = (low[0] < x ? 0x55u : 0u) | (high[0] >= x ? 0xaau : 0u);
    const std::uint32_t in_y = (low[1] < y ? 0x33u : 0u) | (high[1] >= y ? 0xccu : 0u);
    const std::uint32_t in_z = (low[2] < z ? 0x0fu : 0u) | (high[2] >= z ? 0xf0u : 0u);
    return in_x & in_y & in_z;
}

}  // namespace detail

/// Calls visit(begin, end) for runs of view.photons, in ascending order, that together hold every photon within `radius` of the
/// point (and others). Never allocates. A negative radius finds nothing.
template <class Visit>
inline void for_each_run(const PhotonMapView& view, const float (&center)[3], float radius, Visit&& visit) {
    if (view.count == 0 || !(radius >= 0)) return;
    // The slack covers the rounding of the distance in float.
    const double reach = static_cast<double>(radius) * 1.000001;
    std::uint32_t low[3], high[3], widest = 0;
    for (int k = 0; k < 3; ++k) {
        const double lower = static_cast<double>(center[k]) - reach, upper = static_cast<double>(center[k]) + reach;
        if (lower > static_cast<double>(view.upper[k]) || upper < view.lower[k]) return;
        low[k] = detail::to_cells(lower - view.lower[k], view.scale);
        high[k] = detail::to_cells(upper - view.lower[k], view.scale);
        widest = high[k] - low[k] > widest ? high[k] - low[k] : widest;
    }
    // Cells of half of the box or less are not worth opening: their photons are tested in one run.
    const int smallest = widest >= 2 ? 30 - __builtin_clz(widest) : -1;

    std::uint32_t corner[3] = {};
    std::uint32_t open[32], parent[32];  // by the logarithm of the children's edge
    std::uint32_t at = 0;
    int level = 32;
    for (;;) {
        const PhotonCell& cell = view.cells[at];
        if (cell.octants == 0 || level <= smallest) {
            visit(cell.begin, cell.end);
        } else {
            --level;
            parent[level] = at;
            open[level] = cell.octants & detail::overlapped(corner, 1u << level, low, high);
        }
        while (level < 32 && open[level] == 0) ++level;
        if (level == 32) return;
        const auto octant = static_cast<std::uint32_t>(__builtin_ctz(open[level]));
        open[level] &= open[level] - 1;
        const PhotonCell& from = view.cells[parent[level]];
        at = from.children + static_cast<std::uint32_t>(__builtin_popcount(from.octants & ((1u << octant) - 1)));
        const std::uint32_t kept = ~((2u << level) - 1);
        for (std::uint32_t k = 0; k < 3; ++k) corner[k] = (corner[k] & kept) | ((octant >> k & 1u) << level);
    }
}

/// Calls visit(index into view.photons) for every photon within `radius` of the point (closed ball), in ascending order: the
/// same for every thread and run.
template <class Visit>
inline void for_each_photon(const PhotonMapView& view, const float (&center)[3], float radius, Visit&& visit) {
    const float radius2 = radius * radius;
    for_each_run(view, center, radius, [&](std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t i = begin; i < end; ++i) {
            const float x = view.x[i] - center[0], y = view.y[i] - center[1], z = view.z[i] - center[2];
            if (x * x + y * y + z * z <= radius2) visit(static_cast<std::int32_t>(i));
        }
    });
}

/// As for_each_photon, into a list: those within the ball and at most `height` from the plane through the point across the unit
/// normal. Where photons are many this is faster, for it has no branch that depends on a photon. Calls flush(count) when
/// `list`, of `capacity`, is full, and at the end, unless it is empty.
template <class Flush>
inline void collect_photons(const PhotonMapView& view, const float (&center)[3], const float (&normal)[3], float radius,
                            float height, std::int32_t* list, int capacity, Flush&& flush) {
    const float radius2 = radius * radius;
    int count = 0;
    for_each_run(view, center, radius, [&](std::uint32_t begin, std::uint32_t end) {
        while (begin < end) {
            const auto room = static_cast<std::uint32_t>(capacity - count);
            const std::uint32_t stop = end - begin < room ? end : begin + room;
            for (; begin < stop; ++begin) {
                const float x = view.x[begin] - center[0], y = view.y[begin] - center[1], z = view.z[begin] - center[2];
                const float off = x * normal[0] + y * normal[1] + z * normal[2];
                list[count] = static_cast<std::int32_t>(begin);
                count += static_cast<int>(x * x + y * y + z * z <= radius2) & static_cast<int>(off <= height) &
                         static_cast<int>(off >= -height);
            }
            if (count < capacity) continue;
            flush(count);
            count = 0;
        }
    });
    if (count > 0) flush(count);
}

}  // namespace cardioid::photon
