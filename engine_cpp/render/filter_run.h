// SPDX-License-Identifier: GPL-3.0-or-later
// One run of the filter over a film on the threads of the arena that it is called in; shared by sessions and filter jobs.
#pragma once

#include "film/film.h"
#include "filter/filter.h"
#include "scene/filter_settings.h"

#include <nlohmann/json_fwd.hpp>

#include <atomic>
#include <cstdint>
#include <functional>
#include <utility>

namespace cardioid::render {

/// What a run did and cost.
struct FilterReport {
    double seconds = 0, cpu_seconds = 0;  ///< of the whole run; CPU: of all its threads
    double rejection_seconds = 0;         ///< part of `seconds`
    filter::RejectionStats rejection;
    double withheld_share = 0;  ///< of the raw picture's luminance
};

class FilterRun {
public:
    /// `stop`: asked by all threads, often: whether to end the run early.
    explicit FilterRun(std::function<bool()> stop) : stop_(std::move(stop)) {}

    /// The slow part. `film` has clusters; nothing may write to it meanwhile. `lanes` as filter::run.
    filter::Filtered compute(const film::Film& film, const scene::FilterSettings& settings, int lanes = 0);
    /// Puts a complete result into a frame that Film::resolve has filled.
    void publish(const filter::Filtered& result, const scene::FilterSettings& settings, film::Frame& frame);

    /// In [0, 1], from any thread; never falls.
    double fraction() const { return fraction_.load(std::memory_order_relaxed); }
    const FilterReport& report() const { return report_; }

private:
    bool for_each(int n, const std::function<void(int)>& body);

    std::function<bool()> stop_;
    std::atomic<double> fraction_{0};
    std::atomic<std::int64_t> helpers_ns_{0};  ///< CPU time of threads other than the caller's
    int stage_ = 0;
    FilterReport report_;
};

/// Filtered = Raw inside `part` (frame coordinates), for pictures that no filter has seen. Without clusters: nothing.
void show_raw(const film::Region& region, const film::Region& part, film::Frame& frame);

nlohmann::json to_json(const FilterReport& report);

}  // namespace cardioid::render
