// SPDX-License-Identifier: GPL-3.0-or-later
// Films without a renderer: every sample of every pixel is given by a function.
#pragma once

#include "film/film.h"
#include "filter/executor.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace cardioid::test {

struct FilmSize {
    int width = 0, height = 0, samples = 0;
};

/// What a sample sees of a white wall at depth 4 that faces the camera, lit by nothing.
inline film::Sample wall(float albedo = 1, float depth = 4) {
    film::Sample s;
    for (float& c : s.detail) c = albedo;
    s.depth = depth;
    s.normal[2] = 1;
    s.feature_normal[2] = albedo;
    s.feature_depth = albedo * depth;
    s.feature_depth_squared = albedo * depth * depth;
    return s;
}

/// Grey light that arrives at the wall in a layer; the wall sends its albedo of it on.
inline void light(film::Sample& s, int layer, float incident) {
    static constexpr int k_class_of_layer[film::k_layers] = {1, 2, 2};
    for (int k = 0; k < 3; ++k) {
        s.layers[layer].incident[k] += incident;
        s.layers[layer].radiance[k] += incident * s.detail[k];
        s.radiance[k_class_of_layer[layer]][k] += incident * s.detail[k];
    }
}

/// A number in [0, 1) for each sample and purpose.
inline float noise(int x, int y, int sample, int purpose = 0) {
    std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15u +
                      static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4Fu +
                      static_cast<std::uint64_t>(sample) * 0x165667B19E3779F9u +
                      static_cast<std::uint64_t>(purpose) * 0x27D4EB2F165667C5u + 0x85EBCA77C2B2AE63u;
    for (int i = 0; i < 2; ++i) h = (h ^ (h >> 32)) * 0xD6E8FEB86659FD93u;
    return static_cast<float>((h ^ (h >> 32)) >> 40) * 0x1p-24f;
}

inline scene::Settings film_settings(int width, int height) {
    scene::Settings s;
    s.width = width;
    s.height = height;
    s.record_clusters = true;
    return s;
}

using SampleAt = std::function<film::Sample(int x, int y, int sample)>;
using SamplesAt = std::function<int(int x, int y)>;

/// A film with samples_at(x, y) samples in each pixel.
inline film::Film make_film(int width, int height, const SamplesAt& samples_at, const SampleAt& sample_at) {
    film::Film film(film_settings(width, height));
    film::FilmWriter writer;
    writer.open(film);
    for (int by = 0; by < height; by += film::k_block) {
        for (int bx = 0; bx < width; bx += film::k_block) {
            for (int y = by; y < std::min(by + film::k_block, height); ++y) {
                for (int x = bx; x < std::min(bx + film::k_block, width); ++x) {
                    for (int i = 0; i < samples_at(x, y); ++i) writer.add(x, y, sample_at(x, y, i), i == 0);
                }
            }
        }
    }
    writer.close();
    return film;
}

inline film::Film make_film(const FilmSize& size, const SampleAt& sample_at) {
    return make_film(
        size.width, size.height, [&](int, int) { return size.samples; }, sample_at);
}

/// Runs the tasks from the last to the first.
inline bool run_backwards(int n, const std::function<void(int)>& body) {
    for (int i = n - 1; i >= 0; --i) body(i);
    return true;
}

/// Odd tasks before even ones.
inline bool run_interleaved(int n, const std::function<void(int)>& body) {
    for (int i = 1; i < n; i += 2) body(i);
    for (int i = 0; i < n; i += 2) body(i);
    return true;
}

/// Stops before the last task.
inline bool run_but_one(int n, const std::function<void(int)>& body) {
    for (int i = 0; i + 1 < n; ++i) body(i);
    return false;
}

}  // namespace cardioid::test
