// SPDX-License-Identifier: GPL-3.0-or-later
// Meanings of Instruction::imm, shared by the compiler and the kernels.
#pragma once

#include <cstdint>

namespace cardioid::nodes {

/// imm of the lobe ops: kind | fresnel << 5 | distribution << 9, and flags.
enum LobeBits : std::uint32_t {
    lobe_kind_mask = 0x1f,
    lobe_fresnel_shift = 5,
    lobe_distribution_shift = 9,
    lobe_preserve_energy = 1u << 12,
    lobe_keep = 1u << 13,   ///< false: only its result is wanted (emission under a coat)
    lobe_layer = 1u << 14,  ///< the result is read
    lobe_separable = 1u << 15,
    lobe_thin_film = 1u << 16,
    lobe_walks_facets = 1u << 19,
    lobe_v1_exit = 1u << 17,      ///< subsurface of Principled version 1
    lobe_skin_radius = 1u << 18,  ///< subsurface whose radius is that of Random Walk (Skin)
};

enum class InstanceValue : std::uint32_t {
    location,
    color,
    random,
    pass_index,
    dupli_generated,
    dupli_uv,
    material_index
};

/// imm of object_point: space | quantity << 4 | direction << 8.
enum class Space : std::uint32_t { object, camera, generated };
enum class Quantity : std::uint32_t { point, vector, normal };
enum class Direction : std::uint32_t { from_world, to_world };
inline constexpr std::uint32_t transform_mode(Space s, Quantity q, Direction d) {
    return static_cast<std::uint32_t>(s) | static_cast<std::uint32_t>(q) << 4 | static_cast<std::uint32_t>(d) << 8;
}

/// data of the attribute op.
enum AttributeMissing : std::uint32_t {
    attribute_missing_opaque,  ///< alpha is 1 where the mesh lacks the attribute
    attribute_missing_clear,   ///< alpha is 0 there
    attribute_number,          ///< x is what Fac gives: the mean, of two channels the first
};

/// imm of the ops that send rays: number of samples, and flags.
enum RayNodeMode : std::uint32_t {
    ray_samples_mask = 0xff,
    rays_inside = 1u << 8,
    rays_local = 1u << 9,  ///< only the object itself is hit
};

/// imm of the ies op.
enum IesMode : std::uint32_t {
    ies_keeps_ends = 1,  ///< beyond its angles the table keeps its last value; else it is 0 there
    ies_is_round = 2,    ///< it goes on around the circle whatever its angles are
};

/// Entries of a table of the ramp and curve ops: 257 since Blender 4.5, 256 before.
inline constexpr int k_most_entries = 257;
/// imm of these ops: the number of entries and a flag.
constexpr std::uint32_t table_imm(int entries, bool flag) {
    return static_cast<std::uint32_t>(entries) << 1 | (flag ? 1u : 0u);
}
constexpr int table_entries(std::uint32_t imm) { return static_cast<int>(imm >> 1); }

enum class NoiseType : std::uint32_t { fbm, multifractal, hetero_terrain, hybrid_multifractal, ridged_multifractal };

/// imm of the noise op: dimensions | type << 4 | flags.
enum NoiseMode : std::uint32_t {
    noise_dimension_mask = 7,
    noise_type_shift = 4,
    noise_normalize = 1u << 8,
    noise_musgrave = 1u << 9,  ///< octaves are counted from 0, not from 1
    noise_color = 1u << 10,    ///< the second and third result are wanted
};

enum class CellFeature : std::uint32_t { f1, f2, smooth_f1, edge, radius };
enum class CellMetric : std::uint32_t { euclidean, manhattan, chebychev, minkowski };

/// imm of the voronoi op: dimensions | feature << 4 | metric << 8 | flags.
enum CellMode : std::uint32_t {
    cell_dimension_mask = 7,
    cell_feature_shift = 4,
    cell_metric_shift = 8,
    cell_normalize = 1u << 12,
    cell_pcg = 1u << 13,    ///< the hash of Blender 5.0 and later
    cell_color = 1u << 14,  ///< the colour is wanted
};

enum class RayValue : std::uint32_t {
    is_camera,
    is_shadow,
    is_diffuse,
    is_glossy,
    is_singular,
    is_reflection,
    is_transmission,
    is_volume,
    length,
    depth,
    diffuse_depth,
    glossy_depth,
    transparent_depth,
    transmission_depth,
};

}  // namespace cardioid::nodes
