// SPDX-License-Identifier: GPL-3.0-or-later
#include "film/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace cardioid::film {
namespace {

scene::Settings frame(int width, int height) {
    scene::Settings s;
    s.width = width;
    s.height = height;
    return s;
}

Sample sample(float value, float alpha = 1) {
    Sample s;
    for (int c = 0; c < k_classes; ++c) {
        for (int k = 0; k < 3; ++k) s.radiance[c][k] = value * static_cast<float>(1 + c) * static_cast<float>(1 + k);
    }
    s.alpha = alpha;
    s.depth = 7;
    s.normal[0] = value;
    return s;
}

bool add(Film& film, int x, int y, const Sample& s, bool first) {
    FilmWriter writer;
    writer.open(film);
    const bool kept = writer.add(x, y, s, first);
    writer.close();
    return kept;
}

float at(const Frame& f, const char* pass, int x, int y, int channel) {
    const Pass& p = *f.find(pass);
    return p.data[static_cast<std::size_t>((y * f.width + x) * p.channels + channel)];
}

TEST(Film, MeansByClassAndTheirSum) {
    Film film(frame(4, 3));
    for (const float v : {1.0f, 2.0f, 6.0f}) EXPECT_TRUE(add(film, 2, 1, sample(v), v == 1.0f));
    Frame f = film.make_frame();
    film.resolve(film.region(), f);
    const char* names[] = {"D1", "D2", "D3", "C1", "C2"};
    for (int k = 0; k < 3; ++k) {
        float sum = 0;
        for (int c = 0; c < k_classes; ++c) {
            EXPECT_FLOAT_EQ(at(f, names[c], 2, 1, k), 3.0f * static_cast<float>((1 + c) * (1 + k)));
            sum += at(f, names[c], 2, 1, k);
        }
        EXPECT_EQ(at(f, "Combined", 2, 1, k), sum);
    }
    EXPECT_EQ(at(f, "Combined", 2, 1, 3), 1.0f);
    EXPECT_FLOAT_EQ(at(f, "Normal", 2, 1, 0), 3.0f);
    EXPECT_EQ(f.samples, 3);
    EXPECT_EQ(at(f, "Combined", 1, 1, 0), 0.0f);
    EXPECT_EQ(at(f, "Depth", 1, 1, 0), 1e10f);
}

TEST(Film, DepthIsThatOfTheFirstSample) {
    Film film(frame(1, 1));
    Sample a = sample(1), b = sample(1);
    a.depth = 3;
    b.depth = 9;
    add(film, 0, 0, a, true);
    add(film, 0, 0, b, false);
    Frame f = film.make_frame();
    film.resolve(film.region(), f);
    EXPECT_EQ(at(f, "Depth", 0, 0, 0), 3.0f);
}

TEST(Film, EveryNonFiniteFieldIsDropped) {
    const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                         -std::numeric_limits<float>::infinity()};
    Film film(frame(2, 2));
    EXPECT_TRUE(add(film, 1, 1, sample(2), true));
    for (const float v : bad) {
        for (int field = 0; field < 3 * k_classes + 5; ++field) {
            Sample s = sample(1);
            if (field < 3 * k_classes)
                s.radiance[field / 3][field % 3] = v;
            else if (field == 3 * k_classes)
                s.alpha = v;
            else if (field == 3 * k_classes + 1)
                s.depth = v;
            else
                s.normal[field - 3 * k_classes - 2] = v;
            EXPECT_FALSE(add(film, 1, 1, s, false)) << field;
        }
    }
    Frame f = film.make_frame();
    film.resolve(film.region(), f);
    EXPECT_FLOAT_EQ(at(f, "D1", 1, 1, 0), 2.0f);
    EXPECT_EQ(f.samples, 1);
}

TEST(Film, PlusAndMinusInfinityDoNotHideEachOther) {
    Film film(frame(1, 1));
    Sample s = sample(1);
    s.radiance[0][0] = std::numeric_limits<float>::infinity();
    s.radiance[1][0] = -std::numeric_limits<float>::infinity();
    EXPECT_FALSE(add(film, 0, 0, s, true));
}

TEST(Film, AlphaOnlyForATransparentFilm) {
    for (const bool transparent : {false, true}) {
        scene::Settings settings = frame(1, 1);
        settings.transparent_film = transparent;
        Film film(settings);
        add(film, 0, 0, sample(1, 1.0f), true);
        add(film, 0, 0, sample(1, 0.0f), false);
        add(film, 0, 0, sample(1, 0.0f), false);
        add(film, 0, 0, sample(1, 0.0f), false);
        Frame f = film.make_frame();
        film.resolve(film.region(), f);
        EXPECT_FLOAT_EQ(at(f, "Combined", 0, 0, 3), transparent ? 0.25f : 1.0f);
    }
}

TEST(Film, ExposureScalesLightAlone) {
    scene::Settings settings = frame(1, 1);
    settings.exposure = 4;
    Film film(settings);
    add(film, 0, 0, sample(1), true);
    Frame f = film.make_frame();
    film.resolve(film.region(), f);
    EXPECT_FLOAT_EQ(at(f, "D1", 0, 0, 0), 4.0f);
    EXPECT_FLOAT_EQ(at(f, "Combined", 0, 0, 0), 60.0f);
    EXPECT_FLOAT_EQ(at(f, "Normal", 0, 0, 0), 1.0f);
    EXPECT_FLOAT_EQ(at(f, "Depth", 0, 0, 0), 7.0f);
}

TEST(Film, CropHoldsOnlyItsPixels) {
    scene::Settings settings = frame(10, 8);
    settings.crop = {3, 2, 4, 5};
    Film film(settings);
    const Region r = film.region();
    EXPECT_EQ(r.x, 3);
    EXPECT_EQ(r.y, 2);
    EXPECT_EQ(r.width, 4);
    EXPECT_EQ(r.height, 5);
    for (int y = 2; y < 7; ++y) {
        for (int x = 3; x < 7; ++x) add(film, x, y, sample(static_cast<float>(100 * y + x)), true);
    }
    Frame f = film.make_frame();
    film.resolve(r, f);
    EXPECT_EQ(f.width, 4);
    EXPECT_EQ(f.height, 5);
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 4; ++x) EXPECT_EQ(at(f, "D1", x, y, 0), static_cast<float>(100 * (y + 2) + x + 3));
    }
}

TEST(Film, CropIsClippedToTheFrame) {
    for (const auto& crop :
         {std::array<int, 4>{8, 6, 100, 100}, std::array<int, 4>{-5, -5, 3, 3}, std::array<int, 4>{100, 100, 1, 1}}) {
        scene::Settings settings = frame(10, 8);
        settings.crop = crop;
        const Region r = crop_region(settings);
        EXPECT_GE(r.x, 0);
        EXPECT_GE(r.y, 0);
        EXPECT_GE(r.width, 1);
        EXPECT_LE(r.x + r.width, 10);
        EXPECT_LE(r.y + r.height, 8);
    }
    EXPECT_EQ(crop_region(frame(10, 8)).width, 10);
}

TEST(Film, ResolveWritesOnlyItsPart) {
    Film film(frame(4, 4));
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) add(film, x, y, sample(1), true);
    }
    Frame f = film.make_frame();
    film.resolve({1, 2, 2, 1}, f);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) EXPECT_EQ(at(f, "D1", x, y, 0), y == 2 && (x == 1 || x == 2) ? 1.0f : 0.0f);
    }
}

TEST(Film, PassesHaveTheirSizes) {
    const Film film(frame(5, 3));
    const Frame f = film.make_frame();
    ASSERT_EQ(f.passes.size(), 11u);
    for (const Pass& p : f.passes) EXPECT_EQ(p.data.size(), static_cast<std::size_t>(15 * p.channels)) << p.name;
    EXPECT_EQ(f.find("nothing"), nullptr);
    EXPECT_GT(film.memory_bytes(), 15 * 60);
}

}  // namespace
}  // namespace cardioid::film
