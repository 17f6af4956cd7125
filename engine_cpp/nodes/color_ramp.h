// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace cardioid::nodes {

/// A colour ramp as `entries` (2 or more) RGBA values over [0, 1], as Blender evaluates it. `stops`: position, r, g, b, a of each stop in
/// order; the words are Blender's enum identifiers. Without stops: black to white.
std::vector<float> ramp_table(const std::vector<double>& stops, const std::string& interpolation,
                              const std::string& color_mode, const std::string& hue, int entries);

}  // namespace cardioid::nodes
