// SPDX-License-Identifier: GPL-3.0-or-later
// Turns a lamp as Blender defines it (watts, size, cone, spread) into the record that kernels read. Formulas and their
// differences between Blender versions: light/README.md.
#pragma once

#include "light/emitter_bounds.h"
#include "light/light_data.h"
#include "light/light_table.h"

namespace cardioid::light {

struct LampRecord {
    float value[k_lamp_floats] = {};
    std::int32_t number[k_lamp_ints] = {};
    EmitterBounds bounds;         ///< energy 0: the lamp is never chosen; a sun's are those of one far away
    Float3 box_lower, box_upper;  ///< of the surface that rays can hit
    bool hittable = false;

    EmitterKind kind() const { return static_cast<EmitterKind>(number[lamp::kind]); }
    bool at_infinity() const { return kind() == EmitterKind::sun || kind() == EmitterKind::delta_sun; }
};

/// Suns are placed far from the box (scene_min, scene_max). Lamps with non-finite values give an empty record.
LampRecord make_lamp_record(const LampInput& lamp, Float3 scene_min, Float3 scene_max);

}  // namespace cardioid::light
