// SPDX-License-Identifier: GPL-3.0-or-later
// The life of a session: progress, pictures on the way, cancelling in every stage, time limits, statistics.
#include "analytic/replicates.h"
#include "analytic/scenes.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <functional>
#include <thread>

namespace cardioid::test {
namespace {

using render::Phase;
using render::Session;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }

std::shared_ptr<const scene::SceneDesc> shared(scene::SceneDesc scene) {
    EXPECT_FALSE(scene::has_errors(scene::validate(scene)));
    return std::make_shared<const scene::SceneDesc>(std::move(scene));
}

/// Would render for hours.
std::shared_ptr<const scene::SceneDesc> endless() {
    SceneMaker m = busy_scene();
    m.scene.settings.samples = 10'000'000;
    return shared(m.scene);
}

/// Half a million triangles, each of which shines if asked: every stage of the build takes a while.
std::shared_ptr<const scene::SceneDesc> heavy(bool shining) {
    SceneMaker m = busy_scene();
    m.add(sphere({0, 0, 1}, 9, 8, true),
          shining ? combined("ShaderNodeAddShader", diffuse(0.5f), emission(0.1f)) : diffuse(0.5f));
    m.scene.settings.samples = 10'000'000;
    return shared(m.scene);
}

bool wait_for(const std::function<bool()>& condition, double seconds = 30) {
    const auto start = Clock::now();
    while (!condition()) {
        if (seconds_since(start) > seconds) return false;
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    return true;
}

/// Seconds from cancel() to the end when it comes while `stage` runs; 0: that stage was over before it was seen.
double cancel_during(const std::shared_ptr<const scene::SceneDesc>& desc, const std::string& stage) {
    Session session(desc);
    session.start();
    const auto in_stage = [&] {
        const auto p = session.progress();
        return stage == "render" ? p.phase == Phase::render && p.revision > 0
                                 : p.phase == Phase::build && p.message == stage;
    };
    const Phase wanted = stage == "render" ? Phase::render : Phase::build;
    EXPECT_TRUE(wait_for([&] { return in_stage() || session.progress().phase > wanted; })) << stage;
    if (!in_stage()) return 0;
    const auto start = Clock::now();
    session.cancel();
    EXPECT_TRUE(session.wait(30));
    const double took = seconds_since(start);
    EXPECT_EQ(session.progress().phase, Phase::cancelled);
    return took;
}

/// The best of a few: other programs on the machine must not fail the test.
void expect_fast_cancel(const std::shared_ptr<const scene::SceneDesc>& desc, const std::string& stage) {
    double best = 1e9;
    for (int attempt = 0; attempt < 4 && best > 0.25; ++attempt) { best = std::min(best, cancel_during(desc, stage)); }
    EXPECT_LT(best, 0.25) << "cancelled during '" << stage << "'";
}

TEST(Session, CancelWhileRendering) { expect_fast_cancel(endless(), "render"); }

TEST(Session, CancelWhileBuilding) {
    const auto desc = heavy(false);
    for (const char* stage : {"Preparing geometry", "Building the ray tracing tree", "Preparing lights"})
        expect_fast_cancel(desc, stage);
}

// Half a million shining triangles take more than a second.
TEST(Session, CancelWhilePreparingManyLights) { expect_fast_cancel(heavy(true), "Preparing lights"); }

TEST(Session, CancelBeforeAndAfter) {
    Session never(endless());
    never.cancel();
    EXPECT_FALSE(never.wait(0.01));
    never.start();
    EXPECT_TRUE(never.wait(5));
    EXPECT_EQ(never.progress().phase, Phase::cancelled);
    EXPECT_EQ(never.frame(), nullptr);

    Session done(shared(busy_scene().scene));
    done.start();
    ASSERT_TRUE(done.wait(60));
    done.cancel();
    EXPECT_EQ(done.progress().phase, Phase::done);
    EXPECT_NE(done.frame(), nullptr);
}

TEST(Session, DestroyedWhileRenderingOrBuilding) {
    for (const bool building : {true, false}) {
        double best = 1e9;
        for (int attempt = 0; attempt < 4 && best > 0.25; ++attempt) {
            auto session = std::make_unique<Session>(building ? heavy(false) : endless());
            session->start();
            ASSERT_TRUE(
                wait_for([&] { return session->progress().phase == (building ? Phase::build : Phase::render); }));
            const auto start = Clock::now();
            session.reset();
            best = std::min(best, seconds_since(start));
        }
        EXPECT_LT(best, 0.25) << building;
    }
    const Session never_started(endless());
}

TEST(Session, PictureOfACancelledRenderStays) {
    Session session(endless());
    session.start();
    ASSERT_TRUE(wait_for([&] { return session.progress().samples >= 3; }));
    session.cancel();
    ASSERT_TRUE(session.wait(10));
    const auto frame = session.frame();
    ASSERT_NE(frame, nullptr);
    EXPECT_GE(frame->samples, 3);
    EXPECT_GT(mean_of(*frame), 0.01);
}

TEST(Session, ASecondStartDoesNothing) {
    Session session(shared(busy_scene().scene));
    session.start();
    session.start();
    ASSERT_TRUE(session.wait(60));
    const auto revision = session.progress().revision;
    session.start();
    EXPECT_TRUE(session.wait(5));
    EXPECT_EQ(session.progress().revision, revision);
    EXPECT_EQ(session.progress().phase, Phase::done);
}

TEST(Session, ProgressGrows) {
    SceneMaker m = busy_scene();
    m.scene.settings.samples = 64;
    Session session(shared(m.scene));
    EXPECT_EQ(session.progress().phase, Phase::waiting);
    EXPECT_EQ(session.progress().elapsed, 0);
    session.start();
    render::Progress last = session.progress();
    bool seen_rendering = false;
    while (!session.wait(0.002)) {
        const render::Progress p = session.progress();
        EXPECT_GE(p.fraction, last.fraction);
        EXPECT_GE(p.revision, last.revision);
        EXPECT_GE(p.elapsed, last.elapsed);
        EXPECT_GE(p.phase, last.phase);
        EXPECT_LE(p.fraction, 1);
        EXPECT_GE(p.remaining, 0);
        seen_rendering = seen_rendering || p.phase == Phase::render;
        last = p;
    }
    EXPECT_TRUE(seen_rendering);
    const render::Progress end = session.progress();
    EXPECT_EQ(end.phase, Phase::done);
    EXPECT_EQ(end.samples, 64);
    EXPECT_EQ(end.total_samples, 64);
    EXPECT_NEAR(end.fraction, 1, 1e-9);
    EXPECT_EQ(end.remaining, 0);
    EXPECT_GT(end.memory_bytes, 100'000);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(session.progress().elapsed, end.elapsed) << "the clock stops with the render";
}

TEST(Session, PicturesOnTheWayHaveEveryPass) {
    Session session(endless());
    session.start();
    ASSERT_TRUE(wait_for([&] { return session.frame() != nullptr; }));
    const auto early = session.frame();
    EXPECT_EQ(early->passes.size(), 11u);
    const float before = early->find("Combined")->data[0];
    ASSERT_TRUE(wait_for([&] { return session.progress().samples >= 4; }));
    EXPECT_EQ(early->find("Combined")->data[0], before) << "a copy, not the picture in work";
    EXPECT_GE(session.frame()->samples, 4);
}

TEST(Session, TimeLimitEndsTheRender) {
    SceneMaker m = busy_scene();
    m.scene.settings.samples = 10'000'000;
    m.scene.settings.time_limit = 0.3f;
    Session session(shared(m.scene));
    const auto start = Clock::now();
    session.start();
    ASSERT_TRUE(session.wait(20));
    EXPECT_EQ(session.progress().phase, Phase::done);
    EXPECT_GT(seconds_since(start), 0.29);
    EXPECT_LT(seconds_since(start), 3);
    EXPECT_GE(session.frame()->samples, 1);
    const auto stats = nlohmann::json::parse(session.stats());
    EXPECT_NEAR(stats["seconds"]["render"].get<double>(), 0.3, 0.25);
}

TEST(Session, TwoAtOnceShareTheScene) {
    SceneMaker m = busy_scene();
    const auto desc = shared(m.scene);
    Session a(desc), b(desc);
    a.start();
    b.start();
    ASSERT_TRUE(a.wait(60) && b.wait(60));
    EXPECT_EQ(a.frame()->find("Combined")->data, b.frame()->find("Combined")->data);
}

TEST(Session, Statistics) {
    SceneMaker m = busy_scene();
    m.scene.settings.width = 20;
    m.scene.settings.height = 10;
    m.scene.settings.crop = {2, 1, 16, 8};
    m.scene.settings.seed = 77;
    Session session(shared(m.scene), 8);
    EXPECT_EQ(nlohmann::json::parse(session.stats())["phase"], "waiting");
    session.start();
    ASSERT_TRUE(session.wait(60));
    const auto j = nlohmann::json::parse(session.stats());
    EXPECT_EQ(j["phase"], "done");
    EXPECT_EQ(j["samples"], 16);
    EXPECT_EQ(j["resolution"], (std::vector<int>{16, 8}));
    EXPECT_EQ(j["seed"], 77);
    EXPECT_EQ(j["threads"], 2);
    EXPECT_EQ(j["lanes"], 8);
    const auto& counts = j["counts"];
    EXPECT_EQ(counts["camera_paths"], 16 * 8 * 16);
    EXPECT_GE(counts["rays"].get<int>(), 16 * 8 * 16);
    EXPECT_GT(counts["shadow_rays"].get<int>(), 0);
    EXPECT_GT(counts["vertices"].get<int>(), 0);
    EXPECT_EQ(counts["non_finite_dropped"], 0);
    EXPECT_EQ(counts["instances"], 6);
    EXPECT_EQ(counts["triangles"], 3 * 512 + 6);
    EXPECT_EQ(counts["emissive_triangles"], 2);
    for (const char* key : {"ray_tree", "geometry", "film", "lights"}) EXPECT_GT(j["bytes"][key].get<int>(), 0) << key;
    for (const char* key : {"build", "render", "first_tile"}) EXPECT_GT(j["seconds"][key].get<double>(), 0) << key;
    EXPECT_LE(j["seconds"]["first_tile"].get<double>(),
              j["seconds"]["build"].get<double>() + j["seconds"]["render"].get<double>() + 0.01);
    EXPECT_TRUE(j["warnings"].empty());
}

TEST(Session, WarningsNameTheNode) {
    SceneMaker m = busy_scene();
    m.scene.materials[0].graph = GraphMaker().node("ShaderNodeFromTheFuture", "Odd one").surface("BSDF");
    Session session(shared(m.scene));
    session.start();
    ASSERT_TRUE(session.wait(60));
    ASSERT_EQ(session.warnings().size(), 1u);
    EXPECT_NE(session.warnings()[0].find("Odd one"), std::string::npos) << session.warnings()[0];
}

}  // namespace
}  // namespace cardioid::test
