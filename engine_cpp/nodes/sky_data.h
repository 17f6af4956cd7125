// SPDX-License-Identifier: GPL-3.0-or-later
// data of the sky_image op, and what a program's skies tell about their suns.
#pragma once

#include "math/types.h"
#include "nodes/instructions.h"

#include <vector>

namespace cardioid::nodes {

enum SkyData : int {
    sky_bottom = 0,     ///< XYZ at the lowest point of the sun
    sky_top = 3,        ///< and at the highest
    sky_elevation = 6,  ///< of the sun
    sky_rotation = 7,
    sky_diameter = 8,  ///< angle; below 0: no disc
    sky_intensity = 9,
    sky_ground = 10,  ///< elevation below which the ground hides the sun
    sky_width = 11,
    sky_height = 12,
    sky_sun = 13,     ///< direction towards the sun
    sky_pixels = 16,  ///< XYZ
};

/// A sun's disc that a program emits for directions around `direction`, in the space of the Sky Texture's vector.
struct SkySun {
    Float3 direction;
    float half_angle = 0;
    float power = 0;  ///< rough mean radiance of the disc (Y) × its solid angle
};
/// Suns of the skies in a program: too small for a map of the environment. Empty for most worlds.
std::vector<SkySun> sky_suns(const Program& program);

}  // namespace cardioid::nodes
