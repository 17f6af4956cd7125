// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of a batch over lanes. One Tracer lives for one batch and owns nothing.
#pragma once

#include "light/kernels.h"
#include "path/dimensions.h"
#include "trace/surface.h"

#include <bit>

namespace cardioid::CD_ISA_NS {

struct Tracer {
    const trace::SceneView& scene;
    const path::BatchRequest& request;
    path::Scratch& scratch;
    path::BatchResult& result;
    path::RayState* now = nullptr;   ///< rays of this bounce
    path::RayState* next = nullptr;  ///< rays of the next one

    // start.cpp: camera rays of all paths, results cleared.
    void start();

    // hits.cpp
    void find_hits(bool coherent);
    /// Stable counting sort of the live rays by material into scratch.order; bins[m] is the end of bin m.
    void sort_by_material();

    // emission.cpp: light that rays found by themselves.
    void add_lamp_hits();
    void add_world(const std::int32_t* rays, int n);
    void add_surface_emission(int material, const std::int32_t* rays);
    /// Adds radiance × throughput of ray lanes to their paths, clamped as Cycles does.
    void deposit(Int ray, Spectrum radiance, Mask active, bool emission_hit);

    // shade.cpp: one chunk of at most 64 rays at one material.
    void shade(int material, const std::int32_t* rays, int n);
    void fill_shading(int material, const std::int32_t* rays, int n);
    void scatter(path::VertexChunk& chunk, const std::int32_t* rays);
    path::VertexChunk* new_record(int material);
    void write_first_hit(const std::int32_t* rays, int n);
    void log_vertices(const path::VertexChunk& chunk, int material);

    // direct.cpp: next-event estimation for all recorded vertices.
    void add_direct_light();
    void connect(const path::VertexChunk& chunk, int i);
    void flush_shadows();
    /// Share of the light that transparent surfaces let through; lanes that they block leave `visible`.
    Spectrum through_transparent(RayLanes ray, Mask& visible);
};

/// W points whose emission or transparency is wanted, outside the chunks of a bounce.
struct ShadedPoint {
    Vec3 position, normal_geometric, normal, wo;
    Int instance = Int(-1), triangle = Int(0);  ///< instance -1: lamp or world
    Float u = 0.0f, v = 0.0f;
    Int depth = Int(0);
    Int flags = Int(nodes::ray_diffuse | nodes::ray_reflection);
    Float ray_length = 1e30f;
    Float backfacing = 0.0f;
};

/// Runs the programs `program` (ids of SceneView::materials) at the points; gathers lanes by program.
/// Purpose::emission gives radiance, Purpose::transparency what passes straight through.
Spectrum shade_points(Tracer& tracer, nodes::Purpose purpose, Int program, const ShadedPoint& at, Mask active);

/// Appends a packet to the log; one that does not fit is dropped.
inline void log_rays(path::RayLog& log, const RayLanes& ray, Mask active, path::RayKind kind) {
    if (log.n + W > log.capacity) return;
    const Float values[8] = {ray.o.x, ray.o.y, ray.o.z,   ray.d.x,
                             ray.d.y, ray.d.z, ray.t_min, select(active, ray.t_max, Float(-1.0f))};
    for (int f = 0; f < 8; ++f) store(log.field[f] + log.n, values[f]);
    store(log.mask + log.n, ray.mask);
    for (std::size_t k = 0; k < W; ++k) log.kind[log.n + k] = kind;
    log.n += W;
}

/// Cycles' softening of the border where light is under the smooth surface but over the bumped one (Estevez et al. 2019);
/// for diffuse lobes with a normal of their own.
inline Float bump_shadow(const path::VertexChunk& chunk, const bsdf::Lobe& lobe, int i, Vec3 wi) {
    Vec3 smooth = load3(chunk.normal, i);
    const Vec3 bumped = load3(lobe.normal, i);
    const Float cos_light = dot(bumped, wi);
    smooth = select(cos_light < Float(0.0f), -smooth, smooth);
    const Float g = dot(smooth, wi) / max(abs(cos_light) * abs(dot(smooth, bumped)), 1e-20f);
    const Float soft = select(g < Float(0.0f), Float(0.0f), fma(g * g, 1.0f - g, g));
    return select(g >= Float(1.0f), Float(1.0f), soft);
}

inline Int byte_of(Int packed, int which) { return (packed >> (8 * which)) & Int(255); }

inline Int state_of(Int flags) { return (flags >> path::k_state_shift) & Int(7); }

/// path::step over lanes: the state after a lobe that is specular or not.
inline Int step_state(Int state, Mask specular) {
    const Int s0(static_cast<int>(path::State::specular));
    const Int after_s = select(state == s0, s0, Int(static_cast<int>(path::State::caustic_hit)));
    const Int after_d =
        select(state == s0, Int(static_cast<int>(path::State::first_d)),
               select(state == Int(static_cast<int>(path::State::caustic_hit)),
                      Int(static_cast<int>(path::State::caustic_d)), Int(static_cast<int>(path::State::more_d))));
    return select(specular, after_s, after_d);
}

/// scene::Visibility bit of a ray by its flags: transmission hides the kind of lobe, as in Cycles.
inline Int visibility_bit(Int flags) {
    const auto has = [&](std::uint32_t f) { return (flags & Int::of_bits(f)) != Int(0); };
    Int bit(scene::visible_camera);
    bit = select(has(nodes::ray_glossy), Int(scene::visible_glossy), bit);
    bit = select(has(nodes::ray_diffuse), Int(scene::visible_diffuse), bit);
    bit = select(has(nodes::ray_transmission), Int(scene::visible_transmission), bit);
    return select(has(nodes::ray_camera), Int(scene::visible_camera), bit);
}

inline Vec3 load3(const path::PathFloats (&rows)[3], Int index) {
    return {gather(rows[0], index), gather(rows[1], index), gather(rows[2], index)};
}
inline Vec3 load3(const path::PathFloats (&rows)[3], int index) {
    return {load(rows[0] + index), load(rows[1] + index), load(rows[2] + index)};
}
inline void store3(path::PathFloats (&rows)[3], int index, Vec3 a) {
    store(rows[0] + index, a.x);
    store(rows[1] + index, a.y);
    store(rows[2] + index, a.z);
}

/// The lanes of `value` that m selects, next to each other from to[n] on; returns how many.
inline int append(float* to, int n, Float value, Mask m) {
    return compress_store(reinterpret_cast<std::int32_t*>(to) + n, bits_of(value), m);
}

/// Adds radiance to the paths' sums of their classes, in lane order: several lanes may share a path.
inline void add_radiance(path::BatchResult& result, Int path_class, Int path, Spectrum c, Mask active) {
    for (std::uint32_t b = bits(active); b != 0; b &= b - 1) {
        const int k = std::countr_zero(b);
        auto& sums = result.radiance[path_class[k]];
        sums[0][path[k]] += c.r[k];
        sums[1][path[k]] += c.g[k];
        sums[2][path[k]] += c.b[k];
    }
}

/// MIS by the power heuristic (exponent 2); pdf of the other technique may be 0.
inline Float power_heuristic(Float pdf, Float other) {
    const Float a = pdf * pdf;
    return a / max(a + other * other, 1e-37f);
}

/// Cycles' clamp of one contribution: the sum of the components, against 3 × the limit. limit 0: off.
inline Spectrum clamp_contribution(Spectrum c, Int bounce, float direct, float indirect) {
    if (direct <= 0 && indirect <= 0) return c;
    const Float limit = 3.0f * select(bounce > Int(0), Float(indirect), Float(direct));
    const Float sum = abs(c.r) + abs(c.g) + abs(c.b);
    const Mask over = (limit > Float(0.0f)) & (sum > limit);
    return c * select(over, limit / sum, Float(1.0f));
}

}  // namespace cardioid::CD_ISA_NS
