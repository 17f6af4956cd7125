// SPDX-License-Identifier: GPL-3.0-or-later
// Point and spot lamps with a radius: spheres, or disks that face the receiver. Both are seen as a cone of directions.
#pragma once

#include "light/cone.h"
#include "light/fetch.h"

namespace cardioid::CD_ISA_NS {

/// The spot's own factor for light that leaves toward -wi: smooth edge, and the cosine of Blender before 4.0.
inline Float spot_attenuation(const light::LightData& lights, RecordIndex index, Int flags, Vec3 wi) {
    namespace lamp = light::lamp;
    const Vec3 d = -wi;
    const Vec3 local{dot(fetch3(lights.lamp, index, lamp::spot_rows), d),
                     dot(fetch3(lights.lamp, index, lamp::spot_rows + 3), d),
                     dot(fetch3(lights.lamp, index, lamp::spot_rows + 6), d)};
    const Float z = local.z / sqrt(max(length_squared(local), 1e-37f));
    const Float t =
        saturate((z - fetch(lights.lamp, index, lamp::spot_cos)) * fetch(lights.lamp, index, lamp::spot_inv_blend));
    const Float smooth = t * t * (3.0f - 2.0f * t);
    const Mask cosine = (flags & Int(lamp::spot_cosine)) != Int(0);
    return select((flags & Int(lamp::is_spot)) != Int(0), select(cosine, smooth * z, smooth), Float(1.0f));
}

/// Radiance of a sun before Blender 4.0 grows toward its edge: there it is a flat disk.
inline Float sun_factor(const light::LightData& lights, RecordIndex index, Int flags, Vec3 wi) {
    namespace lamp = light::lamp;
    const Float c = max(dot(wi, fetch3(lights.lamp, index, lamp::position)), 1e-4f);
    return select((flags & Int(lamp::legacy_sun)) != Int(0), 1.0f / (c * c * c), Float(1.0f));
}

struct SeenBall {
    Vec3 to_center, toward;  ///< toward: unit
    Float d2, distance, r2;
    Float one_minus_cos;  ///< of the cone that it fills, or of the narrower cone that a spot lights
    Vec3 axis;            ///< of that cone
    Mask disk;            ///< facing disk, otherwise a sphere
    Mask within;          ///< the receiver is inside the sphere: light comes from all around
    Mask by_spot;         ///< the spot's cone is sampled: directions may miss
};

inline SeenBall see_ball(const light::LightData& lights, RecordIndex index, Mask disk, Int flags, Vec3 p) {
    namespace lamp = light::lamp;
    SeenBall b;
    b.to_center = fetch3(lights.lamp, index, lamp::position) - p;
    b.d2 = max(length_squared(b.to_center), 1e-30f);
    b.distance = sqrt(b.d2);
    // In the very middle of a lamp any direction is as good as another.
    b.toward = select(b.d2 > Float(1e-30f), b.to_center * (1.0f / b.distance), Vec3{0.0f, 0.0f, 1.0f});
    b.r2 = fetch(lights.lamp, index, lamp::radius_squared);
    b.disk = disk;
    b.within = ~disk & (b.d2 <= b.r2);
    const Float sin2 = clamp(b.r2 / select(disk, b.d2 + b.r2, b.d2), 1e-30f, 1.0f);
    b.one_minus_cos = one_minus_cos_of_sin2(sin2);
    b.axis = b.toward;
    b.by_spot = mask_of(false);
    const Mask spot = ((flags & Int(lamp::is_spot)) != Int(0)) & ~b.within;
    if (any(spot)) {
        const Float spot_cone = fetch(lights.lamp, index, lamp::spot_one_minus_cos);
        b.by_spot = spot & (spot_cone < b.one_minus_cos);
        b.one_minus_cos = select(b.by_spot, spot_cone, b.one_minus_cos);
        b.axis = select(b.by_spot, -fetch3(lights.lamp, index, lamp::normal), b.axis);
    }
    return b;
}

/// Distance along the unit direction d to the lamp's surface.
struct BallHit {
    Float t;
    Mask hit;
};
inline BallHit hit_ball(const SeenBall& b, Vec3 d) {
    const Float along = dot(b.to_center, d);
    const Float half2 = b.r2 - length_squared(b.to_center - d * along);
    const Float half = safe_sqrt(half2);
    const Float sphere_t = select(b.within, along + half, along - half);
    const Float cosine = dot(b.toward, d);
    const Float disk_t = b.distance / max(cosine, 1e-12f);
    const Mask disk_hit = (cosine > Float(1e-6f)) & (length_squared(d * disk_t - b.to_center) < b.r2);
    const Mask sphere_hit = (half2 >= Float(0.0f)) & (sphere_t > Float(0.0f));
    return {select(b.disk, disk_t, sphere_t), select(b.disk, disk_hit, sphere_hit)};
}

inline Float ball_pdf(const SeenBall& b, LightReceiver at, Vec3 d) {
    const Float cone = cone_pdf(b.one_minus_cos);
    return any(b.within) ? select(b.within, pdf_all_around(at, d), cone) : cone;
}

struct BallSample {
    Vec3 wi, normal;
    Float t, pdf;
    Mask valid;
};

/// Inside of its own cone every direction meets the lamp; distance and normal then come without cancellation.
inline BallSample sample_ball_cone(const SeenBall& b, Float u, Float v) {
    const ConeDirection cone = sample_cone(b.one_minus_cos, u, v);
    const Frame frame(b.axis);
    BallSample out;
    out.wi = frame.to_world(cone.local);
    const Float half = safe_sqrt(b.r2 - b.d2 * cone.sin2);
    out.t = select(b.disk, b.distance / cone.local.z, max(b.distance * cone.local.z - half, 0.0f));
    const Vec3 from_center =
        Vec3{out.t * cone.local.x, out.t * cone.local.y, -(b.distance * cone.sin2 + half * cone.local.z)};
    out.normal = select(b.disk, -out.wi, normalize(frame.to_world(from_center)));
    out.pdf = cone_pdf(b.one_minus_cos);
    out.valid = mask_of(true);
    return out;
}

inline BallSample sample_ball(const SeenBall& b, LightReceiver at, Float u, Float v) {
    BallSample out = sample_ball_cone(b, u, v);
    const Mask general = b.within | b.by_spot;
    if (none(general)) return out;
    const AllAround around = sample_all_around(at, u, v);
    const Vec3 wi = select(b.within, around.wi, out.wi);
    const BallHit hit = hit_ball(b, wi);
    const Vec3 normal = select(b.disk, -wi, normalize(wi * hit.t - b.to_center));
    out.wi = select(general, wi, out.wi);
    out.normal = select(general, normal, out.normal);
    out.t = select(general, hit.t, out.t);
    out.pdf = select(b.within, around.pdf, out.pdf);
    out.valid = ~general | (hit.hit & (out.pdf > Float(0.0f)));
    return out;
}

}  // namespace cardioid::CD_ISA_NS
