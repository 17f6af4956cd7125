// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "nodes/instructions.h"

namespace cardioid::nodes {

/// Mean radiance of an emission program over made-up points: images give their mean colour, attributes and positions are
/// spread over [0, 1]. For choosing between lights only.
Float3 estimate_emission(const Program& program);

}  // namespace cardioid::nodes
