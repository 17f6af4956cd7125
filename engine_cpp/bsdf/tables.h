// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of the GGX model, computed at build time by make_tables.cpp; linear interpolation, first axis fastest.
// Axes: r = Blender roughness (sqrt of alpha) in [0,1]; m = sqrt(cos(normal, wo)) in [0,1];
// z = sqrt(|eta - 1|/(eta + 1)) in [0,1], which covers every index above 1.
#pragma once

namespace cardioid::bsdf {

inline constexpr int k_albedo_size = 32;  ///< axes of the reflection tables
inline constexpr int k_glass_size = 16;   ///< axes of the tables that depend on the index

/// Single-scattering albedo of GGX reflection with Fresnel 1, (r, m); and its cosine-weighted mean over directions,
/// (r).
extern const float k_ggx_albedo[k_albedo_size * k_albedo_size];
extern const float k_ggx_mean_albedo[k_albedo_size];

/// The same for glass with the dielectric term, (r, m, z), for eta ≥ 1 and for 1/eta; means (r, z).
extern const float k_glass_albedo[k_glass_size * k_glass_size * k_glass_size];
extern const float k_glass_albedo_inverse[k_glass_size * k_glass_size * k_glass_size];
extern const float k_glass_mean_albedo[k_glass_size * k_glass_size];
extern const float k_glass_mean_albedo_inverse[k_glass_size * k_glass_size];

/// Where the mean Fresnel term over the visible facets lies between f0 and f90: for the exact dielectric term rescaled,
/// (r, m, z), and for Schlick's fifth power, (r, m).
extern const float k_schlick_dielectric[k_glass_size * k_glass_size * k_glass_size];
extern const float k_schlick_power5[k_glass_size * k_glass_size];

/// Light that interferes over an optical path difference of d: ∫ cmf(λ)·(cos, -sin)(2πd/λ) dλ for the working space's
/// three channels, each 1 at d = 0; six rows (three real, three imaginary), spread evenly up to k_film_reach.
inline constexpr int k_film_size = 512;
inline constexpr float k_film_reach = 60000.0f / 6.28318530718f;  ///< nm, the last entry
extern const float k_film_response[6 * k_film_size];

}  // namespace cardioid::bsdf
