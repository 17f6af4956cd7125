// SPDX-License-Identifier: GPL-3.0-or-later
// What the filter must do to light: noise falls; edges, textures, pools of light and energy stay; it converges.
#include "filter/filter_kit.h"

using namespace cardioid;
using namespace cardioid::test;

namespace {

/// Between 0.5 and 1.5 times `mean`.
float near_to(float mean, int x, int y, int i, int purpose = 0) { return mean * (0.5f + noise(x, y, i, purpose)); }

constexpr float k_density = FilterSettings{}.firefly_density;

class Light : public testing::TestWithParam<FilterMethod> {};

TEST_P(Light, NoiseFalls) {
    const film::Film film = make_film({48, 48, 16}, [](int x, int y, int i) {
        film::Sample s = wall();
        light(s, 0, near_to(1, x, y, i));
        light(s, 1, -0.5f * std::log(1.0001f - noise(x, y, i, 1)));
        return s;
    });
    const Moments before = moments(raw(film)), after = moments(filtered(film, filter_settings(GetParam())));
    EXPECT_LT(after.variance, before.variance / 10);
    EXPECT_NEAR(after.mean, before.mean, 0.01 * before.mean);
}

/// Two walls side by side whose light differs by a third; the step is in what `right` does to a sample.
film::Film two_walls(const std::function<void(film::Sample&)>& right) {
    return make_film({40, 64, 16}, [&](int x, int y, int i) {
        film::Sample s = wall();
        if (x >= 20) right(s);
        light(s, 0, near_to(x < 20 ? 1.0f : 1.3f, x, y, i));
        return s;
    });
}

void expect_apart(const film::Film& film, FilterMethod method) {
    const Picture p = filtered(film, filter_settings(method));
    for (int x = 16; x < 24; ++x) EXPECT_NEAR(moments(p, x, 0, 1, 64).mean, x < 20 ? 1.0 : 1.3, 0.02) << "column " << x;
}

TEST_P(Light, DoesNotCrossDepthSteps) {
    expect_apart(two_walls([](film::Sample& s) { s = wall(1, 6); }), GetParam());
    expect_apart(two_walls([](film::Sample& s) { s = wall(1, 3); }), GetParam());
}

TEST_P(Light, DoesNotCrossNormalSteps) {
    expect_apart(two_walls([](film::Sample& s) { std::swap(s.feature_normal[0], s.feature_normal[2]); }), GetParam());
}

TEST_P(Light, SlopesAreNoSteps) {
    const auto variance = [&](float slope, float scale) {
        return moments(filtered(make_film({40, 40, 16},
                                          [&](int x, int y, int i) {
                                              film::Sample s = wall(1, scale * (10 + slope * static_cast<float>(x)));
                                              light(s, 0, near_to(1, x, y, i));
                                              return s;
                                          }),
                                filter_settings(GetParam())))
            .variance;
    };
    const double flat = variance(0, 1);
    EXPECT_LT(variance(0.5f, 1), 2 * flat);
    EXPECT_LT(variance(0.5f, 1000), 2 * flat) << "in other units of length";
}

TEST_P(Light, EnergyOfSmoothLight) {
    const film::Film film = make_film({64, 64, 16}, [](int x, int y, int i) {
        film::Sample s = wall((x / 4 + y / 4) % 2 == 0 ? 0.8f : 0.3f);
        light(s, 0, near_to(1 + 0.02f * static_cast<float>(x), x, y, i));
        return s;
    });
    EXPECT_NEAR(energy_ratio(filtered(film, filter_settings(GetParam())), raw(film)), 1, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Methods, Light,
                         testing::Values(FilterMethod::clusters, FilterMethod::thesis, FilterMethod::cross_bilateral));

/// Share of the samples that find the lamp, and the light that they bring.
struct Model {
    const char* name;
    float (*found)(int x);
    float (*brings)(float u);
    double within = 0.01;  ///< of the energy
};

class Energy : public testing::TestWithParam<Model> {};

TEST_P(Energy, Stays) {
    const Model m = GetParam();
    const film::Film film = make_film({128, 128, 16}, [&](int x, int y, int i) {
        film::Sample s = wall();
        if (noise(x, y, i, 1) < m.found(x)) light(s, 0, m.brings(noise(x, y, i, 2)));
        return s;
    });
    const Picture before = raw(film), after = filtered(film, filter_settings(FilterMethod::clusters));
    EXPECT_NEAR(energy_ratio(after, before), 1, m.within);
    EXPECT_LT(moments(after).variance, moments(before).variance);
}

constexpr Model k_models[] = {
    // Five pixels of six are black, so that the light of the sixth looks like an edge to them: 3.7 % stay behind.
    {"one_in_a_hundred", [](int) { return 0.01f; }, [](float u) { return 50 * (0.5f + u); }, 0.045},
    {"one_in_ten", [](int) { return 0.1f; }, [](float u) { return 5 * (0.5f + u); }},
    {"one_in_ten_alike", [](int) { return 0.1f; }, [](float) { return 5.0f; }},
    {"half", [](int) { return 0.5f; }, [](float u) { return 1 + u; }},
    {"exponential", [](int) { return 1.0f; }, [](float u) { return -std::log(1.0001f - u); }},
    {"sparse_exponential", [](int) { return 0.05f; }, [](float u) { return -20 * std::log(1.0001f - u); }},
    {"penumbra", [](int x) { return std::clamp((static_cast<float>(x) - 54) / 20, 0.0f, 1.0f); },
     [](float u) { return 1 + 0.3f * u; }},
};
INSTANTIATE_TEST_SUITE_P(Models, Energy, testing::ValuesIn(k_models),
                         [](const auto& instance) { return std::string(instance.param.name); });

class ByClusters : public testing::TestWithParam<FilterMethod> {};

TEST_P(ByClusters, ShadowEdgeKeepsItsContrast) {
    const film::Film film = make_film({64, 64, 16}, [](int x, int y, int i) {
        film::Sample s = wall((x / 2 + y / 2) % 2 == 0 ? 0.9f : 0.5f);
        if (x < 32) light(s, 0, near_to(2, x, y, i));
        light(s, 1, near_to(0.2f, x, y, i, 1));
        return s;
    });
    // The texture is the same on both sides.
    const Picture before = raw(film), after = filtered(film, filter_settings(GetParam()));
    const auto contrast = [](const Picture& p) {
        return moments(p, 31, 0, 1, 64).mean - moments(p, 32, 0, 1, 64).mean;
    };
    EXPECT_NEAR(contrast(after), contrast(before), 0.03 * contrast(before));
    const auto wide = [](const Picture& p) { return moments(p, 28, 0, 4, 64).mean - moments(p, 32, 0, 4, 64).mean; };
    EXPECT_NEAR(wide(after), wide(before), 0.03 * wide(before));
}

TEST_P(ByClusters, NoiseFallsBesideAShadowEdge) {
    const film::Film film = make_film({64, 64, 16}, [](int x, int y, int i) {
        film::Sample s = wall();
        if (x < 32) light(s, 0, near_to(2, x, y, i));
        light(s, 1, near_to(0.2f, x, y, i, 1));
        return s;
    });
    const Picture before = raw(film), after = filtered(film, filter_settings(GetParam()));
    for (const int x : {31, 32}) {
        EXPECT_LT(moments(after, x, 0, 1, 64).variance, moments(before, x, 0, 1, 64).variance / 4) << "column " << x;
    }
}

TEST_P(ByClusters, TextureUnderNoisyLight) {
    const auto albedo = [](int x, int y) { return 0.1f + 0.8f * noise(x, y, 0, 9); };
    const film::Film film = make_film({48, 48, 16}, [&](int x, int y, int i) {
        film::Sample s = wall(albedo(x, y));
        light(s, 0, near_to(1, x, y, i));
        return s;
    });
    Picture p = filtered(film, filter_settings(GetParam()));
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 48; ++x) p.rgb[static_cast<std::size_t>(3 * (y * 48 + x) + 1)] /= albedo(x, y);
    }
    EXPECT_LT(moments(p).variance, 0.1 / 12 / 16) << "a tenth of the light's noise";
    EXPECT_NEAR(moments(p).mean, 1, 0.01);
}

TEST_P(ByClusters, FireflyGoesBrightRegionStays) {
    const film::Film film = make_film({48, 48, 16}, [](int x, int y, int i) {
        film::Sample s = wall();
        light(s, 0, near_to(1, x, y, i));
        if (x == 10 && y == 10 && i == 3) light(s, 2, 800);
        if (x >= 30 && x < 36 && y >= 30 && y < 36) light(s, 1, near_to(40, x, y, i, 1));
        return s;
    });
    const FilterSettings s = filter_settings(GetParam(), k_density);
    const filter::Filtered f = filter::run(film, s, filter::run_serially);
    const Picture p{48, 48, f.shown}, withheld{48, 48, f.withheld};
    EXPECT_EQ(f.rejection.rejected, 1);
    EXPECT_NEAR(withheld(10, 10), 50, 1e-3);
    EXPECT_LT(moments(p, 4, 4, 13, 13).mean, 1.05);
    EXPECT_NEAR(moments(p, 30, 30, 6, 6).mean, moments(raw(film), 30, 30, 6, 6).mean, 0.4);
    EXPECT_LT(p(29, 32), 1.5);
}

INSTANTIATE_TEST_SUITE_P(Methods, ByClusters, testing::Values(FilterMethod::clusters, FilterMethod::thesis));

TEST(Withheld, EnergyIsInThePictureButNoFirefly) {
    // Fireflies that have nothing in common, with a tenth of all light, over a texture.
    const film::Film film = make_film({96, 96, 16}, [](int x, int y, int i) {
        film::Sample s = wall((x / 2 + y / 2) % 2 == 0 ? 0.9f : 0.5f);
        light(s, 0, near_to(1, x, y, i));
        if (x % 12 == 6 && y % 24 == 12 && i == 5) light(s, 1, std::pow(2.1f, static_cast<float>(x / 24 + 5 + y / 24)));
        if (x == 48 && y == 48 && i == 5) light(s, 2, 9000);
        return s;
    });
    const FilterSettings settings = filter_settings(FilterMethod::clusters, k_density);
    const filter::Filtered f = filter::run(film, settings, filter::run_serially);
    const Picture before = raw(film), after{96, 96, f.shown}, withheld{96, 96, f.withheld};
    EXPECT_GT(moments(withheld).mean, 0.05 * moments(before).mean);
    EXPECT_NEAR(energy_ratio(after, before), 1, 0.005);
    // 0.9 and 0.5 with a tenth more on average, which is brighter around the one of 9000 and in corners.
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 96; ++x) EXPECT_LT(after(x, y), (x / 2 + y / 2) % 2 == 0 ? 1.35 : 0.75);
    }
}

TEST(Convergence, NoiseFreePoolKeepsItsPeak) {
    const auto pool = [](int x, int y) {
        const float dx = static_cast<float>(x - 24), dy = static_cast<float>(y - 24);
        return 1 + 19 * std::exp(-(dx * dx + dy * dy) / 20);
    };
    const film::Film film = make_film({49, 49, 16}, [&](int x, int y, int) {
        film::Sample s = wall();
        light(s, 0, pool(x, y));
        return s;
    });
    EXPECT_LT(difference(filtered(film, filter_settings(FilterMethod::clusters)), raw(film)), 0.01);
}

/// A pool of light, a penumbra and sparse light.
struct Mixed {
    static float pool(int x, int y) {
        const float dx = static_cast<float>(x - 8), dy = static_cast<float>(y - 12);
        return 0.5f + 3 * std::exp(-(dx * dx + dy * dy) / 12);
    }
    static float penumbra(int x) { return std::clamp((static_cast<float>(x) - 10) / 10, 0.0f, 1.0f); }
    static film::Sample sample(int x, int y, int i) {
        film::Sample s = wall();
        light(s, 0, near_to(pool(x, y), x, y, i));
        if (noise(x, y, i, 1) < penumbra(x)) light(s, 0, 2);
        if (noise(x, y, i, 2) < 0.02f) light(s, 1, near_to(10, x, y, i, 3));
        return s;
    }
    static Picture expected() {
        Picture p{24, 24, std::vector<float>(std::size_t{3} * 24 * 24)};
        for (std::size_t i = 0; i < p.rgb.size(); ++i) {
            const int x = static_cast<int>(i / 3 % 24), y = static_cast<int>(i / 72);
            p.rgb[i] = pool(x, y) + 2 * penumbra(x) + 0.2f;
        }
        return p;
    }
};

/// RMS of the difference over the mean.
double distance(const Picture& a, const Picture& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::pow(static_cast<double>(a.rgb[i]) - b.rgb[i], 2);
    return std::sqrt(sum / static_cast<double>(a.rgb.size())) / moments(b).mean;
}

TEST(Convergence, FilteredGoesToUnfiltered) {
    double last = 1;
    for (const int samples : {16, 128, 1024, 4096}) {
        const film::Film film = make_film({24, 24, samples}, Mixed::sample);
        const Picture before = raw(film), after = filtered(film, filter_settings(FilterMethod::clusters, k_density));
        const double between = distance(after, before);
        EXPECT_LT(between, 0.75 * last) << samples << " samples";
        EXPECT_LT(distance(after, Mixed::expected()), distance(before, Mixed::expected())) << samples << " samples";
        last = between;
    }
    EXPECT_LT(last, 0.02);
}

}  // namespace
