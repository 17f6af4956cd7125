// SPDX-License-Identifier: GPL-3.0-or-later
// Films with random samples of every kind.
#pragma once

#include "film/cluster_reference.h"
#include "film/film.h"

namespace cardioid::film::test {

inline scene::Settings settings_of(int width, int height) {
    scene::Settings s;
    s.width = width;
    s.height = height;
    return s;
}

/// A path with light in some layers, in D1 and, some of them, of a negative lamp.
inline Sample random_sample(std::mt19937& random) {
    std::uniform_real_distribution<float> u(0.0f, 1.0f);
    Sample s;
    for (int k = 0; k < 3; ++k) s.unfiltered[k] = s.radiance[0][k] = random() % 3 == 0 ? u(random) : 0.0f;
    for (int l = 0; l < k_layers; ++l) {
        const float light = random() % 3 == 0    ? 0.0f
                            : random() % 20 == 0 ? -0.5f
                                                 : -std::log(u(random) + 1e-3f) + 0.01f;
        s.layers[l] = sample_of(light, u(random));
        for (int k = 0; k < 3; ++k) s.radiance[1 + (l + 1) / 2][k] += s.layers[l].radiance[k];
    }
    for (int k = 0; k < 3; ++k) s.detail[k] = u(random);
    s.feature_normal[2] = luminance(s.detail);
    s.feature_depth = 3 * luminance(s.detail);
    s.feature_depth_squared = 9.5f * luminance(s.detail);
    s.alpha = random() % 10 == 0 ? 0.0f : 1.0f;
    s.depth = 3 + u(random);
    s.normal[2] = 1;
    return s;
}

/// `samples` a pixel, by passes of `in_pass`; each pixel's samples depend on it and their numbers alone.
inline void fill(Film& film, int samples, int in_pass) {
    const Region r = film.region();
    FilmWriter writer;
    for (int first = 0; first < samples; first += in_pass) {
        writer.open(film);
        for (int y = r.y; y < r.y + r.height; ++y) {
            for (int x = r.x; x < r.x + r.width; ++x) {
                for (int s = first; s < std::min(first + in_pass, samples); ++s) {
                    std::mt19937 random(static_cast<unsigned>((y * 1009 + x) * 1013 + s));
                    ASSERT_TRUE(writer.add(x, y, random_sample(random), s == 0));
                }
            }
        }
        writer.close();
    }
}

inline void expect_same_lists(const Film& a, const Film& b) {
    ASSERT_EQ(a.region().width, b.region().width);
    ASSERT_EQ(a.region().height, b.region().height);
    for (int y = 0; y < a.region().height; ++y) {
        for (int x = 0; x < a.region().width; ++x) {
            ASSERT_EQ(a.samples(x, y), b.samples(x, y));
            for (int l = 0; l < k_layers; ++l) expect_same(a.clusters().view(x, y, l), b.clusters().view(x, y, l));
        }
    }
}

inline Frame resolved(const Film& film) {
    Frame frame = film.make_frame();
    film.resolve(film.region(), frame);
    return frame;
}

}  // namespace cardioid::film::test
