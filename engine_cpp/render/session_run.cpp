// SPDX-License-Identifier: GPL-3.0-or-later
// What the controller thread does: build, passes, tiles.
#include "render/session_impl.h"
#include "render/tiles.h"
#include "simd/denormals.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <sys/resource.h>

#include <algorithm>

namespace cardioid::render {

double cpu_seconds() {
    rusage u{};
    getrusage(RUSAGE_SELF, &u);
    const auto s = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return s(u.ru_utime) + s(u.ru_stime);
}

int Session::Impl::threads() const {
    const int wish = desc->settings.threads;
    return wish > 0 ? std::min(wish, 4 * available_threads()) : available_threads();
}

void Session::Impl::set_phase(Phase p, const std::string& text) {
    const std::lock_guard lock(state_mutex);
    phase = p;
    message = text;
}

void Session::Impl::finish(Phase p, const std::string& text) {
    {
        const std::lock_guard lock(state_mutex);
        phase = p;
        message = text;
        finished = true;
        elapsed_seconds = seconds_since(started);
        mean_samples = adaptive.mean_samples();
        cpu_total = cpu_seconds() - cpu_at_start;
        if (p != Phase::failed && render_started != Clock::time_point{}) render_seconds = seconds_since(render_started);
        for (const Worker& w : workers) {
            counters.add(w.scratch->counters);
            dropped += w.dropped;
        }
    }
    ended.notify_all();
}

bool Session::Impl::out_of_time() const {
    const auto limit = static_cast<double>(desc->settings.time_limit);
    // The last filter run is to fit too, where it does not take everything.
    const double kept = std::min(filter_schedule.last_seconds(), 0.5 * limit);
    return limit > 0 && seconds_since(render_started) + kept > limit;
}

void Session::Impl::run() {
    try {
        // One thread of the arena is this one.
        tbb::task_arena arena(threads());
        arena.execute([this] {
            const FlushDenormals guard;
            build();
            render();
            filter_at_end();
            measure_film();
        });
        finish(cancelled ? Phase::cancelled : Phase::done, "");
    } catch (const trace::BuildCancelled&) { finish(Phase::cancelled, ""); } catch (const std::bad_alloc&) {
        finish(Phase::failed,
               "Not enough memory for this scene: lower the resolution, simplify meshes or use instances");
    } catch (const std::exception& e) { finish(Phase::failed, e.what()); }
}

void Session::Impl::build() {
    set_phase(Phase::build, "Preparing");
    const auto progress = [this](const std::string& stage) {
        set_phase(Phase::build, stage);
        return cancelled.load();
    };
    scene = std::make_unique<trace::TraceableScene>(*desc, progress);
    const std::lock_guard lock(state_mutex);
    const auto found = scene->warnings();
    scene_warnings.insert(scene_warnings.end(), found.begin(), found.end());
    build_stats = scene->stats();
    build_seconds = seconds_since(started);
    photons = std::make_unique<PhotonStage>(*scene, region, trace_photons);
    if (!photons->has_state()) return;
    // Makes room in the film while one thread has it.
    film->set_photons(0, 0, {});
    if (adaptive.on()) {
        adaptive = Adaptive({}, region);
        scene_warnings.push_back(
            "Adaptive sampling is off: radii of each pixel's own (radius schedule) need all samples of every pixel");
    }
}

void Session::Impl::render() {
    {
        const std::lock_guard lock(state_mutex);
        phase = Phase::render;
        message.clear();
        render_started = Clock::now();
    }
    const int first = desc->settings.first_sample;
    for (Pass pass : passes(0, first + desc->settings.samples, photons->most_samples())) {
        // Photons must have learned what they would have if the whole frame were rendered here.
        const bool teaches = photons->active() && (pass.number < k_training_passes || photons->has_state());
        if (pass.first + pass.samples <= first && !teaches) continue;
        if (stop || (pass.first > first && out_of_time())) break;
        converged = adaptive.finished();
        if (converged) break;
        if (!teaches && pass.first < first) {
            pass.samples -= first - pass.first;
            pass.first = first;
        }
        render_pass(pass);
        if (!stop) after_pass(pass.first + pass.samples);
    }
}

void Session::Impl::after_pass(int end) {
    const int taken = end - desc->settings.first_sample;
    if (taken <= 0) return;
    if (adaptive.due(end, taken)) {
        adaptive.update();
        unfinished_pixels = adaptive.active_pixels();
        photons->thin(static_cast<double>(unfinished_pixels) / (static_cast<double>(region.width) * region.height));
    }
    // Tiles without active pixels were not rendered, and are done all the same.
    pixel_samples = std::int64_t{region.width} * region.height * taken;
    measure_film();
    if (filters() && filter_schedule.due(taken, seconds_since(render_started))) filter_picture();
}

void Session::Impl::render_pass(const Pass& pass) {
    const auto photon_worker = [this] {
        Worker& w = worker();
        return PhotonWorker{w.scratch.get(), &w.photons};
    };
    if (!photons->trace(pass, photon_worker, stop)) return;
    const Clock::time_point camera_started = Clock::now();
    const auto& active = adaptive.active();
    const auto list = active.empty() ? tiles(region, pass.samples) : active_tiles(region, pass.samples, active);
    tbb::parallel_for(
        std::size_t{0}, list.size(),
        [&](std::size_t i) {
            if (stop) return;
            render_tile(list[i], pass);
            // The first pass is finished whatever the limit says: a whole picture, never a part of one.
            if (pass.first > desc->settings.first_sample && out_of_time()) stop = true;
        },
        tbb::simple_partitioner{});
    if (!stop) photons->learn(pass, work());
    const std::lock_guard lock(state_mutex);
    camera_seconds += seconds_since(camera_started);
}

path::Counters Session::Impl::work() const {
    path::Counters sum;
    for (const Worker& w : workers) sum.add(w.scratch->counters);
    return sum;
}

void Session::Impl::measure(const path::BatchResult& r, int pass, BalanceMeter& meter) const {
    for (int i = 0; i < r.n; ++i) {
        Halves path;
        for (int c = 0; c < path::k_classes; ++c) {
            const bool by_photons = (photons->partition().photons >> c & 1) != 0;
            (by_photons ? path.photons : path.camera) +=
                path::luminance(r.radiance[c][0][i], r.radiance[c][1][i], r.radiance[c][2][i]);
        }
        path.hits = r.caustic_hits[i];
        meter.add(pass, r.x[i], r.y[i], path);
    }
}

Worker& Session::Impl::worker() {
    Worker& w = workers.local();
    w.bins.resize(static_cast<std::size_t>(scene->view().material_count) + 3);
    w.scratch->bins = w.bins.data();
    w.scratch->cancelled = &stop;
    return w;
}

void Session::Impl::render_tile(const film::Region& tile, const Pass& pass) {
    const FlushDenormals guard;
    Worker& worker = this->worker();
    path::BatchRequest request;
    request.scene = &photons->view();
    request.filter_table = filter_table.data();
    request.x = tile.x;
    request.y = tile.y;
    request.width = tile.width;
    request.height = tile.height;
    request.first_sample = pass.first;
    request.samples = pass.samples;
    request.seed = desc->settings.seed;
    request.partition = photons->partition();
    request.photons = photons->gather();
    request.layers = film->has_clusters();
    request.active = active_in(tile, worker);
    path::BatchResult& r = *worker.result;
    trace_batch(request, *worker.scratch, r);
    // A batch that was cut short lacks light: it is not counted.
    if (stop) return;
    if (BalanceMeter* meter = photons->meter(pass)) measure(r, pass.number, *meter);
    const int first = desc->settings.first_sample;
    if (pass.first + pass.samples <= first) return;
    add_samples(r, worker);
    photons->store(tile, *film);
    publish(tile);
    pixel_samples += std::int64_t{tile.width} * tile.height * (pass.samples - std::max(0, first - pass.first));
    if (revision++ == 0) {
        const std::lock_guard lock(state_mutex);
        first_tile_seconds = seconds_since(started);
    }
}

const std::uint8_t* Session::Impl::active_in(const film::Region& tile, Worker& w) const {
    const auto& active = adaptive.active();
    if (active.empty()) return nullptr;
    w.active.clear();
    for (int y = tile.y - region.y; y < tile.y - region.y + tile.height; ++y) {
        const auto row = active.begin() + static_cast<std::ptrdiff_t>(y) * region.width + (tile.x - region.x);
        w.active.insert(w.active.end(), row, row + tile.width);
    }
    return w.active.data();
}

}  // namespace cardioid::render
