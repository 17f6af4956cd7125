// SPDX-License-Identifier: GPL-3.0-or-later
// What the light kernels read: plain arrays, owned by LightTable. Records are AoS of floats (one or two cache lines per
// emitter), so that lanes with different emitters gather few lines. Emitter ids: lamps [0, lamp_count), then triangles,
// then the world.
#pragma once

#include <cstdint>

namespace cardioid::light {

/// How an emitter is sampled.
enum class EmitterKind : std::int32_t {
    delta_point,  ///< point or spot lamp of size zero
    sphere,       ///< point or spot with a radius
    facing_disk,  ///< point or spot as a disk that faces the receiver (Blender before 4.0, "Soft Falloff" since)
    rectangle,
    ellipse,
    delta_sun,
    sun,
    triangle,
    world,
};

/// Lamp record: k_lamp_floats floats.
namespace lamp {
enum Field {
    position = 0,  ///< 3; sun: unit direction toward the sun
    radiance = 3,  ///< 3; delta: intensity (sun: irradiance)
    radius = 6,
    radius_squared = 7,
    normal = 8,   ///< 3; area: side that emits; spot: axis; sun: away from the sun
    axis_u = 11,  ///< 3; area: unit
    half_u = 14,
    axis_v = 15,  ///< 3
    half_v = 18,
    inv_area = 19,         ///< area
    tan_half_spread = 20,  ///< area: k_no_spread without spread
    spread_factor = 21,    ///< area: attenuation is (tan_half_spread - tan) * spread_factor
    spot_rows = 11,        ///< 9; rows of the inverse of the linear part, of spots with z negated; points have them too
    spot_cos = 20,         ///< cosine of the half cone angle
    spot_inv_blend = 21,   ///< 1 / width of the blend in cosine
    spot_one_minus_cos = 22,  ///< of a cone around `normal` that holds all the light
    sun_one_minus_cos = 11,
    sun_inv_tan_area = 12,  ///< legacy sun: 1/(pi tan^2) of its half angle
    sun_rows = 13,          ///< 6; the first two rows of the inverse of the linear part
};
inline constexpr float k_no_spread = 1e30f;
enum Flag : std::int32_t {
    is_spot = 1,
    spot_cosine = 2,
    legacy_sun = 4,
    no_shadow = 8,
    has_spread = 16,
    never_hit = 32,
    legacy_place = 64,  ///< parametric coordinates of before Blender 4.0
};
enum IntField { kind = 0, program = 1, flags = 2, visibility = 3, max_bounces = 4, hit_visibility = 5 };
}  // namespace lamp
inline constexpr int k_lamp_floats = 24;
inline constexpr int k_lamp_ints = 8;

/// How a point or spot lamp (any size) sends photons: directions in a cone around `axis`, in coordinates x = (1 - cos)/one_minus_cos
/// and y = azimuth / 2 pi, both in [0, 1]; azimuth 0 is along `tangent`. The rectangle [x0, x1] × [1/2 - half_y, 1/2 + half_y]
/// holds the casters and half of the photons; the whole square, where nothing is aimed.
namespace emission {
enum Field {
    axis = 0,     ///< 3
    tangent = 3,  ///< 3
    one_minus_cos = 6,
    x0 = 7,
    x1 = 8,
    half_y = 9,
    density_in = 10,    ///< of (x, y), in the rectangle
    density_out = 11,   ///< in the rest
    mass_below = 12,    ///< probability of x < x0
    mass_between = 13,  ///< of x0 <= x <= x1
    mass_side = 14,     ///< of y under the rectangle, and again over it, given that x is between
};
/// Share of the photons of a sphere that fill its inside.
inline constexpr float k_inside_share = 1.0f / 16;
}  // namespace emission
inline constexpr int k_emission_floats = 16;

/// Triangle record: p0, edges p1-p0 and p2-p0, radiance, unit normal, area.
namespace triangle {
enum Field { origin = 0, edge1 = 3, edge2 = 6, radiance = 9, normal = 12, area = 15 };
enum IntField { program = 0, instance = 1, index = 2, two_sided = 3 };
}  // namespace triangle
inline constexpr int k_triangle_floats = 16;
inline constexpr int k_triangle_ints = 4;

/// What choosing needs of an emitter or of a group of them: bounding sphere and box, cone of emission and
/// intensity. A record is one cache line.
namespace node {
enum Field {
    center = 0,  ///< 3; suns stand far away
    radius_squared = 3,
    axis = 4,        ///< 3
    cos_o = 7,       ///< normals lie within this angle of the axis
    cos_e = 8,       ///< light leaves within this angle of a normal
    energy = 9,      ///< mean |radiance| × area, summed: intensity along the normal; world: irradiance
    half_size = 10,  ///< 3; of the bounding box around the same center
};
}  // namespace node
inline constexpr int k_node_floats = 16;

/// Children of a node of a tree. More than two look further ahead for the same number of weighings: fewer picks end at
/// emitters that cannot light the receiver.
inline constexpr int k_tree_width = 8;

/// Nodes of all trees; the k_tree_width children of a node are neighbours, those that are missing have no energy.
struct NodeArrays {
    const float* record = nullptr;         ///< k_node_floats each
    const std::int32_t* child = nullptr;   ///< first child; ~emitter for a leaf
    const std::int32_t* parent = nullptr;  ///< -1: an entry
};

/// At most this many entries are weighed first: the top of the tree of lamps and triangles, that of the suns, the world.
inline constexpr int k_max_entries = 2 * k_tree_width + 1;

/// Cumulative distributions over the cells of the world's grid.
struct DirectionTable {
    const float* conditional = nullptr;  ///< (width + 1) per row, 0 … 1
    const float* marginal = nullptr;     ///< height + 1, 0 … 1
};

/// World: one colour, or a latitude-longitude grid whose rows are uniform in the polar angle and cells uniform in solid angle.
struct EnvironmentData {
    std::int32_t emitter = -1;  ///< -1: the world is not sampled
    bool constant = true;
    float color[3] = {0, 0, 0};
    std::int32_t program = -1;
    std::int32_t visibility = 63;
    std::int32_t max_bounces = 1024;
    int width = 0, height = 0;
    DirectionTable seen;           ///< from receivers, which meet what is evenly bright by their lobes
    DirectionTable sent;           ///< photons
    const float* row_z = nullptr;  ///< height + 1: z of the row borders, 1 … -1
};

/// What photons are aimed at (light/emit.h).
struct Sphere {
    float center[3] = {0, 0, 0};
    float radius = 0;
};

struct LightData {
    Sphere scene;    ///< around everything; infinite emitters send photons through its cross section
    Sphere casters;  ///< around the instances with specular lobes; radius 0: none are known, nothing is aimed
    int emitter_count = 0;
    /// Per emitter (the last one is the world, sampled or not): flux toward the casters, roughly (W); 0: sends no photons. For choosing
    /// emitters at the start.
    const float* emission_power = nullptr;
    const float* lamp_emission = nullptr;                       ///< k_emission_floats per lamp
    float scene_low[3] = {0, 0, 0}, scene_high[3] = {0, 0, 0};  ///< box around everything, a little wider; see `scene`

    int lamp_count = 0;
    const float* lamp = nullptr;
    const std::int32_t* lamp_int = nullptr;
    int triangle_count = 0;
    const float* triangle = nullptr;
    const std::int32_t* triangle_int = nullptr;
    EnvironmentData environment;

    int entry_count = 0;                          ///< 0: nothing to sample
    std::int32_t entry_node[k_max_entries] = {};  ///< a leaf (one emitter) or the top of a part of a tree
    bool entry_is_world[k_max_entries] = {};
    NodeArrays nodes;
    const std::int32_t* leaf_of = nullptr;  ///< node of each emitter, -1: never chosen

    int hittable_count = 0;
    int hittable_suns = 0;                    ///< the first ones of the list
    const std::int32_t* hittable = nullptr;   ///< lamp ids
    int box_count = 0;                        ///< nodes of the tree over the finite hittable lamps
    const float* box = nullptr;               ///< 6 floats a node: min, max
    const std::int32_t* box_first = nullptr;  ///< inner: first of two children; leaf: first lamp of `hittable`
    const std::int32_t* box_lamps = nullptr;  ///< lamps of a leaf; 0: an inner node

    int instance_count = 0;
    const std::int32_t* triangle_base = nullptr;     ///< per instance, into triangle_emitter; -1: no emitter
    const std::int32_t* triangle_span = nullptr;     ///< per instance: triangles that are listed
    const std::int32_t* triangle_emitter = nullptr;  ///< emitter id or -1
};

/// Rays that lobes have sent find the emitter wherever its light would reach them; false: some or all of them do not.
inline bool lobes_can_hit(const LightData& lights, int emitter) {
    if (emitter >= lights.lamp_count) return true;
    const std::int32_t* numbers = lights.lamp_int + emitter * k_lamp_ints;
    const auto kind = static_cast<EmitterKind>(numbers[lamp::kind]);
    constexpr std::int32_t lobes = 2 | 4 | 8;  // scene::Visibility: diffuse, glossy, transmission
    return kind != EmitterKind::delta_point && kind != EmitterKind::delta_sun &&
           (numbers[lamp::hit_visibility] & lobes) == (numbers[lamp::visibility] & lobes);
}

}  // namespace cardioid::light
