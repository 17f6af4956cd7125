// SPDX-License-Identifier: GPL-3.0-or-later
// The film that a session gives out: whole, the same for any number of threads, and enough for the picture of the render.
#include "film/film_file.h"
#include "path/batch.h"
#include "render/film_kit.h"

#include <unistd.h>

#include <filesystem>

namespace cardioid::test {
namespace {

scene::SceneDesc small_scene(scene::IntegratorKind kind = scene::IntegratorKind::path_tracing) {
    scene::SceneDesc scene = busy_scene().scene;
    scene.settings.width = 41;
    scene.settings.height = 27;
    scene.settings.integrator = kind;
    return scene;
}

TEST(FilmOfASession, IsThereOnceTheSessionHasEnded) {
    FilmPointer film;
    {
        render::Session session(checked(small_scene()));
        EXPECT_EQ(session.film(), nullptr);
        session.start();
        ASSERT_TRUE(session.wait(60));
        film = session.film();
        ASSERT_NE(film, nullptr);
    }
    EXPECT_EQ(film->region().width, 41);
    EXPECT_EQ(film->samples(40, 26), 16u) << "it outlives the session";
    render::Session never(checked(small_scene()));
    never.cancel();
    never.start();
    ASSERT_TRUE(never.wait(10));
    EXPECT_EQ(never.film(), nullptr) << "nothing was rendered";
}

TEST(FilmOfASession, IsNotGivenOutWhileItGrows) {
    scene::SceneDesc scene = small_scene();
    scene.settings.samples = 10'000'000;
    render::Session session(checked(scene));
    session.start();
    ASSERT_TRUE(wait_until([&] { return session.progress().samples >= 2; }));
    EXPECT_EQ(session.film(), nullptr);
    session.cancel();
    ASSERT_TRUE(session.wait(10));
    EXPECT_NE(session.film(), nullptr);
}

/// Largest difference of a pixel's light in clusters and beside them from its raw light, relative to that.
double light_lost(const Rendered& r) {
    const film::Region region = r.film->region();
    const std::vector<float>& raw = r.frame->find("Raw")->data;
    double worst = 0;
    for (int y = 0; y < region.height; ++y) {
        for (int x = 0; x < region.width; ++x) {
            float sum[3];
            r.film->unfiltered(x, y, sum);
            for (int layer = 0; layer < film::k_layers; ++layer) {
                for (const film::Cluster& c : r.film->clusters().view(x, y, layer)) {
                    for (int k = 0; k < 3; ++k) sum[k] += c.radiance[k] / static_cast<float>(r.film->samples(x, y));
                }
            }
            const auto at = static_cast<std::size_t>(3 * (y * region.width + x));
            for (std::size_t k = 0; k < 3; ++k) {
                const float expected = raw[at + k];
                worst = std::max(worst, static_cast<double>(std::fabs(sum[k] - expected) / (expected + 1e-3f)));
            }
        }
    }
    return worst;
}

TEST(FilmOfASession, HoldsAllLight) {
    using scene::IntegratorKind;
    for (const auto kind : {IntegratorKind::path_tracing, IntegratorKind::hybrid, IntegratorKind::photon_mapping}) {
        for (const auto schedule : {scene::RadiusSchedule::memoryless, scene::RadiusSchedule::per_pixel}) {
            scene::SceneDesc scene = small_scene(kind);
            scene.settings.radius_schedule = schedule;
            EXPECT_LT(light_lost(render_film(scene)), 1e-4)
                << static_cast<int>(kind) << ", " << static_cast<int>(schedule);
        }
    }
}

TEST(FilmOfASession, SameClustersForAnyNumberOfThreads) {
    const ManyThreads threads_of_test;
    scene::SceneDesc scene = small_scene(scene::IntegratorKind::hybrid);
    for (const int lanes : {1, 8, 16}) {
        if (lanes > path::best_width()) continue;
        scene.settings.threads = 1;
        const Rendered one = render_film(scene, lanes);
        EXPECT_GT(one.film->clusters().cluster_count(), 41 * 27 * 2);
        for (const int threads : {2, 7}) {
            scene.settings.threads = threads;
            EXPECT_EQ(different_lists(*one.film, *render_film(scene, lanes).film), 0) << lanes << ", " << threads;
        }
        scene::SceneDesc other = scene;
        other.settings.seed = 5;
        EXPECT_GT(different_lists(*one.film, *render_film(other, lanes).film), 1000);
    }
}

TEST(FilmOfASession, AloneGivesTheWholePicture) {
    using scene::IntegratorKind;
    for (const auto kind : {IntegratorKind::path_tracing, IntegratorKind::hybrid, IntegratorKind::photon_mapping}) {
        for (const auto schedule : {scene::RadiusSchedule::memoryless, scene::RadiusSchedule::per_pixel}) {
            scene::SceneDesc scene = small_scene(kind);
            scene.settings.radius_schedule = schedule;
            const Rendered r = render_film(scene);
            scene::FilterSettings off;
            EXPECT_EQ(different_passes(*r.frame, *filtered(r.film, off)), "")
                << static_cast<int>(kind) << ", " << static_cast<int>(schedule);
        }
    }
}

TEST(FilmOfASession, ThePixelsOfACropAreTheFrames) {
    scene::SceneDesc scene = small_scene();
    const Rendered whole = render_film(scene);
    scene.settings.crop = {7, 5, 22, 19};
    const Rendered part = render_film(scene);
    ASSERT_EQ(part.film->region().width, 22);
    int different = 0, shifted = 0;
    for (int y = 0; y < 19; ++y) {
        for (int x = 0; x < 22; ++x) {
            for (int layer = 0; layer < film::k_layers; ++layer) {
                const auto p = part.film->clusters().view(x, y, layer);
                const auto differs = [&](int dx) {
                    const auto q = whole.film->clusters().view(x + 7 + dx, y + 5, layer);
                    return p.size() != q.size() || (!p.empty() && std::memcmp(p.data(), q.data(), p.size_bytes()) != 0);
                };
                different += differs(0);
                shifted += differs(1);
            }
        }
    }
    EXPECT_EQ(different, 0);
    EXPECT_GT(shifted, 100) << "the comparison sees no shift";
}

class FilmFiles : public testing::TestWithParam<scene::RadiusSchedule> {
protected:
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("film_" + std::to_string(getpid()) + ".cardioid");
    ~FilmFiles() override {
        std::error_code ignored;
        std::filesystem::remove(path, ignored);
    }
};

TEST_P(FilmFiles, FilterTheSameAfterwards) {
    scene::SceneDesc scene = small_scene(scene::IntegratorKind::hybrid);
    scene.settings.radius_schedule = GetParam();
    scene.settings.crop = {3, 2, 30, 20};
    scene.settings.filter.use_filter = true;
    const Rendered r = render_film(scene);
    film::FilmFile::save(*r.film, path);
    const auto loaded = std::make_shared<const film::Film>(film::FilmFile::load(path));
    EXPECT_EQ(different_passes(*r.frame, *filtered(loaded, loaded->filter_settings())), "");
    scene::FilterSettings other = loaded->filter_settings();
    other.filter_size = 5;
    EXPECT_NE(different_passes(*r.frame, *filtered(loaded, other)), "");
}

INSTANTIATE_TEST_SUITE_P(Schedules, FilmFiles,
                         testing::Values(scene::RadiusSchedule::memoryless, scene::RadiusSchedule::per_pixel));

}  // namespace
}  // namespace cardioid::test
