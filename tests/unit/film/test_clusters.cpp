// SPDX-License-Identifier: GPL-3.0-or-later
#include "film/cluster_reference.h"

#include <map>

namespace cardioid::film {
namespace {

using test::Light;
using test::ReferenceList;
using test::sample_of;

constexpr float k_nan = std::numeric_limits<float>::quiet_NaN(), k_inf = std::numeric_limits<float>::infinity();

/// Adds to pixel (0, 0), layer 0; the first sample has the number `taken`.
class OnePixel {
public:
    bool add(const LayerSample& s, std::uint32_t taken) {
        editor_.open(store_, 0, 0);
        return editor_.add(0, 0, 0, s, taken);
    }
    void add_all(const std::vector<float>& luminances, std::uint32_t taken = 0) {
        for (const float y : luminances) EXPECT_TRUE(add(sample_of(y), taken++));
    }
    /// Each its own cluster.
    void fill(const std::vector<float>& luminances) {
        for (const float y : luminances) EXPECT_TRUE(add(sample_of(y), 0));
    }
    std::span<const Cluster> list() {
        editor_.close();
        return store_.view(0, 0, 0);
    }
    /// Pairs of bounds.
    std::vector<std::pair<float, float>> bounds() {
        std::vector<std::pair<float, float>> b;
        for (const Cluster& c : list()) b.emplace_back(c.min, c.max);
        return b;
    }

private:
    ClusterStore store_{1, 1};
    ClusterEditor editor_;
};

using Bounds = std::vector<std::pair<float, float>>;

TEST(Clusters, EveryStreamGivesWhatTheSpecSays) {
    for (int light = 0; light < static_cast<int>(Light::count); ++light) {
        for (const int n : {1, 3, 4, 5, 16, 100, 1000}) {
            const auto samples = test::stream(static_cast<Light>(light), n, static_cast<unsigned>(n));
            OnePixel pixel;
            ReferenceList reference;
            std::uint32_t taken = 0;
            for (const LayerSample& s : samples) {
                ASSERT_TRUE(pixel.add(s, taken));
                reference.add(s, taken++);
                // Packed now and then, as between passes.
                if (taken % 7 == 0) pixel.list();
            }
            SCOPED_TRACE(testing::Message() << "light " << light << ", " << n << " samples");
            test::expect_same(pixel.list(), reference.list());
            test::expect_holds(pixel.list(), samples);
        }
    }
}

TEST(Clusters, AnyOrderKeepsSumsAndRanges) {
    for (int light = 0; light < static_cast<int>(Light::count); ++light) {
        auto samples = test::stream(static_cast<Light>(light), 60, 5);
        std::mt19937 random(3);
        for (int order = 0; order < 40; ++order) {
            if (order == 1) std::ranges::sort(samples, {}, [](const LayerSample& s) { return s.incident[0]; });
            if (order == 2) std::ranges::reverse(samples);
            if (order > 2) std::ranges::shuffle(samples, random);
            OnePixel pixel;
            std::uint32_t taken = 0;
            for (const LayerSample& s : samples) pixel.add(s, taken++);
            test::expect_holds(pixel.list(), samples);
        }
    }
}

TEST(Clusters, MergingKeepsTheMean) {
    // Nine far apart in the first batch's way, then each next one merges.
    const auto samples = test::stream(Light::wide, 200, 9);
    OnePixel pixel;
    double sum[3] = {}, have[3] = {};
    for (const LayerSample& s : samples) {
        pixel.add(s, 0);
        for (int k = 0; k < 3; ++k) sum[k] += static_cast<double>(s.radiance[k]);
    }
    EXPECT_EQ(pixel.list().size(), 8u);
    for (const Cluster& c : pixel.list()) {
        for (int k = 0; k < 3; ++k) have[k] += static_cast<double>(c.radiance[k]);
    }
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(have[k], sum[k], 1e-5 * sum[k]);
}

TEST(Clusters, FirstFourSamplesStayApart) {
    OnePixel pixel;
    pixel.add_all({1.0f, 1.02f, 0.99f, 1.01f});
    EXPECT_EQ(pixel.bounds(), (Bounds{{0.99f, 0.99f}, {1, 1}, {1.01f, 1.01f}, {1.02f, 1.02f}}));
    // Then enough is known: what one sample could not tell apart is one cluster.
    pixel.add_all({1.03f}, 4);
    EXPECT_EQ(pixel.bounds(), (Bounds{{0.99f, 1.03f}}));
}

TEST(Clusters, TheFirstBatchCountsSamplesNotClusters) {
    OnePixel pixel;
    // Four black samples came before.
    pixel.add_all({1.0f, 1.02f, 0.99f}, 4);
    EXPECT_EQ(pixel.bounds(), (Bounds{{0.99f, 1.02f}}));
    // One black and three of light: the fourth is still of the batch, the fifth is not.
    OnePixel other;
    other.add_all({1.0f, 1.02f}, 2);
    EXPECT_EQ(other.list().size(), 2u);
    other.add_all({1.01f}, 4);
    EXPECT_EQ(other.list().size(), 1u);
}

TEST(Clusters, EqualLuminancesAreOneClusterFromTheStart) {
    OnePixel pixel;
    pixel.add_all({2, 2, 2, 2, 2});
    ASSERT_EQ(pixel.list().size(), 1u);
    EXPECT_EQ(pixel.list()[0].samples, 5u);
    EXPECT_EQ(pixel.bounds(), (Bounds{{2, 2}}));
}

TEST(Clusters, ASampleReachesHalfOfItselfToTheNearest) {
    OnePixel up;
    up.add_all({1.0f, 2.0f}, 4);
    EXPECT_EQ(up.bounds(), (Bounds{{1, 2}}));
    OnePixel over;
    over.add_all({1.0f, 2.001f}, 4);
    EXPECT_EQ(over.bounds(), (Bounds{{1, 1}, {2.001f, 2.001f}}));
    OnePixel down;
    down.add_all({3.0f, 2.0f}, 4);
    EXPECT_EQ(down.bounds(), (Bounds{{2, 3}}));
    OnePixel under;
    // Half of 3, not half of 1.499: in the other order they would be one, so they are in this one.
    under.add_all({3.0f, 1.499f}, 4);
    EXPECT_EQ(under.bounds(), (Bounds{{1.499f, 1.499f}, {3, 3}}));
    OnePixel either;
    either.add_all({3.0f, 1.999f}, 4);
    EXPECT_EQ(either.bounds(), (Bounds{{1.999f, 3}}));
}

TEST(Clusters, NeighboursWithinReachOfEachOtherBecomeOne) {
    OnePixel pixel;
    pixel.add_all({1.0f, 2.5f, 6.0f}, 0);
    // Nothing is within half of itself: 2.5 - 1 > 1.25, 6 - 2.5 > 3.
    pixel.add_all({20.0f}, 4);
    EXPECT_EQ(pixel.bounds(), (Bounds{{1, 1}, {2.5f, 2.5f}, {6, 6}, {20, 20}}));
    // 4 is nearer to 2.5, and from there 6 is within reach; 1 is not.
    pixel.add_all({4.0f}, 5);
    EXPECT_EQ(pixel.bounds(), (Bounds{{1, 1}, {2.5f, 6}, {20, 20}}));
    EXPECT_EQ(pixel.list()[1].samples, 3u);
}

TEST(Clusters, NeighboursOfLeastGapAndLikeGradientMerge) {
    // Singles: gaps alone decide. 10 and 10.5 are nearest.
    OnePixel pixel;
    pixel.fill({1, 3, 6, 10, 10.5f, 20, 40, 80});
    ASSERT_EQ(pixel.list().size(), 8u);
    pixel.add_all({200}, 3);
    EXPECT_EQ(pixel.bounds(), (Bounds{{1, 1}, {3, 3}, {6, 6}, {10, 10.5f}, {20, 20}, {40, 40}, {80, 80}, {200, 200}}));
    // The new one may be the one that is merged.
    OnePixel other;
    other.fill({1, 3, 6, 10, 20, 40, 80, 160, 20.25f});
    EXPECT_EQ(other.bounds()[4], std::make_pair(20.0f, 20.25f));
    // A steep cluster (gradient 8) before a gap of 1 gives M = 0.75 · 8 + 1 = 7; two singles 6 apart give 6.
    const Cluster wide{.incident = 24, .min = 8, .max = 16, .samples = 2};
    ClusterStore store(1, 1);
    std::vector<Cluster> list = {wide};
    for (const float y : {17.0f, 23.0f, 40.0f, 60.0f, 80.0f, 100.0f, 120.0f})
        list.push_back({.min = y, .max = y, .samples = 1});
    store.assign(0, 0, 0, list);
    ClusterEditor editor;
    editor.open(store, 0, 0);
    editor.add(0, 0, 0, sample_of(1000), 3);
    editor.close();
    ASSERT_EQ(store.view(0, 0, 0).size(), 8u);
    EXPECT_EQ(store.view(0, 0, 0)[0].max, 16);
    EXPECT_EQ(store.view(0, 0, 0)[1].min, 17);
    EXPECT_EQ(store.view(0, 0, 0)[1].max, 23);
}

TEST(Clusters, WhatIsNotLightDoesNotEnter) {
    OnePixel pixel;
    for (const float y : {0.0f, -0.0f, -1.0f, k_nan, k_inf, -k_inf}) EXPECT_FALSE(pixel.add(sample_of(y), 9)) << y;
    EXPECT_TRUE(pixel.list().empty());
    LayerSample partly = sample_of(1);
    partly.incident[2] = k_nan;
    EXPECT_FALSE(pixel.add(partly, 9));
    partly.incident[2] = -1;  // negative in a channel, yet light as a whole
    EXPECT_TRUE(pixel.add(partly, 9));
    EXPECT_TRUE(pixel.add(sample_of(1e-40f), 9)) << "denormal";
    EXPECT_TRUE(pixel.add(sample_of(1e30f), 9)) << "its square overflows";
    for (const Cluster& c : pixel.list()) EXPECT_TRUE(std::isfinite(c.radiance_squared));
    EXPECT_TRUE(valid(pixel.list(), 3));
}

TEST(Clusters, PixelsOfAllSizesKeepApart) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}, {7, 8}, {8, 8}, {9, 9}, {17, 3}, {16, 25}}) {
        ClusterStore store(width, height);
        ClusterEditor editor;
        std::vector<std::pair<int, int>> pixels;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) pixels.emplace_back(x, y);
        }
        std::map<std::tuple<int, int, int>, ReferenceList> reference;
        std::mt19937 random(static_cast<unsigned>(100 * width + height));
        // Blocks in any order, opened again and again.
        for (std::uint32_t taken = 0; taken < 6; ++taken) {
            std::ranges::shuffle(pixels, random);
            for (const auto& [x, y] : pixels) {
                for (int layer = 0; layer < k_layers; ++layer) {
                    if (random() % 4 == 0) continue;
                    const LayerSample s = sample_of(static_cast<float>(1 + random() % 1000) * 0.01f);
                    editor.open(store, x, y);
                    editor.add(x, y, layer, s, taken);
                    reference[{x, y, layer}].add(s, taken);
                }
            }
        }
        editor.close();
        std::int64_t clusters = 0, singles = 0;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                for (int layer = 0; layer < k_layers; ++layer) {
                    const auto& list = reference[{x, y, layer}].list();
                    test::expect_same(store.view(x, y, layer), list);
                    clusters += static_cast<std::int64_t>(list.size());
                    singles += std::ranges::count(list, 1u, &Cluster::samples);
                }
            }
        }
        EXPECT_EQ(store.cluster_count(), clusters);
        EXPECT_EQ(store.single_count(), singles);
        EXPECT_GE(store.memory_bytes(), 32 * clusters);
        EXPECT_LE(store.memory_bytes(), 32 * clusters + 1536 * ((width + 7) / 8) * ((height + 7) / 8));
    }
}

TEST(Clusters, AssignReplacesOneList) {
    ClusterStore store(9, 9);
    const Cluster a{.min = 1, .max = 2, .samples = 3}, b{.min = 4, .max = 5, .samples = 1};
    store.assign(8, 8, 1, std::vector{a, b});
    store.assign(0, 0, 2, std::vector{b});
    store.assign(1, 0, 0, std::vector{a});
    EXPECT_EQ(store.view(0, 0, 2).size(), 1u);
    EXPECT_EQ(store.view(1, 0, 0)[0].max, 2);
    store.assign(0, 0, 2, std::vector{a, b});
    EXPECT_EQ(store.view(0, 0, 2)[1].max, 5);
    EXPECT_EQ(store.view(1, 0, 0)[0].max, 2);
    store.assign(0, 0, 2, {});
    EXPECT_TRUE(store.view(0, 0, 2).empty());
    EXPECT_EQ(store.view(1, 0, 0)[0].max, 2);
    EXPECT_EQ(store.view(8, 8, 1)[1].min, 4);
    EXPECT_EQ(store.cluster_count(), 3);
}

TEST(Clusters, ValidFindsEveryContradiction) {
    const std::vector<Cluster> good = {{.incident = 3, .min = 1, .max = 2, .samples = 2},
                                       {.min = 3, .max = 3, .samples = 1}};
    EXPECT_TRUE(valid(good, 3));
    EXPECT_TRUE(valid({}, 0));
    EXPECT_FALSE(valid(good, 2)) << "more samples than were taken";
    EXPECT_FALSE(valid(std::vector<Cluster>(9, good[0]), 1000));
    const auto broken = [&](auto change) {
        std::vector<Cluster> list = good;
        change(list);
        return !valid(list, 100);
    };
    EXPECT_TRUE(broken([](auto& l) { std::swap(l[0], l[1]); }));
    EXPECT_TRUE(broken([](auto& l) { l[1].min = 2; }));
    EXPECT_TRUE(broken([](auto& l) { l[0].min = 0; }));
    EXPECT_TRUE(broken([](auto& l) { l[0].min = 2.5f; }));
    EXPECT_TRUE(broken([](auto& l) { l[0].samples = 0; }));
    EXPECT_TRUE(broken([](auto& l) { l[0].samples = l[1].samples = 0x80000000u; }));
    EXPECT_TRUE(broken([](auto& l) { l[0].radiance_squared = -1; }));
    EXPECT_TRUE(broken([](auto& l) { l[0].incident = -1; }));
    for (const float bad : {k_nan, k_inf}) {
        EXPECT_TRUE(broken([&](auto& l) { l[1].max = bad; }));
        EXPECT_TRUE(broken([&](auto& l) { l[1].min = bad; }));
        EXPECT_TRUE(broken([&](auto& l) { l[0].radiance[2] = bad; }));
        EXPECT_TRUE(broken([&](auto& l) { l[0].incident = bad; }));
        EXPECT_TRUE(broken([&](auto& l) { l[0].radiance_squared = bad; }));
    }
}

}  // namespace
}  // namespace cardioid::film
