// SPDX-License-Identifier: GPL-3.0-or-later
// Filtering after the render: jobs that are polled, cancelled, dropped and run beside each other.
#include "path/batch.h"
#include "render/film_kit.h"
#include "scene/error.h"

namespace cardioid::test {
namespace {

using render::FilterJob;
using render::Phase;

FilmPointer film_of(int size, int samples = 4) {
    scene::SceneDesc scene = busy_scene().scene;
    scene.settings.width = scene.settings.height = size;
    scene.settings.samples = samples;
    return render_film(scene).film;
}

scene::FilterSettings settings_on(int size = 11) {
    scene::FilterSettings s;
    s.use_filter = true;
    s.filter_size = size;
    return s;
}

/// Takes seconds to filter.
FilmPointer large_film() {
    static const FilmPointer film = film_of(500);
    return film;
}

TEST(FilterJob, SameBitsForAnyNumberOfThreads) {
    const ManyThreads threads_of_test;
    const FilmPointer film = film_of(70, 8);
    for (const auto method : {scene::FilterMethod::clusters, scene::FilterMethod::thesis,
                              scene::FilterMethod::cross_bilateral, scene::FilterMethod::none}) {
        scene::FilterSettings s = settings_on(7);
        s.filter_method = method;
        for (const int lanes : {1, 8, 16}) {
            if (lanes > path::best_width()) continue;
            const FramePointer one = filtered(film, s, 1, lanes);
            EXPECT_EQ(different_passes(*one, *filtered(film, s, 2, lanes)), "") << lanes;
            EXPECT_EQ(different_passes(*one, *filtered(film, s, 7, lanes)), "") << lanes;
        }
    }
    EXPECT_NE(different_passes(*filtered(film, settings_on(7)), *filtered(film, settings_on(9))), "");
}

TEST(FilterJob, ARunAfterOthersEqualsAFreshOne) {
    const FilmPointer film = film_of(40, 8);
    const FramePointer fresh = filtered(film, settings_on());
    filtered(film, settings_on(3));
    scene::FilterSettings strict = settings_on();
    strict.firefly_density = 1;
    filtered(film, strict);
    EXPECT_EQ(different_passes(*fresh, *filtered(film, settings_on())), "");
}

TEST(FilterJob, WithoutTheFilterIsRaw) {
    const FilmPointer film = film_of(40, 8);
    const FramePointer raw = filtered(film, {});
    EXPECT_TRUE(same_values(combined_rgb(*raw), raw->find("Raw")->data));
    EXPECT_TRUE(same_values(raw->find("Filtered")->data, raw->find("Raw")->data));
    const FramePointer on = filtered(film, settings_on());
    EXPECT_TRUE(is_filtered(*on));
    EXPECT_TRUE(same_values(on->find("Raw")->data, raw->find("Raw")->data));
}

TEST(FilterJob, TellsHowFarItIs) {
    FilterJob job(large_film(), settings_on());
    EXPECT_EQ(job.progress().phase, Phase::waiting);
    EXPECT_EQ(job.frame(), nullptr);
    EXPECT_FALSE(job.wait(0.01));
    job.start();
    job.start();
    double last = 0;
    bool on_the_way = false;
    while (!job.wait(0.001)) {
        const auto p = job.progress();
        EXPECT_GE(p.fraction, last);
        EXPECT_LE(p.fraction, 1);
        on_the_way = on_the_way || (p.fraction > 0 && p.fraction < 1);
        last = p.fraction;
        if (p.phase == Phase::render) { EXPECT_EQ(p.message, "Filtering"); }
    }
    EXPECT_TRUE(on_the_way);
    const auto p = job.progress();
    EXPECT_EQ(p.phase, Phase::done);
    EXPECT_EQ(p.fraction, 1);
    const auto stats = nlohmann::json::parse(job.stats());
    EXPECT_GT(stats["seconds"].get<double>(), 0);
    EXPECT_GT(stats["cpu_seconds"].get<double>(), 0);
    EXPECT_LT(stats["cpu_seconds"].get<double>(),
              1.1 * stats["threads"].get<int>() * stats["seconds"].get<double>() + 0.05);
    EXPECT_EQ(stats["clusters"].get<std::int64_t>(), large_film()->clusters().cluster_count());
    EXPECT_GT(stats["singles"].get<std::int64_t>(), 0);
    EXPECT_GT(stats["film_bytes"].get<std::int64_t>(), 500 * 500 * 100);
}

/// Energy that a pass has, in luminance.
double energy(const film::Frame& f, const char* pass) {
    double sum = 0;
    const auto& d = f.find(pass)->data;
    for (std::size_t i = 0; i < d.size(); i += 3)
        sum += 0.2126 * static_cast<double>(d[i]) + 0.7152 * static_cast<double>(d[i + 1]) +
               0.0722 * static_cast<double>(d[i + 2]);
    return sum;
}

TEST(FilterJob, StatisticsAreThePicturesOwn) {
    const FilmPointer film = film_of(60, 8);
    scene::FilterSettings s = settings_on();
    s.filter_method = scene::FilterMethod::none;
    s.firefly_density = 0.5f;
    FilterJob job(film, s, 2);
    job.start();
    ASSERT_TRUE(job.wait(60));
    const FramePointer f = job.frame();
    const auto stats = nlohmann::json::parse(job.stats());
    const double share = energy(*f, "Withheld") / energy(*f, "Raw");
    EXPECT_GT(share, 0) << "the film has fireflies";
    EXPECT_LT(share, 0.5);
    EXPECT_NEAR(stats["withheld_share"].get<double>(), share, 1e-6);
    EXPECT_NEAR(stats["outlier_share"].get<double>(), stats["rejected"].get<double>() / stats["clusters"].get<double>(),
                1e-12);
    EXPECT_GT(stats["rejected"].get<int>(), 0);
    EXPECT_GE(stats["rejected_samples"].get<int>(), stats["rejected"].get<int>());
    EXPECT_NEAR(energy(*f, "Filtered") + energy(*f, "Withheld"), energy(*f, "Raw"), 1e-4 * energy(*f, "Raw"));
}

TEST(FilterJob, CancelledHasNoPicture) {
    double best = 1e9;
    for (int attempt = 0; attempt < 4 && best > 0.25; ++attempt) {
        FilterJob job(large_film(), settings_on(63));
        job.start();
        ASSERT_TRUE(wait_until([&] { return job.progress().fraction > 0; }));
        const auto start = std::chrono::steady_clock::now();
        job.cancel();
        ASSERT_TRUE(job.wait(30));
        best = std::min(best, seconds_after(start));
        EXPECT_EQ(job.progress().phase, Phase::cancelled);
        EXPECT_EQ(job.frame(), nullptr);
        EXPECT_EQ(nlohmann::json::parse(job.stats())["phase"], "cancelled");
    }
    EXPECT_LT(best, 0.25);
    FilterJob never(large_film(), settings_on());
    never.cancel();
    never.start();
    ASSERT_TRUE(never.wait(30));
    EXPECT_EQ(never.progress().phase, Phase::cancelled);
}

TEST(FilterJob, DroppedWhileItRuns) {
    double best = 1e9;
    for (int attempt = 0; attempt < 4 && best > 0.25; ++attempt) {
        auto job = std::make_unique<FilterJob>(large_film(), settings_on(63));
        job->start();
        ASSERT_TRUE(wait_until([&] { return job->progress().fraction > 0; }));
        const auto start = std::chrono::steady_clock::now();
        job.reset();
        best = std::min(best, seconds_after(start));
    }
    EXPECT_LT(best, 0.25);
}

TEST(FilterJob, TwoAtOnceShareTheFilm) {
    const FilmPointer film = film_of(64, 8);
    FilterJob a(film, settings_on()), b(film, settings_on(5));
    a.start();
    b.start();
    ASSERT_TRUE(a.wait(60) && b.wait(60));
    EXPECT_EQ(different_passes(*a.frame(), *filtered(film, settings_on())), "");
    EXPECT_EQ(different_passes(*b.frame(), *filtered(film, settings_on(5))), "");
}

TEST(FilterJob, WithoutClustersThereIsNothingToFilter) {
    scene::SceneDesc scene = busy_scene().scene;
    scene.settings.record_clusters = false;
    const FilmPointer film = render_film(scene).film;
    ASSERT_FALSE(film->has_clusters());
    EXPECT_NO_THROW(filtered(film, {}));
    try {
        const FilterJob job(film, settings_on());
        FAIL() << "no error";
    } catch (const scene::SceneError& e) {
        EXPECT_NE(std::string(e.what()).find("record_clusters"), std::string::npos) << e.what();
    }
}

}  // namespace
}  // namespace cardioid::test
