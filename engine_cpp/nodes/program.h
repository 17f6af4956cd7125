// SPDX-License-Identifier: GPL-3.0-or-later
// A compiled shading graph: a flat list of instructions over registers (design: interpreted over chunks of 64 lanes).
#pragma once

#include "bsdf/lobe.h"
#include "math/types.h"
#include "scene/graph_desc.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cardioid::image {
class ImageStore;
}

namespace cardioid::nodes {

/// One output each: a program keeps only what its output needs.
enum class Purpose : std::uint8_t {
    surface,       ///< lobes, emission and transparency
    emission,      ///< emission alone (light sampling, world, lamps)
    transparency,  ///< transparency alone (shadow rays)
    volume,        ///< the medium inside the surface, or of the world
    displacement,  ///< how far a vertex moves
};
inline constexpr int k_purposes = 5;

struct Program;  // instruction stream, defined in nodes/instructions.h

/// Facts that the scene builder needs before anything is rendered.
struct ProgramInfo {
    bool has_emission = false;
    bool constant_emission = false;  ///< then emission_value holds it, without the normal's or ray's influence
    Float3 emission_value{0, 0, 0};
    Float3 emission_estimate{0, 0, 0};  ///< rough mean radiance for choosing lights (textures: their mean colour or 1)
    bool has_transparency = false;
    bool has_lobes = false;
    bool has_bump = false;
    bool own_normals = false;       ///< lobes may have other normals than the surface's smooth one
    bool ggx_bump_shadow = false;   ///< diffuse lobes with such normals are darkened as Blender 4.5 and later do
    bool sets_normal = false;       ///< displacement bumps the surface itself (SurfaceOutput::normal)
    bool needs_light_path = false;  ///< depends on the kind of ray
    bool has_holdout = false;
    bool constant_transparency = false;  ///< then transparency_value holds it for every point and ray
    Float3 transparency_value{0, 0, 0};
    bool transparency_needs_light_path = false;
    bool needs_triangle_frame = false;  ///< reads barycentrics, dp_du, dp_dv, triangle or mesh
    bool needs_instance = false;        ///< reads InstanceInfo
    bool has_volume = false;
    bool constant_volume = false;   ///< the same medium everywhere: its program may be run once, without a position
    bool has_displacement = false;  ///< something is linked to the displacement output
    bool has_subsurface = false;    ///< some lobe is_subsurface
    bool sends_rays = false;        ///< Bevel, Ambient Occlusion, Raycast: reads ShadingChunk::rays and random_seed
    int lobes = 0;
    float least_alpha =
        1e30f;  ///< of the glossy lobes: none can be smoother; 0 where that is not known, 1e30 without any
};

}  // namespace cardioid::nodes
