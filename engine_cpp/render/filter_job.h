// SPDX-License-Identifier: GPL-3.0-or-later
// Filtering a film on threads of its own; the host polls, as with a session. Many jobs may share a film.
#pragma once

#include "film/film.h"
#include "render/session.h"
#include "scene/filter_settings.h"

#include <memory>

namespace cardioid::render {

class FilterJob {
public:
    /// Settings have passed scene::validate. `threads` 0: all. `lanes`: width of the kernels, 0 for the best of this machine (tests
    /// choose). Without use_filter the frame is the raw picture. Throws SceneError when there is something to filter, but the film
    /// has no clusters.
    FilterJob(std::shared_ptr<const film::Film> film, const scene::FilterSettings& settings, int threads = 0,
              int lanes = 0);
    /// Cancels and waits.
    ~FilterJob();
    FilterJob(const FilterJob&) = delete;
    FilterJob& operator=(const FilterJob&) = delete;

    void start();
    /// True when the job has ended; waits at most `seconds`.
    bool wait(double seconds);
    void cancel();
    /// phase: render while it filters; fraction of the tiles.
    Progress progress() const;
    /// The whole picture, all passes; null until the job is done, or when it was cancelled.
    std::shared_ptr<const film::Frame> frame() const;
    /// JSON object: seconds and CPU seconds of the filter, clusters, singles, share of outliers, energy withheld, bytes.
    StatsJson stats() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace cardioid::render
