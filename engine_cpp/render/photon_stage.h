// SPDX-License-Identifier: GPL-3.0-or-later
// The photon half of a render: before the camera paths of a pass, its photons are traced and indexed; the first passes teach the
// guide. Nothing is kept from pass to pass but what was learned, so memory does not grow with the number of passes.
#pragma once

#include "film/film.h"
#include "path/batch.h"
#include "render/balance.h"
#include "render/passes.h"
#include "trace/traceable_scene.h"

#include <cstdint>
#include <functional>
#include <memory>

namespace cardioid::render {

/// What one thread needs to trace photons.
struct PhotonWorker {
    path::Scratch* scratch = nullptr;
    std::vector<photon::Photon>* stored = nullptr;
};

/// Counted facts about the photon half (thesis tables 5.1 and 5.2).
struct PhotonStats {
    int passes = 0, skipped_passes = 0, training_passes = 0;
    std::int64_t emitted = 0, stored = 0;
    bool given_up = false;        ///< camera paths alone do better: after the training passes no photon is traced
    std::int64_t per_sample = 0;  ///< emitted for each sample of the frame
    double trace_seconds = 0, index_seconds = 0, learn_seconds = 0;
    std::int64_t bytes = 0;  ///< most that photons, index and guide took
};

class PhotonStage {
public:
    PhotonStage(const trace::TraceableScene& scene, const film::Region& region, path::TracePhotons kernel);
    ~PhotonStage();
    PhotonStage(const PhotonStage&) = delete;
    PhotonStage& operator=(const PhotonStage&) = delete;

    /// The scene as camera paths are to see it: with the threshold of class S that goes with the partition.
    const trace::SceneView& view() const;
    const path::Partition& partition() const;
    /// Photons are traced: something may be specular and something shines (or SPPM is chosen).
    bool active() const;
    /// Largest pass that keeps the photons of a pass within bounds, in samples.
    int most_samples() const;
    /// From the next pass on camera paths start in this share of the pixels only (adaptive sampling).
    void thin(double share);
    /// Traces and indexes the photons of a pass. False: stopped, there is no map.
    bool trace(const Pass& pass, const std::function<PhotonWorker()>& worker, const std::atomic<bool>& stop);
    /// What camera paths of the pass gather from; null when no photons are traced.
    const path::PhotonPass* gather() const;
    /// Where camera paths of a pass tell their results for the balance of the two halves; null: not of this pass.
    BalanceMeter* meter(const Pass& pass);
    /// After the camera paths of a training pass: learns from what they gathered. `work`: counted so far in the whole render.
    void learn(const Pass& pass, const path::Counters& work);
    /// Per-pixel schedule: tells the film the photons' part of the pixels inside `part` (frame coordinates), whose camera paths
    /// have gathered from the last pass.
    void store(const film::Region& part, film::Film& film) const;
    /// Whether passes depend on the ones before (the per-pixel schedule).
    bool has_state() const;
    PhotonStats stats() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace cardioid::render
