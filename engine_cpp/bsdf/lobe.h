// SPDX-License-Identifier: GPL-3.0-or-later
// A lobe of a BSDF for a whole shading chunk: the kind is the same for all 64 lanes (they share a node program), the
// parameters differ. Node programs append lobes; bsdf/kernels evaluate and sample them.
#pragma once

#include "math/types.h"

#include <cstdint>

namespace cardioid::bsdf {

enum class LobeKind : std::uint8_t {
    diffuse,         ///< Lambert, or Oren–Nayar where `roughness` > 0
    translucent,     ///< Lambert on the other side
    ggx_reflection,  ///< microfacet reflection with `fresnel`
    ggx_refraction,  ///< microfacet refraction alone: × (1 - F) with Fresnel::dielectric, else all that can pass
    ggx_glass,  ///< reflection weight·F and refraction weight·tint_transmission·(1 - F); none acts as dielectric
    sheen,      ///< microfiber sheen of Principled v2 and of the Sheen BSDF; its albedo is part of the lobe
    burley,     ///< diffuse part of 3.4's Principled (Disney diffuse), `roughness` is Principled's
    velvet,     ///< 3.4's Velvet BSDF, `roughness` is its sigma
    sheen_v1,   ///< sheen of 3.4's Principled
    /// Light that enters here and leaves elsewhere (Cycles' BSSRDF). f0: albedo (colour), f90: radius per channel in scene
    /// units as Cycles' bssrdf_setup leaves it (walk: mean free path; Burley: d of the profile), eta: index of refraction,
    /// roughness: anisotropy of the walk, alpha_x: roughness² of the boundary; method: `preserve_energy` false random walk,
    /// true Burley. How a walk enters is told by `fresnel`: none: cosine-distributed (Blender 3.4), dielectric: refracted,
    /// schlick: each by half (Random Walk (Skin)). alpha_y 1: the exit has Principled v1's Fresnel (Blender 3.4), else 0.
    /// `weight` contains the albedo, as in Cycles. eval is 0: path/ walks, takes channels whose radius is under 1e-8 for
    /// diffuse, and paths after a diffuse bounce too. Photons take it for a D lobe.
    subsurface,
    toon_diffuse,  ///< constant in a cone about the normal; roughness: size, alpha_x: smooth, both in [0,1] as in the node
    toon_glossy,  ///< the same about the mirror direction
    /// Hair BSDF. tangent: along the strand; alpha_x, alpha_y: its two roughnesses; roughness: offset in radians.
    hair_reflection,
    hair_transmission,
    /// Principled Hair (Chiang et al. 2016). tangent: along the strand, unit; f0: absorption; eta: index inside (not by side);
    /// alpha_x, alpha_y: longitudinal and azimuthal roughness; roughness: factor of the first lobe's roughness; f90[0]: h, place
    /// across the strand in [-1,1]; f90[1]: tilt of the cuticle in radians.
    hair_chiang,
    /// Principled Hair (Huang et al. 2022). As hair_chiang with alpha_x: roughness; roughness: aspect ratio; f90[2]: pixel
    /// coverage; tint_transmission: factors of R, TT, TRT; normal: minor axis of the elliptical section.
    hair_huang,
};

/// Facet distribution of the ggx_* kinds.
enum class Distribution : std::uint8_t {
    ggx,
    beckmann,
    ashikhmin_shirley,  ///< reflection only; the alphas as for the others
    gtr1,               ///< reflection only: clearcoat of 3.4's Principled, masked as GGX of alpha 0.25; isotropic
};

enum class Fresnel : std::uint8_t {
    none,           ///< 1 everywhere (Glossy BSDF)
    dielectric,     ///< real eta
    schlick,        ///< f0 + (f90 - f0)·s, s the exact dielectric term rescaled (Principled v2's generalized Schlick)
    f82,            ///< metal: f0, and in `f90` the tint at 82° that multiplies Schlick's value there
    principled_v1,  ///< 3.4's Principled specular: dielectric term between f0 and f90 (the same formula as schlick)
    conductor,      ///< metal by index: f0 = n, f90 = k per channel (Metallic BSDF)
};

/// Rows that a kind does not use stay untouched. alpha = roughness² (Blender's roughness).
struct alignas(64) Lobe {
    LobeKind kind = LobeKind::diffuse;
    Fresnel fresnel = Fresnel::none;
    /// GGX reflection and glass: compensate for scattering between facets (multiscatter GGX). Diffuse with roughness
    /// > 0: the energy-preserving Oren–Nayar of Blender 4.3 and later (off: the one before).
    bool preserve_energy = false;
    Distribution distribution = Distribution::ggx;
    /// ggx_*: masking and shadowing as independent factors (Blender before 4.0).
    bool separable_masking = false;
    /// ggx_* that preserve energy: Blender's walk between facets (before 4.0), whose energy follows Filter Glossy.
    bool walks_facets = false;
    /// ggx_* with Fresnel dielectric, schlick, f82 or conductor: `roughness` is the thickness of a film in nm (0: none in the
    /// lane), film_ior its index relative to wo's side.
    bool thin_film = false;
    Row weight[3];         ///< throughput weight, 0 where the lobe is absent in a lane
    Row normal[3];         ///< unit, on the side of wo after bending (bump and normal maps applied)
    Row roughness;         ///< diffuse: Oren–Nayar sigma in [0,1]; sheen, burley, velvet: see LobeKind
    Row tangent[3];        ///< ggx: direction of alpha_x where alpha_x ≠ alpha_y; need not be unit or orthogonal
    Row alpha_x, alpha_y;  ///< ggx; both at or under k_delta_alpha: the lane is a perfect mirror or window
    Row eta;               ///< relative index of refraction inside/outside for the side that wo is on
    /// Colours at normal and grazing incidence (see Fresnel). With preserve_energy, f0 is the surface colour that
    /// `weight` already contains (it darkens repeated bounces) for diffuse, Fresnel::none, and glass with
    /// Fresnel::dielectric.
    Row f0[3], f90[3];
    Row tint_transmission[3];  ///< glass: factor of the transmitted part, on top of weight
    Row film_ior;              ///< see thin_film
};

constexpr bool is_microfacet(LobeKind kind) {
    return kind == LobeKind::ggx_reflection || kind == LobeKind::ggx_refraction || kind == LobeKind::ggx_glass;
}

/// Bends what it sends through by `eta`.
constexpr bool refracts(LobeKind kind) { return kind == LobeKind::ggx_refraction || kind == LobeKind::ggx_glass; }

/// Of the Hair BSDF.
constexpr bool is_plain_hair(LobeKind kind) {
    return kind == LobeKind::hair_reflection || kind == LobeKind::hair_transmission;
}

/// Scatters over the whole sphere about a strand; the sides of the surface mean nothing to it.
constexpr bool is_hair(LobeKind kind) {
    return is_plain_hair(kind) || kind == LobeKind::hair_chiang || kind == LobeKind::hair_huang;
}

/// Diffuse-like: counts as a diffuse bounce, or as transmission where it sends light through.
constexpr bool is_diffuse_kind(LobeKind kind) {
    return !is_microfacet(kind) && !is_hair(kind) && kind != LobeKind::toon_glossy;
}

/// Light leaves at another point than it entered.
constexpr bool is_subsurface(LobeKind kind) { return kind == LobeKind::subsurface; }

constexpr bool sends_light_through(LobeKind kind) {
    return kind == LobeKind::translucent || refracts(kind) || is_hair(kind);
}

/// At or under this alpha a GGX lane is a delta.
inline constexpr float k_delta_alpha = 1e-4f;

/// Refraction through an index this close to 1 is a delta: the half vector is undefined there.
inline constexpr float k_delta_eta = 1e-4f;

/// Most lobes that one program may emit; more are dropped with a warning by the compiler.
inline constexpr int k_max_lobes = 12;

}  // namespace cardioid::bsdf
