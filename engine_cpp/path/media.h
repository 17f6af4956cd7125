// SPDX-License-Identifier: GPL-3.0-or-later
// Participating media over lanes. As in Cycles a ray carries the media that it has entered; their coefficients add up, the
// world's medium is in all of them, and surfaces with a medium switch it when a ray passes through.
#pragma once

#include "bsdf/phase.h"
#include "path/tracer.h"

namespace cardioid::CD_ISA_NS {

/// Media of a packet of rays. An empty entry has material -1; the entries lie next to each other.
struct MediaLanes {
    Int instance[path::k_media], material[path::k_media];
};

inline MediaLanes no_media() {
    MediaLanes m;
    for (int k = 0; k < path::k_media; ++k) m.instance[k] = m.material[k] = Int(-1);
    return m;
}
inline MediaLanes load_media(const path::RayState& rays, Int ray) {
    MediaLanes m;
    for (int k = 0; k < path::k_media; ++k) {
        m.instance[k] = gather(rays.media_instance[k], ray);
        m.material[k] = gather(rays.media_material[k], ray);
    }
    return m;
}
/// Of rays that append_ray is about to append.
inline void append_media(path::RayState& to, const MediaLanes& m, Mask lanes) {
    for (int k = 0; k < path::k_media; ++k) {
        compress_store(to.media_instance[k] + to.n, m.instance[k], lanes);
        compress_store(to.media_material[k] + to.n, m.material[k], lanes);
    }
}
inline MediaLanes load_media(const path::MediaRecord& r, int i) {
    MediaLanes m;
    for (int k = 0; k < path::k_media; ++k) {
        m.instance[k] = load(r.instance[k] + i);
        m.material[k] = load(r.material[k] + i);
    }
    return m;
}
inline void store_media(path::MediaRecord& r, int i, const MediaLanes& m) {
    for (int k = 0; k < path::k_media; ++k) {
        store(r.instance[k] + i, m.instance[k]);
        store(r.material[k] + i, m.material[k]);
    }
}

/// Lanes that pass a surface with a medium: from the front they enter it, from the back they leave it.
void cross_surface(MediaLanes& media, Int instance, Int material, Mask backfacing, Mask lanes);

/// Lanes whose material has a medium.
Mask has_medium(const trace::SceneView& scene, Int material, Mask lanes);

/// Nothing but the bounds of a medium: rays pass it uncounted.
inline bool is_boundary(const trace::MaterialView& m) {
    return m.volume && m.info.lobes == 0 && m.info.constant_transparency && m.info.transparency_value.x == 1 &&
           m.info.transparency_value.y == 1 && m.info.transparency_value.z == 1;
}

/// Lanes whose surface with a medium is nothing but its bounds.
Mask only_bounds(const trace::SceneView& scene, Int material, Mask with_medium);
/// A ray passes no more of them.
inline constexpr int k_most_bounds = 200;

/// The media of a packet together, per scene unit.
struct MediumLanes {
    Spectrum extinction{0.0f}, scattering{0.0f}, emission{0.0f};
    /// One of the phase functions, chosen in proportion to its share; `chosen`: its scattering over the probability of the choice.
    Int kind = Int(0);
    Vec3 parameter{0.0f, 0.0f, 0.0f};
    Spectrum chosen{0.0f};
};

/// `choice`: uniform, picks the phase function.
MediumLanes medium_at(Walk& walk, const MediaLanes& media, const ShadedPoint& at, Float choice, Mask active);

/// How far apart media are evaluated: a tenth of the mean size of the object's box, as Cycles (world: 1); 1e30 where all are the
/// same everywhere.
Float medium_step(const trace::SceneView& scene, const MediaLanes& media, Mask active);
/// No more steps along a ray, as Cycles' default; they grow instead.
inline constexpr int k_most_steps = 1024;

/// What reaches t1 from t0. `number`: random bits of the ray.
Spectrum transmittance(Walk& walk, const MediaLanes& media, Vec3 o, Vec3 d, Float t0, Float t1, Int number,
                       Mask active);

/// Media around points: a ray upward counts what it leaves, as in Cycles.
MediaLanes media_around(const trace::SceneView& scene, Vec3 p, Mask active);

/// Lanes with some medium, the world's included.
inline Mask in_medium(const trace::SceneView& scene, const MediaLanes& media) {
    if (scene.materials[scene.world_program].volume) return mask_of(true);
    return media.material[0] >= Int(0);
}

inline Spectrum exp_minus(Spectrum x, Float t) { return {exp(x.r * -t), exp(x.g * -t), exp(x.b * -t)}; }
inline Float channels_dot(Spectrum a, Spectrum b) { return a.r * b.r + a.g * b.g + a.b * b.b; }

/// Settings::max_volume_bounces as far as RayState counts.
inline int most_scatterings(const scene::Settings& settings) {
    return settings.max_volume_bounces < 254 ? settings.max_volume_bounces : 254;
}

inline constexpr int k_phase_kinds = 5;
/// Sampling and value of phase functions, another one in each lane.
PhaseSample sample_phases(Int kind, Vec3 parameter, Vec3 wo, Vec2 u, Mask lanes);
Float eval_medium(const path::MediumRecord& m, int i, Vec3 wo, Vec3 wi, Mask lanes);

}  // namespace cardioid::CD_ISA_NS
