// SPDX-License-Identifier: GPL-3.0-or-later
// Nanoseconds of this thread's CPU time per looked-up point, against OpenImageIO's own ways to do it. Not a test:
// run bench_image_lookup by hand; the figures are in image/README.md.
#include "image/image_store.h"
#include "image/test_files.h"

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/texture.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <random>

namespace cardioid::image {
namespace {

constexpr int k_points = 64 * 2000;

double cpu_ns() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e9 + static_cast<double>(time.tv_nsec);
}

struct Points {
    std::vector<float> u, v;
};

/// A walk of small steps, as neighbouring camera rays make, or points anywhere, as bounces do.
Points make_points(bool coherent) {
    std::mt19937 generator(1);
    std::uniform_real_distribution<float> any(0, 1);
    Points points;
    float u = 0.3f, v = 0.4f;
    for (int i = 0; i < k_points; ++i) {
        u = coherent ? u + (any(generator) - 0.5f) * 0.004f : any(generator);
        v = coherent ? v + (any(generator) - 0.5f) * 0.004f : any(generator);
        points.u.push_back(u - std::floor(u));
        points.v.push_back(v - std::floor(v));
    }
    return points;
}

/// Best of several rounds over all points, 64 at a time.
template <class Lookup>
double measure(const Points& points, Lookup lookup) {
    double best = 1e30;
    for (int round = 0; round < 9; ++round) {
        const double start = cpu_ns();
        for (int i = 0; i < k_points; i += 64)
            lookup(&points.u[static_cast<std::size_t>(i)], &points.v[static_cast<std::size_t>(i)]);
        best = std::min(best, (cpu_ns() - start) / k_points);
    }
    return best;
}

double ours(const std::string& path, const std::string& space, Interpolation interpolation, const Points& points) {
    const ImageStore store({test::file_image(path, space)}, "", 1024);
    Row rgba[4];
    return measure(points, [&](const float* u, const float* v) {
        store.lookup(0, interpolation, Extension::repeat, 64, u, v, rgba);
    });
}

double texture_system(const std::string& path, const Points& points) {
    OIIO::TextureSystem* system = OIIO::TextureSystem::create(false);
    system->attribute("autotile", 64);
    system->attribute("max_memory_MB", 1024.0f);
    OIIO::TextureSystem::Perthread* thread = system->get_perthread_info();
    OIIO::TextureSystem::TextureHandle* handle = system->get_texture_handle(OIIO::ustring(path), thread);
    OIIO::TextureOpt options;
    options.mipmode = OIIO::TextureOpt::MipModeNoMIP;
    options.interpmode = OIIO::TextureOpt::InterpBilinear;
    options.swrap = options.twrap = OIIO::TextureOpt::WrapPeriodic;
    float color[4];
    const double time = measure(points, [&](const float* u, const float* v) {
        for (int i = 0; i < 64; ++i) system->texture(handle, thread, options, u[i], 1 - v[i], 0, 0, 0, 0, 3, color);
    });
    OIIO::TextureSystem::destroy(system);
    return time;
}

/// The tiles of ImageCache, eight of them remembered within a call, weights of our own; bytes, linear, without alpha.
double cache_tiles(const std::string& path, const Points& points) {
    OIIO::ImageCache* cache = OIIO::ImageCache::create(false);
    cache->attribute("autotile", 64);
    cache->attribute("max_memory_MB", 1024.0f);
    OIIO::ImageCache::Perthread* thread = cache->get_perthread_info();
    OIIO::ImageCache::ImageHandle* handle = cache->get_image_handle(OIIO::ustring(path), thread);
    OIIO::ImageSpec spec;
    cache->get_imagespec(handle, thread, spec);
    float color[3];
    const double time = measure(points, [&](const float* u, const float* v) {
        struct Held {
            int key = -1;
            OIIO::ImageCache::Tile* tile = nullptr;
            const std::uint8_t* data = nullptr;
        } held[8];
        const auto texel = [&](int x, int y) {
            x = (x % spec.width + spec.width) % spec.width, y = (y % spec.height + spec.height) % spec.height;
            const int key = (y / 64) * 4096 + x / 64;
            Held& slot = held[static_cast<unsigned>(key * 0x9e3779b9u) >> 29];
            if (slot.key != key) {
                if (slot.tile) cache->release_tile(slot.tile);
                OIIO::TypeDesc type;
                slot.tile = cache->get_tile(handle, thread, 0, 0, x, y, 0);
                slot.data = static_cast<const std::uint8_t*>(cache->tile_pixels(slot.tile, type));
                slot.key = key;
            }
            return slot.data + ((y & 63) * 64 + (x & 63)) * 3;
        };
        for (int i = 0; i < 64; ++i) {
            const float x = u[i] * static_cast<float>(spec.width) - 0.5f,
                        y = v[i] * static_cast<float>(spec.height) - 0.5f;
            const int ix = static_cast<int>(std::floor(x)), iy = static_cast<int>(std::floor(y));
            const float s = x - static_cast<float>(ix), t = y - static_cast<float>(iy);
            const std::uint8_t *a = texel(ix, iy), *b = texel(ix + 1, iy), *c = texel(ix, iy + 1),
                               *d = texel(ix + 1, iy + 1);
            for (int k = 0; k < 3; ++k)
                color[k] = ((1 - t) * ((1 - s) * float(a[k]) + s * float(b[k])) +
                            t * ((1 - s) * float(c[k]) + s * float(d[k]))) /
                           255;
        }
        for (Held& slot : held)
            if (slot.tile) cache->release_tile(slot.tile);
    });
    OIIO::ImageCache::destroy(cache);
    return time;
}

int run() {
    const test::Folder folder;
    const auto pattern = [](int x, int y, int c) { return static_cast<float>((x * 3 + y * 7 + c * 50) & 255) / 255; };
    const std::string png = folder.file("a.png"), alpha = folder.file("b.png"), exr = folder.file("c.exr"),
                      real = folder.file("d.tif");
    test::write_file(png, {2048, 2048, 3}, pattern);
    test::write_file(alpha, {2048, 2048, 4}, pattern);
    test::write_file(exr, {2048, 2048, 3, OIIO::TypeHalf}, pattern);
    test::write_file(real, {2048, 2048, 3, OIIO::TypeFloat}, pattern);
    for (const bool coherent : {true, false}) {
        const Points points = make_points(coherent);
        std::printf("%s points, ns each\n", coherent ? "neighbouring" : "scattered");
        const auto row = [](const char* what, double ns) { std::printf("  %-44s %7.1f\n", what, ns); };
        row("ours, 8-bit linear, data", ours(png, "Non-Color", Interpolation::linear, points));
        row("ours, 8-bit linear, sRGB", ours(png, "sRGB", Interpolation::linear, points));
        row("ours, 8-bit with alpha linear, sRGB", ours(alpha, "sRGB", Interpolation::linear, points));
        row("ours, half linear", ours(exr, "Linear", Interpolation::linear, points));
        row("ours, float linear", ours(real, "Linear", Interpolation::linear, points));
        row("ours, 8-bit closest, sRGB", ours(png, "sRGB", Interpolation::closest, points));
        row("ours, 8-bit cubic, sRGB", ours(png, "sRGB", Interpolation::cubic, points));
        row("TextureSystem::texture, 8-bit linear, data", texture_system(png, points));
        row("ImageCache::get_tile, 8-bit linear, data", cache_tiles(png, points));
    }
    return 0;
}

}  // namespace
}  // namespace cardioid::image

int main() { return cardioid::image::run(); }
