// SPDX-License-Identifier: GPL-3.0-or-later
// The inside of a session, shared by its files.
#pragma once

#include "film/film.h"
#include "film/pixel_filter.h"
#include "path/batch.h"
#include "render/adaptive.h"
#include "render/clock.h"
#include "render/filter_run.h"
#include "render/filter_schedule.h"
#include "render/photon_stage.h"
#include "render/session.h"
#include "trace/traceable_scene.h"

#include <tbb/enumerable_thread_specific.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace cardioid::render {

/// User + system seconds of this process.
double cpu_seconds();

/// Scratch and result of one thread.
struct Worker {
    std::unique_ptr<path::Scratch> scratch = std::make_unique<path::Scratch>();
    std::unique_ptr<path::BatchResult> result = std::make_unique<path::BatchResult>();
    film::FilmWriter writer;
    std::vector<std::int32_t> bins;
    std::vector<std::uint8_t> active;     // pixels of one tile
    std::vector<photon::Photon> photons;  // of one batch
    std::uint64_t dropped = 0;
};

struct Session::Impl {
    std::shared_ptr<const scene::SceneDesc> desc;
    path::TraceBatch trace_batch;
    path::TracePhotons trace_photons;
    int width;
    std::shared_ptr<film::Film> film;
    const film::Region region;
    Adaptive adaptive;
    film::FilterTable filter_table;
    std::unique_ptr<trace::TraceableScene> scene;
    std::unique_ptr<PhotonStage> photons;
    tbb::enumerable_thread_specific<Worker> workers;

    std::thread controller;
    std::atomic<bool> cancelled{false};   // the host's wish
    std::atomic<bool> stop{false};        // cancelled, or out of time: batches end early
    std::atomic<double> cancelled_at{0};  // seconds after the start; 0: not cancelled
    std::atomic<bool> abandoned{false};   // nobody waits for the picture: filter runs end early too
    std::atomic<std::uint64_t> revision{0};
    std::atomic<std::int64_t> pixel_samples{0};  // pixels that adaptive sampling leaves out count as rendered
    std::atomic<bool> converged{false};          // adaptive sampling has nothing left to do
    std::atomic<std::int64_t> film_bytes{0}, cluster_bytes{0}, unfinished_pixels{0};

    mutable std::mutex picture_mutex;
    film::Frame picture;
    std::int64_t picture_bytes = 0;
    bool filtered = false;  // Combined is a filter's, which tiles leave as it is

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
    FilterSchedule filter_schedule;
    FilterReport filter_report;         // of the last run that ended
    double mean_samples = 0;            // of a pixel
    std::int64_t filtered_samples = 0;  // pixel_samples of the last run; the controller's alone
    bool too_large_to_filter = false;   // likewise

    Impl(std::shared_ptr<const scene::SceneDesc> d, int lanes)
        : desc(std::move(d)),
          trace_batch(path::select_trace_batch(lanes)),
          trace_photons(path::select_trace_photons(lanes)),
          width(lanes == 0 ? path::best_width() : lanes),
          film(std::make_shared<film::Film>(desc->settings)),
          region(film->region()),
          adaptive(desc->settings, region),
          filter_table(film::make_filter_table(desc->settings.pixel_filter, desc->settings.filter_width)) {}

    void run();
    void build();
    void render();
    void render_pass(const Pass& pass);
    void render_tile(const film::Region& tile, const Pass& pass);
    /// The tile's part of the pixels that go on; null: all of them do.
    const std::uint8_t* active_in(const film::Region& tile, Worker& worker) const;
    /// Adds the samples of a batch to the film.
    void add_samples(const path::BatchResult& r, Worker& worker);
    /// Brings the pixels of a tile into the picture.
    void publish(const film::Region& tile);
    /// After a pass: judges pixels, filters the picture where it is time.
    void after_pass(int end);
    bool filters() const { return desc->settings.filter.use_filter && !too_large_to_filter; }
    /// Filters the film as it is now and shows the result. Tiles must not be in work.
    void filter_picture();
    void run_filter();
    /// The last run, after a cancel or a time limit too.
    void filter_at_end();
    /// After a cancel: filtering takes longer than the host may be left waiting.
    bool waited_too_long() const;
    /// Bytes for progress and statistics, which must not look at the film while it grows.
    void measure_film();
    /// What all threads have counted.
    path::Counters work() const;
    /// This thread's memory, ready for a batch.
    Worker& worker();
    void measure(const path::BatchResult& r, int pass, BalanceMeter& meter) const;
    void set_phase(Phase p, const std::string& text);
    void finish(Phase p, const std::string& text);
    bool out_of_time() const;
    int threads() const;
};

}  // namespace cardioid::render
