// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace cardioid::nodes {

/// A photometric file (IES LM-63, types A, B, C) as the ies op reads it: number of horizontal and of vertical angles, these
/// angles in radians, and W/sr × 4π by horizontal, then vertical angle. Empty when the text is no such file.
std::vector<float> parse_ies(const std::string& text);

}  // namespace cardioid::nodes
