// SPDX-License-Identifier: GPL-3.0-or-later
// The one place that chooses the lane width for this processor.
#include "path/batch.h"
#include "simd/width.h"

namespace cardioid {
namespace isa_w1 {
int trace_photons(const path::PhotonRequest&, path::Scratch&);
std::uint64_t replay_rays(RTCSceneTy*, const path::RayLog&);
void trace_batch(const path::BatchRequest&, path::Scratch&, path::BatchResult&);
}  // namespace isa_w1
namespace isa_w8 {
int trace_photons(const path::PhotonRequest&, path::Scratch&);
std::uint64_t replay_rays(RTCSceneTy*, const path::RayLog&);
void trace_batch(const path::BatchRequest&, path::Scratch&, path::BatchResult&);
}  // namespace isa_w8
namespace isa_w16 {
int trace_photons(const path::PhotonRequest&, path::Scratch&);
std::uint64_t replay_rays(RTCSceneTy*, const path::RayLog&);
void trace_batch(const path::BatchRequest&, path::Scratch&, path::BatchResult&);
}  // namespace isa_w16

namespace path {

int best_width() { return cardioid::best_width(); }

TraceBatch select_trace_batch(int width) {
    return by_width<TraceBatch>(width, isa_w1::trace_batch, isa_w8::trace_batch, isa_w16::trace_batch);
}

TracePhotons select_trace_photons(int width) {
    return by_width<TracePhotons>(width, isa_w1::trace_photons, isa_w8::trace_photons, isa_w16::trace_photons);
}

ReplayRays select_replay_rays(int width) {
    return by_width<ReplayRays>(width, isa_w1::replay_rays, isa_w8::replay_rays, isa_w16::replay_rays);
}

}  // namespace path
}  // namespace cardioid
