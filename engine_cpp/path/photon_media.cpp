// SPDX-License-Identifier: GPL-3.0-or-later
// Photons in media: absorbed and scattered on their way, never stored there (docs/photons.md, Media).
#include "path/media.h"
#include "path/photons.h"

namespace cardioid::CD_ISA_NS {

void PhotonWalk::cross_media() {
    for (int i = 0; i < now->n; i += W) {
        const Segment s = pass_media(i, first_lanes(now->n - i));
        if (any(s.scattered)) queue_scattered(i, s);
    }
}

void PhotonWalk::scatter_in_media() {
    const path::Scatterings& q = scratch.scatterings;
    for (int i = 0; i < q.n; i += W) send_on_from_medium(i, first_lanes(q.n - i));
    scratch.scatterings.n = 0;
}

void PhotonWalk::send_on_from_medium(int i, Mask lanes) {
    const path::Scatterings& q = scratch.scatterings;
    const scene::Settings& settings = scene.settings;
    const path::RayState& rays = *now;
    const Int ray = select(lanes, load(q.ray + i), Int(0));
    const Int path = cardioid::CD_ISA_NS::gather(rays.path, ray), flags = cardioid::CD_ISA_NS::gather(rays.flags, ray);
    const Int depth = cardioid::CD_ISA_NS::gather(rays.depth, ray), state = state_of(flags);
    const Int transparent = cardioid::CD_ISA_NS::gather(rays.transparent, ray), event = event_of(depth, transparent);
    const Int seed = cardioid::CD_ISA_NS::gather(scratch.pixel_seed, path),
              index = cardioid::CD_ISA_NS::gather(scratch.sample_index, path);
    const Vec2 u = sample_pair(seed, index, event_dimension(event, pair_bsdf));
    const Vec2 chance = sample_pair(seed, index, event_dimension(event, pair_chance));
    const Vec3 parameter{load(q.parameter[0] + i), load(q.parameter[1] + i), load(q.parameter[2] + i)};
    const PhaseSample s = sample_phases(load(q.kind + i), parameter, -load3(rays.direction, ray), u, lanes);

    const Int next_state = step_photon(state, mask_of(false));
    // The vertex next to the light does not count by type, as on camera paths.
    const Mask first = state == Int(static_cast<int>(path::PhotonState::start));
    const Int next_depth = depth + Int(1), next_transparent = transparent + select(first, Int(0), Int(1 << 24));
    Mask go = lanes & (s.value > Float(0.0f)) & may_be_stored(next_state, request.classes) &
              ~over_limits(settings, next_depth) &
              (scatterings_in_media(next_transparent) <= Int(most_scatterings(settings)));
    const Int seen_by = (flags >> path::k_visibility_shift) & Int(0xff);
    if (scene.is_limited) go &= (seen_by & Int(scene::visible_volume)) != Int(0);
    Spectrum carried{load(q.throughput[0] + i), load(q.throughput[1] + i), load(q.throughput[2] + i)};
    const Mask gamble = go & (byte_of(next_depth, 0) > Int(2));
    const Float birth = cardioid::CD_ISA_NS::gather(rays.min_pdf, ray);
    const Float survive = select(gamble, min(max_component(carried) / max(birth, 1e-37f), 0.95f), Float(1.0f));
    go &= chance.x < survive;
    const Mask sane = is_finite(carried.r) & is_finite(carried.g) & is_finite(carried.b);
    scratch.counters.photons_dropped += static_cast<std::uint64_t>(count(go & ~sane));
    go &= sane;
    if (none(go)) return;
    RayLaneState r;
    r.origin = {load(q.position[0] + i), load(q.position[1] + i), load(q.position[2] + i)};
    r.direction = s.wi;
    r.from_normal = {0.0f, 0.0f, 0.0f};
    r.t_min = r.pdf = r.width = r.spread = 0.0f;
    r.throughput = carried * (1.0f / max(survive, 1e-37f));
    r.min_pdf = birth;
    r.merge = cardioid::CD_ISA_NS::gather(rays.merge, ray);
    r.path = path;
    r.flags = Int(nodes::ray_diffuse | nodes::ray_reflection) | (next_state << path::k_state_shift) |
              Int(scene::visible_all << path::k_visibility_shift);
    r.depth = next_depth;
    r.transparent = next_transparent;
    append_media(*next, load_media(rays, ray), go);
    append_ray(*next, r, go);
}

}  // namespace cardioid::CD_ISA_NS
