// SPDX-License-Identifier: GPL-3.0-or-later
// Sessions that filter what they show: on the way, at the end, after a cancel and a time limit.
#include "render/film_kit.h"
#include "render/filter_schedule.h"

namespace cardioid::test {
namespace {

using render::FilterSchedule;
using render::Phase;
using render::Session;
using Clock = std::chrono::steady_clock;

scene::SceneDesc filtered_scene(int samples = 16) {
    scene::SceneDesc scene = busy_scene().scene;
    scene.settings.samples = samples;
    scene.settings.filter.use_filter = true;
    return scene;
}

constexpr int k_endless = 10'000'000;

TEST(FilterSchedule, AtOnceThenWhenSamplesHaveDoubled) {
    FilterSchedule s;
    EXPECT_FALSE(s.due(0, 100));
    EXPECT_TRUE(s.due(1, 0)) << "the first picture is filtered whatever it takes";
    s.ran(1, 0.1);
    EXPECT_FALSE(s.due(1, 1000));
    EXPECT_TRUE(s.due(2, 1000));
    s.ran(4, 0.1);
    EXPECT_FALSE(s.due(7, 1000));
    EXPECT_TRUE(s.due(8, 1000));
}

TEST(FilterSchedule, NeverTakesMoreThanATenthOfTheTime) {
    FilterSchedule s;
    s.ran(1, 1);
    EXPECT_FALSE(s.due(100, 19.9)) << "a second run would make it 2 of 19.9 seconds";
    EXPECT_TRUE(s.due(100, 20.1));
    s.ran(100, 3);
    EXPECT_FALSE(s.due(1000, 69));
    EXPECT_TRUE(s.due(1000, 71));
    EXPECT_TRUE(s.affordable_after_cancel());
    s.ran(1000, 6);
    EXPECT_FALSE(s.affordable_after_cancel());
}

TEST(FilteringSession, OffIsTheRawPictureBitForBit) {
    scene::SceneDesc scene = filtered_scene();
    const Rendered on = render_film(scene);
    scene.settings.filter.use_filter = false;
    const Rendered off = render_film(scene);
    EXPECT_TRUE(same_values(combined_rgb(*off.frame), off.frame->find("Raw")->data));
    EXPECT_TRUE(same_values(off.frame->find("Filtered")->data, off.frame->find("Raw")->data));
    for (const float v : off.frame->find("Withheld")->data) ASSERT_EQ(v, 0);
    scene.settings.record_clusters = false;
    const Rendered plain = render_film(scene);
    EXPECT_EQ(plain.frame->find("Filtered"), nullptr);
    EXPECT_TRUE(same_values(plain.frame->find("Combined")->data, off.frame->find("Combined")->data));
    EXPECT_TRUE(same_values(combined_rgb(*plain.frame), on.frame->find("Raw")->data));
    for (const char* pass : {"D1", "D2", "D3", "C1", "C2", "Depth", "Normal"})
        EXPECT_TRUE(same_values(plain.frame->find(pass)->data, on.frame->find(pass)->data)) << pass;
    EXPECT_TRUE(is_filtered(*on.frame));
    EXPECT_EQ(off.stats["filter"]["runs"], 0);
    EXPECT_GE(on.stats["filter"]["runs"], 1);
}

TEST(FilteringSession, EndsWithTheFiltersPictureOfItsFilm) {
    const ManyThreads threads_of_test;
    scene::SceneDesc scene = filtered_scene(7);
    for (const int threads : {1, 2, 7}) {
        scene.settings.threads = threads;
        const Rendered r = render_film(scene);
        EXPECT_EQ(different_passes(*r.frame, *filtered(r.film, scene.settings.filter)), "") << threads;
    }
    scene.settings.threads = 2;
    scene.settings.crop = {3, 1, 19, 30};
    const Rendered r = render_film(scene);
    EXPECT_EQ(different_passes(*r.frame, *filtered(r.film, scene.settings.filter)), "");
    EXPECT_EQ(r.frame->find("Filtered")->data.size(), 3u * 19 * 30);
}

TEST(FilteringSession, OneSampleAndOnePixel) {
    for (const auto& [w, h] : {std::pair{32, 32}, {1, 1}, {1, 9}, {9, 1}}) {
        scene::SceneDesc scene = filtered_scene(1);
        scene.settings.width = w;
        scene.settings.height = h;
        const Rendered r = render_film(scene);
        for (const float v : r.frame->find("Combined")->data) ASSERT_TRUE(std::isfinite(v));
        EXPECT_TRUE(same_values(combined_rgb(*r.frame), r.frame->find("Filtered")->data));
        EXPECT_EQ(r.stats["filter"]["runs"], 1) << "nothing has changed after the first pass";
    }
}

TEST(FilteringSession, ACancelledRenderStillFilters) {
    Session session(checked(filtered_scene(k_endless)));
    session.start();
    ASSERT_TRUE(wait_until([&] { return session.progress().samples >= 20; }));
    session.cancel();
    ASSERT_TRUE(session.wait(20));
    EXPECT_EQ(session.progress().phase, Phase::cancelled);
    ASSERT_NE(session.film(), nullptr);
    EXPECT_TRUE(is_filtered(*session.frame()));
    EXPECT_EQ(different_passes(*session.frame(), *filtered(session.film(), filtered_scene().settings.filter)), "")
        << "the last samples are filtered too";
}

TEST(FilteringSession, CancelledInItsFirstPass) {
    scene::SceneDesc scene = filtered_scene(k_endless);
    scene.settings.width = scene.settings.height = 300;
    scene.settings.threads = 1;
    Session session(checked(scene));
    session.start();
    ASSERT_TRUE(wait_until([&] { return session.progress().revision > 0; }));
    session.cancel();
    ASSERT_TRUE(session.wait(30));
    const FramePointer frame = session.frame();
    EXPECT_TRUE(same_values(combined_rgb(*frame), frame->find("Filtered")->data));
    for (const float v : frame->find("Combined")->data) ASSERT_TRUE(std::isfinite(v));
    EXPECT_GE(nlohmann::json::parse(session.stats())["filter"]["runs"], 1);
}

TEST(FilteringSession, ATimeLimitIncludesTheFilter) {
    scene::SceneDesc scene = filtered_scene(k_endless);
    scene.settings.time_limit = 0.4f;
    Session session(checked(scene));
    session.start();
    ASSERT_TRUE(session.wait(20));
    EXPECT_EQ(session.progress().phase, Phase::done);
    EXPECT_EQ(different_passes(*session.frame(), *filtered(session.film(), scene.settings.filter)), "");
    const auto stats = nlohmann::json::parse(session.stats());
    EXPECT_NEAR(stats["seconds"]["render"].get<double>(), 0.4, 0.3);
}

/// A large kernel over a large picture: a run takes long.
std::shared_ptr<const scene::SceneDesc> slow_filter() {
    scene::SceneDesc scene = filtered_scene(k_endless);
    scene.settings.width = scene.settings.height = 700;
    scene.settings.filter.filter_size = 63;
    return checked(scene);
}

TEST(FilteringSession, DestroyedWhileItFilters) {
    const auto desc = slow_filter();
    double best = 1e9;
    for (int attempt = 0; attempt < 4 && best > 0.25; ++attempt) {
        auto session = std::make_unique<Session>(desc);
        session->start();
        ASSERT_TRUE(wait_until([&] { return session->progress().message == "Filtering"; }));
        EXPECT_EQ(session->progress().phase, Phase::render);
        const auto start = Clock::now();
        session.reset();
        best = std::min(best, seconds_after(start));
    }
    EXPECT_LT(best, 0.25);
}

TEST(FilteringSession, ACancelWaitsForTheFilterOnlySoLong) {
    scene::SceneDesc scene = *slow_filter();
    scene.settings.filter.filter_method = scene::FilterMethod::thesis;
    Session session(checked(scene));
    session.start();
    ASSERT_TRUE(wait_until([&] { return session.progress().message == "Filtering"; }));
    const auto start = Clock::now();
    session.cancel();
    ASSERT_TRUE(session.wait(60));
    EXPECT_GT(seconds_after(start), 0.9 * FilterSchedule::k_affordable) << "too fast a filter for this test";
    EXPECT_LT(seconds_after(start), FilterSchedule::k_affordable + 3);
    EXPECT_EQ(session.progress().phase, Phase::cancelled);
    EXPECT_TRUE(same_values(combined_rgb(*session.frame()), session.frame()->find("Raw")->data));
    EXPECT_NE(session.film(), nullptr);
}

TEST(FilteringSession, TheShownPictureIsNeverRawAgain) {
    Session session(checked(filtered_scene(256)));
    session.start();
    bool was_filtered = false;
    int pictures = 0;
    std::uint64_t revision = 0;
    while (!session.wait(0.0005)) {
        const auto p = session.progress();
        if (p.revision == revision) continue;
        revision = p.revision;
        const FramePointer f = session.frame();
        const bool now = is_filtered(*f);
        // Between runs the raw passes go on alone.
        EXPECT_TRUE(now || !was_filtered);
        was_filtered = was_filtered || now;
        ++pictures;
    }
    EXPECT_TRUE(was_filtered);
    EXPECT_GT(pictures, 3);
    EXPECT_TRUE(is_filtered(*session.frame()));
    const auto stats = nlohmann::json::parse(session.stats());
    EXPECT_GT(stats["filter"]["clusters"].get<int>(), 32 * 32);
    EXPECT_GT(stats["filter"]["seconds"].get<double>(), 0);
    EXPECT_GT(stats["bytes"]["clusters"].get<int>(), 32 * 32 * 32);
}

}  // namespace
}  // namespace cardioid::test
