// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/filter_job.h"

#include "render/clock.h"
#include "render/filter_run.h"
#include "scene/error.h"

#include <tbb/task_arena.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace cardioid::render {

struct FilterJob::Impl {
    std::shared_ptr<const film::Film> film;
    scene::FilterSettings settings;
    int threads, lanes;
    std::atomic<bool> cancelled{false};
    FilterRun run{[this] { return cancelled.load(); }};
    std::thread controller;

    mutable std::mutex mutex;
    std::condition_variable ended;
    Phase phase = Phase::waiting;
    std::string message;
    bool finished = false;
    Clock::time_point started;
    double seconds = 0;
    std::shared_ptr<const film::Frame> frame;

    void work();
    /// Null: cancelled.
    std::shared_ptr<const film::Frame> picture();
    void finish(Phase p, const std::string& text, std::shared_ptr<const film::Frame> result = nullptr);
};

void FilterJob::Impl::work() {
    try {
        // One thread of the arena is this one.
        tbb::task_arena arena(threads);
        std::shared_ptr<const film::Frame> result;
        arena.execute([&] { result = picture(); });
        finish(result ? Phase::done : Phase::cancelled, "", result);
    } catch (const std::bad_alloc&) {
        finish(Phase::failed, "Not enough memory to filter this picture");
    } catch (const std::exception& e) { finish(Phase::failed, e.what()); }
}

std::shared_ptr<const film::Frame> FilterJob::Impl::picture() {
    if (cancelled) return nullptr;
    auto f = std::make_shared<film::Frame>(film->make_frame());
    filter::Filtered result;
    if (settings.use_filter) {
        result = run.compute(*film, settings, lanes);
        if (!result.complete) return nullptr;
    }
    film->resolve(film->region(), *f);
    show_raw(film->region(), film->region(), *f);
    if (settings.use_filter) run.publish(result, settings, *f);
    return f;
}

void FilterJob::Impl::finish(Phase p, const std::string& text, std::shared_ptr<const film::Frame> result) {
    {
        const std::lock_guard lock(mutex);
        phase = p;
        message = text;
        frame = std::move(result);
        seconds = seconds_since(started);
        finished = true;
    }
    ended.notify_all();
}

FilterJob::FilterJob(std::shared_ptr<const film::Film> film, const scene::FilterSettings& settings, int threads,
                     int lanes)
    : impl_(std::make_unique<Impl>()) {
    if (settings.use_filter && !film->has_clusters())
        throw scene::SceneError("the film holds nothing to filter: it was rendered without record_clusters");
    impl_->film = std::move(film);
    impl_->settings = settings;
    impl_->threads = threads > 0 ? std::min(threads, 4 * available_threads()) : available_threads();
    impl_->lanes = lanes;
}

FilterJob::~FilterJob() {
    cancel();
    if (impl_->controller.joinable()) impl_->controller.join();
}

void FilterJob::start() {
    if (impl_->controller.joinable()) return;
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->phase = Phase::render;
        impl_->message = "Filtering";
        impl_->started = Clock::now();
    }
    impl_->controller = std::thread([this] { impl_->work(); });
}

bool FilterJob::wait(double seconds) {
    std::unique_lock lock(impl_->mutex);
    return impl_->ended.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return impl_->finished; });
}

void FilterJob::cancel() { impl_->cancelled = true; }

Progress FilterJob::progress() const {
    const std::lock_guard lock(impl_->mutex);
    Progress p;
    p.phase = impl_->phase;
    p.message = impl_->message;
    p.fraction = impl_->phase == Phase::done ? 1 : impl_->run.fraction();
    if (impl_->phase != Phase::waiting) p.elapsed = impl_->finished ? impl_->seconds : seconds_since(impl_->started);
    p.revision = impl_->frame ? 1 : 0;
    return p;
}

std::shared_ptr<const film::Frame> FilterJob::frame() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->frame;
}

StatsJson FilterJob::stats() const {
    const std::lock_guard lock(impl_->mutex);
    nlohmann::json j = to_json(impl_->finished ? impl_->run.report() : FilterReport{});
    j["phase"] = phase_name(impl_->phase);
    j["threads"] = impl_->threads;
    j["total_seconds"] = impl_->seconds;
    j["film_bytes"] = impl_->film->memory_bytes();
    j["cluster_bytes"] = impl_->film->clusters().memory_bytes();
    return j.dump(2);
}

}  // namespace cardioid::render
