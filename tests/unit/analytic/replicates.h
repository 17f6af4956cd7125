// SPDX-License-Identifier: GPL-3.0-or-later
// Renders with independent seeds as replicates: whole-picture means are tested against a known value, must lie within a bound
// of it with confidence, and must contradict a value that is 3 % off.
#pragma once

#include "render/session.h"
#include "scene/validate.h"
#include "statistics/ttest.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace cardioid::test {

inline std::shared_ptr<const film::Frame> render_frame(scene::SceneDesc scene, std::uint32_t seed = 0, int width = 0) {
    scene.settings.seed = seed;
    const auto problems = scene::validate(scene);
    for (const auto& p : problems) EXPECT_NE(p.severity, scene::Severity::error) << p.message;
    render::Session session(std::make_shared<scene::SceneDesc>(std::move(scene)), width);
    session.start();
    EXPECT_TRUE(session.wait(120));
    EXPECT_EQ(session.progress().phase, render::Phase::done) << session.progress().message;
    EXPECT_NE(session.stats().find("\"non_finite_dropped\": 0"), std::string::npos) << session.stats();
    for (const auto& w : session.warnings()) ADD_FAILURE() << w;
    return session.frame();
}

/// Mean of one channel of a pass over the whole picture.
inline double mean_of(const film::Frame& frame, const std::string& pass = "Combined", int channel = 0) {
    const film::Pass& p = *frame.find(pass);
    double sum = 0;
    const auto channels = static_cast<std::size_t>(p.channels);
    for (std::size_t i = static_cast<std::size_t>(channel); i < p.data.size(); i += channels)
        sum += static_cast<double>(p.data[i]);
    return sum / (static_cast<double>(frame.width) * frame.height);
}

inline constexpr int k_seeds = 10;
/// Of each test; about 60 tests with fixed seeds share a false alarm rate of 1 %.
inline constexpr double k_level = 2e-4;

inline statistics::Moments replicate(const scene::SceneDesc& scene, const std::string& pass = "Combined",
                                     int seeds = k_seeds, int width = 0) {
    statistics::Moments m;
    for (int s = 0; s < seeds; ++s)
        m.add(mean_of(*render_frame(scene, static_cast<std::uint32_t>(1000 + s), width), pass));
    return m;
}

/// `rounding`: relative error that the scene's tessellation or float arithmetic may have.
inline void expect_value(const statistics::Moments& m, double expected, double bound = 0.01, double rounding = 2e-5) {
    const double tolerance = rounding * std::fabs(expected);
    const statistics::TResult t = statistics::t_test(m, expected, tolerance);
    testing::Test::RecordProperty("relative_error", std::to_string(t.difference / expected));
    EXPECT_FALSE(t.rejected(k_level)) << "mean " << m.mean << ", expected " << expected << " ± " << t.error;
    EXPECT_TRUE(t.equivalent(bound * std::fabs(expected), 0.02))
        << "mean " << m.mean << ", expected " << expected << ": too noisy, ± " << t.error;
    EXPECT_TRUE(statistics::t_test(m, 1.03 * expected, tolerance).rejected(k_level))
        << "cannot tell 3 %: ± " << t.error;
}

inline void expect_value(const scene::SceneDesc& scene, double expected, const std::string& pass = "Combined",
                         double bound = 0.01, double rounding = 2e-5) {
    expect_value(replicate(scene, pass), expected, bound, rounding);
}

/// The mutant of the scene must not pass for the value.
inline void expect_not(const scene::SceneDesc& mutant, double expected, const std::string& pass = "Combined") {
    EXPECT_TRUE(statistics::t_test(replicate(mutant, pass), expected, 2e-5 * std::fabs(expected)).rejected(k_level))
        << "the mutant passes";
}

}  // namespace cardioid::test
