// SPDX-License-Identifier: GPL-3.0-or-later
// Builds trees over emitters for choosing by importance, into the flat node arrays that kernels read.
#pragma once

#include "light/emitter_bounds.h"
#include "light/light_data.h"
#include "light/light_table.h"

#include <cstdint>
#include <vector>

namespace cardioid::light {

inline constexpr std::int32_t k_no_emitter = 0x7fffffff;

struct TreeLeaf {
    EmitterBounds bounds;
    std::int32_t emitter;
};

/// All nodes of all trees of a table.
struct NodeStorage {
    std::vector<float> record;
    std::vector<std::int32_t> child, parent;

    int size() const { return static_cast<int>(child.size()); }
    /// Appends a node without children and returns its index; k_no_emitter for one that is missing.
    int add(const EmitterBounds& bounds, std::int32_t emitter, std::int32_t parent_node);
};

/// Builds the tree of `leaves` without its root: up to k_tree_width nodes without a parent are returned (one for each leaf
/// where there are few). `leaves` is reordered. Deterministic.
/// `checkpoint` is called now and then and may throw to stop.
std::vector<int> build_light_tree(std::vector<TreeLeaf>& leaves, NodeStorage& nodes, const Checkpoint& checkpoint);

}  // namespace cardioid::light
