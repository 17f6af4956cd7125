// SPDX-License-Identifier: GPL-3.0-or-later
// The same scene, settings and seed are the same bits for any number of threads; ranges of samples add up.
#include "caustics/photon_stats.h"

#include <cstring>

namespace cardioid::test {
namespace {

using scene::IntegratorKind;

constexpr IntegratorKind k_photon_kinds[] = {IntegratorKind::hybrid, IntegratorKind::photon_mapping};

bool same_bits(const film::Frame& a, const film::Frame& b) {
    if (a.width != b.width || a.height != b.height || a.passes.size() != b.passes.size()) return false;
    for (std::size_t p = 0; p < a.passes.size(); ++p) {
        const auto &x = a.passes[p].data, &y = b.passes[p].data;
        if (x.size() != y.size() || std::memcmp(x.data(), y.data(), x.size() * sizeof(float)) != 0) return false;
    }
    return true;
}

SceneMaker scene_of(IntegratorKind kind, scene::RadiusSchedule schedule = scene::RadiusSchedule::memoryless) {
    SceneMaker m = small_caustic();
    m.add(quad({0, 0, 2.5f}, {-0.5f, 0, 0}, {0, 0.5f, 0}), emission(4));
    m.point_lamp({1, -1, 2}, 30, 0);
    m.world(background(0.1f));
    scene::Settings& s = m.scene.settings;
    s.integrator = kind;
    s.radius_schedule = schedule;
    s.width = 37;
    s.height = 29;
    s.samples = 12;
    return m;
}

TEST(Repeat, AnyNumberOfThreads) {
    for (const IntegratorKind kind : k_photon_kinds) {
        for (const auto schedule : {scene::RadiusSchedule::memoryless, scene::RadiusSchedule::per_pixel}) {
            SceneMaker m = scene_of(kind, schedule);
            const auto with_threads = [&m](int threads) {
                m.scene.settings.threads = threads;
                return render_counted(m.scene, 3).frame;
            };
            const auto one = with_threads(1);
            EXPECT_GT(mean_of(*one), 0);
            EXPECT_TRUE(same_bits(*one, *with_threads(1))) << "twice";
            EXPECT_TRUE(same_bits(*one, *with_threads(2)));
            EXPECT_TRUE(same_bits(*one, *with_threads(7)));
            EXPECT_FALSE(same_bits(*one, *render_counted(m.scene, 4).frame)) << "another seed is another picture";
        }
    }
}

TEST(Repeat, ManyPhotonsAndThreads) {
    // Several batches of emission for each thread.
    SceneMaker m = scene_of(IntegratorKind::hybrid);
    m.scene.settings.samples = 2;
    m.scene.settings.photons = 300000;
    m.scene.settings.threads = 1;
    const auto one = render_counted(m.scene).frame;
    m.scene.settings.threads = 7;
    EXPECT_TRUE(same_bits(*one, *render_counted(m.scene).frame));
}

TEST(Repeat, SampleRangesAddUp) {
    for (const IntegratorKind kind : k_photon_kinds) {
        const SceneMaker m = scene_of(kind);
        const auto range = [&m](int first, int n) {
            scene::SceneDesc part = m.scene;
            part.settings.first_sample = first;
            part.settings.samples = n;
            // What training learns is learned in the first passes of a frame: parts cannot share it.
            part.settings.guided_emission = false;
            return render_counted(part, 3).frame;
        };
        const auto all = range(0, 12), a = range(0, 6), b = range(6, 6), c = range(0, 2), d = range(2, 10);
        for (const char* pass : {"Combined", "D1", "D2", "D3", "C1", "C2"}) {
            const auto& whole = all->find(pass)->data;
            for (std::size_t i = 0; i < whole.size(); ++i) {
                const auto value = [&](const auto& f) { return static_cast<double>(f->find(pass)->data[i]); };
                const double bound = 1e-5 * std::fabs(value(all)) + 1e-7;
                ASSERT_NEAR((value(a) + value(b)) / 2, value(all), bound) << pass << " " << i;
                ASSERT_NEAR((2 * value(c) + 10 * value(d)) / 12, value(all), bound) << pass << " " << i;
            }
        }
        EXPECT_FALSE(same_bits(*a, *b)) << "the halves are different samples";
    }
}

TEST(Repeat, ACropHasThePixelsOfTheFrame) {
    for (const IntegratorKind kind : k_photon_kinds) {
        SceneMaker m = scene_of(kind);
        // Training looks at the pixels that are rendered.
        m.scene.settings.guided_emission = false;
        const auto full = render_counted(m.scene).frame;
        m.scene.settings.crop = {7, 5, 21, 19};
        const auto crop = render_counted(m.scene).frame;
        const auto &whole = full->find("Combined")->data, &part = crop->find("Combined")->data;
        ASSERT_EQ(part.size(), 4u * 21 * 19);
        for (std::size_t y = 0; y < 19; ++y) {
            for (std::size_t x = 0; x < 4 * 21; ++x)
                ASSERT_EQ(part[y * 4 * 21 + x], whole[(y + 5) * 4 * 37 + 4 * 7 + x]) << x << " " << y;
        }
    }
}

TEST(Repeat, EveryLaneWidth) {
    for (const IntegratorKind kind : k_photon_kinds) {
        const SceneMaker m = scene_of(kind);
        const double reference = mean_of(*render_frame(m.scene, 3, 1));
        for (const int width : {8, 16})
            EXPECT_NEAR(mean_of(*render_frame(m.scene, 3, width)) / reference, 1, 0.01) << width;
    }
}

}  // namespace
}  // namespace cardioid::test
