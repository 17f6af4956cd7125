// SPDX-License-Identifier: GPL-3.0-or-later
// Shading graph → flat programs, one for each Purpose. Never throws and never gives up on a graph: what cannot be
// compiled is named in the warnings and takes a default, the rest still renders.
#pragma once

#include "nodes/instructions.h"
#include "nodes/program.h"
#include "nodes/warnings.h"
#include "scene/graph_desc.h"

#include <memory>
#include <string>
#include <vector>

namespace cardioid::nodes {

enum class GraphKind : std::uint8_t { material, world, light };

/// Reserved attribute names: the mesh's render-active UV map and colour attribute.
inline constexpr const char* k_active_uv = "#active_uv";
inline constexpr const char* k_active_color = "#active_color";

struct CompileContext {
    std::string name;  ///< of the material, world or lamp, for messages
    GraphKind kind = GraphKind::material;
    std::vector<std::string>* attribute_names = nullptr;  ///< name id = index; names that are missing are appended
    const image::ImageStore* images = nullptr;            ///< may be null: images are then magenta
    Float3 fallback_color{0.8f, 0.8f, 0.8f};  ///< an empty graph is Diffuse, Background or Emission of this colour
    bool optimise = true;                     ///< false: no folding, merging or dead-code removal (tests)
};

struct CompiledGraph {
    Program program[k_purposes];  ///< by Purpose
    ProgramInfo info;
    const Program& of(Purpose p) const { return program[static_cast<int>(p)]; }
};

CompiledGraph compile(const scene::GraphDesc& graph, const CompileContext& context, Warnings& warnings);

}  // namespace cardioid::nodes
