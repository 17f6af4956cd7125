// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of a batch: rays → hits → chunks by material → rays, then direct light from the record.
#include "path/tracer.h"

namespace cardioid::CD_ISA_NS {

namespace {

/// More events than any setting allows: transparent surfaces and bounces together.
constexpr int k_max_events = 1024;

void shade_bins(Tracer& tracer) {
    path::Scratch& scratch = tracer.scratch;
    const int materials = tracer.scene.material_count;
    std::int32_t list[k_chunk + 16];
    int begin = 0;
    for (int m = 0; m <= materials; ++m) {
        const int end = scratch.bins[m];
        for (int at = begin; at < end; at += k_chunk) {
            const int n = end - at < k_chunk ? end - at : k_chunk;
            for (int i = 0; i < n; ++i) list[i] = scratch.order[at + i];
            // Lanes past the end repeat the last ray, so that kernels may compute them.
            for (int i = n; i < n + 16; ++i) list[i] = list[n - 1];
            if (m == materials) {
                tracer.add_world(list, n);
            } else {
                tracer.shade(m, list, n);
            }
        }
        begin = end;
    }
}

}  // namespace

void trace_batch(const path::BatchRequest& request, path::Scratch& scratch, path::BatchResult& result) {
    Tracer tracer{*request.scene, request, scratch, result, &scratch.rays[0], &scratch.rays[1]};
    scratch.arena.reset();
    scratch.first_chunk = nullptr;
    scratch.last_chunk = &scratch.first_chunk;
    scratch.shadows.n = 0;
    tracer.start();
    for (int event = 0; event < k_max_events && tracer.now->n > 0; ++event) {
        if (scratch.cancelled && scratch.cancelled->load(std::memory_order_relaxed)) return;
        tracer.find_hits(event == 0);
        tracer.add_lamp_hits();
        tracer.sort_by_material();
        tracer.next->n = 0;
        shade_bins(tracer);
        path::RayState* const done = tracer.now;
        tracer.now = tracer.next;
        tracer.next = done;
    }
    tracer.add_direct_light();
}

}  // namespace cardioid::CD_ISA_NS
