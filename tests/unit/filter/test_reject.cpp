// SPDX-License-Identifier: GPL-3.0-or-later
// What outlier rejection withholds and what stays.
#include "filter/reject_kernel.h"
#include "filter/reject_rules.h"
#include "filter/synthetic_film.h"

#include <gtest/gtest.h>

using namespace cardioid;
using namespace cardioid::test;

namespace {

/// Samples of given luminance in an otherwise dark film of 16 samples a pixel.
struct Flash {
    int x, y, layer;
    float luminance;
    int count = 1;
};

film::Sample flashing(const std::vector<Flash>& flashes, int x, int y, int sample, film::Sample s) {
    int next = 0;
    for (const Flash& f : flashes) {
        if (f.x != x || f.y != y) continue;
        if (sample >= next && sample < next + f.count) light(s, f.layer, f.luminance);
        next += f.count;
    }
    return s;
}

film::Film dark_with(const std::vector<Flash>& flashes, int size = 40) {
    return make_film({size, size, 16}, [&](int x, int y, int i) { return flashing(flashes, x, y, i, wall()); });
}

film::Film lit_with(const std::vector<Flash>& flashes, float brightness) {
    return make_film({40, 40, 16}, [&](int x, int y, int i) {
        film::Sample s = wall();
        light(s, 0, brightness * (0.5f + noise(x, y, i)));
        return flashing(flashes, x, y, i, s);
    });
}

int bits_set(const filter::Rejection& r) {
    int n = 0;
    for (const std::uint8_t b : r.bits) n += std::popcount(b);
    return n;
}

filter::Rejection reject(const film::Film& film, filter::RejectionStats* stats = nullptr) {
    return filter::reject(film, {}, filter::run_serially, stats);
}

int rejected(const std::vector<Flash>& flashes) { return bits_set(reject(dark_with(flashes))); }

TEST(Reject, OneFireflyGoesWhereverItIs) {
    for (int layer = 0; layer < film::k_layers; ++layer) {
        for (const int x : {0, 3, 8, 20, 39}) {
            const film::Film film = lit_with({{x, 20, layer, 1000}}, 1);
            filter::RejectionStats stats;
            const filter::Rejection r = reject(film, &stats);
            EXPECT_EQ(bits_set(r), 1) << "layer " << layer << " x " << x;
            const auto list = film.clusters().view(x, 20, layer);
            EXPECT_EQ(r.withheld(x, 20, layer), 1u << (list.size() - 1));
            EXPECT_EQ(stats.rejected, 1);
            EXPECT_EQ(stats.rejected_samples, 1);
            EXPECT_EQ(stats.clusters, film.clusters().cluster_count());
        }
    }
}

TEST(Reject, BrightRegionStays) {
    const film::Film film = make_film({40, 40, 16}, [](int x, int y, int i) {
        film::Sample s = wall();
        light(s, 0, 0.5f + noise(x, y, i));
        // A highlight that one sample in four finds.
        if (x >= 18 && x < 23 && y >= 18 && y < 23 && i % 4 == 0) light(s, 1, 500 + 200 * noise(x, y, i, 1));
        return s;
    });
    EXPECT_EQ(bits_set(reject(film)), 0);
}

TEST(Reject, FourAlikeStayThreeGo) {
    std::vector<Flash> flashes{{20, 20, 1, 100}, {22, 20, 1, 110}, {20, 23, 1, 90}};
    EXPECT_EQ(rejected(flashes), 3);
    flashes.push_back({18, 21, 1, 105});
    EXPECT_EQ(rejected(flashes), 0);
    EXPECT_EQ(rejected({{20, 20, 1, 100, 3}}), 1) << "three samples of one cluster";
    EXPECT_EQ(rejected({{20, 20, 1, 100, 4}}), 0);
}

TEST(Reject, OnlyLikeSamplesOfTheSameLayerNearbyCount) {
    const Flash a{20, 20, 1, 100, 2};
    EXPECT_EQ(rejected({a, {25, 25, 1, 100, 2}}), 0) << "in the corner of the kernel";
    EXPECT_EQ(rejected({a, {26, 20, 1, 100, 2}}), 2) << "outside";
    EXPECT_EQ(rejected({a, {21, 20, 2, 100, 2}}), 2) << "another layer";
    EXPECT_EQ(rejected({a, {21, 20, 1, 201, 2}}), 2) << "brighter by more than μ, from its end too";
    EXPECT_EQ(rejected({a, {21, 20, 1, 151, 2}}), 1) << "from its end 100 is like it";
    EXPECT_EQ(rejected({a, {21, 20, 1, 49, 2}}), 2) << "darker by more than μ";
}

TEST(Reject, OnlyTheTestedClusterIsStretched) {
    // From 19, 10 is within μ; from 10, 19 is not.
    const film::Film film = dark_with({{20, 20, 1, 10}, {21, 20, 1, 19, 3}});
    const filter::Rejection r = reject(film);
    EXPECT_EQ(r.withheld(20, 20, 1), 1);
    EXPECT_EQ(r.withheld(21, 20, 1), 0);
}

TEST(Reject, OtherClustersOfThePixelAreEvidence) { EXPECT_EQ(rejected({{20, 20, 0, 100, 2}, {20, 20, 0, 140, 2}}), 0); }

TEST(Reject, DimmerThanWhatStaysStays) {
    const Flash dim{20, 20, 1, 90};
    EXPECT_EQ(rejected({{20, 20, 0, 100, 4}, dim}), 0);
    EXPECT_EQ(rejected({{20, 20, 0, 80, 4}, dim}), 1);
    EXPECT_EQ(rejected({{20, 20, 0, 100, 1}, dim}), 2) << "a rejected cluster excuses nothing";
    EXPECT_EQ(rejected({{20, 20, 2, 100, 4}, dim}), 1) << "layers come in order";
}

TEST(Reject, RulesDifferAsPrinted) {
    const film::Film film = dark_with({{20, 20, 0, 3000}, {20, 20, 0, 1000}, {20, 20, 0, 300}, {20, 20, 0, 100}});
    EXPECT_EQ(reject(film).withheld(20, 20, 0), 0b1111) << "each by itself";
    scene::FilterSettings thesis;
    thesis.filter_method = scene::FilterMethod::thesis;
    EXPECT_EQ(filter::reject(film, thesis, filter::run_serially).withheld(20, 20, 0), 0b1110) << "density runs on";
}

/// A cluster of a white wall whose samples bring as much as their mean.
film::Cluster wide(float min, float max, std::uint32_t samples, float mean) {
    film::Cluster c;
    const float n = static_cast<float>(samples);
    for (float& r : c.radiance) r = n * mean;
    c.incident = n * mean;
    c.radiance_squared = film::luminance(c.radiance) * film::luminance(c.radiance) / n;
    c.min = min;
    c.max = max;
    c.samples = samples;
    return c;
}

TEST(Reject, WideNeighbourCountsInPart) {
    film::Film film = dark_with({{20, 20, 0, 100}});
    float max = 1000;
    const auto kept = [&](std::uint32_t samples, bool whole) {
        const film::Cluster c = wide(1, max, samples, 60);
        film.clusters().assign(21, 20, 0, std::span(&c, 1));
        const filter::RejectionRules rules{false, whole, false};
        return filter::reject_by(rules, film, {}, filter::run_serially).withheld(20, 20, 0) == 0;
    };
    EXPECT_TRUE(kept(3, true));
    EXPECT_FALSE(kept(3, false)) << "the ends lie outside, between them is one sample";
    EXPECT_FALSE(kept(31, false)) << "29 × 100/999 < 3";
    EXPECT_TRUE(kept(33, false)) << "31 × 100/999 > 3";
    max = 120;
    EXPECT_FALSE(kept(4, false)) << "one end, and 2 × 70/119";
    EXPECT_TRUE(kept(6, false)) << "one end, and 4 × 70/119";
}

/// A sample of a glossy lobe arrives dim, because it was likely, and is added bright.
void glossy(film::Sample& s, float incident, float added) {
    for (int k = 0; k < 3; ++k) {
        s.layers[2].incident[k] = incident;
        s.layers[2].radiance[k] = s.radiance[2][k] = added;
    }
}

film::Film metal(const std::function<bool(int x, int y, int i)>& shines) {
    return make_film({40, 40, 16}, [&](int x, int y, int i) {
        film::Sample s = wall();
        light(s, 0, 0.5f + noise(x, y, i));
        glossy(s, 0.05f + 0.1f * noise(x, y, i, 1), 0.05f);
        if (shines(x, y, i)) glossy(s, 0.1f, 8);
        return s;
    });
}

TEST(Reject, BrightnessIsWhatIsAdded) {
    const film::Film film = metal([](int x, int y, int i) { return x == 20 && y == 20 && i == 9; });
    filter::RejectionStats stats;
    const filter::Rejection r = reject(film, &stats);
    EXPECT_EQ(bits_set(r), 1);
    EXPECT_EQ(std::popcount(r.withheld(20, 20, 2)), 1);
    scene::FilterSettings thesis;
    thesis.filter_method = scene::FilterMethod::thesis;
    EXPECT_EQ(bits_set(filter::reject(film, thesis, filter::run_serially)), 0) << "it arrives as dim as the others";
    EXPECT_EQ(bits_set(reject(metal([](int x, int, int i) { return x > 15 && i % 8 == 0; }))), 0) << "a highlight";
}

TEST(Reject, OneSampleDoesNotHideBehindThoseOfItsCluster) {
    film::Film film = dark_with({{20, 20, 1, 100}});
    film::Cluster c = wide(90, 110, 10, 1);
    const auto kept = [&](float bright) {
        // Nine samples bring 1, one brings more.
        for (float& r : c.radiance) r = 9 + bright;
        c.radiance_squared = 9 + bright * bright;
        film.clusters().assign(20, 20, 1, std::span(&c, 1));
        return reject(film).withheld(20, 20, 1) == 0;
    };
    EXPECT_TRUE(kept(1));
    EXPECT_TRUE(kept(3));
    EXPECT_FALSE(kept(50));
}

TEST(Reject, TexturesDoNotSetPixelsApart) {
    // Sparse samples of the same light, on squares that send on 0.9 and 0.1 of it.
    const film::Film film = make_film({40, 40, 16}, [](int x, int y, int i) {
        film::Sample s = wall((x + y) % 2 == 0 ? 0.9f : 0.1f);
        if (noise(x / 3, y / 3, 7) < 0.5f && x % 3 == 1 && y % 3 == 1 && i == 2) light(s, 1, 50);
        return s;
    });
    int lit = 0, withheld = 0;
    const filter::Rejection r = reject(film);
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 40; ++x) {
            int near = 0;
            for (int v = std::max(y - 5, 0); v <= std::min(y + 5, 39); ++v) {
                for (int u = std::max(x - 5, 0); u <= std::min(x + 5, 39); ++u)
                    near += static_cast<int>(film.clusters().view(u, v, 1).size());
            }
            if (film.clusters().view(x, y, 1).empty() || near < 4) continue;
            ++lit;
            withheld += r.withheld(x, y, 1) != 0;
        }
    }
    EXPECT_GT(lit, 30);
    EXPECT_EQ(withheld, 0);
}

TEST(Reject, EvidenceOfPixelsWithOtherNumbersOfSamples) {
    const auto bits = [](int own, int others, int alike) {
        const film::Film film = make_film(
            21, 21, [&](int x, int y) { return x == 10 && y == 10 ? own : others; },
            [&](int x, int y, int i) {
                film::Sample s = wall();
                if (y == 10 && ((x == 10 && i == 0) || (x == 11 && i < alike))) light(s, 0, 50);
                return s;
            });
        return reject(film).withheld(10, 10, 0);
    };
    EXPECT_EQ(bits(16, 16, 3), 0);
    EXPECT_EQ(bits(16, 64, 3), 1) << "less than one in 16 samples";
    EXPECT_EQ(bits(16, 64, 11), 1);
    EXPECT_EQ(bits(16, 64, 12), 0);
    EXPECT_EQ(bits(64, 16, 3), 0) << "what was seen was seen";
    EXPECT_EQ(bits(4096, 16, 2), 1) << "and is not multiplied";
}

TEST(Reject, OneSampleAPixel) {
    // Any smooth light stays, at any level, noisy by its own factor of two; a firefly goes.
    const film::Film film = make_film({64, 64, 1}, [](int x, int y, int i) {
        film::Sample s = wall();
        light(s, 0, (1 + 0.1f * static_cast<float>(x)) * (0.5f + noise(x, y, i)));
        if (noise(x, y, i, 1) < 0.2f) light(s, 1, 5 + 5 * noise(x, y, i, 2));
        if (x == 30 && y == 30) light(s, 2, 400);
        return s;
    });
    const filter::Rejection r = reject(film);
    EXPECT_EQ(r.withheld(30, 30, 2), 1);
    EXPECT_LE(bits_set(r), 1);
}

TEST(Reject, DensityNotCountAtTheBorder) {
    const scene::FilterSettings s;
    const filter::RejectionKernel kernel(s, 100, 100);
    EXPECT_EQ(kernel.needed(50, 50), 4 * filter::k_evidence);
    EXPECT_NEAR(static_cast<double>(kernel.needed(0, 50)), 4.0 * 66 / 121 * filter::k_evidence,
                filter::k_evidence / 256.0);
    EXPECT_NEAR(static_cast<double>(kernel.needed(99, 99)), 4.0 * 36 / 121 * filter::k_evidence,
                filter::k_evidence / 256.0);
    EXPECT_EQ(rejected({{0, 0, 1, 100}}), 1) << "even in a corner it takes a second one";
    EXPECT_EQ(rejected({{0, 0, 1, 100, 2}}), 0);
}

}  // namespace
