// SPDX-License-Identifier: GPL-3.0-or-later
// Light sampling over W lanes. Densities are per solid angle at the shading point and include the probability of choosing
// the emitter, so that sample_light and the pdf_* functions make exact MIS pairs.
#pragma once

#include "light/light_data.h"
#include "simd/vec.h"

namespace cardioid::CD_ISA_NS {

/// The place that is lit; `n` may be zero where light from both sides counts (translucency, glass).
struct LightReceiver {
    Vec3 p, n;
};

struct LightSample {
    Vec3 wi;             ///< unit, toward the light
    Float distance;      ///< 1e30 for the world and the sun
    Vec3 position, normal;  ///< on the emitter (world: direction, 0)
    Spectrum radiance;   ///< toward the receiver; where program >= 0 it multiplies that program's emission
    Float pdf;
    Mask valid;          ///< false: nothing to add
    Mask delta;          ///< lamp of size zero: radiance is an intensity already divided by distance², pdf is the choice's
    Int emitter;         ///< id in LightData
    Int program;         ///< emission program still to be evaluated at (position, barycentrics, instance, triangle), or -1
    Int instance, triangle;
    Float barycentric_u, barycentric_v;
    Mask casts_shadow;
    Mask infinite;
};

/// u.x chooses the emitter, (u.y, u.z) the point on it.
LightSample sample_light(const light::LightData& lights, LightReceiver at, Vec3 u, Mask active);

/// Density with which sample_light at `at` would have made this hit on emissive triangle (instance, triangle):
/// hit point and unit geometric normal of the triangle are given. 0 if it is not in the table.
Float pdf_triangle(const light::LightData& lights, LightReceiver at, Int instance, Int triangle, Vec3 hit, Vec3 hit_normal, Mask active);

/// Density of the unit direction `d` for the world.
Float pdf_environment(const light::LightData& lights, LightReceiver at, Vec3 d, Mask active);

/// A lamp crossed by the ray (o, d), 0 < t < t_max. Lamps do not occlude.
struct LampHit {
    Mask hit;
    Float t;
    Vec3 position, normal;
    Spectrum radiance;       ///< times the lamp's program where program >= 0
    Float pdf;               ///< as sample_light's, 0 where the lamp is not MIS-sampled
    int program;
    std::uint8_t visibility; ///< scene::Visibility bits of the lamp
};
/// Number of lamps with a surface (sun included, at infinity); loop over it for every ray that left by BSDF sampling.
int hittable_lamps(const light::LightData& lights);
LampHit intersect_lamp(const light::LightData& lights, int which, LightReceiver from, Vec3 d, Float t_max, Mask active);

}  // namespace cardioid::CD_ISA_NS
