// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever is wrong with an image: magenta or repaired, named once, never a crash.
#include "image/lookups.h"
#include "image/test_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cardioid::image {
namespace {

using test::Color;
constexpr Color k_magenta{1, 0, 1, 1};

void expect_magenta(const ImageStore& store, int image, const std::string& warning) {
    for (const Interpolation interpolation : {Interpolation::closest, Interpolation::linear, Interpolation::cubic}) {
        const Color color = test::look(store, image, 0.3f, 0.7f, interpolation);
        for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(color[c], k_magenta[c], 1e-6) << "channel " << c;
    }
    ASSERT_EQ(store.warnings().size(), 1u);
    EXPECT_NE(store.warnings()[0].find(warning), std::string::npos) << store.warnings()[0];
}

TEST(BadImages, MissingIsMagentaAndNamed) {
    const ImageStore store({test::file_image("/no/such/wood.png", "sRGB")}, "", 64);
    expect_magenta(store, 0, "image \"wood.png\" is missing: '/no/such/wood.png'");
    EXPECT_EQ(store.width(0), 1);
    EXPECT_FALSE(store.has_alpha(0));
    EXPECT_EQ(store.mean_color(0), (Float3{1, 0, 1}));
}

TEST(BadImages, IndicesThatAreNoImages) {
    const ImageStore store({}, "", 64);
    for (const int image : {-1, 0, 7, -2147483647}) {
        EXPECT_EQ(test::look(store, image, 0.5f, 0.5f), k_magenta);
        EXPECT_EQ(store.mean_color(image), (Float3{1, 0, 1}));
        EXPECT_EQ(store.width(image), 1);
    }
    EXPECT_EQ(store.size(), 0);
    EXPECT_TRUE(store.warnings().empty());
}

TEST(BadImages, FoldersEmptyNamesAndEmptyData) {
    const test::Folder folder;
    expect_magenta(ImageStore({test::file_image(folder.path().string())}, "", 64), 0, "is not a file");
    expect_magenta(ImageStore({test::file_image("")}, "", 64), 0, "has no file");
    scene::ImageDesc packed;
    packed.name = "packed";
    packed.source = scene::ImageSource::packed;
    expect_magenta(ImageStore({packed}, "", 64), 0, "packed but empty");
    for (const auto& [width, height, channels] : {std::tuple{0, 0, 0}, {0, 4, 3}, {2, 2, 3}, {-1, -4, 1}, {1, 1, 5}})
        expect_magenta(ImageStore({test::pixel_image(width, height, channels, {1, 2, 3, 4})}, "", 64), 0,
                       "has no pixels");
}

TEST(BadImages, TextThatIsNoImage) {
    const test::Folder folder;
    for (const std::string name : {"a.png", "a.jpg", "a.exr", "a.hdr", "a.tif", "a.tga", "a.unknown", "a"}) {
        const std::string path = folder.file(name);
        test::write_bytes(path, {'h', 'e', 'l', 'l', 'o', ' ', 'w', 'o', 'r', 'l', 'd'});
        expect_magenta(ImageStore({test::file_image(path)}, "", 64), 0, "cannot be read");
        expect_magenta(ImageStore({test::packed_image(path)}, "", 64), 0, "cannot be read");
        test::write_bytes(path, {});
        expect_magenta(ImageStore({test::file_image(path)}, "", 64), 0, "cannot be read");
    }
}

/// Every lookup is finite, whatever the file is.
void expect_no_crash(const scene::ImageDesc& image) {
    const ImageStore store({image}, "", 64);
    for (float v = 0.01f; v < 1; v += 0.07f) {
        const Color color = test::look(store, 0, 0.5f, v, Interpolation::linear);
        for (const float value : color) ASSERT_TRUE(std::isfinite(value));
    }
}

TEST(BadImages, TruncatedAndDamagedFiles) {
    const test::Folder folder;
    for (const std::string name : {"a.png", "a.jpg", "a.exr", "a.hdr", "a.tif", "a.bmp", "a.tga"}) {
        const std::string path = folder.file(name);
        const bool real = name == "a.exr" || name == "a.hdr";
        test::write_file(path, {70, 70, 3, real ? OIIO::TypeFloat : OIIO::TypeUInt8},
                         [](int x, int y, int c) { return static_cast<float>((x * 7 + y * 13 + c * 31) % 64) / 64; });
        const std::vector<std::uint8_t> whole = test::bytes_of_file(path);
        std::vector<std::size_t> cuts = {0, 1, 3, 7, 15, 40, 100};
        for (std::size_t i = 1; i < 8; ++i) cuts.push_back(whole.size() * i / 8);
        for (const std::size_t size : cuts) {
            SCOPED_TRACE(name + " cut to " + std::to_string(size));
            test::write_bytes(
                path, {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(std::min(size, whole.size()))});
            expect_no_crash(test::file_image(path));
            expect_no_crash(test::packed_image(path));
        }
        for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 40) {
            SCOPED_TRACE(name + " damaged at " + std::to_string(at));
            std::vector<std::uint8_t> damaged = whole;
            damaged[at] ^= 0x5a;
            test::write_bytes(path, damaged);
            expect_no_crash(test::file_image(path));
            expect_no_crash(test::packed_image(path));
        }
    }
}

TEST(BadImages, DamageInTheMiddleIsNamed) {
    const test::Folder folder;
    const std::string path = folder.file("half.png");
    test::write_file(path, {64, 256, 3}, [](int x, int y, int c) {
        return static_cast<float>((x * 7919 + y * 104729 + c * 31) % 251) / 251;
    });
    std::vector<std::uint8_t> bytes = test::bytes_of_file(path);
    bytes.resize(bytes.size() / 2);
    test::write_bytes(path, bytes);
    const ImageStore store({test::file_image(path)}, "", 64);
    const Color bottom = test::texel(store, 0, 3, 3);
    for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(bottom[c], k_magenta[c], 1e-6);
    ASSERT_EQ(store.warnings().size(), 1u);
    EXPECT_NE(store.warnings()[0].find("image \"half.png\" is damaged"), std::string::npos) << store.warnings()[0];
}

TEST(BadImages, NanAndInfinityBecomeBlackAndAreCounted) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const test::Folder folder;
    const std::string path = folder.file("hdr.exr");
    test::write_file(path, {4, 1, 3, OIIO::TypeFloat}, [&](int x, int, int c) {
        return x == 1 && c == 2 ? nan : x == 2 && c == 0 ? inf : 7.0f;
    });
    const std::string half = folder.file("half.exr");
    test::write_file(half, {4, 1, 3, OIIO::TypeHalf}, [&](int x, int, int c) {
        return x == 1 && c == 2 ? nan : x == 2 && c == 0 ? -inf : 7.0f;
    });
    const std::vector<float> pixels = {7, 7, 7, 7, 7, nan, -inf, 7, 7, 7, 7, 7};
    for (const scene::ImageDesc& image :
         {test::file_image(path, "Linear"), test::file_image(half, "Linear"), test::packed_image(path, "Linear"),
          test::pixel_image(4, 1, 3, pixels, "Linear")}) {
        const ImageStore store({image}, "", 64);
        EXPECT_EQ(test::texel(store, 0, 0, 0), (Color{7, 7, 7, 1}));
        for (const int x : {1, 2}) {
            const Color color = test::texel(store, 0, x, 0);
            for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(color[c], 0.0f);
        }
        ASSERT_EQ(store.warnings().size(), 1u);
        EXPECT_NE(store.warnings()[0].find("2 pixels that are not finite"), std::string::npos) << store.warnings()[0];
    }
}

TEST(BadImages, OneBadImageLeavesTheOthersAlone) {
    const test::Folder folder;
    const std::string good = folder.file("good.png");
    test::write_file(good, {2, 2, 3}, [](int, int, int c) { return c == 1 ? 1.0f : 0.0f; });
    std::vector<scene::ImageDesc> images;
    for (int i = 0; i < 20; ++i) {
        images.push_back(i % 2 ? test::file_image(good) : test::file_image("/no/such/" + std::to_string(i) + ".png"));
    }
    const ImageStore store(images, "", 64);
    EXPECT_EQ(store.warnings().size(), 10u);
    for (int i = 0; i < 20; ++i) EXPECT_EQ(test::look(store, i, 0.5f, 0.5f), (i % 2 ? Color{0, 1, 0, 1} : k_magenta));
}

TEST(BadImages, AHeaderThatLiesAboutItsSize) {
    const test::Folder folder;
    const std::string path = folder.file("huge.bmp");
    test::write_file(path, {4, 4, 3}, [](int, int, int) { return 0.5f; });
    std::vector<std::uint8_t> bytes = test::bytes_of_file(path);
    const std::int32_t side = 1000000;
    std::memcpy(bytes.data() + 18, &side, 4);
    std::memcpy(bytes.data() + 22, &side, 4);
    test::write_bytes(path, bytes);
    const ImageStore store({test::file_image(path)}, "", 64);
    EXPECT_EQ(test::look(store, 0, 0.5f, 0.5f), k_magenta);
    EXPECT_EQ(store.warnings().size(), 1u);
}

}  // namespace
}  // namespace cardioid::image
