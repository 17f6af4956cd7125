// SPDX-License-Identifier: GPL-3.0-or-later
// Directions toward the world: uniform colour by cosine (or the whole sphere), pictures by their importance map.
#pragma once

#include "light/cone.h"

namespace cardioid::CD_ISA_NS {

struct EnvironmentSample {
    Vec3 wi;
    Float pdf;  ///< without the choice of the world among the emitters
};

EnvironmentSample sample_environment(const light::LightData& lights, LightReceiver at, Float u, Float v);

/// The same density for a given unit direction.
Float environment_density(const light::LightData& lights, LightReceiver at, Vec3 d);

/// Directions that photons come from, and their density.
EnvironmentSample sample_sent_direction(const light::LightData& lights, Float u, Float v);
Float sent_direction_density(const light::LightData& lights, Vec3 d);

}  // namespace cardioid::CD_ISA_NS
