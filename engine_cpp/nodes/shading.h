// SPDX-License-Identifier: GPL-3.0-or-later
// What a node program reads (ShadingChunk, GeometryTables) and writes (SurfaceOutput), for up to 64 points of one material.
// Lanes from n to the next multiple of 16 repeat lane n-1, so that kernels may compute them.
#pragma once

#include "bsdf/lobe.h"
#include "bsdf/phase_kind.h"
#include "math/types.h"

#include <array>
#include <cstdint>

namespace cardioid::nodes {

/// Light Path flags of the ray that arrived.
enum RayFlag : std::uint32_t {
    ray_camera = 1,
    ray_shadow = 2,
    ray_diffuse = 4,
    ray_glossy = 8,
    ray_singular = 16,
    ray_reflection = 32,
    ray_transmission = 64,
    ray_volume = 128,
};

/// Where a mesh keeps an attribute; channels 0: the mesh lacks it.
struct AttributeRef {
    std::uint32_t offset = 0;  ///< into GeometryTables::floats
    std::uint8_t domain = 0;   ///< scene::Domain
    std::uint8_t channels = 0;
};

/// Per-instance values that nodes can read.
struct InstanceInfo {
    Affine object_to_world, world_to_object;
    std::int32_t mesh = 0;
    float random = 0, pass_index = 0;
    float color[4] = {1, 1, 1, 1};
    Float3 location;
    Float3 dupli_generated;
    float dupli_uv[2] = {0, 0};
};

/// What nodes read by name from instances (scene::InstanceValueDesc): rows of four floats, [instance * names + name id]; a missing
/// one is 0, 0, 0, 0.
struct InstanceValues {
    const float* rows = nullptr;
    int names = 0;
};

struct MeshInfo {
    std::uint32_t first_triangle = 0;  ///< into GeometryTables::triangles
    std::uint32_t first_vertex = 0;
    Float3 generated_min, generated_size;
};

/// Read-only views of the built scene's geometry; pointers are owned by trace/.
struct GeometryTables {
    const std::uint32_t* triangles = nullptr;  ///< 3 indices each, relative to the mesh's first vertex
    const float* positions = nullptr;          ///< xyz per vertex, object space
    const float* floats = nullptr;             ///< attribute data of all meshes
    const AttributeRef* attributes = nullptr;  ///< [mesh * attribute_names + name id]
    int attribute_names = 0;
    const InstanceInfo* instances = nullptr;
    const MeshInfo* meshes = nullptr;
    InstanceValues instance_values;
    Affine camera_to_world, world_to_camera;  ///< camera looks along -z
    std::array<float, 4> view_plane{};        ///< left, right, bottom, top at distance 1 (Window coordinates)
    bool orthographic = false;
};

/// Rays that nodes send (Bevel, Ambient Occlusion, Raycast), for the lanes of a chunk.
struct alignas(64) NodeRays {
    Row origin[3], direction[3], t_min, t_max;  ///< t_max < t_min: no ray in this lane
    std::int32_t only[k_chunk];  ///< instance that alone can be hit; -1: all; -2: what is opaque to shadow rays
};
struct alignas(64) NodeHits {
    Row t;                           ///< 1e30: nothing
    Row normal[3];                   ///< smooth, unit, world, on the side that the mesh's own normals have
    Row normal_geometric[3];         ///< the same, flat
    std::int32_t instance[k_chunk];  ///< -1: nothing
};
/// Given by who owns the traceable scene; `lanes` is n rounded up to the kernel's width.
struct RayService {
    const void* scene = nullptr;
    void (*closest)(const void* scene, const NodeRays& rays, NodeHits& hits, int lanes) = nullptr;
};

struct alignas(64) ShadingChunk {
    int n = 0;                         ///< 1…64
    const RayService* rays = nullptr;  ///< null: nothing is hit
    const GeometryTables* geometry = nullptr;
    alignas(64) Row position[3];       ///< world; for the world shader: the direction
    Row normal_geometric[3];           ///< unit, world, on wo's side
    Row normal[3];                     ///< smooth, unit, on wo's side
    Row wo[3];                         ///< unit, toward the ray's origin
    Row barycentric_u, barycentric_v;  ///< weights of corners 1 and 2
    Row dp_du[3], dp_dv[3];            ///< world: edge 1 and edge 2 of the triangle
    Row footprint;                     ///< world-space width of a pixel at the point (bump, later photon radii)
    Row ray_length;
    Row time;
    Row backfacing;                  ///< 1 or 0
    std::int32_t triangle[k_chunk];  ///< within the mesh
    std::int32_t mesh[k_chunk];
    std::int32_t instance[k_chunk];  ///< -1 for lamps and the world
    std::int32_t material_pass_index = 0;
    std::uint32_t ray_flags[k_chunk];
    std::int32_t random_seed[k_chunk];  ///< for nodes that send rays, by vertex and path; < 0: too blurred for bevels
    Row ray_depth, diffuse_depth, glossy_depth, transmission_depth, transparent_depth;
};

using bsdf::PhaseKind;

/// One scattering part of a medium.
struct alignas(64) MediumPhase {
    PhaseKind kind = PhaseKind::henyey_greenstein;
    Row scatter[3];    ///< coefficient per scene unit
    Row parameter[3];  ///< see bsdf/phase_kind.h; bsdf/phase.h evaluates and samples
};
inline constexpr int k_max_phases = 4;

/// The medium at the points of a chunk (Purpose::volume).
struct alignas(64) VolumeOutput {
    int phases = 0;
    Row absorption[3];  ///< coefficient per scene unit, without scattering
    Row emission[3];    ///< radiance per scene unit
    MediumPhase phase[k_max_phases];
};

struct alignas(64) SurfaceOutput {
    int lobes = 0;
    bsdf::Lobe* lobe =
        nullptr;          ///< room for ProgramInfo::lobes of them, given by the caller (a path's record keeps them)
    Row emission[3];      ///< radiance toward wo; world and lamps: the colour × strength
    Row transparency[3];  ///< weight of Transparent BSDFs: light that passes straight through
    Row holdout;          ///< weight of Holdout
    VolumeOutput* volume = nullptr;  ///< Purpose::volume writes it; given by the caller
    Row normal[3];                   ///< where ProgramInfo::sets_normal: the smooth normal, bumped by displacement
    Row displacement[3];             ///< Purpose::displacement: world-space offset
};

}  // namespace cardioid::nodes
