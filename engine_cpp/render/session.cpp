// SPDX-License-Identifier: GPL-3.0-or-later
// The public face of a session: start, wait, cancel, and copies of what it has.
#include "render/session.h"

#include "render/sample_counts.h"
#include "render/session_impl.h"

#include <tbb/info.h>
#include <tbb/version.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace cardioid::render {

const char* phase_name(Phase phase) {
    constexpr const char* names[] = {"waiting", "build", "render", "done", "cancelled", "failed"};
    return names[static_cast<int>(phase)];
}

int available_threads() { return std::max(1, tbb::info::default_concurrency()); }

std::string tbb_version() { return TBB_runtime_version(); }

Session::Session(std::shared_ptr<const scene::SceneDesc> desc, int width, std::vector<std::string> notes)
    : impl_(std::make_unique<Impl>(std::move(desc), width)) {
    impl_->scene_warnings = std::move(notes);
    impl_->picture = impl_->film->make_frame();
    if (impl_->adaptive.on()) add_sample_counts(impl_->picture);
    for (const film::Pass& p : impl_->picture.passes)
        impl_->picture_bytes += static_cast<std::int64_t>(p.data.size() * sizeof(float));
    impl_->unfinished_pixels = impl_->adaptive.active_pixels();
    impl_->measure_film();
}

Session::~Session() {
    impl_->abandoned = true;
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
    if (!impl_->cancelled) impl_->cancelled_at = std::max(1e-9, seconds_since(impl_->started));
    impl_->cancelled = true;
    impl_->stop = true;
}

Progress Session::progress() const {
    const Impl& s = *impl_;
    Progress p;
    const scene::Settings& settings = s.desc->settings;
    const double pixels = static_cast<double>(s.region.width) * s.region.height;
    const double done = static_cast<double>(s.pixel_samples.load()) / pixels;
    p.revision = s.revision.load();
    p.total_samples = settings.samples;
    p.samples = static_cast<int>(done);
    p.fraction = s.converged ? 1 : done / settings.samples;
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
        } else if (p.remaining > 0) {
            p.remaining += s.filter_schedule.last_seconds();
        }
    }
    const auto& b = s.build_stats;
    p.memory_bytes = b.embree_bytes + b.geometry_bytes + b.image_bytes + b.light_bytes + s.film_bytes + s.picture_bytes;
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

std::shared_ptr<const film::Film> Session::film() const {
    const std::lock_guard lock(impl_->state_mutex);
    if (!impl_->finished || impl_->phase == Phase::failed || impl_->revision == 0) return nullptr;
    return impl_->film;
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
    j["resolution"] = {s.region.width, s.region.height};
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
    j["bytes"] = {{"ray_tree", b.embree_bytes}, {"geometry", b.geometry_bytes}, {"images", b.image_bytes},
                  {"lights", b.light_bytes},    {"film", s.film_bytes.load()},  {"clusters", s.cluster_bytes.load()}};
    j["bytes"]["photons"] = photons.bytes;
    j["photons"] = {{"passes", photons.passes},
                    {"skipped_passes", photons.skipped_passes},
                    {"training_passes", photons.training_passes},
                    {"given_up", photons.given_up},
                    {"emitted", photons.emitted},
                    {"stored", photons.stored},
                    {"gathers", c.gathers},
                    {"gathered", c.gathered},
                    {"rays", c.photon_rays},
                    {"dropped", c.photons_dropped},
                    {"per_sample", photons.per_sample}};
    j["filter"] = to_json(s.filter_report);
    j["filter"]["runs"] = s.filter_schedule.runs();
    j["filter"]["seconds_of_all_runs"] = s.filter_schedule.seconds();
    if (s.adaptive.on()) {
        j["adaptive"] = {{"min_samples", s.adaptive.min_samples()},
                         {"mean_samples", s.mean_samples},
                         {"unfinished_pixels", s.unfinished_pixels.load()}};
    }
    j["warnings"] = s.scene_warnings;
    return j.dump(2);
}

}  // namespace cardioid::render
