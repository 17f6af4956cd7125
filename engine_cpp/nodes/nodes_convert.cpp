// SPDX-License-Identifier: GPL-3.0-or-later
#include "nodes/node_helpers.h"

namespace cardioid::nodes {

std::span<const NodeType> convert_nodes() { return {}; }

}  // namespace cardioid::nodes
