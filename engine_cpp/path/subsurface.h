// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that random walks and Burley's disk share.
#pragma once

#include "bsdf/diffuse.h"
#include "path/tracer.h"
#include "trace/chosen_hits.h"

namespace cardioid::CD_ISA_NS {

/// Independent numbers of one step of a walk.
struct WalkRandom {
    Int seed;
    Float operator()(int which) const { return unit_float(hash(seed + Int(which))); }
};
/// `step`: of the walk; -1 before it.
inline WalkRandom walk_random(Int pixel_seed, Int sample_index, Int event, int step) {
    return {hash(hash(pixel_seed, sample_index), event * Int(1024) + Int(step + 1))};
}

inline Spectrum exp(Spectrum x) { return {exp(x.r), exp(x.g), exp(x.b)}; }
inline Float dot(Spectrum a, Spectrum b) { return a.r * b.r + a.g * b.g + a.b * b.b; }

/// One of three channels with probabilities in proportion to weights.
struct ChannelChoice {
    Spectrum probability;
    Int channel;
};
inline ChannelChoice choose_channel(Spectrum weight, Float u) {
    const Spectrum w{abs(weight.r), abs(weight.g), abs(weight.b)};
    const Float sum = w.r + w.g + w.b;
    const Mask black = ~(sum > Float(1e-30f));
    ChannelChoice c;
    c.probability = select(black, Spectrum(1.0f / 3.0f), w * (1.0f / max(sum, 1e-30f)));
    const Float two = c.probability.r + c.probability.g;
    c.channel = select(u < c.probability.r, Int(0), select(u < two, Int(1), Int(2)));
    // Rounding must not choose a channel without weight.
    c.channel = select((c.channel == Int(2)) & ~(c.probability.b > Float(0.0f)),
                       select(c.probability.g > Float(0.0f), Int(1), Int(0)), c.channel);
    return c;
}
inline Float channel_of(Spectrum s, Int channel) {
    return select(channel == Int(0), s.r, select(channel == Int(1), s.g, s.b));
}

/// One packet of a queue.
struct WalkLanes {
    Vec3 position, direction, entry, normal;
    Spectrum throughput, extinction, albedo;
    Float anisotropy, opposite;
    Int ray, instance, kind;
};

inline WalkLanes load_walk(const path::Subsurface& q, int i) {
    const auto vec = [&](int row) {
        return Vec3{load(q.row[row] + i), load(q.row[row + 1] + i), load(q.row[row + 2] + i)};
    };
    const auto rgb = [&](int row) {
        return Spectrum{load(q.row[row] + i), load(q.row[row + 1] + i), load(q.row[row + 2] + i)};
    };
    return {vec(path::walk_position),
            vec(path::walk_direction),
            vec(path::walk_entry),
            vec(path::walk_normal),
            rgb(path::walk_throughput),
            rgb(path::walk_extinction),
            rgb(path::walk_albedo),
            load(q.row[path::walk_anisotropy] + i),
            load(q.row[path::walk_opposite] + i),
            load(q.ray + i),
            load(q.instance + i),
            load(q.kind + i)};
}

/// Appends the lanes of m; the queue may be the one that they came from, if they lie further on.
inline void append_walk(path::Subsurface& q, const WalkLanes& w, Mask m) {
    const Float values[path::walk_rows] = {
        w.position.x,   w.position.y,   w.position.z,   w.direction.x,  w.direction.y,  w.direction.z,
        w.throughput.r, w.throughput.g, w.throughput.b, w.entry.x,      w.entry.y,      w.entry.z,
        w.normal.x,     w.normal.y,     w.normal.z,     w.extinction.r, w.extinction.g, w.extinction.b,
        w.albedo.r,     w.albedo.g,     w.albedo.b,     w.anisotropy,   w.opposite};
    for (int row = 0; row < path::walk_rows; ++row) append(q.row[row], q.n, values[row], m);
    compress_store(q.ray + q.n, w.ray, m);
    compress_store(q.instance + q.n, w.instance, m);
    q.n += compress_store(q.kind + q.n, w.kind, m);
}

/// Appends where lanes came out. `normals`: on the outer side.
inline void append_exit(path::SubsurfaceExit& to, const WalkLanes& w, Vec3 position, const SurfaceNormals& normals,
                        const HitLanes& h, Mask m) {
    const Float values[] = {position.x,     position.y,     position.z,  normals.ng.x, normals.ng.y,
                            normals.ng.z,   normals.n.x,    normals.n.y, normals.n.z,  w.throughput.r,
                            w.throughput.g, w.throughput.b, h.u,         h.v};
    float* const rows[] = {to.position[0],
                           to.position[1],
                           to.position[2],
                           to.normal_geometric[0],
                           to.normal_geometric[1],
                           to.normal_geometric[2],
                           to.normal[0],
                           to.normal[1],
                           to.normal[2],
                           to.throughput[0],
                           to.throughput[1],
                           to.throughput[2],
                           to.u,
                           to.v};
    static_assert(sizeof rows / sizeof *rows == sizeof values / sizeof *values);
    for (std::size_t r = 0; r < sizeof rows / sizeof *rows; ++r) append(rows[r], to.n, values[r], m);
    compress_store(to.ray + to.n, w.ray, m);
    compress_store(to.instance + to.n, h.instance, m);
    compress_store(to.triangle + to.n, h.triangle, m);
    to.n += compress_store(to.kind + to.n, w.kind, m);
}

/// Lanes with this value. Out of line: GCC 12 folds the comparison of a one-lane vector with its own lane to 1, which is no mask.
Mask lanes_with(Int values, int value, Mask among);

/// The surface of one program at the lanes of `here`, into `out`, which has room for its lobes; `first` is one of them.
void run_surface(Walk& walk, int program, const ShadedPoint& at, Float footprint, nodes::SurfaceOutput& out, Mask here,
                 int first);

}  // namespace cardioid::CD_ISA_NS
