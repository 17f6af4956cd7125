// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/filter_run.h"

#include "render/clock.h"
#include "simd/denormals.h"

#include <tbb/parallel_for.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <thread>

namespace cardioid::render {

namespace {

/// Where the stages of a run end: light is surveyed, rejected, and what is left is filtered, which takes most of the time.
constexpr double k_stage_ends[] = {0, 0.05, 0.2, 0.98};
constexpr int k_filter_stage = 2;

std::int64_t thread_cpu_ns() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return std::int64_t{1'000'000'000} * t.tv_sec + t.tv_nsec;
}

double luminance_of(const film::Pass& pass) {
    double sum = 0;
    for (std::size_t i = 0; i + 2 < pass.data.size(); i += 3) {
        const float rgb[3] = {pass.data[i], pass.data[i + 1], pass.data[i + 2]};
        sum += static_cast<double>(film::luminance(rgb));
    }
    return sum;
}

}  // namespace

bool FilterRun::for_each(int n, const std::function<void(int)>& body) {
    const std::thread::id caller = std::this_thread::get_id();
    const Clock::time_point start = Clock::now();
    const double before = k_stage_ends[stage_], share = (k_stage_ends[stage_ + 1] - before) / std::max(n, 1);
    std::atomic<int> done{0};
    tbb::parallel_for(
        0, n,
        [&](int i) {
            if (stop_()) return;
            const FlushDenormals guard;
            const bool helper = std::this_thread::get_id() != caller;
            const std::int64_t cpu = helper ? thread_cpu_ns() : 0;
            body(i);
            if (helper) helpers_ns_ += thread_cpu_ns() - cpu;
            const double now = before + share * ++done;
            double seen = fraction_.load(std::memory_order_relaxed);
            while (seen < now && !fraction_.compare_exchange_weak(seen, now, std::memory_order_relaxed)) {}
        },
        tbb::simple_partitioner{});
    if (stage_ < k_filter_stage) {
        report_.rejection_seconds += seconds_since(start);
        ++stage_;
    }
    return done == n;
}

filter::Filtered FilterRun::compute(const film::Film& film, const scene::FilterSettings& settings, int lanes) {
    const FlushDenormals guard;
    stage_ = settings.firefly_density > 0 ? 0 : k_filter_stage;
    const Clock::time_point start = Clock::now();
    const std::int64_t cpu = thread_cpu_ns();
    filter::Filtered result = filter::run(
        film, settings, [this](int n, const std::function<void(int)>& body) { return for_each(n, body); }, lanes);
    report_.seconds = seconds_since(start);
    report_.cpu_seconds = 1e-9 * static_cast<double>(thread_cpu_ns() - cpu + helpers_ns_);
    report_.rejection = result.rejection;
    if (result.complete) fraction_ = 1;
    return result;
}

void FilterRun::publish(const filter::Filtered& result, const scene::FilterSettings& settings, film::Frame& frame) {
    filter::write(result, settings, frame);
    const double raw = luminance_of(*frame.find("Raw"));
    report_.withheld_share = raw > 0 ? luminance_of(*frame.find("Withheld")) / raw : 0;
}

void show_raw(const film::Region& region, const film::Region& part, film::Frame& frame) {
    film::Pass* filtered = frame.find("Filtered");
    if (!filtered) return;
    const std::vector<float>& raw = frame.find("Raw")->data;
    for (int y = part.y; y < part.y + part.height; ++y) {
        const std::size_t at = 3 * (static_cast<std::size_t>(y - region.y) * region.width + (part.x - region.x));
        std::copy_n(&raw[at], 3 * static_cast<std::size_t>(part.width), &filtered->data[at]);
    }
}

nlohmann::json to_json(const FilterReport& r) {
    const filter::RejectionStats& c = r.rejection;
    const double clusters = static_cast<double>(std::max<std::int64_t>(c.clusters, 1));
    return {{"seconds", r.seconds},
            {"cpu_seconds", r.cpu_seconds},
            {"rejection_seconds", r.rejection_seconds},
            {"clusters", c.clusters},
            {"singles", c.singles},
            {"rejected", c.rejected},
            {"rejected_samples", c.rejected_samples},
            {"outlier_share", static_cast<double>(c.rejected) / clusters},
            {"withheld_share", r.withheld_share}};
}

}  // namespace cardioid::render
