// SPDX-License-Identifier: GPL-3.0-or-later
// What the filter must do to the bit or nearly: identities, symmetry, purity, sizes.
#include "filter/filter_kit.h"

#include <bit>

using namespace cardioid;
using namespace cardioid::test;

namespace {

/// All layers, coloured, textured, with edges in depth and normal, some fireflies, pixels without anything, another number of
/// samples for each pixel.
film::Sample rich(int x, int y, int i, float scale = 1) {
    if (noise(x / 5, y / 4, 0, 30) < 0.1f) return {};
    film::Sample s = wall((x / 2 + y) % 2 == 0 ? 0.9f : 0.2f, x > y ? 4.0f : 7.0f);
    if (noise(x / 6, y / 7, 0, 31) < 0.3f) std::swap(s.feature_normal[0], s.feature_normal[2]);
    light(s, 0, scale * (noise(x, y, i, 0) < 0.6f ? 1 + noise(x, y, i, 1) : 0.0f));
    light(s, 1, scale * -0.3f * std::log(1.0001f - noise(x, y, i, 2)));
    light(s, 2, scale * (noise(x, y, i, 3) < 0.004f ? 80 + 900 * noise(x, y, i, 5) : 0.05f * noise(x, y, i, 4)));
    s.layers[1].radiance[0] *= 0.5f;
    s.layers[1].incident[0] *= 0.5f;
    s.radiance[2][0] = s.layers[1].radiance[0] + s.layers[2].radiance[0];
    for (float& c : s.unfiltered) c = 0.1f * scale;
    for (float& c : s.radiance[0]) c = 0.1f * scale;
    return s;
}

int uneven(int x, int y) { return 3 + static_cast<int>(9 * noise(x, y, -1)); }

using Place = std::function<std::pair<int, int>(int x, int y)>;

film::Film placed(int width, int height, const Place& place) {
    return make_film(
        width, height, [&](int x, int y) { return uneven(place(x, y).first, place(x, y).second); },
        [&](int x, int y, int i) { return rich(place(x, y).first, place(x, y).second, i); });
}

film::Film rich_film(int width = 29, int height = 22) {
    return placed(width, height, [](int x, int y) { return std::pair{x, y}; });
}

constexpr float k_density = FilterSettings{}.firefly_density;

class Exact : public testing::TestWithParam<FilterMethod> {};

TEST_P(Exact, KernelOfOnePixelIsTheMean) {
    const film::Film film = rich_film();
    EXPECT_LT(difference(filtered(film, filter_settings(GetParam(), 0, 1)), raw(film)), 1e-5);
}

TEST_P(Exact, NoLayersIsTheMean) {
    const film::Film film = rich_film();
    FilterSettings s = filter_settings(GetParam());
    s.filter_direct = s.filter_indirect = s.filter_deep = false;
    EXPECT_LT(difference(filtered(film, s), raw(film)), 1e-5);
}

TEST_P(Exact, LayersAreFilteredEachByItself) {
    const film::Film film = rich_film();
    const Picture before = raw(film), all = filtered(film, filter_settings(GetParam()));
    std::vector<double> sum(before.rgb.begin(), before.rgb.end());
    for (int layer = 0; layer < film::k_layers; ++layer) {
        FilterSettings s = filter_settings(GetParam());
        s.filter_direct = layer == 0;
        s.filter_indirect = layer == 1;
        s.filter_deep = layer == 2;
        const Picture one = filtered(film, s);
        EXPECT_GT(difference(one, before), 0.01) << "layer " << layer;
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += static_cast<double>(one.rgb[i]) - before.rgb[i];
    }
    for (std::size_t i = 0; i < sum.size(); ++i) ASSERT_NEAR(all.rgb[i], sum[i], 1e-4 * (1 + sum[i]));
}

TEST_P(Exact, ScalesWithTheLight) {
    const FilterSettings s = filter_settings(GetParam(), k_density);
    const Picture once = filtered(rich_film(), s);
    for (const float scale : {0x1p-12f, 0x1p14f}) {
        Picture much =
            filtered(make_film(29, 22, uneven, [&](int x, int y, int i) { return rich(x, y, i, scale); }), s);
        for (float& v : much.rgb) v /= scale;
        EXPECT_LT(difference(much, once), 1e-4) << scale;
    }
}

TEST_P(Exact, FlipsAndTransposes) {
    const FilterSettings s = filter_settings(GetParam(), k_density);
    const Picture straight = filtered(rich_film(), s);
    const auto expect = [&](int width, int height, const Place& place) {
        const Picture p = filtered(placed(width, height, place), s);
        Picture back = straight;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const auto [sx, sy] = place(x, y);
                for (int k = 0; k < 3; ++k)
                    back.rgb[3 * (static_cast<std::size_t>(sy) * 29 + static_cast<std::size_t>(sx)) +
                             static_cast<std::size_t>(k)] = p(x, y, k);
            }
        }
        EXPECT_LT(difference(back, straight), 1e-4);
    };
    expect(29, 22, [](int x, int y) { return std::pair{28 - x, y}; });
    expect(29, 22, [](int x, int y) { return std::pair{x, 21 - y}; });
    expect(22, 29, [](int x, int y) { return std::pair{y, x}; });
}

TEST_P(Exact, SameBitsInAnyOrderAndAgain) {
    const film::Film film = rich_film(70, 45);
    const FilterSettings s = filter_settings(GetParam(), k_density);
    const filter::Filtered first = filter::run(film, s, filter::run_serially);
    for (const filter::ForEach& order : {filter::ForEach(run_backwards), filter::ForEach(run_interleaved)}) {
        const filter::Filtered f = filter::run(film, s, order);
        EXPECT_EQ(f.shown, first.shown);
        EXPECT_EQ(f.withheld, first.withheld);
    }
    filter::run(film, filter_settings(FilterMethod::thesis, 1, 5), filter::run_serially);
    EXPECT_EQ(filter::run(film, s, filter::run_serially).shown, first.shown) << "after a run with other settings";
    EXPECT_EQ(filter::run(rich_film(70, 45), s, filter::run_serially).shown, first.shown) << "a fresh film";
}

TEST_P(Exact, StoppedIsNotComplete) {
    EXPECT_FALSE(filter::run(rich_film(), filter_settings(GetParam(), k_density), run_but_one).complete);
}

TEST_P(Exact, AllWidthsOfKernelsAgree) {
    const film::Film film = rich_film();
    const FilterSettings s = filter_settings(GetParam(), k_density);
    const Picture one = filtered(film, s, 1);
    EXPECT_LT(difference(filtered(film, s, 0), one), 1e-3);
    if (__builtin_cpu_supports("avx2")) { EXPECT_LT(difference(filtered(film, s, 8), one), 1e-3); }
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
        EXPECT_LT(difference(filtered(film, s, 16), one), 1e-3);
    }
}

TEST_P(Exact, EverySize) {
    for (int width = 1; width <= 20; ++width) {
        for (int height = 1; height <= 20; ++height) {
            const film::Film film = rich_film(width, height);
            const Picture p = filtered(film, filter_settings(GetParam(), k_density));
            ASSERT_EQ(p.rgb.size(), static_cast<std::size_t>(3 * width * height));
            for (const float v : p.rgb) ASSERT_TRUE(std::isfinite(v) && v >= 0) << width << "×" << height;
        }
    }
    const film::Film small = rich_film(5, 3);
    const Picture huge = filtered(small, filter_settings(GetParam(), k_density, scene::k_largest_filter));
    for (const float v : huge.rgb) EXPECT_TRUE(std::isfinite(v));
}

TEST_P(Exact, PixelsWithoutSamplesAreBlackAndHarmless) {
    const film::Film film = make_film(
        20, 20, [](int x, int) { return x < 10 ? 0 : 8; },
        [](int x, int y, int i) {
            film::Sample s = wall();
            light(s, 0, 0.5f + noise(x, y, i));
            return s;
        });
    const Picture p = filtered(film, filter_settings(GetParam(), k_density));
    EXPECT_EQ(moments(p, 0, 0, 10, 20).mean, 0);
    EXPECT_NEAR(moments(p, 10, 0, 10, 20).mean, 1, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Methods, Exact,
                         testing::Values(FilterMethod::clusters, FilterMethod::thesis, FilterMethod::cross_bilateral));

class Textured : public testing::TestWithParam<FilterMethod> {};

TEST_P(Textured, ConstantLightLeavesIt) {
    const film::Film film = make_film({24, 24, 8}, [](int x, int y, int) {
        film::Sample s = wall((x + y) % 2 == 0 ? 0.9f : 0.1f);
        s.detail[2] = x % 3 == 0 ? 0.0f : 0.5f;
        for (int layer = 0; layer < film::k_layers; ++layer) light(s, layer, 2);
        return s;
    });
    EXPECT_LT(difference(filtered(film, filter_settings(GetParam())), raw(film)), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Methods, Textured, testing::Values(FilterMethod::clusters, FilterMethod::thesis));

TEST(CrossBilateral, TexturesWithinItsWidthAreBlurred) {
    const film::Film film = make_film({24, 24, 8}, [](int x, int y, int) {
        film::Sample s = wall((x + y) % 2 == 0 ? 0.6f : 0.4f);
        light(s, 0, 2);
        return s;
    });
    FilterSettings s = filter_settings(FilterMethod::cross_bilateral);
    s.texture_width = 0.03f;
    EXPECT_LT(difference(filtered(film, s), raw(film)), 1e-3) << "narrow";
    s.texture_width = 1;
    EXPECT_NEAR(filtered(film, s)(12, 12), 1, 0.03) << "wide: as if there were none";
}

TEST(Exactly, RawIsShownAndWithheld) {
    for (const float exposure : {1.0f, 0.7f}) {
        scene::Settings settings = film_settings(40, 33);
        settings.exposure = exposure;
        film::Film film(settings);
        film::FilmWriter writer;
        writer.open(film);
        for (int p = 0; p < 40 * 33; ++p) {
            for (int i = 0; i < uneven(p % 40, p / 40); ++i)
                writer.add(p % 40, p / 40, rich(p % 40, p / 40, i), i == 0);
        }
        writer.close();
        const Picture before = raw(film);
        for (const float density : {k_density, 50.0f}) {
            const filter::Filtered f =
                filter::run(film, filter_settings(FilterMethod::none, density), filter::run_serially);
            ASSERT_GE(f.rejection.rejected, density > 1 ? 400 : 6);
            int unlike = 0, lower = 0;
            for (std::size_t i = 0; i < before.rgb.size(); ++i) {
                unlike += before.rgb[i] != f.shown[i] + f.withheld[i];
                lower += f.shown[i] < before.rgb[i];
                EXPECT_GE(f.withheld[i], 0);
            }
            EXPECT_EQ(unlike, 0);
            EXPECT_GE(lower, 12);
        }
    }
}

TEST(Exactly, NothingRejectedIsRawToTheBit) {
    const film::Film film = rich_film();
    const filter::Filtered f = filter::run(film, filter_settings(FilterMethod::none), filter::run_serially);
    EXPECT_EQ(f.shown, raw(film).rgb);
    EXPECT_EQ(std::count(f.withheld.begin(), f.withheld.end(), 0.0f), static_cast<std::ptrdiff_t>(f.withheld.size()));
}

TEST(Exactly, FilmStaysAsItWas) {
    const film::Film film = rich_film();
    const Picture before = raw(film);
    filtered(film, filter_settings(FilterMethod::clusters, k_density));
    EXPECT_EQ(raw(film).rgb, before.rgb);
}

TEST(Exactly, WritePutsTheResultWhereTheFilterIsUsed) {
    const film::Film film = rich_film();
    FilterSettings s = filter_settings(FilterMethod::clusters, k_density);
    const filter::Filtered f = filter::run(film, s, filter::run_serially);
    for (const bool use : {false, true}) {
        s.use_filter = use;
        film::Frame frame = film.make_frame();
        film.resolve(film.region(), frame);
        const film::Frame plain = frame;
        filter::write(f, s, frame);
        EXPECT_EQ(frame.find("Filtered")->data, f.shown);
        EXPECT_EQ(frame.find("Withheld")->data, f.withheld);
        EXPECT_EQ(frame.find("Raw")->data, plain.find("Raw")->data);
        const std::vector<float>&combined = frame.find("Combined")->data, &unfiltered = plain.find("Combined")->data;
        int unlike = 0;
        for (std::size_t i = 0; i < combined.size(); ++i) {
            const bool alpha = i % 4 == 3;
            const float wanted = use && !alpha ? f.shown[i / 4 * 3 + i % 4] : unfiltered[i];
            unlike += std::bit_cast<std::uint32_t>(combined[i]) != std::bit_cast<std::uint32_t>(wanted);
        }
        EXPECT_EQ(unlike, 0) << "use_filter " << use;
    }
}

}  // namespace
