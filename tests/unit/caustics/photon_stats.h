// SPDX-License-Identifier: GPL-3.0-or-later
// A render with its statistics, for tests that count photons and for scenes whose warnings are expected.
#pragma once

#include "analytic/replicates.h"
#include "analytic/scenes.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <memory>

namespace cardioid::test {

struct Rendered {
    std::shared_ptr<const film::Frame> frame;
    nlohmann::json stats;
    std::int64_t photons(const char* what) const { return stats.at("photons").at(what).get<std::int64_t>(); }
};

/// Renders what validation leaves; everything must be finite and nothing dropped.
inline Rendered render_counted(scene::SceneDesc scene, std::uint32_t seed = 1) {
    scene.settings.seed = seed;
    const auto problems = scene::validate(scene);
    EXPECT_FALSE(scene::has_errors(problems)) << problems.front().message;
    render::Session session(std::make_shared<scene::SceneDesc>(std::move(scene)));
    session.start();
    EXPECT_TRUE(session.wait(120));
    EXPECT_EQ(session.progress().phase, render::Phase::done) << session.progress().message;
    Rendered r{session.frame(), nlohmann::json::parse(session.stats())};
    EXPECT_EQ(r.stats["counts"]["non_finite_dropped"], 0);
    if (!r.frame) {
        ADD_FAILURE() << "no picture";
        r.frame = std::make_shared<film::Frame>();
    }
    for (const auto& pass : r.frame->passes) {
        int bad = 0;
        for (const float v : pass.data) bad += !std::isfinite(v);
        EXPECT_EQ(bad, 0) << "values of " << pass.name << " that are not finite";
    }
    return r;
}

/// Glass and chrome above a floor under one lamp, few pixels: something to catch, quick.
inline SceneMaker small_caustic() {
    SceneMaker m;
    m.add(floor_quad(0, 6), diffuse(0.7f));
    m.add(sphere({-0.5f, 0, 0.7f}, 0.5f, 3, true), glass(1, 1.5f));
    m.add(sphere({0.7f, 0.2f, 0.5f}, 0.4f, 3, true), glossy(0.9f, 0));
    m.area_lamp({0, 0, 3}, {0, 0, 0}, 1, 1, 8);
    m.perspective({0, -3.5f, 2.5f}, {0, 0, 0.3f}, 0.35f);
    scene::Settings& s = m.scene.settings;
    s.integrator = scene::IntegratorKind::hybrid;
    s.width = s.height = 24;
    s.samples = 8;
    s.photons = 3000;
    return m;
}

}  // namespace cardioid::test
