// SPDX-License-Identifier: GPL-3.0-or-later
// Builds binary trees over emitters for choosing by importance, into the flat node arrays that kernels read.
#pragma once

#include "light/emitter_bounds.h"
#include "light/light_data.h"

#include <cstdint>
#include <vector>

namespace cardioid::light {

struct TreeLeaf {
    EmitterBounds bounds;
    std::int32_t emitter;
};

/// All nodes of all trees of a table.
struct NodeStorage {
    std::vector<float> record;
    std::vector<std::int32_t> child, parent;

    int size() const { return static_cast<int>(child.size()); }
    /// Appends a node without children and returns its index.
    int add(const EmitterBounds& bounds, std::int32_t emitter, std::int32_t parent_node);
};

/// Builds the tree of `leaves` (at least one) and returns its root. `leaves` is reordered. Deterministic.
int build_light_tree(std::vector<TreeLeaf>& leaves, NodeStorage& nodes);

}  // namespace cardioid::light
