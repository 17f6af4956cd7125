// SPDX-License-Identifier: GPL-3.0-or-later
// Outlier rejection: symmetry, purity, sizes, convergence.
#include "filter/reject_rules.h"
#include "filter/synthetic_film.h"

#include <gtest/gtest.h>

using namespace cardioid;
using namespace cardioid::test;

namespace {
using scene::FilterMethod;
using scene::FilterSettings;

/// Heavy tails in every layer, with holes and another number of samples for each pixel.
film::Sample tail(int x, int y, int sample, float scale) {
    film::Sample s = wall();
    for (int layer = 0; layer < film::k_layers; ++layer) {
        const float u = noise(x, y, sample, 2 * layer);
        if (noise(x, y, sample, 2 * layer + 1) < 0.4f) light(s, layer, scale / std::sqrt(1.0001f - u) / (1.0001f - u));
    }
    return s;
}

int uneven(int x, int y) { return 4 + static_cast<int>(20 * noise(x, y, -1)); }

using Place = std::function<std::pair<int, int>(int x, int y)>;

/// The film with pixel (x, y) as pixel place(x, y) of a fixed one.
film::Film placed(int width, int height, const Place& place, float scale = 1) {
    return make_film(
        width, height, [&](int x, int y) { return uneven(place(x, y).first, place(x, y).second); },
        [&](int x, int y, int i) { return tail(place(x, y).first, place(x, y).second, i, scale); });
}

film::Film plain(float scale = 1) {
    return placed(
        45, 37,
        [](int x, int y) {
            return std::pair{x, y};
        },
        scale);
}

FilterSettings with(FilterMethod method) {
    FilterSettings s;
    s.filter_method = method;
    return s;
}

filter::Rejection reject(const film::Film& film, const FilterSettings& s) {
    return filter::reject(film, s, filter::run_serially);
}

void expect_placed(const film::Film& film, const filter::Rejection& straight, const Place& place,
                   const FilterSettings& s) {
    const filter::Rejection r = reject(film, s);
    int differing = 0;
    for (int y = 0; y < r.height; ++y) {
        for (int x = 0; x < r.width; ++x) {
            const auto [sx, sy] = place(x, y);
            for (int l = 0; l < film::k_layers; ++l) differing += r.withheld(x, y, l) != straight.withheld(sx, sy, l);
        }
    }
    EXPECT_EQ(differing, 0);
}

class RejectBy : public testing::TestWithParam<FilterMethod> {};

TEST_P(RejectBy, FlipsAndTransposes) {
    const FilterSettings s = with(GetParam());
    const filter::Rejection straight = reject(plain(), s);
    ASSERT_GT(std::count_if(straight.bits.begin(), straight.bits.end(), [](int b) { return b != 0; }), 50);
    const Place across = [](int x, int y) { return std::pair{44 - x, y}; };
    const Place up = [](int x, int y) { return std::pair{x, 36 - y}; };
    const Place transposed = [](int x, int y) { return std::pair{y, x}; };
    expect_placed(placed(45, 37, across), straight, across, s);
    expect_placed(placed(45, 37, up), straight, up, s);
    expect_placed(placed(37, 45, transposed), straight, transposed, s);
}

TEST_P(RejectBy, BrightnessOfTheWholeDoesNotMatter) {
    const FilterSettings s = with(GetParam());
    const std::vector<std::uint8_t> bits = reject(plain(), s).bits;
    EXPECT_EQ(reject(plain(0x1p20f), s).bits, bits);
    EXPECT_EQ(reject(plain(0x1p-20f), s).bits, bits);
}

TEST_P(RejectBy, PureAndInAnyOrder) {
    const FilterSettings s = with(GetParam());
    const film::Film film = plain();
    filter::RejectionStats once, twice;
    const std::vector<std::uint8_t> bits = filter::reject(film, s, filter::run_serially, &once).bits;
    EXPECT_EQ(filter::reject(film, s, run_backwards, &twice).bits, bits);
    EXPECT_EQ(filter::reject(film, s, run_interleaved).bits, bits);
    EXPECT_EQ(reject(plain(), s).bits, bits) << "a fresh film";
    EXPECT_EQ(once.rejected, twice.rejected);
    EXPECT_EQ(once.rejected_samples, twice.rejected_samples);
    EXPECT_EQ(once.singles, twice.singles);
}

INSTANTIATE_TEST_SUITE_P(Methods, RejectBy, testing::Values(FilterMethod::clusters, FilterMethod::thesis));

TEST(RejectProperties, StoppedIsEmpty) {
    filter::RejectionStats stats;
    EXPECT_TRUE(filter::reject(plain(), {}, run_but_one, &stats).bits.empty());
    EXPECT_EQ(stats.rejected, 0);
}

TEST(RejectProperties, StatsCountTheFilm) {
    const film::Film film = plain();
    filter::RejectionStats stats;
    const filter::Rejection r = filter::reject(film, {}, filter::run_serially, &stats);
    std::int64_t singles = 0, clusters = 0, rejected = 0, samples = 0;
    for (int y = 0; y < 37; ++y) {
        for (int x = 0; x < 45; ++x) {
            for (int l = 0; l < film::k_layers; ++l) {
                const auto list = film.clusters().view(x, y, l);
                for (std::size_t i = 0; i < list.size(); ++i) {
                    const bool withheld = (r.withheld(x, y, l) >> i & 1) != 0;
                    clusters += 1;
                    singles += list[i].samples == 1;
                    rejected += withheld;
                    samples += withheld ? list[i].samples : 0;
                }
                EXPECT_EQ(r.withheld(x, y, l) >> list.size(), 0) << "bits beyond the list";
            }
        }
    }
    EXPECT_EQ(stats.clusters, clusters);
    EXPECT_EQ(stats.singles, singles);
    EXPECT_EQ(stats.rejected, rejected);
    EXPECT_EQ(stats.rejected_samples, samples);
    EXPECT_GT(rejected, 0);
    EXPECT_LT(rejected, clusters / 5);
}

TEST(RejectProperties, SettingsAtTheirLimits) {
    const film::Film film = plain();
    FilterSettings s;
    s.luminance_sensitivity = 0;
    const filter::Rejection none = reject(film, s);
    EXPECT_TRUE(std::all_of(none.bits.begin(), none.bits.end(), [](int b) { return b == 0; })) << "n = 0";
    s = {};
    s.firefly_density = 0;
    EXPECT_TRUE(reject(film, s).bits.empty());
    s = {};
    s.filter_size = 1;
    s.firefly_density = 4;
    EXPECT_EQ(reject(film, s).bits.size(), 45u * 37 * 3);
    s.firefly_density = 1e30f;
    for (const std::uint8_t bits : {reject(film, s).withheld(5, 5, 0)}) {
        EXPECT_EQ(bits + 1u, 1u << film.clusters().view(5, 5, 0).size()) << "nothing is dense enough";
    }
    s.filter_size = scene::k_largest_filter;
    s.luminance_sensitivity = 0.99f;
    EXPECT_EQ(reject(film, s).bits.size(), 45u * 37 * 3) << "larger than the picture";
}

TEST(RejectProperties, EverySizeAndEmptyFilms) {
    for (int width = 1; width <= 20; width += width < 4 ? 1 : 5) {
        for (int height = 1; height <= 20; height += height < 4 ? 1 : 5) {
            const auto size = static_cast<std::size_t>(width * height * film::k_layers);
            for (const int samples : {0, 1, 3}) {
                const film::Film film =
                    make_film({width, height, samples}, [](int x, int y, int i) { return tail(x, y, i, 1); });
                EXPECT_EQ(reject(film, {}).bits.size(), size) << width << "×" << height;
            }
        }
    }
    const film::Film one = make_film({1, 1, 1}, [](int, int, int) {
        film::Sample s = wall();
        light(s, 0, 1e4f);
        return s;
    });
    EXPECT_EQ(reject(one, {}).withheld(0, 0, 0), 0) << "nothing to compare with";
    scene::Settings bare = film_settings(8, 8);
    bare.record_clusters = false;
    EXPECT_TRUE(reject(film::Film(bare), {}).bits.empty());
}

/// Radiance of withheld clusters over that of all, of a layer.
double withheld_share(const film::Film& film) {
    const filter::Rejection r = reject(film, {});
    double withheld = 0, all = 0;
    for (int y = 0; y < r.height; ++y) {
        for (int x = 0; x < r.width; ++x) {
            const auto list = film.clusters().view(x, y, 0);
            for (std::size_t i = 0; i < list.size(); ++i) {
                all += list[i].radiance[1];
                if ((r.withheld(x, y, 0) >> i & 1) != 0) withheld += list[i].radiance[1];
            }
        }
    }
    return withheld / all;
}

TEST(RejectProperties, EnergyReturnsAsSamplesGrow) {
    // One sample in a hundred finds a lamp whose light is spread over two decades; around the pixels nothing else is bright.
    const auto share = [](int samples) {
        return withheld_share(make_film({13, 13, samples}, [](int x, int y, int i) {
            film::Sample s = wall();
            light(s, 0, 0.5f + noise(x, y, i));
            if (noise(x, y, i, 1) < 0.01f) light(s, 0, 30 * std::pow(100.0f, noise(x, y, i, 2)));
            return s;
        }));
    };
    const double first = share(4), second = share(64), last = share(4096);
    EXPECT_GT(first, 0.3);
    EXPECT_LT(second, 0.5 * first);
    EXPECT_LT(last, 1e-3);
}

TEST(RejectProperties, AFireflyReturnsInItsPixelAlone) {
    // Bright now and then in one pixel only: a glint.
    const auto share = [](int samples) {
        return withheld_share(make_film({13, 13, samples}, [](int x, int y, int i) {
            film::Sample s = wall();
            light(s, 0, 0.5f + noise(x, y, i));
            if (x == 6 && y == 6 && i % 250 == 100) light(s, 0, 2000);
            return s;
        }));
    };
    EXPECT_GT(share(128), 0);
    EXPECT_EQ(share(1024), 0);
}

TEST(RejectProperties, TheFilmStays) {
    const film::Film film = plain(), same = plain();
    reject(film, {});
    for (int y = 0; y < 37; ++y) {
        for (int x = 0; x < 45; ++x) {
            for (int l = 0; l < film::k_layers; ++l) {
                const auto a = film.clusters().view(x, y, l), b = same.clusters().view(x, y, l);
                ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& p, const auto& q) {
                    return std::equal(p.radiance, p.radiance + 3, q.radiance) && p.min == q.min && p.max == q.max &&
                           p.samples == q.samples;
                }));
            }
        }
    }
}

}  // namespace
