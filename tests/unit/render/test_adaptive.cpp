// SPDX-License-Identifier: GPL-3.0-or-later
// Adaptive sampling: Cycles' rules, pixels that stop, and samples that are the plain render's.
#include "render/adaptive.h"
#include "render/film_kit.h"
#include "render/passes.h"
#include "render/tiles.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace cardioid::test {
namespace {

using render::Adaptive;
using render::HalfSums;

scene::Settings adaptive_settings(int width, int height, float threshold, int min_samples = 0) {
    scene::Settings s;
    s.width = width;
    s.height = height;
    s.adaptive_threshold = threshold;
    s.adaptive_min_samples = min_samples;
    return s;
}

TEST(Adaptive, HalvesAreEqualAndMadeOfWholePasses) {
    for (std::uint32_t end = 16; end <= 4096; end += 16) {
        std::uint32_t second = 0;
        for (std::uint32_t s = 0; s < end; ++s) second += render::in_second_half(s);
        ASSERT_EQ(2 * second, end);
    }
    for (const render::Pass& p : render::passes(0, 512)) {
        for (int s = p.begin; s < p.begin + p.size; ++s)
            ASSERT_EQ(render::in_second_half(static_cast<std::uint32_t>(s)),
                      render::in_second_half(static_cast<std::uint32_t>(p.begin)));
    }
}

TEST(Adaptive, ErrorIsCycles) {
    // Means 0.1, 0.2, 0.06; of the half 0.12, 0.17, 0.06.
    HalfSums s{{1.6f, 3.2f, 0.96f}, {0.96f, 1.36f, 0.48f}, 16, 8};
    EXPECT_NEAR(s.error(1), 0.05f / (1e-4f + std::sqrt(0.36f)), 1e-6f);
    EXPECT_NEAR(s.error(0.25f), 0.0125f / (1e-4f + 0.3f), 1e-6f);
    EXPECT_NEAR(s.error(10), 0.5f / (1e-4f + 3.6f), 1e-6f) << "over 1 it is relative to the brightness";
    EXPECT_EQ((HalfSums{{0, 0, 0}, {0, 0, 0}, 16, 8}.error(1)), 0) << "black";
    EXPECT_TRUE(std::isinf(HalfSums{}.error(1)));
    EXPECT_TRUE(std::isinf((HalfSums{{1, 1, 1}, {1, 1, 1}, 8, 8}.error(1))));
}

TEST(Adaptive, FirstLookAsInCycles) {
    const film::Region r{0, 0, 4, 4};
    const auto automatic = [&](float threshold) {
        return Adaptive(adaptive_settings(4, 4, threshold), r).min_samples();
    };
    EXPECT_EQ(automatic(0.1f), 32);
    EXPECT_EQ(automatic(0.01f), 64);
    EXPECT_EQ(automatic(0.001f), 128);
    const Adaptive least(adaptive_settings(4, 4, 0.1f, 1), r);
    EXPECT_EQ(least.min_samples(), 4);
    EXPECT_TRUE(least.due(16, 16));
    EXPECT_FALSE(least.due(24, 24));
    EXPECT_TRUE(least.due(32, 32));
    EXPECT_FALSE(Adaptive(adaptive_settings(4, 4, 0.1f, 15), r).due(16, 16));
    EXPECT_FALSE(least.due(32, 4)) << "a range counts its own samples";
    EXPECT_FALSE(Adaptive(adaptive_settings(4, 4, 0), r).due(64, 64));
}

/// Every pixel has 16 samples of 0.3, but those listed, of which every second half is black.
Adaptive judged(int width, int height, const std::vector<std::pair<int, int>>& noisy) {
    const film::Region region{5, 3, width, height};
    Adaptive a(adaptive_settings(width, height, 0.01f), region);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const bool odd = std::find(noisy.begin(), noisy.end(), std::pair{x, y}) != noisy.end();
            for (int n = 0; n < 16; ++n) {
                film::Sample s;
                s.radiance[1][0] = odd && render::in_second_half(static_cast<std::uint32_t>(n)) ? 0 : 0.3f;
                a.add(region.x + x, region.y + y, s, n);
            }
        }
    }
    a.update();
    return a;
}

TEST(Adaptive, NeighboursOfNoisyPixelsGoOn) {
    EXPECT_TRUE(judged(7, 5, {}).finished());
    const Adaptive middle = judged(7, 5, {{2, 3}});
    EXPECT_EQ(middle.active_pixels(), 9);
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 7; ++x)
            EXPECT_EQ(middle.active()[static_cast<std::size_t>(y * 7 + x)] != 0,
                      std::abs(x - 2) <= 1 && std::abs(y - 3) <= 1);
    }
    EXPECT_EQ(judged(7, 5, {{0, 0}}).active_pixels(), 4);
    EXPECT_EQ(judged(7, 5, {{6, 4}, {6, 3}}).active_pixels(), 6);
    EXPECT_EQ(judged(1, 1, {{0, 0}}).active_pixels(), 1);
}

TEST(ActiveTiles, CoverEveryActivePixelOnce) {
    std::uint32_t state = 1;
    for (const auto& [w, h] : {std::pair{1, 1}, {64, 64}, {65, 130}, {200, 37}, {9, 300}}) {
        const film::Region region{11, 5, w, h};
        for (const int every : {1, 2, 7, 100, 1 << 20}) {
            std::vector<std::uint8_t> active(static_cast<std::size_t>(w * h));
            for (auto& v : active)
                v = (state = state * 1664525u + 1013904223u) / 4096 % static_cast<std::uint32_t>(every) == 0;
            for (int samples = 1; samples <= 8; ++samples) {
                auto left = active;
                for (const film::Region& t : render::active_tiles(region, samples, active)) {
                    EXPECT_EQ((t.x - region.x) % 8, 0);
                    EXPECT_EQ((t.y - region.y) % 8, 0);
                    EXPECT_LE(std::max(t.width, t.height), 64);
                    int n = 0;
                    for (int y = t.y - region.y; y < t.y - region.y + t.height; ++y) {
                        for (int x = t.x - region.x; x < t.x - region.x + t.width; ++x) {
                            auto& v = left.at(static_cast<std::size_t>(y * w + x));
                            n += v == 1;
                            if (active[static_cast<std::size_t>(y * w + x)]) ++v;
                        }
                    }
                    EXPECT_GT(n, 0);
                    EXPECT_LE(n * samples, 1024);
                }
                for (std::size_t i = 0; i < left.size(); ++i) ASSERT_EQ(left[i], 2 * active[i]);
            }
        }
    }
}

scene::SceneDesc adaptive_scene(float threshold, int samples = 128) {
    scene::SceneDesc scene = busy_scene().scene;
    scene.settings.width = 48;
    scene.settings.height = 40;
    scene.settings.samples = samples;
    scene.settings.adaptive_threshold = threshold;
    scene.settings.adaptive_min_samples = 16;
    return scene;
}

TEST(AdaptiveSession, AFlatPictureEndsEarly) {
    SceneMaker m;
    m.probe({0, -1, 1}, {0, 0, 0});
    m.world(background(0.25f));
    m.scene.settings.width = 70;
    m.scene.settings.height = 30;
    m.scene.settings.samples = 100000;
    m.scene.settings.adaptive_threshold = 0.1f;
    render::Session session(checked(m.scene));
    session.start();
    ASSERT_TRUE(session.wait(60));
    const auto p = session.progress();
    EXPECT_EQ(p.phase, render::Phase::done);
    EXPECT_EQ(p.fraction, 1);
    EXPECT_EQ(p.samples, 48) << "32 at least, so the first look is after 48";
    EXPECT_EQ(session.film()->samples(3, 3), 48u);
    const auto stats = nlohmann::json::parse(session.stats());
    EXPECT_EQ(stats["counts"]["camera_paths"], 70 * 30 * 48);
    EXPECT_EQ(stats["adaptive"]["mean_samples"], 48);
    EXPECT_EQ(stats["adaptive"]["unfinished_pixels"], 0);
    for (const float v : session.frame()->find("Debug Sample Count")->data) ASSERT_EQ(v, 48);
    for (const float v : session.frame()->find("Raw")->data) ASSERT_NEAR(v, 0.25f, 1e-6f);
}

const std::vector<float>& raw_of(const Rendered& r) { return r.frame->find("Raw")->data; }

scene::SceneDesc plain(scene::SceneDesc scene, int first, int samples) {
    scene.settings.adaptive_threshold = 0;
    scene.settings.first_sample = first;
    scene.settings.samples = samples;
    return scene;
}

/// Whether some of the blocks of 16 samples (means) have this mean together.
bool is_mean_of_blocks(const std::vector<float>& blocks, std::uint32_t n, float mean) {
    for (unsigned set = 0; set < 1u << blocks.size(); ++set) {
        if (static_cast<std::uint32_t>(std::popcount(set)) * 16 != n) continue;
        float sum = 0;
        for (std::size_t b = 0; b < blocks.size(); ++b) sum += (set >> b & 1) != 0 ? blocks[b] : 0;
        if (std::fabs(sum * 16 / static_cast<float>(n) - mean) <= 1e-5f * mean) return true;
    }
    return false;
}

/// An adaptive render of 128 samples against plain ones.
struct Comparison {
    std::map<std::uint32_t, int> counts;  ///< of samples → pixels
    int same = 0;                         ///< pixels whose bits are those of a plain render of as many samples
    int blocks = 0;  ///< others that paused while their neighbours were quiet: some blocks of 16 samples
    int wrong = 0;
};

Comparison compare(const scene::SceneDesc& scene) {
    const Rendered a = render_film(scene);
    const int w = scene.settings.width, pixels = w * scene.settings.height;
    const auto samples = [&](int i) { return a.film->samples(i % w, i / w); };
    Comparison c;
    for (int i = 0; i < pixels; ++i) ++c.counts[samples(i)];
    std::vector<Rendered> block;
    for (int b = 0; b < 8; ++b) block.push_back(render_film(plain(scene, 16 * b, 16)));
    for (const auto& [n, ignored] : c.counts) {
        const Rendered b = render_film(plain(scene, 0, static_cast<int>(n)));
        for (int i = 0; i < pixels; ++i) {
            if (samples(i) != n) continue;
            const auto at = static_cast<std::size_t>(3 * i);
            if (std::memcmp(&raw_of(a)[at], &raw_of(b)[at], 12) == 0) {
                ++c.same;
                continue;
            }
            std::vector<float> means;
            for (const Rendered& r : block) means.push_back(raw_of(r)[at]);
            ++(is_mean_of_blocks(means, n, raw_of(a)[at]) ? c.blocks : c.wrong);
        }
    }
    return c;
}

TEST(AdaptiveSession, SamplesAreThoseOfThePlainRender) {
    const Comparison c = compare(adaptive_scene(0.02f));
    EXPECT_EQ(c.wrong, 0);
    EXPECT_GT(c.same, 9 * c.blocks) << "most pixels stop once and for all";
    EXPECT_GE(c.counts.size(), 3u) << "pixels stop at different times";
    EXPECT_GE(c.counts.begin()->first, 32u);
    EXPECT_EQ(c.counts.rbegin()->first, 128u);
    for (const auto& [n, ignored] : c.counts) EXPECT_EQ(n % 16, 0u);
}

TEST(AdaptiveSession, SameBitsForAnyNumberOfThreads) {
    const ManyThreads threads_of_test;
    scene::SceneDesc scene = adaptive_scene(0.02f);
    scene.settings.filter.use_filter = true;
    scene.settings.integrator = scene::IntegratorKind::hybrid;
    scene.settings.photons = 1000;
    scene.settings.threads = 1;
    const Rendered one = render_film(scene);
    for (const int threads : {2, 7}) {
        scene.settings.threads = threads;
        const Rendered other = render_film(scene);
        EXPECT_EQ(different_passes(*one.frame, *other.frame), "");
        EXPECT_EQ(different_lists(*one.film, *other.film), 0);
    }
}

double mean_of_raw(const Rendered& r) {
    const std::vector<float>& d = raw_of(r);
    return std::accumulate(d.begin(), d.end(), 0.0) / static_cast<double>(d.size());
}

TEST(AdaptiveSession, EnergyStaysAndTimeIsSaved) {
    for (const auto kind : {scene::IntegratorKind::path_tracing, scene::IntegratorKind::hybrid}) {
        scene::SceneDesc scene = adaptive_scene(0.02f, 512);
        scene.settings.integrator = kind;
        scene.settings.photons = 1000;  // or they are given up where camera paths do better
        const Rendered a = render_film(scene);
        scene.settings.adaptive_threshold = 0;
        const Rendered full = render_film(scene);
        EXPECT_NEAR(mean_of_raw(a) / mean_of_raw(full), 1, 0.01);
        const double mean = a.stats["adaptive"]["mean_samples"];
        EXPECT_LT(mean, 400);
        EXPECT_EQ(a.stats["counts"]["camera_paths"].get<double>(), mean * 48 * 40);
        if (kind == scene::IntegratorKind::hybrid) {
            const auto emitted = [](const Rendered& r) { return r.stats["photons"]["emitted"].get<double>(); };
            EXPECT_LT(emitted(a), 0.9 * emitted(full)) << "photons are thinned with the pixels";
        }
        for (int y = 0; y < 40; ++y) {
            for (int x = 0; x < 48; ++x)
                ASSERT_EQ(a.frame->find("Debug Sample Count")->data[static_cast<std::size_t>(48 * y + x)],
                          a.film->samples(x, y));
        }
        EXPECT_EQ(full.frame->find("Debug Sample Count"), nullptr);
    }
}

TEST(AdaptiveSession, ARangeOfSamplesDecidesByItsOwn) {
    scene::SceneDesc scene = adaptive_scene(1, 64);
    scene.settings.adaptive_min_samples = 30;
    scene.settings.first_sample = 24;
    const Rendered r = render_film(scene);
    EXPECT_EQ(r.film->samples(0, 39), 40u) << "samples 24 to 63: the first multiple of 16 that leaves it more than 31";
}

TEST(AdaptiveSession, RadiiOfEachPixelNeedEverySample) {
    scene::SceneDesc scene = adaptive_scene(1, 32);
    scene.settings.integrator = scene::IntegratorKind::hybrid;
    scene.settings.radius_schedule = scene::RadiusSchedule::per_pixel;
    render::Session session(checked(scene));
    session.start();
    ASSERT_TRUE(session.wait(60));
    EXPECT_EQ(session.film()->samples(0, 0), 32u);
    ASSERT_EQ(session.warnings().size(), 1u);
    EXPECT_NE(session.warnings()[0].find("Adaptive sampling is off"), std::string::npos);
}

}  // namespace
}  // namespace cardioid::test
