// SPDX-License-Identifier: GPL-3.0-or-later
// Shading graph → flat programs, one for each Purpose. Never throws and never gives up on a graph: what cannot be
// compiled is named in the warnings and takes a default, the rest still renders.
#pragma once

#include "nodes/instructions.h"
#include "nodes/program.h"
#include "nodes/warnings.h"
#include "scene/scene_desc.h"

#include <memory>
#include <string>
#include <vector>

namespace cardioid::nodes {

enum class GraphKind : std::uint8_t { material, world, light };

/// Reserved attribute names: the mesh's render-active UV map and colour attribute.
inline constexpr const char* k_active_uv = "#active_uv";
inline constexpr const char* k_active_color = "#active_color";
/// Attributes that trace/ computes when a program names them: 1 channel per triangle, random in [0,1) by connected part;
/// 1 channel per vertex, Geometry ▸ Pointiness.
inline constexpr const char* k_random_island = "#random_island";
inline constexpr const char* k_pointiness = "#pointiness";
/// Prefix: "#tangent:UVMAP" ("#tangent:#active_uv" for the render-active map) is written by the host, 4 channels per corner: MikkTSpace tangent in object space and the sign of the
/// bitangent.
inline constexpr const char* k_tangent_prefix = "#tangent:";
/// The host writes it for meshes that modifiers or shape keys have bent: 3 channels per point, Generated coordinates.
inline constexpr const char* k_generated = "#generated";
/// Trace/ writes it for meshes whose vertices moved: 3 channels per point, object-space position before that.
inline constexpr const char* k_undisplaced = "#undisplaced";
/// Hair that the host turned into triangles: 3 channels per point, direction along the strand in object space; and Hair Info's
/// values, 1 channel each.
inline constexpr const char* k_curve_tangent = "#curve_tangent";
inline constexpr const char* k_curve_intercept = "#curve_intercept";
inline constexpr const char* k_curve_length = "#curve_length";
inline constexpr const char* k_curve_thickness = "#curve_thickness";
inline constexpr const char* k_curve_random = "#curve_random";

struct CompileContext {
    std::string name;  ///< of the material, world or lamp, for messages
    GraphKind kind = GraphKind::material;
    std::vector<std::string>* attribute_names = nullptr;       ///< name id = index; names that are missing are appended
    std::vector<std::string>* instance_value_names = nullptr;  ///< the same for scene::InstanceValueDesc
    /// Material: whether the displacement output turns normals (bump, both) or is left to Purpose::displacement alone.
    scene::DisplacementMethod displacement_method = scene::DisplacementMethod::bump;
    const image::ImageStore* images = nullptr;  ///< may be null: images are then magenta
    Float3 fallback_color{0.8f, 0.8f, 0.8f};    ///< an empty graph is Diffuse, Background or Emission of this colour
    bool optimise = true;                       ///< false: no folding, merging or dead-code removal (tests)
};

struct CompiledGraph {
    Program program[k_purposes];  ///< by Purpose
    ProgramInfo info;
    const Program& of(Purpose p) const { return program[static_cast<int>(p)]; }
};

CompiledGraph compile(const scene::GraphDesc& graph, const CompileContext& context, Warnings& warnings);

}  // namespace cardioid::nodes
