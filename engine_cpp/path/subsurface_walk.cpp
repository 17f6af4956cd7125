// SPDX-License-Identifier: GPL-3.0-or-later
// Random walks under a surface (Chiang, Kutz and Burley 2016), guided out of it by Dwivedi sampling (Křivánek and d'Eon 2014; Meng,
// Hanika and Dachsbacher 2016; d'Eon and Křivánek 2020). All walks of a bounce take their steps together.
#include "bsdf/phase.h"
#include "path/subsurface.h"

namespace cardioid::CD_ISA_NS {

namespace {

/// Limits of Cycles: steps of a walk; after so many it goes on isotropically with reduced coefficients; and when it is given up.
constexpr int k_walk_steps = 256, k_similar_after = 9;
constexpr float k_least_throughput = 1e-6f;

enum WalkNumber : int { number_channel, number_distance, number_guided, number_backward, number_cosine, number_angle };

/// Density of cosines to the outward normal, 1/((ν − c) log((ν + 1)/(ν − 1))), and distances shortened by 1 − c/ν.
struct Dwivedi {
    Float length, log_ratio;
    /// `albedo`: of one scattering. The diffusion length is eq. 67 of d'Eon and Křivánek 2020.
    explicit Dwivedi(Float albedo) {
        const Float exponent = 2.44294f - 0.0215813f * albedo + 0.578637f / albedo;
        length = max(1.0f / sqrt(max(1.0f - pow(albedo, exponent), 1e-12f)), 1.00001f);
        log_ratio = log((length + 1.0f) / (length - 1.0f));
    }
    Float pdf(Float cosine) const { return 1.0f / ((length - cosine) * log_ratio); }
    Float sample(Float u) const { return length - (length + 1.0f) * exp(-u * log_ratio); }
    Float stretch(Float cosine) const { return 1.0f - cosine / length; }
};

Vec3 around(Vec3 axis, Float cosine, Float u) {
    Float s, c;
    sincos(k_two_pi * u, s, c);
    const Float sine = safe_sqrt(1.0f - cosine * cosine);
    return Frame(axis).to_world({sine * c, sine * s, cosine});
}

/// Density of the distance (or of passing it), by channel.
Spectrum distance_pdf(Spectrum extinction, Float t, Mask hit) {
    const Spectrum through = exp(extinction * -t);
    return select(hit, through, extinction * through);
}

/// The way of one step and the densities that other ways of choosing it would have had.
struct Step {
    Float stretch_sampled = 1.0f;  ///< of the distance, by the technique that was chosen
    Float forward = 0.0f, backward = 0.0f, backward_share = 0.0f;
    Float stretch_forward = 1.0f, stretch_backward = 1.0f;
};

/// Chooses where a scattered walk goes: by the phase function, or guided toward one of the two surfaces.
Step turn(WalkLanes& w, const Dwivedi& guide, Float anisotropy, Float guided_share, const WalkRandom& random) {
    Step s;
    const Mask guided = random(number_guided) < guided_share;
    const Mask thin = w.opposite >= Float(0.0f);
    const Float depth = clamp(-dot(w.position - w.entry, w.normal), Float(0.0f), max(w.opposite, 0.0f));
    s.backward_share = select(thin, 1.0f / (1.0f + exp((w.opposite - 2.0f * depth) / guide.length)), Float(0.0f));
    const Mask back = random(number_backward) < s.backward_share;
    const Float u0 = random(number_cosine), u1 = random(number_angle);
    const Float toward = guide.sample(u0);
    const Vec3 by_guide = around(w.normal, select(back, -toward, toward), u1);
    const Vec3 parameter{anisotropy, 0.0f, 0.0f};
    const PhaseSample by_phase = sample_phase(bsdf::PhaseKind::henyey_greenstein, parameter, -w.direction, u0, u1);
    const Vec3 d = select(guided, by_guide, by_phase.wi);
    const Float phase = eval_phase(bsdf::PhaseKind::henyey_greenstein, parameter, dot(w.direction, d));
    const Float cosine = clamp(dot(d, w.normal), -1.0f, 1.0f);
    w.direction = d;
    const Float per_phase = 1.0f / (k_two_pi * max(phase, 1e-20f));
    s.forward = guide.pdf(cosine) * per_phase;
    s.backward = guide.pdf(-cosine) * per_phase;
    s.stretch_forward = guide.stretch(cosine);
    s.stretch_backward = guide.stretch(-cosine);
    s.stretch_sampled = select(guided, select(back, s.stretch_backward, s.stretch_forward), Float(1.0f));
    return s;
}

}  // namespace

void Tracer::step_walks(int step, int i, int end) {
    path::Subsurface& q = scratch.walks;
    const Mask lanes = first_lanes(end - i);
    WalkLanes w = load_walk(q, i);
    // Masked lanes hold what earlier batches left.
    w.ray = select(lanes, w.ray, Int(0));
    const Int path = gather(now->path, w.ray);
    const Int event = event_of(gather(now->depth, w.ray), gather(now->transparent, w.ray));
    const WalkRandom random =
        walk_random(gather(scratch.pixel_seed, path), gather(scratch.sample_index, path), event, step);
    const bool similar = step > k_similar_after;
    const Float anisotropy = similar ? Float(0.0f) : w.anisotropy;
    Spectrum extinction = w.extinction, scattering = w.extinction * w.albedo;
    if (similar) {
        const Spectrum reduced = scattering * (1.0f - w.anisotropy);
        extinction = extinction - scattering + reduced;
        scattering = reduced;
    }
    const Dwivedi guide(max_component(w.albedo));
    const Float guided_share = similar ? Float(0.75f) : 1.0f - max(pow(w.anisotropy, 0.125f), 0.5f);
    Step s;
    if (step > 0) s = turn(w, guide, anisotropy, guided_share, random);
    const ChannelChoice channel = choose_channel(w.throughput * w.albedo, random(number_channel));
    const Float sampled = channel_of(extinction, channel.channel) * s.stretch_sampled;
    Float t = -log(1.0f - random(number_distance)) / max(sampled, 1e-20f);

    RayLanes ray{w.position, w.direction, 0.0f, t, 0.0f, Int(-1)};
    // The first ray looks further: it also tells how thick the object is.
    const Float least = min(extinction.r, min(extinction.g, extinction.b));
    if (step == 0) ray.t_max = max(t, 10.0f / max(least, 1e-20f));
    // The walk starts at the surface itself: moved inside by the offset of rays, short radii would lose light.
    if (step == 0) ray.t_min = max(-w.opposite, 0.0f);
    scratch.counters.rays += static_cast<std::uint64_t>(count(lanes));
    const HitLanes h = intersect_only(scene, ray, w.instance, lanes);
    const Mask hit = h.hit & (h.t < t);
    if (step == 0) {
        const Vec3 far = w.position + w.direction * h.t;
        w.opposite = select(h.hit, max(-dot(far - w.entry, w.normal), 0.0f), w.opposite);
    }
    t = select(hit, h.t, t);
    w.position = w.position + w.direction * t;

    Spectrum pdf = distance_pdf(extinction, t, hit);
    if (step > 0) {
        const Spectrum forward = distance_pdf(extinction * s.stretch_forward, t, hit) * s.forward;
        const Spectrum backward = distance_pdf(extinction * s.stretch_backward, t, hit) * s.backward;
        pdf = mix(pdf, mix(forward, backward, s.backward_share), guided_share);
    }
    const Spectrum through = exp(extinction * -t);
    const Float whole = max(dot(channel.probability, pdf), 1e-37f);
    w.throughput *= select(hit, through, scattering * through) * (1.0f / whole);
    const Float most = max_component(w.throughput);
    const Mask alive = lanes & (most > Float(k_least_throughput)) & (most < Float(1e30f));
    const Mask out = alive & hit;
    if (any(out)) {
        const Int triangle = select(out, h.triangle, Int(0)), instance = select(out, h.instance, Int(0));
        append_exit(scratch.exits, w, w.position,
                    surface_normals(scene, instance, triangle, h.ng, h.u, h.v, w.direction), h, out);
    }
    append_walk(q, w, alive & ~hit);
}

void Tracer::walk_subsurface() {
    path::Subsurface& q = scratch.walks;
    scratch.exits.n = 0;
    for (int step = 0; step < k_walk_steps && q.n > 0; ++step) {
        const int end = q.n;
        q.n = 0;
        for (int i = 0; i < end; i += W) step_walks(step, i, end);
    }
    q.n = 0;
    for (int i = 0; i < scratch.disks.n; i += W) project_disk(i);
    scratch.disks.n = 0;
    leave_subsurface();
}

}  // namespace cardioid::CD_ISA_NS
