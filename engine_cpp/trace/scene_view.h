// SPDX-License-Identifier: GPL-3.0-or-later
// The traceable scene as kernels see it: plain pointers, all read-only while rendering.
#pragma once

#include "math/types.h"
#include "nodes/instructions.h"
#include "nodes/shading.h"
#include "scene/scene_desc.h"

#include <cstdint>

struct RTCSceneTy;

namespace cardioid::light {
struct LightData;
}

namespace cardioid::trace {

/// Bits of the ray mask in Embree: scene::Visibility for closest hits; shadow rays see the two kinds apart.
enum RayMask : std::uint32_t {
    mask_shadow_opaque = 1u << 8,
    mask_shadow_transparent = 1u << 9,
};

struct MaterialView {
    const nodes::Program* surface = nullptr;
    const nodes::Program* emission = nullptr;
    const nodes::Program* transparency = nullptr;
    const nodes::Program* volume = nullptr;        ///< null: no medium
    const nodes::Program* displacement = nullptr;  ///< null: vertices stay
    nodes::ProgramInfo info;
    std::int32_t pass_index = 0;
    bool emission_sampled = false;  ///< its triangles are in the light table
};

/// One array per field, indexed by instance; gathered by kernels.
struct InstanceArrays {
    const std::int32_t* mesh = nullptr;
    const std::int32_t* first_triangle = nullptr;  ///< into triangles, packed normals (both × 3) and slots
    const std::int32_t* first_vertex = nullptr;
    const std::int32_t* smooth = nullptr;          ///< 1: packed normals exist
    const std::int32_t* baked = nullptr;           ///< 1: positions and normals of its mesh are in world space
    const std::int32_t* flip = nullptr;            ///< 1: baked with a mirroring transform, geometric normals turn
    const std::int32_t* slot_mask = nullptr;       ///< 0: one material for the whole mesh; ~0: look the slot up
    const std::int32_t* first_material = nullptr;  ///< into slot_materials
    const std::int32_t* holdout = nullptr;
    const std::int32_t* visibility = nullptr;    ///< scene::Visibility bits
    const float* terminator_geometry = nullptr;  ///< as scene::InstanceDesc
    const float* terminator_shading = nullptr;
};

struct CameraView {
    scene::CameraDesc desc;
    float pixel_x = 0, pixel_y = 0;  ///< size of a pixel on the view plane
    float pixel_angle = 0;           ///< angle between neighbouring pixels; orthographic: that of a usual lens
};

struct SceneView {
    RTCSceneTy* embree = nullptr;
    bool has_transparent_shadows = false;
    bool any_holdout = false;
    bool lifts_shadow_rays = false;  ///< some smooth mesh has terminator_geometry
    bool narrows_diffuse = false;    ///< some instance has terminator_shading
    std::int32_t first_lamp_instance =
        0;  ///< lamps as instances that nodes see, by id in LightData; only `mesh` has a row for them
    nodes::GeometryTables geometry;
    InstanceArrays instances;
    const std::uint32_t* packed_normals = nullptr;  ///< 3 per triangle, octahedral 2×16 bits
    const std::int32_t* slots = nullptr;            ///< per triangle
    const std::int32_t* slot_materials = nullptr;
    const MaterialView* materials =
        nullptr;             ///< materials, then lamps' graphs, then the world: one id space of programs
    int material_count = 0;  ///< materials alone (the default grey is the last)
    int world_program = 0;   ///< id of the world
    const light::LightData* lights = nullptr;
    bool has_lights = false;
    bool lights_are_limited = false;  ///< some lamp or the world is hidden from a kind of lobe or ends early
    bool has_casters = false;         ///< some lobe may be class S: there can be caustics
    bool is_limited = false;          ///< lights_are_limited, or some object is hidden from a kind of lobe
    bool has_world = false;           ///< something shines from outside
    bool has_volumes = false;         ///< some material of a placed mesh, or the world, has a medium
    std::uint8_t world_visibility = scene::visible_all;
    int world_max_bounces = 1024;
    Float3 world_constant{0, 0, 0};  ///< its radiance when its program is constant
    CameraView camera;
    scene::Settings settings;
};

}  // namespace cardioid::trace
