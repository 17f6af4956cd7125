// SPDX-License-Identifier: GPL-3.0-or-later
// A lobe of a BSDF for a whole shading chunk: the kind is the same for all 64 lanes (they share a node program), the
// parameters differ. Node programs append lobes; bsdf/kernels evaluate and sample them.
#pragma once

#include "math/types.h"

#include <cstdint>

namespace cardioid::bsdf {

enum class LobeKind : std::uint8_t {
    diffuse,          ///< Lambert, or Oren–Nayar where `roughness` > 0
    translucent,      ///< Lambert on the other side
    ggx_reflection,   ///< microfacet reflection with `fresnel`
    ggx_refraction,   ///< microfacet refraction alone, tint `f0`-free: weight × (1 - 0)
    ggx_glass,        ///< reflection and refraction chosen by the dielectric Fresnel term
    sheen,            ///< Charlie-like sheen of Principled v2 and Velvet's successor
};

enum class Fresnel : std::uint8_t {
    none,             ///< 1 everywhere (Glossy BSDF)
    dielectric,       ///< real eta
    schlick,          ///< f0 + (f90 - f0)·s, s the exact dielectric term rescaled (Principled v2's generalized Schlick)
    f82,              ///< metal: f0 and the tint at 82° in `f90`
    principled_v1,    ///< 3.4's Principled specular: dielectric term between f0 and f90
};

/// Rows that a kind does not use stay untouched. alpha = roughness² (Blender's roughness).
struct alignas(64) Lobe {
    LobeKind kind = LobeKind::diffuse;
    Fresnel fresnel = Fresnel::none;
    bool preserve_energy = false;   ///< multiple-scattering compensation (multiscatter GGX)
    Row weight[3];                  ///< throughput weight, 0 where the lobe is absent in a lane
    Row normal[3];                  ///< unit, on the side of wo after bending (bump and normal maps applied)
    Row roughness;                  ///< diffuse: Oren–Nayar sigma in [0,1]; sheen: its roughness
    Row tangent[3];                 ///< ggx: anisotropy direction
    Row alpha_x, alpha_y;           ///< ggx; at or under k_delta_alpha the lane is a perfect mirror or window
    Row eta;                        ///< relative index of refraction inside/outside for the side that wo is on
    Row f0[3], f90[3];              ///< colours at normal and grazing incidence (see Fresnel)
    Row tint_transmission[3];       ///< glass: colour of the transmitted part (weight holds the reflection's)
};

/// At or under this alpha a GGX lane is a delta.
inline constexpr float k_delta_alpha = 1e-4f;

/// Most lobes that one program may emit; more are dropped with a warning by the compiler.
inline constexpr int k_max_lobes = 12;

}  // namespace cardioid::bsdf
