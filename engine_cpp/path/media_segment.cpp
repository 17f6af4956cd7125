// SPDX-License-Identifier: GPL-3.0-or-later
// What media do to rays on their way to the next surface: they absorb, emit and scatter. Distances are sampled by the extinction of
// one channel; the three channels share the sample by the balance heuristic. Media that are not the same everywhere are evaluated
// step by step, each step as if it were homogeneous.
#include "path/media.h"
#include "path/subsurface.h"

namespace cardioid::CD_ISA_NS {

namespace {

/// Random dimensions of distances in media: those of events that no path reaches.
constexpr std::int32_t k_medium_event = 1 << 17;
/// Paths that carry less are done, as in Cycles.
constexpr float k_least_throughput = 1e-6f;

Float emitted_share(Float extinction, Float through, Float length) {
    // Series where 1 - e^(-x) would lose its digits.
    const Float x = extinction * length;
    const Float thin = length * (1.0f - 0.5f * x);
    return select(x < Float(1e-3f), thin, (1.0f - through) / max(extinction, 1e-30f));
}

Spectrum emitted(const MediumLanes& m, Spectrum through, Float length) {
    return m.emission * Spectrum{emitted_share(m.extinction.r, through.r, length),
                                 emitted_share(m.extinction.g, through.g, length),
                                 emitted_share(m.extinction.b, through.b, length)};
}

/// Scattering over extinction; 1 where nothing stops light, so that passing such a channel is sampled too.
Spectrum albedo_of(const MediumLanes& m) {
    const auto share = [](Float s, Float e) { return select(e > Float(0.0f), s / max(e, 1e-30f), Float(1.0f)); };
    return {share(m.scattering.r, m.extinction.r), share(m.scattering.g, m.extinction.g),
            share(m.scattering.b, m.extinction.b)};
}

/// Random numbers of a step: which channel, how far, which phase function.
struct StepNumbers {
    Float channel, distance, phase;
};
StepNumbers step_numbers(Int seed, Int index, Int event, int step) {
    const WalkRandom random{hash(hash(seed, index), (event + Int(k_medium_event)) * Int(2048) + Int(step))};
    if (step > 0) return {random(0), random(1), random(2)};
    const Vec2 u = sample_pair(seed, index, event_dimension(event + Int(k_medium_event), pair_bsdf));
    return {u.y, u.x, random(2)};
}

}  // namespace

Walk::Segment Walk::pass_media(int i, Mask lanes) {
    path::RayState& rays = *now;
    const path::HitState& hits = scratch.hits;
    Segment out;
    out.scattered = mask_of(false);
    out.emitted = Spectrum(0.0f);
    const Int index = Int(i) + lane_index();
    MediaLanes media = load_media(rays, min(index, Int(rays.n - 1)));
    const Mask missed = load(hits.material + i) == Int(scene.material_count);
    // Only the world's medium has no end: a mesh that a ray does not leave is not closed.
    for (int k = 0; k < path::k_media; ++k) media.material[k] = select(missed, Int(-1), media.material[k]);
    Mask active = lanes & in_medium(scene, media);
    if (none(active)) return out;

    const Vec3 o = load3(rays.origin, i), d = load3(rays.direction, i), tp = load3(rays.throughput, i);
    const Int flags = load(rays.flags + i), path = select(active, load(rays.path + i), Int(0));
    const Int seed = gather(scratch.pixel_seed, path), sample = gather(scratch.sample_index, path);
    const Int event = event_of(load(rays.depth + i), load(rays.transparent + i));
    const Float begin = load(rays.t_min + i), end = load(hits.t + i);
    active &= end > begin;
    const Mask last = (flags & Int(path::k_flag_last)) != Int(0);
    const WalkRandom jitter{hash(hash(seed, sample), event + Int(2 * k_medium_event))};
    Float step = medium_step(scene, media, active);
    const Mask even = step > Float(1e29f);
    step = select(even, end - begin, max(step, (end - begin) * (1.0f / k_most_steps)));
    const Float offset = select(even, Float(1.0f), jitter(0)), within = jitter(1);

    Spectrum carried(1.0f);
    const Mask inside = active;
    Float from = begin;
    for (int k = 0; k <= k_most_steps && any(active); ++k) {
        const Float to = min(begin + step * (offset + static_cast<float>(k)), end), length = to - from;
        const StepNumbers number = step_numbers(seed, sample, event, k);
        ShadedPoint at;
        at.position = o + d * fma(length, within, from);
        at.normal_geometric = at.normal = at.wo = -d;
        at.flags = flags & Int(0xff);
        at.depth = load(rays.depth + i);
        const MediumLanes m = medium_at(*this, media, at, number.phase, active);
        const Spectrum through = exp_minus(m.extinction, length);
        out.emitted += select(active, carried * emitted(m, through, length), Spectrum(0.0f));

        const Mask scatters = active & ~last & (max_component(m.scattering) > Float(0.0f));
        const ChannelChoice c = choose_channel(Spectrum{tp.x, tp.y, tp.z} * carried * albedo_of(m), number.channel);
        const Float sigma = channel_of(m.extinction, c.channel);
        const Float t = select(sigma > Float(0.0f), -log(1.0f - number.distance) / max(sigma, 1e-30f), Float(1e30f));
        const Mask stops = scatters & (t < length);
        const Spectrum to_there = exp_minus(m.extinction, t);
        const Float pdf_stop = channels_dot(c.probability, m.extinction * to_there);
        const Float pdf_pass = select(scatters, channels_dot(c.probability, through), Float(1.0f));
        carried *= select(active,
                          select(stops, m.chosen * to_there * (1.0f / max(pdf_stop, 1e-37f)),
                                 through * (1.0f / max(pdf_pass, 1e-37f))),
                          Spectrum(1.0f));
        out.t = select(stops, from + t, out.t);
        out.kind = select(stops, m.kind, out.kind);
        out.parameter = select(stops, m.parameter, out.parameter);
        out.scattered |= stops;
        from = to;
        active &= ~stops & (to < end) & (max_component(carried) > Float(k_least_throughput));
    }
    out.throughput = Spectrum{tp.x, tp.y, tp.z} * carried;
    store3(rays.throughput, i,
           {select(inside, out.throughput.r, tp.x), select(inside, out.throughput.g, tp.y),
            select(inside, out.throughput.b, tp.z)});
    return out;
}

void Walk::queue_scattered(int i, const Segment& s) {
    path::Scatterings& q = scratch.scatterings;
    const Mask m = s.scattered & (max_component(s.throughput) > Float(0.0f));
    const Vec3 p = load3(now->origin, i) + load3(now->direction, i) * s.t;
    const Float values[] = {
        p.x,           p.y,           p.z, s.throughput.r, s.throughput.g, s.throughput.b, s.parameter.x,
        s.parameter.y, s.parameter.z, s.t};
    float* const rows[] = {q.position[0],   q.position[1],  q.position[2],  q.throughput[0], q.throughput[1],
                           q.throughput[2], q.parameter[0], q.parameter[1], q.parameter[2],  q.length};
    static_assert(sizeof rows / sizeof *rows == sizeof values / sizeof *values);
    for (std::size_t r = 0; r < sizeof rows / sizeof *rows; ++r) append(rows[r], q.n, values[r], m);
    compress_store(q.kind + q.n, s.kind, m);
    q.n += compress_store(q.ray + q.n, Int(i) + lane_index(), m);
    // They do not arrive at the surface.
    store(scratch.hits.material + i, select(s.scattered, Int(-1), load(scratch.hits.material + i)));
}

void Tracer::cross_media() {
    for (int i = 0; i < now->n; i += W) {
        const Mask lanes = first_lanes(now->n - i);
        const Vec3 before = load3(now->throughput, i);
        const Segment s = pass_media(i, lanes);
        const Mask glows = lanes & (max_component(s.emitted) > Float(0.0f));
        if (any(glows)) {
            // What it emits belongs to the ray as it was when it came.
            const Vec3 after = load3(now->throughput, i);
            store3(now->throughput, i, before);
            deposit(min(Int(i) + lane_index(), Int(now->n - 1)), s.emitted, Float(1.0f), glows);
            store3(now->throughput, i, after);
        }
        if (any(s.scattered)) queue_scattered(i, s);
    }
}

}  // namespace cardioid::CD_ISA_NS
