// SPDX-License-Identifier: GPL-3.0-or-later
// One octave of Voronoi cells over lanes, in 1 to 4 dimensions: the nearest feature point, the second, smooth blends and
// distances to edges. Blender's hashes decide where the points are: lookup3, or PCG from 5.0 on.
#pragma once

#include "nodes/kernel_hash.h"
#include "nodes/kernel_math.h"
#include "nodes/op_modes.h"

namespace cardioid::CD_ISA_NS {

struct CellResult {
    Float distance = 0.0f;
    Vec3 color{0.0f, 0.0f, 0.0f};
    Vec4 position{0.0f, 0.0f, 0.0f, 0.0f};
};

inline Vec4 select(Mask m, Vec4 a, Vec4 b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z), select(m, a.w, b.w)};
}
template <int D>
inline Float dot_of(Vec4 a, Vec4 b) {
    Float s = a.x * b.x;
    if constexpr (D > 1) s += a.y * b.y;
    if constexpr (D > 2) s += a.z * b.z;
    if constexpr (D > 3) s += a.w * b.w;
    return s;
}

/// What all octaves share.
struct CellSettings {
    nodes::CellMetric metric;
    bool pcg, color;
    Float exponent, randomness, smoothness;
};

inline Int arithmetic_shift_16(Int v) { return (v >> 16) | (select(v < Int(0), Int(-1), Int(0)) << 16); }

struct Int4 {
    Int x, y, z, w;
};

/// PCG of 2, 3 or 4 words.
template <int D>
inline Vec4 pcg(Int4 v) {
    const Int k(1664525), c(1013904223);
    v = {v.x * k + c, v.y * k + c, v.z * k + c, v.w * k + c};
    const auto round = [&] {
        if constexpr (D == 2) {
            v.x += v.y * k;
            v.y += v.x * k;
        } else if constexpr (D == 3) {
            v.x += v.y * v.z;
            v.y += v.z * v.x;
            v.z += v.x * v.y;
        } else {
            v.x += v.y * v.w;
            v.y += v.z * v.x;
            v.z += v.x * v.y;
            v.w += v.y * v.z;
        }
    };
    round();
    v = {v.x ^ arithmetic_shift_16(v.x), v.y ^ arithmetic_shift_16(v.y), v.z ^ arithmetic_shift_16(v.z),
         v.w ^ arithmetic_shift_16(v.w)};
    round();
    const auto unit = [](Int x) { return to_float(x & Int(0x7fffffff)) * (1.0f / 2147483647.0f); };
    return {unit(v.x), unit(v.y), D > 2 ? unit(v.z) : Float(0.0f), D > 3 ? unit(v.w) : Float(0.0f)};
}

inline Int4 whole(Vec4 p) { return {to_int(p.x), to_int(p.y), to_int(p.z), to_int(p.w)}; }

/// Where in its cell the feature point lies.
template <int D>
inline Vec4 cell_point(Vec4 cell, bool use_pcg) {
    const Float one = 1.0f, zero = 0.0f;
    if constexpr (D == 1) return {random(cell.x), zero, zero, zero};
    if (use_pcg) return pcg<D>(whole(cell));
    if constexpr (D == 2) return {random(cell.x, cell.y), random(cell.x, cell.y, one), zero, zero};
    if constexpr (D == 3) {
        const Vec3 r = random_color<3>(cell);
        return {r.x, r.y, r.z, zero};
    }
    return {random(cell.x, cell.y, cell.z, cell.w), random(cell.w, cell.x, cell.y, cell.z),
            random(cell.z, cell.w, cell.x, cell.y), random(cell.y, cell.z, cell.w, cell.x)};
}

template <int D>
inline Vec3 cell_color(Vec4 cell, bool use_pcg) {
    if (D == 1 || !use_pcg) return random_color<D>(cell);
    const Vec4 r = pcg<(D == 2 ? 3 : D)>(whole(cell));
    return {r.x, r.y, r.z};
}

template <int D>
inline Float cell_distance(Vec4 a, Vec4 b, const CellSettings& s) {
    const Vec4 d = {abs(a.x - b.x), abs(a.y - b.y), abs(a.z - b.z), abs(a.w - b.w)};
    if constexpr (D == 1) return d.x;
    switch (s.metric) {
        case nodes::CellMetric::euclidean: return sqrt(dot_of<D>(d, d));
        case nodes::CellMetric::manhattan: return d.x + d.y + d.z + d.w;
        case nodes::CellMetric::chebychev: return max(max(d.x, d.y), max(d.z, d.w));
        default: break;
    }
    Float sum = pow(d.x, s.exponent) + pow(d.y, s.exponent);
    if constexpr (D > 2) sum += pow(d.z, s.exponent);
    if constexpr (D > 3) sum += pow(d.w, s.exponent);
    // Without an exponent everything is endlessly far.
    return select(s.exponent == Float(0.0f), Float(1e30f), pow(sum, 1.0f / s.exponent));
}

/// Calls f(offset) for the cells around, from -reach to reach along each axis, x fastest.
template <int D, int Reach, class F>
inline void around(F f) {
    constexpr int r1 = Reach, r2 = D > 1 ? Reach : 0, r3 = D > 2 ? Reach : 0, r4 = D > 3 ? Reach : 0;
    for (int l = -r4; l <= r4; ++l)
        for (int k = -r3; k <= r3; ++k)
            for (int j = -r2; j <= r2; ++j)
                for (int i = -r1; i <= r1; ++i)
                    f(Vec4{Float(static_cast<float>(i)), Float(static_cast<float>(j)), Float(static_cast<float>(k)),
                           Float(static_cast<float>(l))});
}

struct Placed {
    Vec4 cell, local;
    explicit Placed(Vec4 p) : cell{floor(p.x), floor(p.y), floor(p.z), floor(p.w)}, local(p - cell) {}
};

/// The nearest point, or the second nearest.
template <int D>
inline CellResult nearest_cell(Vec4 p, const CellSettings& s, bool second) {
    const Placed at(p);
    const Float far = 1e30f;
    const Vec4 zero{0.0f, 0.0f, 0.0f, 0.0f};
    Float d1 = far, d2 = far;
    Vec4 offset1 = zero, offset2 = zero, point1 = zero, point2 = zero;
    around<D, 1>([&](Vec4 offset) {
        const Vec4 point = offset + cell_point<D>(at.cell + offset, s.pcg) * s.randomness;
        const Float d = cell_distance<D>(point, at.local, s);
        const Mask first = d < d1, next = d < d2;
        d2 = select(first, d1, select(next, d, d2));
        offset2 = select(first, offset1, select(next, offset, offset2));
        point2 = select(first, point1, select(next, point, point2));
        d1 = select(first, d, d1);
        offset1 = select(first, offset, offset1);
        point1 = select(first, point, point1);
    });
    CellResult r;
    r.distance = second ? d2 : d1;
    r.position = (second ? point2 : point1) + at.cell;
    if (s.color) r.color = cell_color<D>(at.cell + (second ? offset2 : offset1), s.pcg);
    return r;
}

template <int D>
inline CellResult smooth_cell(Vec4 p, const CellSettings& s) {
    const Placed at(p);
    CellResult r;
    bool first = true;
    around<D, 2>([&](Vec4 offset) {
        const Vec4 point = offset + cell_point<D>(at.cell + offset, s.pcg) * s.randomness;
        const Float d = cell_distance<D>(point, at.local, s);
        const Float t = saturate(0.5f + 0.5f * (r.distance - d) / s.smoothness);
        const Float h = first ? Float(1.0f) : t * t * (3.0f - 2.0f * t);
        first = false;
        const Float correction = s.smoothness * h * (1.0f - h), less = correction / (1.0f + 3.0f * s.smoothness);
        r.distance = mix(r.distance, d, h) - correction;
        const auto blend = [&](Float a, Float b) { return mix(a, b, h) - less; };
        if (s.color) {
            const Vec3 c = cell_color<D>(at.cell + offset, s.pcg);
            r.color = {blend(r.color.x, c.x), blend(r.color.y, c.y), blend(r.color.z, c.z)};
        }
        r.position = {blend(r.position.x, point.x), blend(r.position.y, point.y), blend(r.position.z, point.z),
                      blend(r.position.w, point.w)};
    });
    r.position = r.position + at.cell;
    return r;
}

template <int D>
inline Float edge_distance(Vec4 p, const CellSettings& s) {
    const Placed at(p);
    Float least = 1e30f;
    if constexpr (D == 1) {
        const auto point = [&](float k) { return k + random(at.cell.x + k) * s.randomness; };
        const Float mid = point(0);
        return min(abs(0.5f * (mid + point(-1)) - at.local.x), abs(0.5f * (mid + point(1)) - at.local.x));
    }
    Vec4 closest{0.0f, 0.0f, 0.0f, 0.0f};
    const auto to_point = [&](Vec4 offset) {
        return offset + cell_point<D>(at.cell + offset, s.pcg) * s.randomness - at.local;
    };
    around<D, 1>([&](Vec4 offset) {
        const Vec4 v = to_point(offset);
        const Float d = dot_of<D>(v, v);
        closest = select(d < least, v, closest);
        least = min(d, least);
    });
    least = 1e30f;
    around<D, 1>([&](Vec4 offset) {
        const Vec4 v = to_point(offset), across = v - closest;
        const Float l2 = dot_of<D>(across, across);
        const Float d = dot_of<D>((closest + v) * 0.5f, across * (1.0f / sqrt(max(l2, 1e-20f))));
        least = select(l2 > Float(0.0001f), min(least, d), least);
    });
    return least;
}

/// Half the distance from the nearest point to its own nearest neighbour.
template <int D>
inline Float sphere_radius(Vec4 p, const CellSettings& s) {
    const Placed at(p);
    const Vec4 zero{0.0f, 0.0f, 0.0f, 0.0f};
    Vec4 closest = zero, home = zero;
    Float least = 1e30f;
    around<D, 1>([&](Vec4 offset) {
        const Vec4 point = offset + cell_point<D>(at.cell + offset, s.pcg) * s.randomness, v = point - at.local;
        const Mask nearer = dot_of<D>(v, v) < least;
        least = select(nearer, dot_of<D>(v, v), least);
        closest = select(nearer, point, closest);
        home = select(nearer, offset, home);
    });
    least = 1e30f;
    around<D, 1>([&](Vec4 step) {
        if (all(dot_of<D>(step, step) == Float(0.0f))) return;
        const Vec4 offset = step + home;
        const Vec4 v = closest - (offset + cell_point<D>(at.cell + offset, s.pcg) * s.randomness);
        least = min(least, dot_of<D>(v, v));
    });
    return 0.5f * sqrt(least);
}

}  // namespace cardioid::CD_ISA_NS
