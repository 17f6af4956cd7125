// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/session.h"

#include "film/film.h"
#include "film/pixel_filter.h"
#include "path/batch.h"
#include "render/photon_stage.h"
#include "render/tiles.h"
#include "simd/denormals.h"
#include "trace/traceable_scene.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/version.h>
#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace cardioid::render {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }

/// User + system seconds of this process.
double cpu_seconds() {
    rusage u{};
    getrusage(RUSAGE_SELF, &u);
    const auto s = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return s(u.ru_utime) + s(u.ru_stime);
}

/// Scratch and result of one thread.
struct Worker {
    std::unique_ptr<path::Scratch> scratch = std::make_unique<path::Scratch>();
    std::unique_ptr<path::BatchResult> result = std::make_unique<path::BatchResult>();
    std::vector<std::int32_t> bins;
    std::vector<photon::Photon> photons;  // of one batch
    std::uint64_t dropped = 0;
};

}  // namespace

const char* phase_name(Phase phase) {
    constexpr const char* names[] = {"waiting", "build", "render", "done", "cancelled", "failed"};
    return names[static_cast<int>(phase)];
}

int available_threads() { return std::max(1, tbb::info::default_concurrency()); }

std::string tbb_version() { return TBB_runtime_version(); }

struct Session::Impl {
    std::shared_ptr<const scene::SceneDesc> desc;
    path::TraceBatch trace_batch;
    path::TracePhotons trace_photons;
    int width;
    film::Film film;
    film::FilterTable filter_table;
    std::unique_ptr<trace::TraceableScene> scene;
    std::unique_ptr<PhotonStage> photons;
    tbb::enumerable_thread_specific<Worker> workers;

    std::thread controller;
    std::atomic<bool> cancelled{false};  // the host's wish
    std::atomic<bool> stop{false};       // cancelled, or out of time: batches end early
    std::atomic<std::uint64_t> revision{0};
    std::atomic<std::int64_t> pixel_samples{0};

    mutable std::mutex picture_mutex;
    film::Frame picture;

    mutable std::mutex state_mutex;
    std::condition_variable ended;
    Phase phase = Phase::waiting;
    std::string message;
    bool finished = false;
    Clock::time_point started, render_started;
    double build_seconds = 0, render_seconds = 0, camera_seconds = 0, elapsed_seconds = 0, first_tile_seconds = 0,
           cpu_at_start = 0, cpu_total = 0;
    std::vector<std::string> scene_warnings;
    trace::BuildStats build_stats;
    path::Counters counters;
    std::uint64_t dropped = 0;

    Impl(std::shared_ptr<const scene::SceneDesc> d, int lanes)
        : desc(std::move(d)),
          trace_batch(path::select_trace_batch(lanes)),
          trace_photons(path::select_trace_photons(lanes)),
          width(lanes == 0 ? path::best_width() : lanes),
          film(desc->settings),
          filter_table(film::make_filter_table(desc->settings.pixel_filter, desc->settings.filter_width)) {}

    void run();
    void build();
    void render();
    void render_pass(const Pass& pass, bool keep);
    void render_tile(const film::Region& tile, const Pass& pass, bool keep);
    /// This thread's memory, ready for a batch.
    Worker& worker();
    void set_phase(Phase p, const std::string& text);
    void finish(Phase p, const std::string& text);
    bool out_of_time() const;
    int threads() const;
};

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
    const float limit = desc->settings.time_limit;
    return limit > 0 && seconds_since(render_started) > static_cast<double>(limit);
}

void Session::Impl::run() {
    try {
        // One thread of the arena is this one.
        tbb::task_arena arena(threads());
        arena.execute([this] {
            const FlushDenormals guard;
            build();
            render();
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
    photons = std::make_unique<PhotonStage>(*scene, film.region(), trace_photons);
}

void Session::Impl::render() {
    {
        const std::lock_guard lock(state_mutex);
        phase = Phase::render;
        message.clear();
        render_started = Clock::now();
    }
    const int first = desc->settings.first_sample, most = photons->most_samples();
    // Photons must have learned what they would have if the whole frame were rendered here.
    if (photons->active() && first > 0) {
        const int lead = photons->has_state() ? first : std::min(first, 1 << (k_training_passes - 1));
        for (const Pass& pass : passes(0, lead, most)) {
            if (stop) return;
            if (photons->has_state() || pass.number < k_training_passes) render_pass(pass, false);
        }
    }
    for (const Pass& pass : passes(first, desc->settings.samples, most)) {
        if (stop || (pass.first > first && out_of_time())) break;
        render_pass(pass, true);
    }
}

void Session::Impl::render_pass(const Pass& pass, bool keep) {
    const auto photon_worker = [this] {
        Worker& w = worker();
        return PhotonWorker{w.scratch.get(), &w.photons};
    };
    if (!photons->trace(pass, photon_worker, stop)) return;
    const Clock::time_point camera_started = Clock::now();
    const auto list = tiles(film.region(), pass.samples);
    tbb::parallel_for(
        std::size_t{0}, list.size(),
        [&](std::size_t i) {
            if (stop) return;
            render_tile(list[i], pass, keep);
            // The first pass is finished whatever the limit says: a whole picture, never a part of one.
            if (pass.first > desc->settings.first_sample && out_of_time()) stop = true;
        },
        tbb::simple_partitioner{});
    if (!stop) photons->learn(pass);
    const std::lock_guard lock(state_mutex);
    camera_seconds += seconds_since(camera_started);
}

Worker& Session::Impl::worker() {
    Worker& w = workers.local();
    w.bins.resize(static_cast<std::size_t>(scene->view().material_count) + 3);
    w.scratch->bins = w.bins.data();
    w.scratch->cancelled = &stop;
    return w;
}

void Session::Impl::render_tile(const film::Region& tile, const Pass& pass, bool keep) {
    const FlushDenormals guard;
    Worker& worker = this->worker();
    path::BatchRequest request;
    request.scene = &scene->view();
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
    path::BatchResult& r = *worker.result;
    trace_batch(request, *worker.scratch, r);
    // A batch that was cut short lacks light: it is not counted.
    if (stop || !keep) return;
    for (int i = 0; i < r.n; ++i) {
        film::Sample s;
        for (int c = 0; c < film::k_classes; ++c) {
            for (int k = 0; k < 3; ++k) s.radiance[c][k] = r.radiance[c][k][i];
        }
        s.alpha = r.alpha[i];
        s.depth = r.depth[i];
        for (int k = 0; k < 3; ++k) s.normal[k] = r.normal[k][i];
        if (!film.add(r.x[i], r.y[i], s, r.sample[i] == desc->settings.first_sample)) ++worker.dropped;
    }
    {
        const std::lock_guard lock(picture_mutex);
        film.resolve(tile, picture);
        photons->resolve(tile, desc->settings.exposure, picture);
    }
    pixel_samples += std::int64_t{tile.width} * tile.height * pass.samples;
    if (revision++ == 0) {
        const std::lock_guard lock(state_mutex);
        first_tile_seconds = seconds_since(started);
    }
}

Session::Session(std::shared_ptr<const scene::SceneDesc> desc, int width, std::vector<std::string> notes)
    : impl_(std::make_unique<Impl>(std::move(desc), width)) {
    impl_->scene_warnings = std::move(notes);
    impl_->picture = impl_->film.make_frame();
}

Session::~Session() {
    cancel();
    if (impl_->controller.joinable()) impl_->controller.join();
}

void Session::start() {
    if (impl_->controller.joinable()) return;
    impl_->started = Clock::now();
    impl_->cpu_at_start = cpu_seconds();
    impl_->controller = std::thread([this] { impl_->run(); });
}

bool Session::wait(double seconds) {
    std::unique_lock lock(impl_->state_mutex);
    return impl_->ended.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return impl_->finished; });
}

void Session::cancel() {
    impl_->cancelled = true;
    impl_->stop = true;
}

Progress Session::progress() const {
    const Impl& s = *impl_;
    Progress p;
    const scene::Settings& settings = s.desc->settings;
    const film::Region region = s.film.region();
    const double pixels = static_cast<double>(region.width) * region.height;
    const double done = static_cast<double>(s.pixel_samples.load()) / pixels;
    p.revision = s.revision.load();
    p.total_samples = settings.samples;
    p.samples = static_cast<int>(done);
    p.fraction = done / settings.samples;
    const std::lock_guard lock(s.state_mutex);
    p.phase = s.phase;
    p.message = s.message;
    if (s.phase != Phase::waiting) p.elapsed = s.finished ? s.elapsed_seconds : seconds_since(s.started);
    if (s.phase == Phase::render) {
        const double spent = seconds_since(s.render_started);
        if (p.fraction > 0.001) p.remaining = spent / p.fraction * (1 - p.fraction);
        if (settings.time_limit > 0) {
            const double left = std::max(0.0, static_cast<double>(settings.time_limit) - spent);
            p.remaining = p.fraction > 0.001 ? std::min(p.remaining, left) : left;
            p.fraction = std::max(p.fraction, std::min(1.0, spent / static_cast<double>(settings.time_limit)));
        }
    }
    const auto& b = s.build_stats;
    p.memory_bytes = b.embree_bytes + b.geometry_bytes + b.image_bytes + b.light_bytes + 2 * s.film.memory_bytes();
    if (s.photons && s.render_started != Clock::time_point{}) {
        const PhotonStats photons = s.photons->stats();
        p.passes = photons.passes;
        p.photons_emitted = photons.emitted;
        p.photons_stored = photons.stored;
        p.memory_bytes += photons.bytes;
    }
    return p;
}

std::shared_ptr<const film::Frame> Session::frame() const {
    if (impl_->revision == 0) return nullptr;
    const std::lock_guard lock(impl_->picture_mutex);
    return std::make_shared<const film::Frame>(impl_->picture);
}

std::vector<std::string> Session::warnings() const {
    const std::lock_guard lock(impl_->state_mutex);
    return impl_->scene_warnings;
}

StatsJson Session::stats() const {
    const Impl& s = *impl_;
    const Progress p = progress();
    const std::lock_guard lock(s.state_mutex);
    const trace::BuildStats& b = s.build_stats;
    const path::Counters& c = s.counters;
    nlohmann::json j;
    j["phase"] = phase_name(s.phase);
    j["samples"] = p.samples;
    j["resolution"] = {s.film.region().width, s.film.region().height};
    j["seed"] = s.desc->settings.seed;
    j["threads"] = s.threads();
    j["lanes"] = s.width;
    const PhotonStats photons = s.photons ? s.photons->stats() : PhotonStats{};
    j["seconds"] = {{"camera", s.camera_seconds},
                    {"photon_trace", photons.trace_seconds},
                    {"photon_index", photons.index_seconds},
                    {"photon_learn", photons.learn_seconds},
                    {"build", s.build_seconds},
                    {"render", s.render_seconds},
                    {"first_tile", s.first_tile_seconds},
                    {"images", b.images_seconds},
                    {"materials", b.materials_seconds},
                    {"geometry", b.geometry_seconds},
                    {"tree", b.bvh_seconds},
                    {"lights", b.lights_seconds}};
    j["cpu_seconds"] = s.cpu_total;
    j["counts"] = {{"camera_paths", c.camera_paths},   {"rays", c.rays},
                   {"shadow_rays", c.shadow_rays},     {"vertices", c.vertices},
                   {"light_samples", c.light_samples}, {"non_finite_dropped", s.dropped},
                   {"triangles", b.triangles},         {"unique_triangles", b.unique_triangles},
                   {"instances", b.instances},         {"emissive_triangles", b.emissive_triangles}};
    j["bytes"] = {{"ray_tree", b.embree_bytes},
                  {"geometry", b.geometry_bytes},
                  {"images", b.image_bytes},
                  {"lights", b.light_bytes},
                  {"film", s.film.memory_bytes()}};
    j["bytes"]["photons"] = photons.bytes;
    j["photons"] = {{"passes", photons.passes},
                    {"skipped_passes", photons.skipped_passes},
                    {"training_passes", photons.training_passes},
                    {"emitted", photons.emitted},
                    {"stored", photons.stored},
                    {"gathers", c.gathers},
                    {"gathered", c.gathered},
                    {"rays", c.photon_rays},
                    {"dropped", c.photons_dropped},
                    {"per_sample", photons.per_sample}};
    j["warnings"] = s.scene_warnings;
    return j.dump(2);
}

}  // namespace cardioid::render
