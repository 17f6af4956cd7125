// SPDX-License-Identifier: GPL-3.0-or-later
// Box tree over the lamps that rays can hit, so that thousands of them need not be tried for every ray.
#pragma once

#include "math/types.h"

#include <cstdint>
#include <vector>

namespace cardioid::light {

struct LampBox {
    Float3 lower, upper;
    std::int32_t lamp;
};

/// Nodes as LightData wants them; leaves name runs of `lamps` that begin at `offset` + their position there.
struct LampBoxTree {
    std::vector<float> box;  ///< min, max
    std::vector<std::int32_t> first, count;
    std::vector<std::int32_t> lamps;  ///< in the order of the leaves
};

LampBoxTree build_lamp_boxes(std::vector<LampBox> lamps, int offset);

}  // namespace cardioid::light
