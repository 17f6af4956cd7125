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

TEST(Reject, WideNeighbourCountsInPart) {
    film::Film film = dark_with({{20, 20, 0, 100}});
    film::Cluster wide;
    wide.min = 1;
    wide.max = 1000;
    const auto kept = [&](std::uint32_t samples, bool whole) {
        wide.samples = samples;
        film.clusters().assign(21, 20, 0, std::span(&wide, 1));
        const filter::RejectionRules rules{false, whole};
        return filter::reject_by(rules, film, {}, filter::run_serially).withheld(20, 20, 0) == 0;
    };
    EXPECT_TRUE(kept(3, true));
    EXPECT_FALSE(kept(3, false)) << "the ends lie outside, between them is one sample";
    EXPECT_FALSE(kept(31, false)) << "29 × 100/999 < 3";
    EXPECT_TRUE(kept(33, false)) << "31 × 100/999 > 3";
    wide.max = 120;
    EXPECT_FALSE(kept(4, false)) << "one end, and 2 × 70/119";
    EXPECT_TRUE(kept(6, false)) << "one end, and 4 × 70/119";
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
