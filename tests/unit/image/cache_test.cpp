// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/lookups.h"
#include "image/test_files.h"

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <thread>

namespace cardioid::image {
namespace {

constexpr std::int64_t k_megabyte = 1 << 20;

/// Differs between images and texels; exact in 8 bits.
float value_of(int image, int x, int y, int c) {
    return static_cast<float>((image * 37 + x * 3 + y * 7 + c * 50) & 255) / 255;
}

std::vector<scene::ImageDesc> many_images(const test::Folder& folder, int count, int side, const std::string& extension,
                                          int tile) {
    std::vector<scene::ImageDesc> images;
    for (int i = 0; i < count; ++i) {
        const std::string path = folder.file(std::to_string(i) + extension);
        test::write_file(path, {side, side, 3, OIIO::TypeUInt8, tile},
                         [&](int x, int y, int c) { return value_of(i, x, y, c); });
        images.push_back(test::file_image(path));
    }
    return images;
}

/// Random texels of random images are right; returns the most memory that was seen.
std::int64_t wander(const ImageStore& store, int side, int lookups, unsigned seed, std::atomic<int>& wrong) {
    std::mt19937 generator(seed);
    std::int64_t most = 0;
    for (int i = 0; i < lookups; ++i) {
        const int image = static_cast<int>(generator() % static_cast<unsigned>(store.size()));
        float u[16], v[16];
        int x[16], y[16];
        for (int k = 0; k < 16; ++k) {
            x[k] = static_cast<int>(generator() % static_cast<unsigned>(side)),
            y[k] = static_cast<int>(generator() % static_cast<unsigned>(side));
            u[k] = (static_cast<float>(x[k]) + 0.5f) / static_cast<float>(side);
            v[k] = 1 - (static_cast<float>(y[k]) + 0.5f) / static_cast<float>(side);
        }
        Row rgba[4];
        store.lookup(image, Interpolation::linear, Extension::repeat, 16, u, v, rgba);
        for (int k = 0; k < 16; ++k)
            for (int c = 0; c < 3; ++c)
                if (std::abs(rgba[c][k] - value_of(image, x[k], y[k], c)) > 1e-2f) ++wrong;
        most = std::max(most, store.memory_bytes());
    }
    return most;
}

TEST(Cache, HundredImagesStayWithinTheBound) {
    const test::Folder folder;
    // 100 images of a quarter megabyte.
    const int side = 256;
    const ImageStore store(many_images(folder, 100, side, ".bmp", 0), "", 16);
    std::atomic<int> wrong{0};
    const std::int64_t most = wander(store, side, 2000, 1, wrong);
    EXPECT_EQ(wrong, 0);
    EXPECT_LE(most, 16 * k_megabyte);
    EXPECT_GT(most, 8 * k_megabyte) << "the cache is used";
    EXPECT_TRUE(store.warnings().empty());
}

TEST(Cache, TiledFilesAreReadInParts) {
    const test::Folder folder;
    const int side = 256;
    const ImageStore store(many_images(folder, 80, side, ".tif", 64), "", 16);
    EXPECT_LT(store.memory_bytes(), k_megabyte) << "nothing is read before it is needed";
    std::atomic<int> wrong{0};
    EXPECT_LE(wander(store, side, 2000, 2, wrong), 16 * k_megabyte);
    EXPECT_EQ(wrong, 0);
    EXPECT_TRUE(store.warnings().empty());
}

TEST(Cache, AFileLargerThanTheCache) {
    const test::Folder folder;
    const int side = 2100;
    const ImageStore store(many_images(folder, 1, side, ".tif", 0), "", 16);
    std::atomic<int> wrong{0};
    EXPECT_LE(wander(store, side, 1000, 3, wrong), 16 * k_megabyte);
    EXPECT_EQ(wrong, 0);
    const Float3 mean = store.mean_color(0);
    EXPECT_NEAR(mean.x, 0.5f, 0.01f);
}

TEST(Cache, WhatFitsIsReadOnce) {
    const test::Folder folder;
    const std::vector<scene::ImageDesc> images = many_images(folder, 10, 300, ".png", 0);
    const ImageStore store(images, "", 64);
    for (const scene::ImageDesc& image : images) std::filesystem::remove(image.path);
    std::atomic<int> wrong{0};
    wander(store, 300, 500, 4, wrong);
    EXPECT_EQ(wrong, 0);
    EXPECT_TRUE(store.warnings().empty());
}

TEST(Cache, ThreadsThatEvictEachOthersTiles) {
    const test::Folder folder;
    const int side = 256;
    for (const auto& [extension, tile] : {std::pair{".bmp", 0}, {".tif", 64}}) {
        const ImageStore store(many_images(folder, 80, side, extension, tile), "", 16);
        std::atomic<int> wrong{0};
        std::vector<std::jthread> threads;
        for (unsigned t = 0; t < 6; ++t) threads.emplace_back([&, t] { wander(store, side, 1000, 10 + t, wrong); });
        threads.clear();
        EXPECT_EQ(wrong, 0) << extension;
        EXPECT_LE(store.memory_bytes(), 18 * k_megabyte);
    }
}

TEST(Cache, ThreadsThatShareWhatFits) {
    const test::Folder folder;
    const ImageStore store(many_images(folder, 5, 200, ".png", 0), "", 64);
    std::atomic<int> wrong{0};
    {
        std::vector<std::jthread> threads;
        for (unsigned t = 0; t < 8; ++t)
            threads.emplace_back([&, t] {
                wander(store, 200, 2000, 20 + t, wrong);
                for (int i = 0; i < store.size(); ++i)
                    if (std::abs(store.mean_color(i).x - 0.5f) > 0.05f) ++wrong;
            });
    }
    EXPECT_EQ(wrong, 0);
}

TEST(Cache, AFileThatVanishesWhileItIsUsed) {
    const test::Folder folder;
    const std::vector<scene::ImageDesc> images = many_images(folder, 120, 256, ".bmp", 0);
    const ImageStore store(images, "", 16);
    for (const scene::ImageDesc& image : images) std::filesystem::remove(image.path);
    int magenta = 0;
    for (int i = 0; i < store.size(); ++i) magenta += test::look(store, i, 0.5f, 0.5f) == test::Color{1, 0, 1, 1};
    EXPECT_GT(magenta, 60);
    EXPECT_LT(magenta, 120);
    EXPECT_EQ(store.warnings().size(), static_cast<std::size_t>(magenta));
}

}  // namespace
}  // namespace cardioid::image
