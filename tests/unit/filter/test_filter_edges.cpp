// SPDX-License-Identifier: GPL-3.0-or-later
// The filter where pixels are unlike each other: silhouettes, other numbers of samples, values that are out of range.
#include "filter/filter_kit.h"

#include <limits>

using namespace cardioid;
using namespace cardioid::test;

namespace {

class Edges : public testing::TestWithParam<FilterMethod> {};

TEST_P(Edges, CoverageStays) {
    // A wall ends within column 20: half of that column's samples see nothing.
    const film::Film film = make_film({40, 48, 16}, [](int x, int y, int i) {
        if (x > 20 || (x == 20 && i % 2 != 0)) return film::Sample{};
        film::Sample s = wall(0.8f);
        light(s, 0, 0.5f + noise(x, y, i));
        return s;
    });
    const Picture p = filtered(film, filter_settings(GetParam()));
    for (int x = 18; x < 23; ++x) {
        EXPECT_NEAR(moments(p, x, 0, 1, 48).mean, x < 20 ? 0.8 : x == 20 ? 0.4 : 0.0, 0.012) << "column " << x;
    }
}

TEST_P(Edges, EdgesBetweenSurfacesStaySoft) {
    // Columns 19 and 20 see both of two walls, as the pixel filter has it; light and albedo differ.
    const auto share = [](int x) { return x < 19 ? 0 : x == 19 ? 5 : x == 20 ? 11 : 16; };
    const film::Film film = make_film({40, 48, 16}, [&](int x, int y, int i) {
        const bool second = i * 7 % 16 < share(x);
        film::Sample s = wall(second ? 0.3f : 0.8f, second ? 9.0f : 4.0f);
        if (second) std::swap(s.feature_normal[0], s.feature_normal[2]);
        light(s, 0, (second ? 2.0f : 1.0f) * (0.5f + noise(x, y, i)));
        return s;
    });
    const Picture before = raw(film), after = filtered(film, filter_settings(GetParam()));
    for (int x = 16; x < 24; ++x) {
        EXPECT_NEAR(moments(after, x, 0, 1, 48).mean, moments(before, x, 0, 1, 48).mean, 0.05) << "column " << x;
    }
}

TEST_P(Edges, NumbersOfSamplesDoNotShow) {
    const auto brightness = [&](int right) {
        const film::Film film = make_film(
            48, 48, [&](int x, int) { return x < 24 ? 16 : right; },
            [](int x, int y, int i) {
                film::Sample s = wall();
                if (noise(x, y, i) < 0.5f) light(s, 0, 1 + noise(x, y, i, 1));
                return s;
            });
        const Picture p = filtered(film, filter_settings(GetParam()));
        return std::pair{moments(p, 12, 0, 12, 48).mean, moments(p, 24, 0, 12, 48).mean};
    };
    for (const int right : {4, 64, 256}) {
        const auto [few, many] = brightness(right);
        EXPECT_NEAR(few, 0.75, 0.025) << right;
        EXPECT_NEAR(many, 0.75, 0.025) << right;
    }
}

TEST_P(Edges, PixelsOfMoreSamplesHelp) {
    // Few of the pixels around a column have as few samples as it.
    const film::Film film = make_film(
        49, 96, [](int x, int) { return x % 12 == 6 ? 16 : 64; },
        [](int x, int y, int i) {
            film::Sample s = wall();
            light(s, 0, 0.5f + noise(x, y, i));
            return s;
        });
    const Picture before = raw(film), after = filtered(film, filter_settings(GetParam()));
    const auto noisy = [](const Picture& p) {
        return moments(p, 18, 0, 1, 96).variance + moments(p, 30, 0, 1, 96).variance;
    };
    EXPECT_LT(noisy(after), noisy(before) / 30);
}

TEST_P(Edges, WhatIsNotFiniteIsDropped) {
    const auto film = [](bool spoilt) {
        return make_film({24, 24, 9}, [=](int x, int y, int i) {
            film::Sample s = wall();
            light(s, 0, 0.5f + noise(x, y, i));
            if (spoilt && x == 12 && y == 12 && i == 8) {
                s.layers[1].radiance[1] = s.radiance[2][1] = std::numeric_limits<float>::quiet_NaN();
                s.layers[1].incident[0] = std::numeric_limits<float>::infinity();
            }
            return s;
        });
    };
    const Picture spoilt = filtered(film(true), filter_settings(GetParam())),
                  clean = filtered(film(false), filter_settings(GetParam()));
    EXPECT_LT(difference(spoilt, clean), 0.2);
    EXPECT_NEAR(moments(spoilt).mean, moments(clean).mean, 1e-3);
}

TEST_P(Edges, HugeValuesStayWhereTheyAre) {
    for (const float huge : {1e12f, 1e20f, 1e29f}) {
        const film::Film film = make_film({90, 24, 8}, [=](int x, int y, int i) {
            film::Sample s = wall();
            light(s, 0, 0.5f + noise(x, y, i));
            if (x == 80 && y == 12 && i == 3) light(s, 1, huge);
            return s;
        });
        const Picture all = filtered(film, filter_settings(GetParam()));
        for (const float v : all.rgb) ASSERT_TRUE(std::isfinite(v)) << huge;
        EXPECT_NEAR(moments(all, 0, 0, 40, 24).mean, 1, 0.02) << "beyond the kernel";
        const Picture rejected = filtered(film, filter_settings(GetParam(), FilterSettings{}.firefly_density));
        for (const float v : rejected.rgb) ASSERT_TRUE(std::isfinite(v) && v < 2) << huge;
    }
}

TEST_P(Edges, BlackSurfacesStayBlack) {
    const film::Film film = make_film({24, 24, 8}, [](int x, int y, int i) {
        film::Sample s = wall((x / 3 + y / 3) % 2 == 0 ? 0.0f : 0.7f);
        if (s.detail[0] == 0) s.feature_normal[2] = s.feature_depth = s.feature_depth_squared = 0;
        light(s, 0, 0.5f + noise(x, y, i));
        return s;
    });
    const Picture before = raw(film), after = filtered(film, filter_settings(GetParam()));
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 24; ++x) {
            if (before(x, y) == 0) { EXPECT_LT(after(x, y), 1e-4); }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, Edges,
                         testing::Values(FilterMethod::clusters, FilterMethod::thesis, FilterMethod::cross_bilateral));

}  // namespace
