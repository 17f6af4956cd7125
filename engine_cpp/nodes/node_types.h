// SPDX-License-Identifier: GPL-3.0-or-later
// The nodes that the compiler knows, family by family. docs/nodes.md is this table; a test compares the two.
#pragma once

#include "nodes/builder.h"

#include <array>
#include <span>
#include <string>

namespace cardioid::nodes {

class NodeContext;

enum class Support : std::uint8_t {
    same,          ///< as Cycles does, to rounding
    approximated,  ///< the note tells what differs
    none,          ///< not supported
    absent,        ///< that version of Blender has no such node
};

/// Versions of Blender that the table has a column for.
inline constexpr std::array<const char*, 4> k_blender_versions = {"3.4", "4.5", "5.0", "5.2"};

/// How well a node is supported in each of k_blender_versions.
struct SupportByVersion {
    std::array<Support, 4> in;
    constexpr SupportByVersion(Support s) : in{s, s, s, s} {}  // NOLINT: one word for all is the usual row
    constexpr SupportByVersion(Support v34, Support v45, Support v50, Support v52) : in{v34, v45, v50, v52} {}
};
constexpr SupportByVersion only_34(Support s) { return {s, Support::absent, Support::absent, Support::absent}; }
constexpr SupportByVersion until_45(Support s) { return {s, s, Support::absent, Support::absent}; }
constexpr SupportByVersion since_45(Support s) { return {Support::absent, s, s, s}; }
constexpr SupportByVersion since_50(Support s) { return {Support::absent, Support::absent, s, s}; }
constexpr SupportByVersion since_52(Support s) { return {Support::absent, Support::absent, Support::absent, s}; }

struct NodeType {
    const char* idname;
    void (*values)(NodeContext&);               ///< computes the outputs, or null
    void (*closure)(NodeContext&, Ref weight);  ///< adds to the surface, or null
    SupportByVersion support;
    const char* note;  ///< what differs
};

std::span<const NodeType> closure_nodes();
std::span<const NodeType> principled_nodes();
std::span<const NodeType> input_nodes();
std::span<const NodeType> info_nodes();
std::span<const NodeType> math_nodes();
std::span<const NodeType> color_nodes();
std::span<const NodeType> convert_nodes();
std::span<const NodeType> texture_nodes();
std::span<const NodeType> image_nodes();
std::span<const NodeType> vector_nodes();
std::span<const NodeType> ray_nodes();
std::span<const NodeType> special_nodes();
std::span<const NodeType> sky_nodes();
std::span<const NodeType> volume_nodes();
std::span<const NodeType> hair_nodes();
/// Listed alone: the compiler takes them for unknown.
std::span<const NodeType> unsupported_nodes();

/// Null for a node that is not supported.
const NodeType* find_node_type(const std::string& idname);
/// The table of docs/nodes.md.
std::string node_table_markdown();

}  // namespace cardioid::nodes
