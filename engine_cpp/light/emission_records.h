// SPDX-License-Identifier: GPL-3.0-or-later
// What photon emission (light/emit.h) needs beyond the records of sampling: where lamps aim, and how much flux emitters send.
#pragma once

#include "light/lamp_records.h"

namespace cardioid::light {

struct EmissionRecord {
    float value[k_emission_floats] = {};
};

/// Directions of a point or spot lamp; zeros for other kinds.
EmissionRecord make_emission_record(const LampRecord& lamp, const Sphere& casters);

/// What photons are sent into, once it is known.
struct EmissionTargets {
    Sphere scene, casters;
};

/// Shares of an emitter's photons start by this power (W): so that those that are aimed at casters carry the same flux for all
/// emitters. 0 where the emitter sends none.
float lamp_emission_power(const LampInput& in, const LampRecord& lamp, const EmissionRecord& emission,
                          const EmissionTargets& targets);
float triangle_emission_power(const EmissiveTriangle& triangle, float area);
/// `brightness`: mean radiance over all directions.
float world_emission_power(float brightness, const EmissionTargets& targets);

/// Sphere around a box; radius 0 where the box is empty or not finite.
Sphere sphere_around(Float3 low, Float3 high);

}  // namespace cardioid::light
