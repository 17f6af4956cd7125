// SPDX-License-Identifier: GPL-3.0-or-later
// What clusters cost while rendering: nanoseconds to add one camera path's three layers, by samples a pixel in each
// pass, and bytes a pixel. Light as scenes have it: a penumbra and two lamps in layer 1, exponential inter-reflection
// in layers 2 and 3.
#include "film/film.h"
#include "film/film_file.h"

#include <benchmark/benchmark.h>

#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <random>
#include <utility>
#include <vector>

namespace {
using namespace cardioid;

constexpr int k_side = 256, k_samples = 16;

film::Sample random_sample(std::mt19937& random) {
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    const float lamp = uniform(random) < 0.3f ? 0.0f : uniform(random) < 0.5f ? 4.0f : 1.0f;
    const float light[film::k_layers] = {lamp * (0.8f + 0.4f * uniform(random)),
                                         uniform(random) < 0.6f ? -0.5f * std::log(uniform(random) + 1e-6f) : 0.0f,
                                         uniform(random) < 0.5f ? -0.2f * std::log(uniform(random) + 1e-6f) : 0.0f};
    film::Sample s;
    for (int l = 0; l < film::k_layers; ++l) {
        for (int k = 0; k < 3; ++k) {
            s.layers[l].incident[k] = light[l];
            s.layers[l].radiance[k] = 0.3f * light[l];
            s.radiance[l][k] = 0.3f * light[l];
        }
    }
    s.depth = 5;
    return s;
}

/// Results of a batch of paths, an array for each value, as the tracer leaves them.
struct Batch {
    static constexpr int k_paths = 1024, k_padded = k_paths + 64, k_values = sizeof(film::Sample) / sizeof(float);
    std::vector<float> values = std::vector<float>(k_values * k_padded);
    void put(const film::Sample& s, int path) {
        const auto v = std::bit_cast<std::array<float, k_values>>(s);
        for (int i = 0; i < k_values; ++i)
            values[static_cast<std::size_t>(i * k_padded + path)] = v[static_cast<std::size_t>(i)];
    }
    film::Sample get(int path) const {
        const float* from = values.data() + path;
        film::Sample s;
        const auto next = [&] { return *std::exchange(from, from + k_padded); };
        const auto row = [&](float(&rgb)[3]) {
            for (float& c : rgb) c = next();
        };
        for (auto& c : s.radiance) row(c);
        row(s.unfiltered);
        for (auto& l : s.layers) row(l.radiance), row(l.incident);
        row(s.detail);
        row(s.mirrored_detail);
        row(s.feature_normal);
        s.feature_depth = next();
        s.feature_depth_squared = next();
        s.alpha = next();
        s.depth = next();
        row(s.normal);
        return s;
    }
};

/// In the order in which they are rendered: blocks of 8 × 8, in each a pixel's samples of the pass after each other.
void add_pass(film::Film& film, const std::vector<Batch>& batches, int first, int count) {
    film::FilmWriter writer;
    writer.open(film);
    int at = first * 7919;
    for (int by = 0; by < k_side; by += film::k_block) {
        for (int bx = 0; bx < k_side; bx += film::k_block) {
            for (int i = 0; i < film::k_block * film::k_block; ++i) {
                for (int s = first; s < first + count; ++s, ++at) {
                    const Batch& batch = batches[static_cast<std::size_t>(at / Batch::k_paths) % batches.size()];
                    writer.add(bx + i % film::k_block, by + i / film::k_block, batch.get(at % Batch::k_paths), s == 0);
                }
            }
        }
    }
    writer.close();
}

std::vector<Batch> some_samples() {
    std::mt19937 random(1);
    std::vector<Batch> batches(5);
    for (Batch& b : batches) {
        for (int i = 0; i < Batch::k_paths; ++i) b.put(random_sample(random), i);
    }
    return batches;
}

scene::Settings settings(bool clusters) {
    scene::Settings s;
    s.width = s.height = k_side;
    s.record_clusters = clusters;
    return s;
}

void run(benchmark::State& state, bool clusters) {
    const std::vector<Batch> samples = some_samples();
    const int count = static_cast<int>(state.range(0)), total = static_cast<int>(state.range(1));
    double bytes = 0, lists = 0;
    for (auto _ : state) {
        film::Film film(settings(clusters));
        for (int s = 0; s < total; s += count) add_pass(film, samples, s, count);
        bytes = static_cast<double>(film.memory_bytes()) / (k_side * k_side);
        lists = static_cast<double>(film.clusters().cluster_count()) / (k_side * k_side);
    }
    state.SetItemsProcessed(state.iterations() * k_side * k_side * total);
    state.counters["ns_per_sample"] =
        benchmark::Counter(static_cast<double>(state.iterations()) * k_side * k_side * total * 1e-9,
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["bytes_per_pixel"] = bytes;
    state.counters["clusters_per_pixel"] = lists;
}

void with_clusters(benchmark::State& state) { run(state, true); }
void without_clusters(benchmark::State& state) { run(state, false); }
BENCHMARK(with_clusters)->Args({1, 16})->Args({2, 16})->Args({4, 16})->Args({8, 16})->Args({8, 256});
BENCHMARK(without_clusters)->Args({1, 16})->Args({2, 16})->Args({8, 16})->Args({8, 256});

void read_all(benchmark::State& state) {
    const std::vector<Batch> samples = some_samples();
    film::Film film(settings(true));
    add_pass(film, samples, 0, k_samples);
    for (auto _ : state) {
        float sum = 0;
        for (int y = 0; y < k_side; ++y) {
            for (int x = 0; x < k_side; ++x) {
                for (int l = 0; l < film::k_layers; ++l) {
                    for (const film::Cluster& c : film.clusters().view(x, y, l)) sum += c.radiance[0];
                }
            }
        }
        benchmark::DoNotOptimize(sum);
    }
    state.counters["ns_per_pixel"] =
        benchmark::Counter(static_cast<double>(state.iterations()) * k_side * k_side * 1e-9,
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(read_all);

void save_and_load(benchmark::State& state) {
    const std::vector<Batch> samples = some_samples();
    film::Film film(settings(true));
    add_pass(film, samples, 0, k_samples);
    const auto path = std::filesystem::temp_directory_path() / "cluster_bench.cardioid";
    for (auto _ : state) {
        film::FilmFile::save(film, path);
        benchmark::DoNotOptimize(film::FilmFile::load(path));
    }
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(std::filesystem::file_size(path)));
    std::filesystem::remove(path);
}
BENCHMARK(save_and_load);

}  // namespace
