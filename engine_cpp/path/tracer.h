// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of a batch over lanes: Walk is what camera paths and photons share, Tracer is a batch of camera paths. Both live
// for one batch and own nothing.
#pragma once

#include "light/kernels.h"
#include "path/dimensions.h"
#include "trace/surface.h"

#include <bit>

namespace cardioid::CD_ISA_NS {

/// More events of a path than any setting allows: transparent surfaces and bounces together.
inline constexpr int k_max_events = 1024;

struct Walk {
    const trace::SceneView& scene;
    path::Scratch& scratch;
    path::RayState* now = nullptr;   ///< rays of this bounce
    path::RayState* next = nullptr;  ///< rays of the next one

    // hits.cpp
    /// `visibility`: scene::Visibility bits of what can be hit; 0: by the kind of each ray. `bounded`: scratch.hits.t holds how
    /// far rays go.
    void find_hits(bool coherent, int visibility, bool bounded);
    /// Stable counting sort of the live rays by material into scratch.order; bins[m] is the end of bin m.
    void sort_by_material();
    /// Calls body(material, rays, n) for chunks of at most 64 rays at one material; material_count stands for no hit.
    template <class Body>
    void for_each_chunk(Body&& body);
    void swap_rays() {
        path::RayState* const done = now;
        now = next;
        next = done;
    }

    // points.cpp: the shading chunk of rays at one material.
    void fill_shading(int material, const std::int32_t* rays, int n);
    /// Displacement that acts as bump turns the surface itself: what looks at its normal later sees the bumped one, as in Cycles.
    void take_bumped_normal(int n);

    // media_segment.cpp
    /// What media did to a packet of rays on the way to their hits.
    struct Segment {
        Spectrum throughput, emitted;  ///< emitted: radiance for the ray as it came
        Mask scattered;                ///< and where: t, and the phase function that was chosen
        Float t = 0.0f;
        Int kind = Int(0);
        Vec3 parameter{0.0f, 0.0f, 0.0f};
    };
    /// Attenuates the rays [i, i + W) of this bounce.
    Segment pass_media(int i, Mask lanes);
    /// Rays that ended in a medium leave the surfaces' chunks.
    void queue_scattered(int i, const Segment& s);

    // subsurface_enter.cpp: gives every subsurface lobe a diffuse one, which has its place where the path was diffuse before, where
    // a channel's radius is nothing, or everywhere (photons).
    void add_twins(path::VertexChunk& chunk, const std::int32_t* rays, bool all_diffuse);
};

/// Lobes of a material's chunks, twins of subsurface lobes included.
inline int room_for_lobes(const nodes::ProgramInfo& info) { return info.has_subsurface ? 2 * info.lobes : info.lobes; }

struct Choice;
struct DetailSum;
struct MediaLanes;

struct Tracer : Walk {
    const path::BatchRequest& request;
    path::BatchResult& result;

    // start.cpp: camera rays of all paths, results cleared.
    void start();
    /// Adds what rays met by themselves to what was sought.
    void finish();

    // emission.cpp: light that rays found by themselves.
    void add_lamp_hits();
    void add_world(const std::int32_t* rays, int n);
    void add_surface_emission(int material, const std::int32_t* rays);
    /// Adds radiance × throughput × share of ray lanes that hit light to their paths, clamped as Cycles does. `share`: what
    /// photons leave of it.
    void deposit(Int ray, Spectrum radiance, Float share, Mask active);
    /// Lanes whose hit is (in part) the photons' part: they ask for caustic_share.
    Mask shares_with_photons(Int ray, Mask active) const;
    /// Weight of a hit on light that photons of this density bring too (MIS; 0: they never bring it).
    Float caustic_share(Int ray, Float photon_density, Mask active) const;

    // shade.cpp: one chunk of at most 64 rays at one material.
    void shade(int material, const std::int32_t* rays, int n);
    void apply_holdout(Int path, Spectrum throughput, Float holdout, Mask lanes);
    /// What Cycles' settings do to lobes: caustics switched off, Filter Glossy.
    void adjust_lobes(path::VertexChunk& chunk, int i, Int flags, Float min_pdf);
    /// Room for a chunk; null if it could never fit.
    path::VertexChunk* new_record(int lobes, bool in_medium = false);
    /// Its direct light is evaluated later.
    void keep_record(path::VertexChunk* chunk);
    void write_first_hit(const std::int32_t* rays, int n);
    void log_vertices(const path::VertexChunk& chunk, int material);

    // scatter.cpp: ways on from a chunk.
    void scatter(path::VertexChunk& chunk, const std::int32_t* rays);
    /// Appends the rays that c says, or that pass straight through with throughput `passed`. `scatters`: the lanes that are vertices.
    void send_on(path::VertexChunk& chunk, int i, Int ray, Choice& c, Mask scatters, Float chance, Spectrum passed);
    /// Growth of the pixel's cone after the vertex; with photons, curved mirrors and glass bend it too.
    Float spread_after(const path::VertexChunk& chunk, int i, const Choice& c, Int flags, Float width,
                       Float spread) const;

    // subsurface_*.cpp: light that leaves elsewhere than it enters.
    /// Queues the paths that chose a subsurface lobe.
    void enter_subsurface(const path::VertexChunk& chunk, int i, Int ray, const Choice& c, Mask entering);
    /// Runs the queued walks and goes on from where they end; after all chunks of a bounce.
    void walk_subsurface();
    void step_walks(int step, int i, int end);
    /// Burley: a point near the entry.
    void project_disk(int i);
    void leave_subsurface();
    void leave_chunk(const std::int32_t* exits, int n, bool fresnel);

    // media_segment.cpp, media_scatter.cpp
    void cross_media();
    void scatter_in_media();
    void scatter_medium_chunk(const std::int32_t* queued, int n);
    void send_on_from_medium(const path::VertexChunk& chunk, int i, Int ray, Mask lanes);
    /// Notes the media around the vertices of a surface.
    void record_media(path::VertexChunk& chunk, int i, Int ray);

    // layers.cpp: incident light at x_d, for clusters and filter (thesis 6.2).
    /// Texture detail, normal and depth of the vertices that may be x_d; `flags` of the arriving rays.
    void add_features(const path::VertexChunk& chunk, int i, const DetailSum& detail, Int flags, Mask scatters);
    /// Where a D lobe was taken for the first time: what leads from R to I for all light that arrives along wi.
    void mark_incident(const path::VertexChunk& chunk, int i, const Choice& c, Int flags, Mask scatters);
    /// I of light R that comes after x_d.
    Spectrum demodulated(Int path, Spectrum radiance) const;

    // gather.cpp: photons around x_d, the first vertex where a D lobe was chosen.
    /// Fills the chunk's gather and radius; returns RayState::merge of the ways on.
    Float mark_gather(path::VertexChunk& chunk, int i, const Choice& c, Mask scatters, Float footprint, Float merge);
    /// Radius of the gather, or what the pixel has come to.
    Float gather_radius(const path::VertexChunk& chunk, int i, Float footprint, Mask here);
    void gather_photons(const path::VertexChunk& chunk, int i);
    /// Adds the photons of scratch.gather to the lanes' sums by class.
    void add_photons(const path::VertexChunk& chunk, int i, Spectrum (&sum)[path::k_classes]);
    /// From flux to radiance; in the per-pixel schedule to the pixels' statistics.
    void add_estimate(const path::VertexChunk& chunk, int i, const Spectrum (&sum)[path::k_classes],
                      const int (&found)[W], Mask active);

    // direct.cpp: next-event estimation for all recorded vertices.
    void add_direct_light();
    void connect(const path::VertexChunk& chunk, int i);
    void flush_shadows();
    /// Share of the light that transparent surfaces and media (in which the rays start; null: there are none) let through; lanes
    /// that surfaces block leave `visible`.
    Spectrum through_transparent(RayLanes ray, Mask& visible, MediaLanes* media);

    /// Classes for which paths go on.
    path::ClassSet wanted() const {
        return path::ClassSet(request.partition.camera | (request.partition.blend_hits ? bit(path::PathClass::c1) : 0));
    }
    /// True where some class of the set is estimated by camera paths.
    bool wants(path::ClassSet classes) const { return (request.partition.camera & classes) != 0; }
};

template <class Body>
void Walk::for_each_chunk(Body&& body) {
    std::int32_t list[k_chunk + 16];
    int begin = 0;
    for (int m = 0; m <= scene.material_count; ++m) {
        const int end = scratch.bins[m];
        for (int at = begin; at < end; at += k_chunk) {
            const int n = end - at < k_chunk ? end - at : k_chunk;
            for (int i = 0; i < n; ++i) list[i] = scratch.order[at + i];
            // Lanes past the end repeat the last ray, so that kernels may compute them.
            for (int i = n; i < n + 16; ++i) list[i] = list[n - 1];
            body(m, list, n);
        }
        begin = end;
    }
}

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
Spectrum shade_points(Walk& walk, nodes::Purpose purpose, Int program, const ShadedPoint& at, Mask active);
/// The medium of one program at the lanes of `here`; `first` is one of them.
const nodes::VolumeOutput& volume_points(Walk& walk, int program, const ShadedPoint& at, Mask here, int first);

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

/// Visibility bit that decides whether a lamp lights a lobe in direction wi.
inline Int lobe_visibility(bsdf::LobeKind kind, Vec3 wi, Vec3 ng) {
    const Int reflected(bsdf::is_diffuse_kind(kind) ? scene::visible_diffuse : scene::visible_glossy);
    if (!bsdf::sends_light_through(kind)) return reflected;
    return select(dot(wi, ng) < Float(0.0f), Int(scene::visible_transmission), reflected);
}

/// Width of a pixel's cone after t. Curved mirrors and glass may focus it (negative spread): near the focus it keeps a share of
/// what it had.
inline Float footprint(Float width, Float spread, Float t) {
    const Float focused = abs(width + spread * t);
    return select(spread < Float(0.0f), max(focused, 0.25f * abs(width)), focused);
}

/// Lanes whose state, as a class, is in the set.
inline Mask in_set(Int path_class, path::ClassSet set) {
    Mask m = mask_of(false);
    for (int c = 0; c < path::k_classes; ++c) {
        if (set >> c & 1) m |= path_class == Int(c);
    }
    return m;
}

inline Int byte_of(Int packed, int which) { return (packed >> (8 * which)) & Int(255); }

/// RayState::transparent: surfaces passed, bounds of media passed << 16, scatterings in media << 24.
inline Int surfaces_passed(Int transparent) { return transparent & Int(0xffff); }
inline Int bounds_passed(Int transparent) { return (transparent >> 16) & Int(255); }
inline Int scatterings_in_media(Int transparent) { return transparent >> 24; }
/// Index of the random dimensions of a ray's next event.
inline Int event_of(Int depth, Int transparent) {
    return byte_of(depth, 0) + surfaces_passed(transparent) + bounds_passed(transparent);
}

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

/// The state after a vertex in a medium: before x_d it changes nothing (path/media_scatter.cpp).
inline Int state_in_medium(Int state) {
    return select(state == Int(static_cast<int>(path::State::specular)), state, step_state(state, mask_of(false)));
}

/// scene::Visibility bit of a ray by its flags: transmission hides the kind of lobe, as in Cycles.
inline Int visibility_bit(Int flags) {
    const auto has = [&](std::uint32_t f) { return (flags & Int::of_bits(f)) != Int(0); };
    Int bit(scene::visible_camera);
    bit = select(has(nodes::ray_glossy), Int(scene::visible_glossy), bit);
    bit = select(has(nodes::ray_diffuse), Int(scene::visible_diffuse), bit);
    bit = select(has(nodes::ray_transmission), Int(scene::visible_transmission), bit);
    bit = select(has(nodes::ray_volume), Int(scene::visible_volume), bit);
    return select(has(nodes::ray_camera), Int(scene::visible_camera), bit);
}

/// path::reachable over lanes: some class of the set may still come.
inline Mask can_reach(Int state, path::ClassSet set) {
    Mask m = mask_of(false);
    for (int s = 0; s < path::k_states; ++s) {
        if ((path::reachable(static_cast<path::State>(s)) & set) != 0) m |= state == Int(s);
    }
    return m;
}

/// Roulette from the third vertex: chance to go on. The square root keeps more paths than it costs: 17 % less variance for 5 %
/// more time in the Cornell box.
inline Float survival(Spectrum carried, Int depth, Mask active) {
    const Mask gamble = active & (byte_of(depth, 0) > Int(2));
    return select(gamble, min(sqrt(max_component(carried)), 0.95f), Float(1.0f));
}

/// One packet of RayState.
struct RayLaneState {
    Vec3 origin, direction, from_normal;
    Spectrum throughput;
    Float t_min, pdf, width, spread, min_pdf, merge;
    Int path, flags, depth, transparent;
};

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

/// Appends the lanes of m to the rays.
inline void append_ray(path::RayState& to, const RayLaneState& r, Mask m) {
    const int n = to.n;
    const Float floats[] = {r.origin.x,    r.origin.y,      r.origin.z,      r.direction.x,   r.direction.y,
                            r.direction.z, r.t_min,         r.throughput.r,  r.throughput.g,  r.throughput.b,
                            r.pdf,         r.from_normal.x, r.from_normal.y, r.from_normal.z, r.width,
                            r.spread,      r.min_pdf,       r.merge};
    float* const rows[] = {to.origin[0],    to.origin[1],      to.origin[2],      to.direction[0],   to.direction[1],
                           to.direction[2], to.t_min,          to.throughput[0],  to.throughput[1],  to.throughput[2],
                           to.pdf,          to.from_normal[0], to.from_normal[1], to.from_normal[2], to.width,
                           to.spread,       to.min_pdf,        to.merge};
    static_assert(sizeof rows / sizeof *rows == sizeof floats / sizeof *floats);
    for (std::size_t k = 0; k < sizeof rows / sizeof *rows; ++k) append(rows[k], n, floats[k], m);
    compress_store(to.path + n, r.path, m);
    compress_store(to.flags + n, r.flags, m);
    compress_store(to.depth + n, r.depth, m);
    to.n += compress_store(to.transparent + n, r.transparent, m);
}

inline void add_to(path::PathFloats (&sums)[3], int path, Spectrum c, int lane) {
    sums[0][path] += c.r[lane];
    sums[1][path] += c.g[lane];
    sums[2][path] += c.b[lane];
}

/// Light that belongs to no layer: D1 and photons.
constexpr int k_no_layer = -1;

/// R and I of light that camera paths find (film/cluster.h); the layer is k_no_layer where it is not filtered.
struct Light {
    Spectrum radiance, incident{0.0f};
    Int layer = Int(k_no_layer);
};

/// Adds light to the paths' sums of their classes and layers, in lane order: several lanes may share a path.
inline void add_light(path::LightSums& result, bool layers, Int path_class, Int path, const Light& light, Mask active) {
    for (std::uint32_t b = bits(active); b != 0; b &= b - 1) {
        const int k = std::countr_zero(b);
        add_to(result.radiance[path_class[k]], path[k], light.radiance, k);
        if (!layers) continue;
        const int layer = light.layer[k];
        if (layer == k_no_layer) {
            add_to(result.unfiltered, path[k], light.radiance, k);
            continue;
        }
        add_to(result.layer_radiance[layer], path[k], light.radiance, k);
        add_to(result.layer_incident[layer], path[k], light.incident, k);
    }
}

/// Scatterings since x_d (path::k_layer_shift).
inline Int scatterings_since_d(Int flags) { return (flags >> path::k_layer_shift) & Int(3); }

/// MIS by the power heuristic (exponent 2); pdf of the other technique may be 0.
inline Float power_heuristic(Float pdf, Float other) {
    const Float a = pdf * pdf;
    return a / max(a + other * other, 1e-37f);
}

/// Cycles' clamp of one contribution, as a factor: the sum of the components, against 3 × the limit. limit 0: off.
inline Float clamp_factor(Spectrum c, Int bounce, float direct, float indirect) {
    if (direct <= 0 && indirect <= 0) return 1.0f;
    const Float limit = 3.0f * select(bounce > Int(0), Float(indirect), Float(direct));
    const Float sum = abs(c.r) + abs(c.g) + abs(c.b);
    const Mask over = (limit > Float(0.0f)) & (sum > limit);
    return select(over, limit / sum, Float(1.0f));
}

}  // namespace cardioid::CD_ISA_NS
