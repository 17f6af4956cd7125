// SPDX-License-Identifier: GPL-3.0-or-later
// Who estimates what: the three integrators are three values of this (spec 2).
#pragma once

#include "path/automaton.h"
#include "scene/scene_desc.h"

namespace cardioid::path {

struct Partition {
    ClassSet camera = k_all_classes;  ///< by camera paths
    ClassSet photons = 0;             ///< by photons
    /// Camera paths that meet a lamp through D S+ count too, weighted against photons; they are C1.
    bool blend_hits = false;
};

/// `casters`: some lobe may be specular. Without any, there are no caustics and the hybrid is path tracing.
inline Partition make_partition(const scene::Settings& s, bool casters) {
    constexpr ClassSet d1 = bit(PathClass::d1), c1 = bit(PathClass::c1), c2 = bit(PathClass::c2);
    if (s.integrator == scene::IntegratorKind::photon_mapping)
        return {d1, static_cast<ClassSet>(k_all_classes & ~d1), false};
    if (s.integrator == scene::IntegratorKind::path_tracing || !casters) return {};
    Partition p{static_cast<ClassSet>(k_all_classes & ~(c1 | c2)), c1, s.blend_caustic_hits};
    if (s.indirect_caustics == scene::IndirectCaustics::photons) p.photons |= c2;
    if (s.indirect_caustics == scene::IndirectCaustics::path_tracing) p.camera |= c2;
    return p;
}

}  // namespace cardioid::path
