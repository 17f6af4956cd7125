// SPDX-License-Identifier: GPL-3.0-or-later
// Where an emitter or a group of emitters is, which way it shines and how much: what choosing between them needs.
#pragma once

#include "math/types.h"

#include <algorithm>

namespace cardioid::light {

struct EmitterBounds {
    Float3 lower{1e30f, 1e30f, 1e30f}, upper{-1e30f, -1e30f, -1e30f};
    float radius_squared = -1;  ///< of the bounding sphere around the middle of the box; < 0: the box's own
    Float3 axis{0, 0, 1};
    float theta_o = 0;  ///< normals lie within this angle of the axis, 0 … pi
    float theta_e = 0;  ///< light leaves within this angle of a normal, 0 … pi/2
    float energy = 0;   ///< >= 0; intensity along the normal; 0: nothing here

    Float3 center() const { return (lower + upper) * 0.5f; }
    float sphere_radius_squared() const {
        const Float3 half = (upper - lower) * 0.5f;
        return radius_squared >= 0 ? radius_squared : dot(half, half);
    }
};

/// Smallest bounds that hold both; empty ones (energy 0) change nothing.
EmitterBounds merge(const EmitterBounds& a, const EmitterBounds& b);

/// How many expected look-ups a group costs: energy × area × spread of directions (Conty Estevez & Kulla 2018).
float split_cost(const EmitterBounds& b);

inline void extend(EmitterBounds& b, Float3 p) {
    b.lower = {std::min(b.lower.x, p.x), std::min(b.lower.y, p.y), std::min(b.lower.z, p.z)};
    b.upper = {std::max(b.upper.x, p.x), std::max(b.upper.y, p.y), std::max(b.upper.z, p.z)};
}

}  // namespace cardioid::light
