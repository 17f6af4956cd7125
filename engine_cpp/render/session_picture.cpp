// SPDX-License-Identifier: GPL-3.0-or-later
// What a session shows: samples into the film, tiles into the picture, and the filter over it.
#include "render/sample_counts.h"
#include "render/session_impl.h"

namespace cardioid::render {

namespace {

film::Sample sample_of(const path::BatchResult& r, int i) {
    film::Sample s;
    for (int c = 0; c < film::k_classes; ++c) {
        for (int k = 0; k < 3; ++k) s.radiance[c][k] = r.radiance[c][k][i];
    }
    for (int k = 0; k < 3; ++k) {
        s.unfiltered[k] = r.unfiltered[k][i];
        s.detail[k] = r.detail[k][i];
        s.mirrored_detail[k] = r.mirrored_detail[k][i];
        s.feature_normal[k] = r.feature_normal[k][i];
        s.normal[k] = r.normal[k][i];
        for (int l = 0; l < film::k_layers; ++l) {
            s.layers[l].radiance[k] = r.layer_radiance[l][k][i];
            s.layers[l].incident[k] = r.layer_incident[l][k][i];
        }
    }
    s.feature_depth = r.feature_depth[i];
    s.feature_depth_squared = r.feature_depth_squared[i];
    s.alpha = r.alpha[i];
    s.depth = r.depth[i];
    return s;
}

}  // namespace

void Session::Impl::add_samples(const path::BatchResult& r, Worker& worker) {
    const int first = desc->settings.first_sample;
    worker.writer.open(*film);
    for (int i = 0; i < r.n; ++i) {
        if (r.sample[i] < first) continue;
        const film::Sample s = sample_of(r, i);
        const bool added = worker.writer.add(r.x[i], r.y[i], s, r.sample[i] == first);
        if (!added) ++worker.dropped;
        if (added && adaptive.on()) adaptive.add(r.x[i], r.y[i], s, r.sample[i]);
    }
    worker.writer.close();
}

void Session::Impl::publish(const film::Region& tile) {
    const std::lock_guard lock(picture_mutex);
    film->resolve(tile, picture, filtered);
    if (!filtered) show_raw(region, tile, picture);
    show_sample_counts(*film, tile, picture);
}

void Session::Impl::filter_picture() {
    set_phase(Phase::render, "Filtering");
    try {
        run_filter();
    } catch (const std::bad_alloc&) {
        too_large_to_filter = true;
        const std::lock_guard lock(state_mutex);
        scene_warnings.push_back("Not enough memory to filter: the picture stays as it was");
    }
    set_phase(Phase::render, "");
}

void Session::Impl::run_filter() {
    const std::int64_t samples = pixel_samples;
    FilterRun run([this] { return abandoned || waited_too_long(); });
    const filter::Filtered result = run.compute(*film, desc->settings.filter, width);
    if (!result.complete) return;
    {
        const std::lock_guard lock(picture_mutex);
        run.publish(result, desc->settings.filter, picture);
        filtered = true;
    }
    filtered_samples = samples;
    ++revision;
    const std::lock_guard lock(state_mutex);
    filter_report = run.report();
    filter_schedule.ran(static_cast<int>(samples / (std::int64_t{region.width} * region.height)), run.report().seconds);
}

bool Session::Impl::waited_too_long() const {
    const double since = cancelled_at;
    return since > 0 && seconds_since(started) - since > FilterSchedule::k_affordable;
}

void Session::Impl::filter_at_end() {
    if (!filters() || abandoned || pixel_samples == filtered_samples) return;
    if (cancelled && !filter_schedule.affordable_after_cancel()) return;
    filter_picture();
}

void Session::Impl::measure_film() {
    film_bytes = film->memory_bytes() + adaptive.memory_bytes();
    cluster_bytes = film->clusters().memory_bytes();
}

}  // namespace cardioid::render
