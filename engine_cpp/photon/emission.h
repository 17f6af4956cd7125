// SPDX-License-Identifier: GPL-3.0-or-later
// How photons are born, and what is learned of those that mattered.
#pragma once

#include <cstdint>

namespace cardioid::photon {

inline constexpr int k_cube = 4;  ///< point (2), direction (2)

/// One photon's choice.
struct Emission {
    std::int32_t emitter = -1;
    float u[k_cube] = {};
    /// Density of (emitter, u) against choosing u uniformly and the emitter never: probability of the emitter × density in the
    /// cube. Flux is divided by it.
    float density = 0;
};

/// A photon of a training pass that pixels gathered.
struct Lesson {
    std::int32_t emitter;
    float u[k_cube];
    float value;  ///< what it added to the picture, × density with which it was emitted: unbiased for the integrand
    float density;
};

}  // namespace cardioid::photon
