// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of a batch: rays → hits → chunks by material → rays, then direct light from the record.
#include "path/tracer.h"

namespace cardioid::CD_ISA_NS {

void trace_batch(const path::BatchRequest& request, path::Scratch& scratch, path::BatchResult& result) {
    Tracer tracer{{*request.scene, scratch, &scratch.rays[0], &scratch.rays[1]}, request, result};
    scratch.arena.reset();
    scratch.first_chunk = nullptr;
    scratch.last_chunk = &scratch.first_chunk;
    scratch.shadows.n = scratch.walks.n = scratch.disks.n = scratch.scatterings.n = 0;
    tracer.start();
    for (int event = 0; event < k_max_events && tracer.now->n > 0; ++event) {
        if (scratch.cancelled && scratch.cancelled->load(std::memory_order_relaxed)) return;
        scratch.counters.rays += static_cast<std::uint64_t>(tracer.now->n);
        tracer.find_hits(event == 0, 0, event == 0);
        tracer.add_lamp_hits();
        if (tracer.scene.has_volumes) tracer.cross_media();
        tracer.sort_by_material();
        tracer.next->n = 0;
        tracer.for_each_chunk([&](int material, const std::int32_t* list, int n) {
            if (material == tracer.scene.material_count) {
                tracer.add_world(list, n);
            } else {
                tracer.shade(material, list, n);
            }
        });
        if (scratch.scatterings.n > 0) tracer.scatter_in_media();
        if (scratch.walks.n + scratch.disks.n > 0) tracer.walk_subsurface();
        tracer.swap_rays();
    }
    tracer.add_direct_light();
    tracer.finish();
}

}  // namespace cardioid::CD_ISA_NS
