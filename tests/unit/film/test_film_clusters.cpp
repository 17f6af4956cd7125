// SPDX-License-Identifier: GPL-3.0-or-later
// The film as a whole: its picture does not depend on clusters, and clusters and the rest add up to it.
#include "film/some_film.h"

namespace cardioid::film {
namespace {

using test::fill;
using test::resolved;
using test::settings_of;

TEST(FilmClusters, ThePictureIsTheSameWithoutThem) {
    scene::Settings with = settings_of(19, 11), without = with;
    without.record_clusters = false;
    Film a(with), b(without);
    fill(a, 9, 4);
    fill(b, 9, 4);
    EXPECT_TRUE(a.has_clusters());
    EXPECT_FALSE(b.has_clusters());
    const Frame fa = resolved(a), fb = resolved(b);
    for (const Pass& p : fb.passes) EXPECT_EQ(fa.find(p.name)->data, p.data) << p.name;
    EXPECT_GT(a.memory_bytes(), b.memory_bytes());
}

TEST(FilmClusters, ClustersAndTheRestAreTheRawPicture) {
    Film film(settings_of(9, 9));
    fill(film, 40, 8);
    const Frame frame = resolved(film);
    for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < 9; ++x) {
            float rest[3];
            film.unfiltered(x, y, rest);
            for (int k = 0; k < 3; ++k) {
                double sum = static_cast<double>(rest[k]) * 40;
                for (int l = 0; l < k_layers; ++l) {
                    for (const Cluster& c : film.clusters().view(x, y, l)) sum += static_cast<double>(c.radiance[k]);
                }
                const float raw = frame.find("Raw")->data[static_cast<std::size_t>((y * 9 + x) * 3 + k)];
                EXPECT_NEAR(sum / 40, static_cast<double>(raw), 1e-5 * (1 + std::abs(static_cast<double>(raw))));
            }
        }
    }
}

TEST(FilmClusters, PassesDoNotChangeABit) {
    Film one(settings_of(10, 17)), two(settings_of(10, 17)), all(settings_of(10, 17));
    fill(one, 24, 1);
    fill(two, 24, 5);
    fill(all, 24, 24);
    test::expect_same_lists(one, two);
    test::expect_same_lists(one, all);
    EXPECT_EQ(resolved(one).find("Combined")->data, resolved(all).find("Combined")->data);
}

TEST(FilmClusters, BlocksCountFromTheCorner) {
    scene::Settings cropped = settings_of(40, 40);
    cropped.crop = {5, 3, 20, 18};
    Film film(cropped);
    FilmWriter writer;
    writer.open(film);
    Sample s;
    s.layers[2] = test::sample_of(1);
    for (int y = 3; y < 21; ++y) {
        for (int x = 5; x < 25; ++x) {
            s.layers[2].incident[0] = static_cast<float>(x + 100 * y);
            ASSERT_TRUE(writer.add(x, y, s, true));
        }
    }
    writer.close();
    for (int y = 0; y < 18; ++y) {
        for (int x = 0; x < 20; ++x) {
            const auto list = film.clusters().view(x, y, 2);
            ASSERT_EQ(list.size(), 1u);
            EXPECT_NEAR(list[0].min, 0.2126f * static_cast<float>(x + 5 + 100 * (y + 3)) + 0.7874f, 1e-2f);
            EXPECT_TRUE(film.clusters().view(x, y, 0).empty());
        }
    }
}

TEST(FilmClusters, LightOfNegativeLampsStaysUnfiltered) {
    Film film(settings_of(1, 1));
    FilmWriter writer;
    writer.open(film);
    Sample s;
    s.layers[0] = test::sample_of(-2);
    s.layers[1] = test::sample_of(1);
    s.unfiltered[1] = 0.25f;
    writer.add(0, 0, s, true);
    writer.add(0, 0, Sample{}, false);
    writer.close();
    float rest[3];
    film.unfiltered(0, 0, rest);
    EXPECT_FLOAT_EQ(rest[0], -0.5f);
    EXPECT_FLOAT_EQ(rest[1], -0.125f);
    EXPECT_TRUE(film.clusters().view(0, 0, 0).empty());
    EXPECT_EQ(film.clusters().view(0, 0, 1).size(), 1u);
    EXPECT_EQ(film.samples(0, 0), 2u);
}

TEST(FilmClusters, ANonFiniteLayerDropsTheSample) {
    Film film(settings_of(1, 1));
    FilmWriter writer;
    writer.open(film);
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        for (int field = 0; field < 16; ++field) {
            Sample s;
            s.layers[0] = test::sample_of(1);
            float* const fields[] = {&s.layers[0].radiance[0],
                                     &s.layers[1].radiance[1],
                                     &s.layers[2].radiance[2],
                                     &s.layers[0].incident[0],
                                     &s.layers[1].incident[1],
                                     &s.layers[2].incident[2],
                                     &s.unfiltered[0],
                                     &s.unfiltered[2],
                                     &s.detail[0],
                                     &s.detail[2],
                                     &s.feature_normal[0],
                                     &s.feature_normal[2],
                                     &s.feature_depth,
                                     &s.feature_depth_squared,
                                     &s.depth,
                                     &s.alpha};
            *fields[field] = bad;
            EXPECT_FALSE(writer.add(0, 0, s, true)) << field;
        }
    }
    writer.close();
    EXPECT_EQ(film.samples(0, 0), 0u);
    EXPECT_EQ(film.clusters().cluster_count(), 0);
    EXPECT_EQ(film.features(0, 0).detail[0], 0.0f);
}

TEST(FilmClusters, FeaturesAreMeans) {
    Film film(settings_of(1, 1));
    FilmWriter writer;
    writer.open(film);
    // Two hits at depths 2 and 4, seen through a throughput of 0.5, and a miss.
    for (const float depth : {2.0f, 4.0f}) {
        Sample s;
        for (float& c : s.detail) c = 0.5f;
        s.feature_normal[depth < 3 ? 0 : 1] = 0.5f;
        s.feature_depth = 0.5f * depth;
        s.feature_depth_squared = 0.5f * depth * depth;
        writer.add(0, 0, s, false);
    }
    writer.add(0, 0, Sample{}, false);
    writer.close();
    const PixelFeatures f = film.features(0, 0);
    EXPECT_FLOAT_EQ(f.detail[0], 1.0f / 3);
    EXPECT_FLOAT_EQ(f.normal[0], 0.5f);
    EXPECT_FLOAT_EQ(f.normal[1], 0.5f);
    EXPECT_FLOAT_EQ(f.depth, 3);
    EXPECT_FLOAT_EQ(f.depth_variance, 1);
}

TEST(FilmClusters, PhotonMeansReplaceEachOther) {
    Film film(settings_of(2, 1));
    FilmWriter writer;
    writer.open(film);
    Sample s;
    s.radiance[0][0] = s.unfiltered[0] = 1;
    writer.add(1, 0, s, true);
    writer.close();
    float classes[k_classes - 1][3] = {{1, 2, 3}, {0, 0, 0}, {4, 0, 0}, {0, 8, 0}};
    film.set_photons(1, 0, {});
    film.set_photons(1, 0, classes);
    float rest[3];
    film.unfiltered(1, 0, rest);
    EXPECT_FLOAT_EQ(rest[0], 6);
    EXPECT_FLOAT_EQ(rest[1], 10);
    film.unfiltered(0, 0, rest);
    EXPECT_EQ(rest[0], 0.0f);
    const Frame frame = resolved(film);
    EXPECT_FLOAT_EQ(frame.find("Combined")->data[4], 6);
    EXPECT_FLOAT_EQ(frame.find("C1")->data[3], 4);
    EXPECT_FLOAT_EQ(frame.find("D2")->data[5], 3);
}

}  // namespace
}  // namespace cardioid::film
