// SPDX-License-Identifier: GPL-3.0-or-later
// Interpolation and extension against a plain reference in double precision.
#include "image/lookups.h"
#include "image/srgb.h"
#include "image/test_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace cardioid::image {
namespace {

using test::Color;

/// A picture as doubles: four channels, rows from the bottom, alpha associated.
struct Reference {
    int width, height;
    std::vector<std::array<double, 4>> texels;

    static int wrap(Extension extension, long i, int size) {
        if (extension == Extension::extend) return static_cast<int>(std::clamp<long>(i, 0, size - 1));
        if (extension == Extension::clip) return i >= 0 && i < size ? static_cast<int>(i) : -1;
        const long period = extension == Extension::repeat ? size : 2L * size;
        const int in = static_cast<int>(((i % period) + period) % period);
        return in < size ? in : 2 * size - 1 - in;
    }
    static double spline(double distance) {
        const double d = std::abs(distance);
        if (d < 1) return 2.0 / 3 - d * d + d * d * d / 2;
        return d < 2 ? (2 - d) * (2 - d) * (2 - d) / 6 : 0;
    }
    static double kernel(Interpolation interpolation, double distance) {
        if (interpolation == Interpolation::linear) return std::max(0.0, 1 - std::abs(distance));
        return spline(distance);
    }
    std::array<double, 4> at(Interpolation interpolation, Extension extension, double u, double v) const {
        std::array<double, 4> sum{};
        const auto add = [&](long ix, long iy, double weight) {
            const int x = wrap(extension, ix, width), y = wrap(extension, iy, height);
            if (x < 0 || y < 0) return;
            for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * texels[static_cast<std::size_t>(y * width + x)][c];
        };
        const double px = u * width, py = v * height;
        if (interpolation == Interpolation::closest) {
            add(std::lround(std::floor(px)), std::lround(std::floor(py)), 1);
            return sum;
        }
        // Texel i has its centre at i + 0.5.
        const long x0 = std::lround(std::floor(px - 0.5)), y0 = std::lround(std::floor(py - 0.5));
        for (long y = y0 - 1; y <= y0 + 2; ++y)
            for (long x = x0 - 1; x <= x0 + 2; ++x)
                add(x, y, kernel(interpolation, px - 0.5 - double(x)) * kernel(interpolation, py - 0.5 - double(y)));
        return sum;
    }
};

constexpr Interpolation k_interpolations[] = {Interpolation::closest, Interpolation::linear, Interpolation::cubic};
constexpr Extension k_extensions[] = {Extension::repeat, Extension::extend, Extension::clip, Extension::mirror};

/// Coordinates from -2.5 to 3.5, off the borders of texels by 1e-3 so that rounding cannot choose another one.
std::vector<float> coordinates(int size, unsigned seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> anywhere(-2.5, 3.5);
    std::vector<float> out;
    while (out.size() < 64) {
        const double u = anywhere(generator), offset = std::abs(u * size - std::round(u * size));
        if (offset > 1e-3 && offset < 0.499) out.push_back(static_cast<float>(u));
    }
    return out;
}

void expect_like_reference(const ImageStore& store, int image, const Reference& reference, double tolerance,
                           bool grey = false) {
    for (const Interpolation interpolation : k_interpolations) {
        for (const Extension extension : k_extensions) {
            const std::vector<float> u = coordinates(reference.width, 1), v = coordinates(reference.height, 2);
            Row rgba[4];
            store.lookup(image, interpolation, extension, 64, u.data(), v.data(), rgba, AlphaUse::associated);
            for (std::size_t i = 0; i < 64; ++i) {
                const auto expected =
                    reference.at(interpolation, extension, static_cast<double>(u[i]), static_cast<double>(v[i]));
                for (std::size_t c = 0; c < 4; ++c)
                    ASSERT_NEAR(static_cast<double>(rgba[c][i]), c == 3 && grey ? 1.0 : expected[c], tolerance)
                        << "interpolation " << int(interpolation) << " extension " << int(extension) << " u " << u[i]
                        << " v " << v[i] << " channel " << c;
            }
        }
    }
}

float noise(int x, int y, int c) {
    const unsigned h = static_cast<unsigned>(x) * 73856093u ^ static_cast<unsigned>(y) * 19349663u ^
                       static_cast<unsigned>(c + 1) * 83492791u;
    return static_cast<float>((h * 2654435761u) >> 8) / static_cast<float>(1 << 24);
}

Reference reference_of_pixels(int width, int height, int channels, const std::vector<float>& pixels) {
    Reference r{width, height, {}};
    for (int i = 0; i < width * height; ++i) {
        const auto p = [&](int c) { return static_cast<double>(pixels[static_cast<std::size_t>(i * channels + c)]); };
        const double grey = p(0);
        r.texels.push_back({grey, channels >= 3 ? p(1) : grey, channels >= 3 ? p(2) : grey,
                            channels % 2 == 0 ? p(channels - 1) : 1.0});
    }
    return r;
}

TEST(Lookup, FloatPixelsOfManySizesAndChannels) {
    // Sizes around the tile of 64 and below the four texels of a cubic footprint.
    for (const auto& [width, height] :
         {std::pair{1, 1}, {2, 3}, {3, 2}, {5, 4}, {64, 64}, {65, 63}, {130, 70}, {200, 129}}) {
        for (int channels = 1; channels <= 4; ++channels) {
            std::vector<float> pixels;
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    for (int c = 0; c < channels; ++c) pixels.push_back(noise(x, y, c) * 10);
            const ImageStore store({test::pixel_image(width, height, channels, pixels)}, "", 64);
            SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height) + " of " + std::to_string(channels));
            expect_like_reference(store, 0, reference_of_pixels(width, height, channels, pixels), 2e-3, channels == 1);
        }
    }
}

class FileFormats : public testing::TestWithParam<std::tuple<std::string, OIIO::TypeDesc, int, int>> {};

TEST_P(FileFormats, ReadLikeTheirPattern) {
    const auto& [extension, type, channels, tile] = GetParam();
    const test::Folder folder;
    const int width = 150, height = 100;
    const std::string path = folder.file("image." + extension);
    // Alpha is 1: how it acts is the subject of other tests.
    const auto pattern = [&](int x, int y, int c) {
        return channels % 2 == 0 && c == channels - 1 ? 1.0f : noise(x, y, c);
    };
    test::write_file(path, {width, height, channels, type, tile}, pattern);
    std::vector<float> pixels;
    for (int y = height - 1; y >= 0; --y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) pixels.push_back(pattern(x, y, c));
    const double step = type == OIIO::TypeUInt8    ? 0.5 / 255
                        : type == OIIO::TypeUInt16 ? 1e-5
                        : type == OIIO::TypeHalf   ? 3e-4
                                                   : 0;
    const ImageStore store({test::file_image(path), test::packed_image(path)}, "", 64);
    ASSERT_EQ(store.warnings(), std::vector<std::string>{});
    ASSERT_EQ(store.width(0), width);
    ASSERT_EQ(store.height(1), height);
    const Reference reference = reference_of_pixels(width, height, channels, pixels);
    expect_like_reference(store, 0, reference, step + 1e-3, channels == 1);
    expect_like_reference(store, 1, reference, step + 1e-3, channels == 1);
}

INSTANTIATE_TEST_SUITE_P(
    All, FileFormats,
    testing::Values(std::tuple{"png", OIIO::TypeUInt8, 1, 0}, std::tuple{"png", OIIO::TypeUInt8, 2, 0},
                    std::tuple{"png", OIIO::TypeUInt8, 3, 0}, std::tuple{"png", OIIO::TypeUInt8, 4, 0},
                    std::tuple{"png", OIIO::TypeUInt16, 1, 0}, std::tuple{"png", OIIO::TypeUInt16, 3, 0},
                    std::tuple{"png", OIIO::TypeUInt16, 4, 0}, std::tuple{"tif", OIIO::TypeUInt8, 3, 0},
                    std::tuple{"tif", OIIO::TypeUInt8, 4, 32}, std::tuple{"tif", OIIO::TypeUInt16, 4, 16},
                    std::tuple{"tif", OIIO::TypeFloat, 3, 64}, std::tuple{"exr", OIIO::TypeHalf, 1, 0},
                    std::tuple{"exr", OIIO::TypeHalf, 4, 0}, std::tuple{"exr", OIIO::TypeHalf, 3, 48},
                    std::tuple{"exr", OIIO::TypeFloat, 4, 0}, std::tuple{"exr", OIIO::TypeFloat, 3, 100},
                    std::tuple{"tga", OIIO::TypeUInt8, 3, 0}, std::tuple{"bmp", OIIO::TypeUInt8, 3, 0}));

TEST(Lookup, SrgbIsInterpolatedEncoded) {
    const test::Folder folder;
    const std::string path = folder.file("two.png");
    test::write_file(path, {2, 1, 3}, [](int x, int, int) { return x == 0 ? 0.0f : 1.0f; });
    const ImageStore store({test::file_image(path, "sRGB"), test::file_image(path, "Non-Color")}, "", 64);
    EXPECT_NEAR(test::look(store, 0, 0.5f, 0.5f, Interpolation::linear)[0], linear_from_srgb(0.5f), 1e-6);
    EXPECT_NEAR(test::look(store, 1, 0.5f, 0.5f, Interpolation::linear)[0], 0.5f, 1e-6);
}

TEST(Lookup, FarAndMadCoordinatesAreHarmless) {
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<float> pixels(64 * 3 * 3, 0.5f);
    const ImageStore store({test::pixel_image(64, 3, 3, pixels), test::pixel_image(1, 1, 1, {0.5f})}, "", 64);
    const float values[] = {0, -0.0f, 1, -1, 1e9f, -1e9f, 3e38f, -3e38f, inf, -inf, nan, 1e-40f, 0.99999997f, -1e-9f};
    for (const Interpolation interpolation : k_interpolations)
        for (const Extension extension : k_extensions)
            for (const float u : values)
                for (const float v : values)
                    for (int image = 0; image < 2; ++image) {
                        const Color color = test::look(store, image, u, v, interpolation, extension);
                        const bool clip = extension == Extension::clip;
                        ASSERT_TRUE(color[0] > (clip ? -1e-6f : 0.4999f) && color[0] < 0.5001f)
                            << u << ' ' << v << ' ' << int(extension);
                    }
}

TEST(Lookup, LargeCoordinatesRepeatExactly) {
    std::vector<float> pixels;
    for (int i = 0; i < 16; ++i) pixels.push_back(static_cast<float>(i));
    const ImageStore store({test::pixel_image(16, 1, 1, pixels)}, "", 64);
    for (int i = 0; i < 16; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) / 16;
        EXPECT_EQ(test::look(store, 0, u + 1000, 0)[0], static_cast<float>(i));
        EXPECT_EQ(test::look(store, 0, u - 1000, 0)[0], static_cast<float>(i));
    }
}

TEST(Lookup, EveryCountOfPoints) {
    const ImageStore store({test::pixel_image(2, 1, 3, {1, 2, 3, 4, 5, 6})}, "", 64);
    for (int n = 0; n <= 64; ++n) {
        float u[64], v[64] = {};
        for (int i = 0; i < 64; ++i) u[i] = i % 2 == 0 ? 0.25f : 0.75f;
        Row rgba[4];
        for (Row& row : rgba) std::fill(row, row + 64, -1.0f);
        store.lookup(0, Interpolation::closest, Extension::extend, n, u, v, rgba);
        for (int i = 0; i < 64; ++i) EXPECT_EQ(rgba[1][i], i >= n ? -1.0f : i % 2 == 0 ? 2.0f : 5.0f);
    }
}

}  // namespace
}  // namespace cardioid::image
