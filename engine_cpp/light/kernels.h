// SPDX-License-Identifier: GPL-3.0-or-later
// Light sampling over W lanes. Densities are per solid angle at the shading point and include the probability of choosing
// the emitter, so that sample_light and the pdf_* functions make exact MIS pairs.
#pragma once

#include "light/light_data.h"
#include "simd/vec.h"

namespace cardioid::CD_ISA_NS {

/// The place that is lit. `n` (unit) promises that light from under its horizon adds nothing; it may be zero where light
/// from all sides counts (translucency, glass). A density belongs to the whole receiver: pass the same p and n to the pdf.
struct LightReceiver {
    Vec3 p, n;
};

struct LightSample {
    Vec3 wi;                ///< unit, toward the light
    Float distance;         ///< 1e30 for the world and the sun
    Vec3 position, normal;  ///< on the emitter (world: direction, 0; sun: direction, away from it)
    Spectrum radiance;      ///< toward the receiver; where program >= 0 it multiplies that program's emission
    Float pdf;
    Mask valid;  ///< false: nothing to add
    Mask
        delta;  ///< no BSDF-sampled ray finds this lamp (size zero, or without MIS): the sample has the full MIS weight.
                ///< Size zero: radiance is an intensity already divided by distance², pdf is the choice's alone
    Int emitter;  ///< id in LightData
    Int program;  ///< emission program still to be evaluated at (position, barycentrics, instance, triangle), or -1
    Int instance, triangle;              ///< -1 unless a triangle
    Float barycentric_u, barycentric_v;  ///< weights of the triangle's second and third corner
    Int visibility;                      ///< scene::Visibility bits of the lamp or world
    Int max_bounces;                     ///< bounces after which the lamp gives no light
    Mask casts_shadow;
    Mask infinite;
};

/// u.x chooses the emitter; what the choice leaves of it and u.y choose the point, so that each emitter's share of a
/// stratified sequence stays stratified.
LightSample sample_light(const light::LightData& lights, LightReceiver at, Vec2 u, Mask active);

/// Density with which sample_light at `at` would have made this hit on emissive triangle (instance, triangle):
/// hit point and unit geometric normal of the triangle are given. 0 if it is not in the table.
Float pdf_triangle(const light::LightData& lights, LightReceiver at, Int instance, Int triangle, Vec3 hit,
                   Vec3 hit_normal, Mask active);

/// Density of the unit direction `d` for the world.
Float pdf_environment(const light::LightData& lights, LightReceiver at, Vec3 d, Mask active);

/// A lamp crossed by the ray (o, d), 0 < t < t_max. Lamps do not occlude.
struct LampHit {
    Mask hit;
    Float t;  ///< 1e30 for a sun
    Vec3 position, normal;
    Spectrum radiance;  ///< times the lamp's program where program >= 0
    Float pdf;          ///< as sample_light's, 0 where the lamp is not MIS-sampled
    int program;
    int max_bounces;
    std::uint8_t
        visibility;  ///< scene::Visibility bits of the rays that may hit it (without use_mis: the camera at most)
};
/// Number of lamps with a surface (sun included, at infinity). A short list can be looped over for every ray that left by
/// BSDF sampling; LampWalk skips the far ones of a long list.
int hittable_lamps(const light::LightData& lights);
LampHit intersect_lamp(const light::LightData& lights, int which, LightReceiver from, Vec3 d, Float t_max, Mask active);

/// Visits the lamps that some active ray may cross, in logarithmic time: `LampWalk walk(...); while ((which = walk.next()) >= 0)`.
/// Suns are visited for every ray; t_max of a ray that hit nothing is 1e30.
class LampWalk {
public:
    LampWalk(const light::LightData& lights, Vec3 origin, Vec3 d, Float t_max, Mask active);
    /// Argument for intersect_lamp, or -1 at the end.
    int next();

private:
    bool crosses(int node) const;

    const light::LightData& lights_;
    Vec3 origin_, inverse_;
    Float t_max_;
    Mask active_;
    int stack_[64];
    int top_ = 0;
    int run_ = 0, run_end_ = 0;
};

}  // namespace cardioid::CD_ISA_NS
