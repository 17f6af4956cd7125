// SPDX-License-Identifier: GPL-3.0-or-later
// The nodes that the compiler knows, family by family. docs/nodes.md is this table; a test compares the two.
#pragma once

#include "nodes/builder.h"

#include <span>
#include <string>

namespace cardioid::nodes {

class NodeContext;

enum class Support : std::uint8_t { same, approximated };

struct NodeType {
    const char* idname;
    void (*values)(NodeContext&);               ///< computes the outputs, or null
    void (*closure)(NodeContext&, Ref weight);  ///< adds to the surface, or null
    Support support;                            ///< same: as Cycles does, to rounding
    const char* note;                           ///< what differs
};

std::span<const NodeType> closure_nodes();
std::span<const NodeType> principled_nodes();
std::span<const NodeType> input_nodes();
std::span<const NodeType> math_nodes();
std::span<const NodeType> color_nodes();
std::span<const NodeType> convert_nodes();
std::span<const NodeType> texture_nodes();
std::span<const NodeType> image_nodes();
std::span<const NodeType> vector_nodes();

/// Null for a node that is not supported.
const NodeType* find_node_type(const std::string& idname);
/// The table of docs/nodes.md.
std::string node_table_markdown();

}  // namespace cardioid::nodes
