// SPDX-License-Identifier: GPL-3.0-or-later
// Textures that are more than the cache: how much memory and time lookups take. Not a test: run
//   bench_image_memory [images] [side] [cache in MB]
// by hand (100 4096 1024 by default; the spill file takes images × side² × 4 bytes of disk); figures are in image/README.md.
#include "image/image_store.h"
#include "image/test_files.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>

namespace cardioid::image {
namespace {

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double peak_megabytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// One picture under many names: the store does not know that they are alike.
std::vector<scene::ImageDesc> many_names(const test::Folder& folder, int images, int side) {
    const std::string first = folder.file("0.png");
    // By a process of its own, whose memory does not count.
    if (const pid_t child = ::fork(); child == 0) {
        test::write_file(first, {side, side, 3},
                         [](int x, int y, int c) { return static_cast<float>((x * 3 + y * 7 + c * 50) & 255) / 255; });
        ::_exit(0);
    } else {
        ::waitpid(child, nullptr, 0);
    }
    std::vector<scene::ImageDesc> list;
    for (int i = 0; i < images; ++i) {
        const std::string path = folder.file(std::to_string(i) + ".png");
        if (i > 0) std::filesystem::create_hard_link(first, path);
        list.push_back(test::file_image(path, "sRGB"));
    }
    return list;
}

enum class Walk { near, part, anywhere };

/// 64 points a call in one image after the other: within a thousandth of the picture, within a tile or two of a fixed
/// twentieth of it, or anywhere.
void measure(const ImageStore& store, const char* name, Walk walk, int calls) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<float> any(0, 1);
    const auto images = static_cast<unsigned>(store.size());
    Row rgba[4];
    double sum = 0;
    const double start = seconds();
    for (int call = 0; call < calls; ++call) {
        const int image = static_cast<int>(generator() % images);
        const float place[2] = {any(generator), any(generator)};
        float u[k_chunk], v[k_chunk];
        for (int i = 0; i < k_chunk; ++i) {
            const float a = any(generator), b = any(generator);
            u[i] = walk == Walk::anywhere ? a : walk == Walk::near ? place[0] + a * 0.001f : a * 0.22f;
            v[i] = walk == Walk::anywhere ? b : walk == Walk::near ? place[1] + b * 0.001f : b * 0.22f;
        }
        store.lookup(image, Interpolation::linear, Extension::repeat, k_chunk, u, v, rgba);
        sum += static_cast<double>(rgba[0][0]);
    }
    const double points = static_cast<double>(calls) * k_chunk;
    std::printf("%-28s %10.1f ns a point, texels held %6.0f MB, peak resident %6.0f MB (%.0f)\n", name,
                (seconds() - start) * 1e9 / points, static_cast<double>(store.memory_bytes()) / (1 << 20),
                peak_megabytes(), sum);
    std::fflush(stdout);
}

int run(int images, int side, int cache_mb) {
    const test::Folder folder;
    const auto list = many_names(folder, images, side);
    std::printf("%d images of %d x %d, cache %d MB, before the store %.0f MB\n", images, side, side, cache_mb,
                peak_megabytes());
    double start = seconds();
    const ImageStore store(list, "", cache_mb);
    std::printf("opened in %.1f s, peak resident %.0f MB\n", seconds() - start, peak_megabytes());
    start = seconds();
    const float middle = 0.5f;
    Row rgba[4];
    for (int i = 0; i < images; ++i)
        store.lookup(i, Interpolation::closest, Extension::repeat, 1, &middle, &middle, rgba);
    std::printf("every image touched once in %.1f s, peak resident %.0f MB\n", seconds() - start, peak_megabytes());
    measure(store, "a small place, first", Walk::near, 20000);
    measure(store, "a twentieth of each, first", Walk::part, 20000);
    measure(store, "a twentieth of each, again", Walk::part, 20000);
    measure(store, "anywhere", Walk::anywhere, 2000);
    for (const std::string& warning : store.warnings()) std::printf("%s\n", warning.c_str());
    return 0;
}

}  // namespace
}  // namespace cardioid::image

int main(int argc, char** argv) {
    const auto number = [&](int k, int otherwise) { return argc > k ? std::atoi(argv[k]) : otherwise; };
    return cardioid::image::run(number(1, 100), number(2, 4096), number(3, 1024));
}
