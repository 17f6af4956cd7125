// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes that send rays. Bevel: BSSRDF importance sampling (King et al. 2013) with a cubic falloff, as in Cycles.
#include "nodes/kernel.h"
#include "simd/sampler.h"

namespace cardioid::CD_ISA_NS {

using nodes::Instruction;
using nodes::NodeHits;
using nodes::NodeRays;

namespace {

constexpr int k_max_bevel_hits = 8;  ///< surfaces along one line

bool can_send(const Machine& m) { return m.chunk.rays != nullptr && m.chunk.rays->closest != nullptr; }

void send(const Machine& m, const NodeRays& rays, NodeHits& hits) {
    m.chunk.rays->closest(m.chunk.rays->scene, rays, hits, m.end);
}

/// Sample k of a sequence that fills the square evenly (R2, Roberts 2018), turned by the lanes' seeds.
Vec2 square_point(const Machine& m, int i, int k) {
    const Int seed = load(m.chunk.random_seed + i) & Int(0x7fffffff);
    const auto turn = [&](Int h, double step) {
        const Float u =
            to_float(h >> 8) * (1.0f / 16777216.0f) + static_cast<float>(step * k - __builtin_floor(step * k));
        return u - floor(u);
    };
    return {turn(hash(seed), 0.7548776662466927), turn(hash(seed ^ Int(0x2545f491)), 0.5698402909980532)};
}

void put(Row (&rows)[3], int i, Vec3 v) {
    store(rows[0] + i, v.x);
    store(rows[1] + i, v.y);
    store(rows[2] + i, v.z);
}

/// Clear of the surface that the lanes are on: as far as rounding may have moved them.
Float clearance(Vec3 p) { return max(max(abs(p.x), abs(p.y)), abs(p.z)) * 8e-6f + 1e-12f; }

/// x with 10x² - 20x³ + 15x⁴ - 4x⁵ = u: the radius below which a share u of the cubic falloff lies.
Float falloff_radius(Float u) {
    Float x = 0.25f;
    for (int k = 0; k < 10; ++k) {
        const Float x2 = x * x, rest = 1.0f - x;
        const Float f = x2 * (10.0f + x * (-20.0f + x * (15.0f - 4.0f * x))) - u,
                    slope = 20.0f * x * rest * rest * rest;
        x = select((abs(f) < Float(1e-6f)) | (slope == Float(0.0f)), x, saturate(x - f / max(slope, 1e-20f)));
    }
    return x;
}

/// Unnormalised cubic falloff; 0 from the radius on.
Float falloff(Float radius, Float r) {
    const Float rest = max(radius - r, 0.0f);
    return rest * rest * rest;
}

/// The axis along which a bevel looks, two across, and the chance of having picked each.
struct Disk {
    Vec3 axis, s, t;
    Float pick_axis, pick_s, pick_t;
    Float angle;
};

Disk pick_disk(Vec3 n, Float u) {
    const Frame f(n);
    const Mask along = u < Float(0.5f), first = u < Float(0.75f);
    Disk d;
    d.axis = select(along, f.n, select(first, f.s, f.t));
    d.s = select(along | ~first, f.s, f.n);
    d.t = select(along | first, f.t, f.n);
    const Float half = 0.5f, quarter = 0.25f;
    d.pick_axis = select(along, half, quarter);
    d.pick_s = select(~along & first, half, quarter);
    d.pick_t = select(first, quarter, half);
    const Float rest = select(along, u * 2.0f, select(first, (u - 0.5f) * 4.0f, (u - 0.75f) * 4.0f));
    d.angle = 2.0f * k_pi * rest;
    return d;
}

struct BevelRows {
    Row axis[3], s[3], t[3], pick[3], r;
};

/// Rays of sample k through all lanes.
void aim_bevel(const Machine& m, const Source& radius, int k, NodeRays& rays, BevelRows& rows) {
    for (int i = 0; i < m.end; i += W) {
        const Vec2 u = square_point(m, i, k);
        const Disk d = pick_disk(load3(m.chunk.normal_geometric, i), u.x);
        const Float size = radius.at(i), r = falloff_radius(u.y) * size, height = safe_sqrt(size * size - r * r);
        const Vec3 p = load3(m.chunk.position, i);
        put(rays.origin, i, p + d.axis * height + (d.s * cos(d.angle) + d.t * sin(d.angle)) * r);
        put(rays.direction, i, -d.axis);
        const Mask on =
            (size > Float(0.0f)) & (load(m.chunk.random_seed + i) >= Int(0)) & (load(m.chunk.instance + i) >= Int(0));
        store(rays.t_min + i, Float(0.0f));
        store(rays.t_max + i, select(on, 2.0f * height, Float(-1.0f)));
        store(rays.only + i, load(m.chunk.instance + i));
        put(rows.axis, i, d.axis);
        put(rows.s, i, d.s);
        put(rows.t, i, d.t);
        put(rows.pick, i, {d.pick_axis, d.pick_s, d.pick_t});
        store(rows.r + i, r);
    }
}

/// Adds the normals that were hit; false when none was. Rays go on behind their hits.
bool gather_bevel(const Machine& m, const Source& radius, NodeRays& rays, const NodeHits& hits, const BevelRows& rows,
                  Row (&sum)[3]) {
    bool more = false;
    for (int i = 0; i < m.end; i += W) {
        const Float t = load(hits.t + i), size = radius.at(i), r = load(rows.r + i);
        const Mask hit = (load(hits.instance + i) >= Int(0)) & (load(rays.t_max + i) >= load(rays.t_min + i));
        if (none(hit)) {
            store(rays.t_max + i, Float(-1.0f));
            continue;
        }
        more = true;
        const Vec3 ng = load3(hits.normal_geometric, i), p = load3(rays.origin, i) + load3(rays.direction, i) * t;
        const auto density = [&](const Row(&axis)[3], int c) {
            return load(rows.pick[c] + i) * abs(dot(load3(axis, i), ng));
        };
        const Float a = density(rows.axis, 0), b = density(rows.s, 1), c = density(rows.t, 2);
        const Float wide = falloff(size, r), far = falloff(size, length(p - load3(m.chunk.position, i)));
        Float w = a / max(a * a + b * b + c * c, 1e-20f) * far / max(wide, 1e-30f);
        w = select(hit & (wide > Float(0.0f)), w, Float(0.0f));
        put(sum, i, load3(sum, i) + load3(hits.normal, i) * w);
        store(rays.t_min + i, t + clearance(p));
        store(rays.t_max + i, select(hit, load(rays.t_max + i), Float(-1.0f)));
    }
    return more;
}

}  // namespace

void op_ambient_occlusion(const Machine& m, const Instruction& in) {
    const int samples = static_cast<int>(in.imm & nodes::ray_samples_mask);
    const bool inside = (in.imm & nodes::rays_inside) != 0, local = (in.imm & nodes::rays_local) != 0;
    const Source distance = m.arg(in, 0);
    const Source3 normal = m.arg3(in, 1);
    float* open = m.dst(in);
    for (int i = 0; i < m.end; i += W) store(open + i, Float(can_send(m) && samples > 0 ? 0.0f : 1.0f));
    if (!can_send(m) || samples < 1) return;
    NodeRays rays;
    NodeHits hits;
    for (int k = 0; k < samples; ++k) {
        for (int i = 0; i < m.end; i += W) {
            const Vec3 n = normalize(normal.at(i)), p = load3(m.chunk.position, i);
            const Frame frame(inside ? -n : n);
            const Vec2 u = square_point(m, i, k);
            const Float r = sqrt(u.x), angle = 2.0f * k_pi * u.y;
            const Vec3 d = frame.s * (r * cos(angle)) + frame.t * (r * sin(angle)) + frame.n * safe_sqrt(1.0f - u.x);
            const Vec3 ng = load3(m.chunk.normal_geometric, i);
            put(rays.origin, i, p + ng * copysign(clearance(p), dot(ng, d)));
            put(rays.direction, i, d);
            const Int instance = load(m.chunk.instance + i);
            const Mask on = (distance.at(i) > Float(0.0f)) & (instance >= Int(0));
            store(rays.t_min + i, Float(0.0f));
            store(rays.t_max + i, select(on, distance.at(i), Float(-1.0f)));
            store(rays.only + i, local ? instance : Int(-2));
        }
        send(m, rays, hits);
        for (int i = 0; i < m.end; i += W) {
            const Mask free = load(hits.instance + i) < Int(0);
            store(open + i, load(open + i) + select(free, Float(1.0f / static_cast<float>(samples)), Float(0.0f)));
        }
    }
}

void op_bevel(const Machine& m, const Instruction& in) {
    const int samples = can_send(m) ? static_cast<int>(in.imm) : 0;
    const Source radius = m.arg(in, 0);
    alignas(64) Row sum[3];
    for (int i = 0; i < m.end; i += W) put(sum, i, {0.0f, 0.0f, 0.0f});
    NodeRays rays;
    NodeHits hits;
    alignas(64) BevelRows rows;
    for (int k = 0; k < samples; ++k) {
        aim_bevel(m, radius, k, rays, rows);
        for (int h = 0; h < k_max_bevel_hits; ++h) {
            send(m, rays, hits);
            if (!gather_bevel(m, radius, rays, hits, rows, sum)) break;
        }
    }
    for (int i = 0; i < m.end; i += W) {
        const Vec3 s = load3(sum, i);
        const Float size = dot(s, s);
        const Vec3 n = s * (1.0f / sqrt(max(size, 1e-30f)));
        const Vec3 sided = select(load(m.chunk.backfacing + i) > Float(0.0f), -n, n);
        store_vec(m, in, 0, i, select(size > Float(1e-30f), sided, load3(m.chunk.normal, i)));
    }
}

void op_raycast(const Machine& m, const Instruction& in) {
    const Source3 from = m.arg3(in, 0), towards = m.arg3(in, 3);
    const Source length = m.arg(in, 6);
    NodeRays rays;
    NodeHits hits;
    for (int i = 0; i < m.end; i += W) {
        const Vec3 o = from.at(i), d = towards.at(i), p = load3(m.chunk.position, i),
                   ng = load3(m.chunk.normal_geometric, i);
        const Int instance = load(m.chunk.instance + i);
        const Mask here = (o.x == p.x) & (o.y == p.y) & (o.z == p.z);
        put(rays.origin, i, select(here, o + ng * copysign(clearance(p), dot(ng, d)), o));
        put(rays.direction, i, d);
        const Mask on = (length.at(i) > Float(0.0f)) & (instance >= Int(0)) & (dot(d, d) > Float(0.0f));
        store(rays.t_min + i, Float(0.0f));
        store(rays.t_max + i, select(on, length.at(i), Float(-1.0f)));
        store(rays.only + i, (in.imm & nodes::rays_local) != 0 ? instance : Int(-1));
        store(hits.instance + i, Int(-1));
    }
    if (can_send(m)) send(m, rays, hits);
    const Float one = 1.0f, zero = 0.0f;
    for (int i = 0; i < m.end; i += W) {
        const Int instance = load(hits.instance + i);
        const Mask hit = instance >= Int(0);
        const Vec3 n = load3(hits.normal, i), ng = load3(hits.normal_geometric, i);
        const Vec3 facing = select(dot(ng, towards.at(i)) > zero, -n, n);
        store(m.dst(in, 0) + i, select(hit, one, zero));
        store(m.dst(in, 1) + i, select(hit & (instance == load(m.chunk.instance + i)), one, zero));
        store(m.dst(in, 2) + i, select(hit, load(hits.t + i), length.at(i)));
        store_vec(m, in, 3, i, select(hit, facing, Vec3{0.0f, 0.0f, 0.0f}));
    }
}

}  // namespace cardioid::CD_ISA_NS
