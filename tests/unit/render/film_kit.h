// SPDX-License-Identifier: GPL-3.0-or-later
// Renders that keep their film, filter jobs in one line, and comparisons bit for bit.
#pragma once

#include "analytic/scenes.h"
#include "render/filter_job.h"
#include "render/session.h"
#include "scene/validate.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <thread>

namespace cardioid::test {

using FramePointer = std::shared_ptr<const film::Frame>;
using FilmPointer = std::shared_ptr<const film::Film>;

/// Threads beyond the machine's cores, for as long as it lives: races need them.
struct ManyThreads {
    tbb::global_control control{tbb::global_control::max_allowed_parallelism, 8};
};

struct Rendered {
    FramePointer frame;
    FilmPointer film;
    nlohmann::json stats;
};

inline std::shared_ptr<const scene::SceneDesc> checked(scene::SceneDesc scene) {
    EXPECT_FALSE(scene::has_errors(scene::validate(scene)));
    return std::make_shared<const scene::SceneDesc>(std::move(scene));
}

inline Rendered render_film(const scene::SceneDesc& scene, int lanes = 0) {
    render::Session session(checked(scene), lanes);
    session.start();
    EXPECT_TRUE(session.wait(120));
    EXPECT_EQ(session.progress().phase, render::Phase::done) << session.progress().message;
    return {session.frame(), session.film(), nlohmann::json::parse(session.stats())};
}

inline FramePointer filtered(const FilmPointer& film, const scene::FilterSettings& settings, int threads = 0,
                             int lanes = 0) {
    render::FilterJob job(film, settings, threads, lanes);
    job.start();
    EXPECT_TRUE(job.wait(120));
    EXPECT_EQ(job.progress().phase, render::Phase::done) << job.progress().message;
    return job.frame();
}

inline bool same_values(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

/// Names of the passes that differ in a bit, or that one of the frames lacks.
inline std::string different_passes(const film::Frame& a, const film::Frame& b) {
    std::string names;
    if (a.passes.size() != b.passes.size()) names = "number of passes ";
    for (const film::Pass& p : a.passes) {
        const film::Pass* q = b.find(p.name);
        if (!q || !same_values(p.data, q->data)) names += p.name + " ";
    }
    return names;
}

/// Lists of clusters and counts of samples that differ in a bit.
inline int different_lists(const film::Film& a, const film::Film& b) {
    const film::Region r = a.region();
    int n = 0;
    for (int y = 0; y < r.height; ++y) {
        for (int x = 0; x < r.width; ++x) {
            n += a.samples(x, y) != b.samples(x, y);
            for (int layer = 0; layer < film::k_layers; ++layer) {
                const auto p = a.clusters().view(x, y, layer), q = b.clusters().view(x, y, layer);
                n += p.size() != q.size() || (!p.empty() && std::memcmp(p.data(), q.data(), p.size_bytes()) != 0);
            }
        }
    }
    return n;
}

/// RGB of the Combined pass, as the passes of three channels have it.
inline std::vector<float> combined_rgb(const film::Frame& f) {
    const std::vector<float>& c = f.find("Combined")->data;
    std::vector<float> rgb;
    rgb.reserve(c.size() / 4 * 3);
    for (std::size_t i = 0; i < c.size(); i += 4) rgb.insert(rgb.end(), {c[i], c[i + 1], c[i + 2]});
    return rgb;
}

inline bool is_filtered(const film::Frame& f) {
    return same_values(combined_rgb(f), f.find("Filtered")->data) &&
           !same_values(f.find("Raw")->data, f.find("Filtered")->data);
}

inline double seconds_after(std::chrono::steady_clock::time_point t) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - t).count();
}

inline bool wait_until(const std::function<bool()>& condition, double seconds = 30) {
    const auto start = std::chrono::steady_clock::now();
    while (!condition()) {
        if (seconds_after(start) > seconds) return false;
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    return true;
}

}  // namespace cardioid::test
