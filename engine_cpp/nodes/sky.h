// SPDX-License-Identifier: GPL-3.0-or-later
// Skies that are computed when a graph is compiled, as Cycles does: pictures of XYZ over directions, the sun's disc, and the
// coefficients of the two analytic models. Angles in radians, altitude in metres.
#pragma once

#include "math/types.h"

#include <array>
#include <vector>

namespace cardioid::nodes {

struct Atmosphere {
    float sun_elevation = 0;
    float altitude = 1;
    float air = 1, aerosol = 1, ozone = 1;  ///< densities; 1: a clear day
};

/// Columns go around from the sun's opposite; rows get finer towards the horizon.
struct SkyImage {
    int width, height;
    std::vector<float> xyz;
    SkyImage(int w, int h) : width(w), height(h), xyz(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * 3) {}
    Float3 at(int x, int y) const {
        const std::size_t i =
            3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
        return {xyz[i], xyz[i + 1], xyz[i + 2]};
    }
};

/// XYZ radiance at the lowest and highest point of the sun.
struct SunDisc {
    Float3 bottom, top;
};

/// `whole`: both hemispheres, as from Blender 5.0 on; else the upper one.
SkyImage single_scattering(Atmosphere a, bool whole);
SunDisc single_scattering_sun(Atmosphere a, float diameter, bool whole);

/// García Liñán 2023 (MIT licence), from Blender 5.0 on.
SkyImage multiple_scattering(Atmosphere a);
SunDisc multiple_scattering_sun(Atmosphere a, float diameter);

/// Coefficients of an analytic sky: the sun's azimuth and zenith angle, three radiances, 9 numbers for each of three channels.
using AnalyticSky = std::array<float, 5 + 27>;
AnalyticSky preetham_sky(Float3 sun, float turbidity);
AnalyticSky hosek_sky(Float3 sun, float turbidity, float albedo);

}  // namespace cardioid::nodes
