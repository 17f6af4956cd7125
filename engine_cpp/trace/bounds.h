// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes around placed meshes.
#pragma once

#include "trace/geometry_pool.h"

#include <functional>

namespace cardioid::trace {

struct Box {
    Float3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
    bool empty() const { return low.x > high.x; }
    void add(Float3 p);
};

/// Around the instances that `wanted` picks, in world space.
Box scene_bounds(const GeometryPool& pool, const std::function<bool(int instance)>& wanted);

}  // namespace cardioid::trace
