// SPDX-License-Identifier: GPL-3.0-or-later
// A shading graph as the host hands it over: Blender's node types and socket identifiers, groups inlined, reroutes and
// muted nodes gone. nodes/compile.h turns it into flat programs.
#pragma once

#include <array>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace cardioid::scene {

/// A socket's own value: number, vector or colour (unused components 0), or text.
using SocketValue = std::array<float, 4>;

/// An input: either linked to another node's output, or the socket's value.
struct InputDesc {
    int node = -1;       ///< index into GraphDesc::nodes; -1: not linked
    std::string socket;  ///< output identifier of that node
    std::string type;    ///< Blender socket type of the *source*: VALUE INT BOOLEAN VECTOR RGBA SHADER
    SocketValue value{0, 0, 0, 0};
    bool linked() const { return node >= 0; }
};

/// A property of a node: operation names, flags, numbers, lists (ramp stops, curve tables).
using ParamValue = std::variant<bool, double, std::string, std::vector<double>>;

struct NodeDesc {
    std::string name;  ///< as the artist sees it, for messages
    std::string type;  ///< Blender's bl_idname, e.g. ShaderNodeBsdfPrincipled
    std::map<std::string, ParamValue> params;
    std::map<std::string, InputDesc> inputs;  ///< by socket identifier
};

/// Outputs of the graph; node -1: nothing connected.
struct OutputDesc {
    int node = -1;
    std::string socket;
};

struct GraphDesc {
    std::vector<NodeDesc> nodes;
    OutputDesc surface, volume, displacement;
    bool empty() const { return nodes.empty(); }
};

}  // namespace cardioid::scene
