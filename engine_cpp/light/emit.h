// SPDX-License-Identifier: GPL-3.0-or-later
// Photons leave emitters, over W lanes. Emission is a map from the unit cube [0,1)⁴ (point, direction) to rays, one for each
// emitter, continuous enough that neighbours in the cube are neighbours in space: photon/guide.h learns densities in the cube.
//
// Half of the emission of suns, of the world and of point-like lamps is aimed at the sphere around the specular casters
// (LightData::casters), the other half covers the whole scene; the map is one-to-one, so the density is exact and the same
// seen from both ends.
#pragma once

#include "light/light_data.h"
#include "simd/vec.h"

namespace cardioid::CD_ISA_NS {

/// A photon at birth, given its emitter.
struct PhotonRay {
    Vec3 origin, direction;  ///< unit direction, away from the emitter; infinite emitters start outside of the scene
    Vec3 normal;             ///< of the emitter, on the side of direction; suns and world: direction
    Spectrum
        flux;  ///< W that one photon stands for: radiance·|cos| / (density of point and direction); where program >= 0
               ///< it multiplies that program's emission
    Float density;  ///< of the ray per m² and projected sr (m² across the direction per sr), given the emitter;
                    ///< delta lamps: per sr, nothing can hit them
    /// Where the photon's first hit counts, as distances from the origin; [0, 1e30] for most. A photon that hits something
    /// nearer or farther ends there and leaves nothing: the inside of a sphere lamp has photons of its own, and close to a lamp
    /// that is a facing disk only some of its rays are there. Emission looks exactly like sample_light from everywhere.
    Float t_min, t_max;
    Mask valid;                          ///< false: no light goes this way, or nothing is there to be hit
    Int program, instance, triangle;     ///< as LightSample's
    Float barycentric_u, barycentric_v;  ///< as LightSample's
    Int visibility, max_bounces;         ///< scene::Visibility bits of the lamp or world
    Mask infinite;
};

/// `emitter`: ids of LightData with power > 0; inactive lanes may hold anything.
PhotonRay emit_photon(const light::LightData& lights, Int emitter, Vec2 u_point, Vec2 u_direction, Mask active);

/// PhotonRay::density of the ray that a camera path has met from the other end: it hit lamp `id`, travelling along
/// the unit direction d from p, its origin (not the hit: a sphere is another lamp from inside). 0: emit_photon never makes it.
Float lamp_emission_density(const light::LightData& lights, int id, Vec3 p, Vec3 d, Mask active);
/// Of a hit on emissive triangle (instance, triangle); 0 where it is not in the table. `emitter`: its id, -1 where there is none.
Float triangle_emission_density(const light::LightData& lights, Int instance, Int triangle, Int& emitter, Mask active);
/// Of a ray that left the scene toward the unit direction d, from p.
Float environment_emission_density(const light::LightData& lights, Vec3 p, Vec3 d, Mask active);

}  // namespace cardioid::CD_ISA_NS
