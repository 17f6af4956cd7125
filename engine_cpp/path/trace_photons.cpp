// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of a batch of photons.
#include "path/photons.h"

namespace cardioid::CD_ISA_NS {

namespace {
/// Whatever some lobe may see; which one does is tested at the far end of the segment.
constexpr int k_seen_by_lobes = scene::visible_diffuse | scene::visible_glossy | scene::visible_transmission;
}  // namespace

int trace_photons(const path::PhotonRequest& request, path::Scratch& scratch) {
    PhotonWalk walk{{*request.scene, scratch, &scratch.rays[0], &scratch.rays[1]}, request};
    scratch.scatterings.n = 0;
    walk.start();
    for (int event = 0; event < k_max_events && walk.now->n > 0; ++event) {
        if (scratch.cancelled && scratch.cancelled->load(std::memory_order_relaxed)) break;
        scratch.counters.photon_rays += static_cast<std::uint64_t>(walk.now->n);
        walk.find_hits(false, k_seen_by_lobes, event == 0);
        if (event == 0) walk.drop_early_hits();
        if (walk.scene.has_volumes) walk.cross_media();
        walk.sort_by_material();
        walk.next->n = 0;
        walk.for_each_chunk([&](int material, const std::int32_t* list, int n) {
            if (material != walk.scene.material_count) walk.shade(material, list, n);
        });
        if (scratch.scatterings.n > 0) walk.scatter_in_media();
        walk.swap_rays();
    }
    return walk.stored;
}

}  // namespace cardioid::CD_ISA_NS
