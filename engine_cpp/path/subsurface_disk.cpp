// SPDX-License-Identifier: GPL-3.0-or-later
// Burley's normalised diffusion (Christensen and Burley 2015) by projecting points of a disk onto the object (King, Kulla, Conty
// and Fajardo 2013): three axes, weighted by the power heuristic, one hit kept in proportion to its weight. As Cycles.
#include "path/subsurface.h"

namespace cardioid::CD_ISA_NS {

namespace {

/// The profile ends at so many d; its share inside.
constexpr float k_truncate = 16.0f, k_truncated_share = 0.9963790093708328f;
constexpr int k_most_hits = 32;
enum DiskNumber : int { number_channel, number_radius, number_axis, number_keep };

/// Density of the distance r: (e^(-r/d) + e^(-r/3d)) / 4d inside the truncation.
Float profile(Float d, Float r) {
    const Float safe = max(d, 1e-20f), third = exp(r / (-3.0f * safe));
    const Float value = (third * third * third + third) / (4.0f * safe * k_truncated_share);
    return select((d > Float(0.0f)) & (r < k_truncate * d), value, Float(0.0f));
}
Spectrum profile(Spectrum d, Float r) { return {profile(d.r, r), profile(d.g, r), profile(d.b, r)}; }

/// r/d where the profile's share inside is u: Newton's method on 1 - e^(-r)/4 - 3 e^(-r/3)/4.
Float quantile(Float u) {
    Float r = select(u < Float(0.9f), exp(u * u * 2.4f) - 1.0f, Float(15.0f));
    for (int k = 0; k < 6; ++k) {
        const Float third = exp(r * (-1.0f / 3.0f)), whole = third * third * third;
        const Float excess = 1.0f - 0.25f * whole - 0.75f * third - u;
        r = max(r - excess / max(0.25f * whole + 0.25f * third, 1e-20f), 0.0f);
    }
    return r;
}

/// The disk's normal n and its other axes, with the chance that each was the disk's normal, for points that lie on n's disk.
struct Axes {
    Vec3 n, s, t;
    Float share_n, share_s, share_t;
};
Axes choose_axes(Vec3 normal, Float& u) {
    const Frame frame(normal);
    const Mask first = u < Float(0.5f), second = ~first & (u < Float(0.75f)), third = ~(first | second);
    u = select(first, 2.0f * u, select(second, 4.0f * (u - 0.5f), 4.0f * (u - 0.75f)));
    Axes a;
    a.n = select(first, frame.n, select(second, frame.s, frame.t));
    a.s = select(second, frame.n, frame.s);
    a.t = select(third, frame.n, frame.t);
    a.share_n = select(first, Float(0.5f), Float(0.25f));
    a.share_s = select(second, Float(0.5f), Float(0.25f));
    a.share_t = select(third, Float(0.5f), Float(0.25f));
    return a;
}

}  // namespace

void Tracer::project_disk(int i) {
    const path::Subsurface& q = scratch.disks;
    Mask lanes = first_lanes(q.n - i);
    WalkLanes w = load_walk(q, i);
    w.ray = select(lanes, w.ray, Int(0));
    const Int path = gather(now->path, w.ray);
    const Int event = event_of(gather(now->depth, w.ray), gather(now->transparent, w.ray));
    const WalkRandom random =
        walk_random(gather(scratch.pixel_seed, path), gather(scratch.sample_index, path), event, -1);

    Float u = random(number_axis);
    const Axes axes = choose_axes(w.direction, u);
    const Spectrum d = w.extinction;
    const auto one = [](Float x) { return select(x > Float(0.0f), Float(1.0f), Float(0.0f)); };
    const Spectrum present{one(d.r), one(d.g), one(d.b)};
    const Float channels = present.r + present.g + present.b;
    lanes &= channels > Float(0.0f);
    const Float chosen = channel_of(d, choose_channel(present, random(number_channel)).channel);
    const Float r = quantile(random(number_radius) * k_truncated_share) * chosen;
    const Float height = safe_sqrt(k_truncate * k_truncate * chosen * chosen - r * r);
    Float s, c;
    sincos(k_two_pi * u, s, c);
    const Spectrum p_disk = profile(d, r);
    const Float disk_pdf = (p_disk.r + p_disk.g + p_disk.b) / max(channels, 1.0f);
    lanes &= disk_pdf > Float(0.0f);

    RayLanes ray;
    ray.o = w.entry + axes.n * height + axes.s * (r * c) + axes.t * (r * s);
    ray.d = -axes.n;
    ray.t_min = 0.0f;
    ray.t_max = 2.0f * height;
    ray.time = 0.0f;
    ray.mask = Int(-1);
    HitLanes kept{};
    SurfaceNormals normals{};
    kept.t = kept.u = kept.v = 0.0f;
    kept.instance = kept.triangle = Int(0);
    Spectrum weight_kept(0.0f);
    Float sum = 0.0f;
    const Mask backfacing = (w.kind & Int(path::walk_backfacing)) != Int(0);
    Mask search = lanes;
    for (int k = 0; k < k_most_hits && any(search); ++k) {
        const HitLanes h = intersect_only(scene, ray, w.instance, search);
        search &= h.hit;
        if (none(search)) break;
        SurfaceNormals at = surface_normals(scene, select(search, h.instance, Int(0)),
                                            select(search, h.triangle, Int(0)), h.ng, h.u, h.v, -ray.d);
        const Float p_n = axes.share_n * abs(dot(axes.n, at.ng)), p_s = axes.share_s * abs(dot(axes.s, at.ng)),
                    p_t = axes.share_t * abs(dot(axes.t, at.ng));
        const Float axis_weight = p_n / max(p_n * p_n + p_s * p_s + p_t * p_t, 1e-20f);
        const Float distance = length(ray.o + ray.d * h.t - w.entry);
        const Spectrum weight = profile(d, distance) * (axis_weight / max(disk_pdf, 1e-30f));
        const Float size = select(search, average(weight), Float(0.0f));
        sum += size;
        const Float chance = unit_float(hash(random.seed + Int(number_keep + k)));
        const Mask keep = search & (chance * sum < size);
        // Out is the side of the mesh's own normal, or the other where light entered from within.
        const Mask turn = at.backfacing ^ backfacing;
        normals.ng = select(keep, select(turn, -at.ng, at.ng), normals.ng);
        normals.n = select(keep, select(turn, -at.n, at.n), normals.n);
        kept.t = select(keep, h.t, kept.t);
        kept.u = select(keep, h.u, kept.u);
        kept.v = select(keep, h.v, kept.v);
        kept.instance = select(keep, h.instance, kept.instance);
        kept.triangle = select(keep, h.triangle, kept.triangle);
        weight_kept = select(keep, weight * (1.0f / max(size, 1e-30f)), weight_kept);
        ray.t_min = select(search, h.t + offset_step(ray.o, h.t), ray.t_min);
        search &= ray.t_min < ray.t_max;
        scratch.counters.rays += static_cast<std::uint64_t>(count(search));
    }
    w.throughput *= weight_kept * sum;
    append_exit(scratch.exits, w, ray.o + ray.d * kept.t, normals, kept, lanes & (sum > Float(0.0f)));
}

}  // namespace cardioid::CD_ISA_NS
