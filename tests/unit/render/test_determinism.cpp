// SPDX-License-Identifier: GPL-3.0-or-later
// Same scene, settings and seed: the same bits for any number of threads and any grouping of pixels into batches.
#include "analytic/replicates.h"
#include "analytic/scenes.h"

#include <cstring>

namespace cardioid::test {
namespace {

bool same_bits(const film::Frame& a, const film::Frame& b) {
    if (a.width != b.width || a.height != b.height || a.passes.size() != b.passes.size()) return false;
    for (std::size_t p = 0; p < a.passes.size(); ++p) {
        const auto &x = a.passes[p].data, &y = b.passes[p].data;
        if (x.size() != y.size() || std::memcmp(x.data(), y.data(), x.size() * sizeof(float)) != 0) return false;
    }
    return true;
}

std::shared_ptr<const film::Frame> with_threads(scene::SceneDesc scene, int threads) {
    scene.settings.threads = threads;
    return render_frame(scene, 3);
}

/// Full frame against its crop: pixels of `cropped` that differ in some pass.
int different_pixels(const film::Frame& full, const film::Frame& cropped, int x0, int y0) {
    int n = 0;
    for (int y = 0; y < cropped.height; ++y) {
        for (int x = 0; x < cropped.width; ++x) {
            bool same = true;
            for (std::size_t p = 0; p < full.passes.size(); ++p) {
                const auto channels = static_cast<std::size_t>(full.passes[p].channels);
                const float* a =
                    &full.passes[p].data[static_cast<std::size_t>((y + y0) * full.width + x + x0) * channels];
                const float* b = &cropped.passes[p].data[static_cast<std::size_t>(y * cropped.width + x) * channels];
                same = same && std::memcmp(a, b, channels * sizeof(float)) == 0;
            }
            n += !same;
        }
    }
    return n;
}

/// A box full of small things, each with a material of its own, and deep paths: chunks are small and the record of a batch
/// overflows, so that direct light is evaluated early in some batches and late in others.
SceneMaker many_materials() {
    SceneMaker m;
    m.add(sphere({0, 0, 0}, 6, 3, false), diffuse(0.9f));
    for (int k = 0; k < 60; ++k) {
        const float a = 0.7f * static_cast<float>(k), r = 0.5f + 0.06f * static_cast<float>(k);
        const float shade = 0.5f + 0.008f * static_cast<float>(k);
        scene::GraphDesc graph = k % 3 == 0   ? glossy(shade, 0.2f)
                                 : k % 3 == 1 ? diffuse(shade)
                                              : combined("ShaderNodeMixShader", diffuse(shade), glossy(shade, 0.1f));
        m.add(sphere({r * std::cos(a), r * std::sin(a), 0.03f * static_cast<float>(k) - 1}, 0.35f, 1, k % 2 == 0),
              graph);
    }
    m.point_lamp({0, 0, 4}, 300, 0.3f);
    m.point_lamp({2, 0, -3}, 200, 0);
    m.add(quad({0, 0, 5}, {-1, 0, 0}, {0, 1, 0}), emission(5));
    m.perspective({0, -5, 2}, {0, 0, 0}, 0.6f);
    scene::Settings& s = m.scene.settings;
    s.width = s.height = 32;
    s.samples = 8;
    s.max_bounces = s.max_diffuse_bounces = s.max_glossy_bounces = 40;
    return m;
}

TEST(Determinism, AnyNumberOfThreads) {
    SceneMaker m = busy_scene();
    m.scene.settings.width = 70;
    m.scene.settings.height = 50;
    m.scene.settings.samples = 7;
    const auto one = with_threads(m.scene, 1);
    EXPECT_TRUE(same_bits(*one, *with_threads(m.scene, 2)));
    EXPECT_TRUE(same_bits(*one, *with_threads(m.scene, 7)));
    EXPECT_FALSE(same_bits(*one, *render_frame(m.scene, 4))) << "another seed is another picture";
}

TEST(Determinism, ACropHasThePixelsOfTheFrame) {
    SceneMaker m = busy_scene();
    m.scene.settings.width = 40;
    m.scene.settings.height = 36;
    m.scene.settings.samples = 7;
    const auto full = render_frame(m.scene, 3);
    m.scene.settings.crop = {7, 5, 21, 19};
    const auto cropped = render_frame(m.scene, 3);
    EXPECT_EQ(different_pixels(*full, *cropped, 7, 5), 0);
    EXPECT_GT(different_pixels(*full, *cropped, 8, 5), 300) << "the comparison sees no shift";
}

TEST(Determinism, ACropWhereTheRecordOverflows) {
    SceneMaker m = many_materials();
    const auto full = render_frame(m.scene, 3);
    m.scene.settings.crop = {3, 3, 5, 5};
    const auto cropped = render_frame(m.scene, 3);
    EXPECT_EQ(different_pixels(*full, *cropped, 3, 3), 0);
}

TEST(Determinism, SampleRangesAddUp) {
    SceneMaker m = busy_scene();
    m.scene.settings.samples = 8;
    const auto all = render_frame(m.scene, 3);
    const auto range = [&](int first, int n) {
        scene::SceneDesc part = m.scene;
        part.settings.first_sample = first;
        part.settings.samples = n;
        return render_frame(part, 3);
    };
    const auto a = range(0, 4), b = range(4, 4), c = range(0, 1), d = range(1, 7);
    for (const char* pass : {"Combined", "D1", "D2", "D3", "C1", "C2"}) {
        const auto& whole = all->find(pass)->data;
        for (std::size_t i = 0; i < whole.size(); ++i) {
            const double expected = static_cast<double>(whole[i]), bound = 2e-6 * std::fabs(expected) + 1e-9;
            ASSERT_NEAR(
                0.5 * (static_cast<double>(a->find(pass)->data[i]) + static_cast<double>(b->find(pass)->data[i])),
                expected, bound);
            ASSERT_NEAR(
                (static_cast<double>(c->find(pass)->data[i]) + 7 * static_cast<double>(d->find(pass)->data[i])) / 8,
                expected, bound);
        }
    }
    EXPECT_FALSE(same_bits(*a, *b)) << "the halves are different samples";
}

TEST(Determinism, ASecondSessionOfTheSameScene) {
    const SceneMaker m = busy_scene();
    EXPECT_TRUE(same_bits(*render_frame(m.scene, 9), *render_frame(m.scene, 9)));
}

/// Share of pixels that differ by more than 1 % of themselves.
double different_share(const film::Frame& a, const film::Frame& b) {
    const auto &x = a.find("Combined")->data, &y = b.find("Combined")->data;
    int n = 0;
    for (std::size_t i = 0; i < x.size(); i += 4) n += std::fabs(x[i] - y[i]) > 0.01f * (x[i] + 1e-3f);
    return n / (static_cast<double>(x.size()) / 4);
}

TEST(Widths, SamePictureUpToRounding) {
    SceneMaker m = busy_scene();
    const auto reference = render_frame(m.scene, 3, 1);
    for (const int width : {8, 16}) {
        const auto f = render_frame(m.scene, 3, width);
        const double share = different_share(*reference, *f);
        testing::Test::RecordProperty("different_share_" + std::to_string(width), std::to_string(share));
        // Rounding decides otherwise at few vertices; then the rest of the path is another one.
        EXPECT_LT(share, 0.05) << width;
        EXPECT_NEAR(mean_of(*f) / mean_of(*reference), 1, 3e-3) << width;
    }
    EXPECT_GT(different_share(*reference, *render_frame(m.scene, 4, 1)), 0.5) << "the measure sees no other seed";
}

TEST(Widths, MeansAgree) {
    SceneMaker m = busy_scene();
    m.scene.settings.width = m.scene.settings.height = 16;
    const auto means = [&](int width, std::uint32_t first) {
        statistics::Moments moments;
        for (std::uint32_t s = 0; s < 40; ++s) moments.add(mean_of(*render_frame(m.scene, first + s, width)));
        return moments;
    };
    const statistics::Moments one = means(1, 0);
    for (const int width : {8, 16}) {
        const statistics::TResult t =
            statistics::welch_test(one, means(width, 100 * static_cast<std::uint32_t>(width)));
        EXPECT_FALSE(t.rejected(k_level)) << width << ": " << t.difference << " ± " << t.error;
        EXPECT_TRUE(t.equivalent(0.05 * one.mean, 0.02)) << width << ": ± " << t.error;
    }
    m.scene.lights[0].energy *= 2;
    EXPECT_TRUE(statistics::welch_test(one, means(1, 50)).rejected(k_level)) << "the test sees no stronger lamp";
}

}  // namespace
}  // namespace cardioid::test
