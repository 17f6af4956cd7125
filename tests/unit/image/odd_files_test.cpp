// SPDX-License-Identifier: GPL-3.0-or-later
// Files as artists have them: channel counts, depths, orders and alphas that no test picture of ours would have by itself. What
// Cycles of Blender 4.5 shows for them was looked up by rendering an emission plane.
#include "image/lookups.h"
#include "image/test_files.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cardioid::image {
namespace {

using test::Color;

constexpr const char* k_linear = "Linear Rec.709";

/// 8 × 8 pixels of CMYK (51, 102, 204, 26), inverted as Adobe writes it.
const std::vector<std::uint8_t> k_cmyk_jpeg = {
    0xff, 0xd8, 0xff, 0xee, 0x00, 0x0e, 0x41, 0x64, 0x6f, 0x62, 0x65, 0x00, 0x64, 0x00, 0x00, 0x00, 0x00, 0x00,
    0xff, 0xdb, 0x00, 0x43, 0x00, 0x02, 0x01, 0x01, 0x01, 0x01, 0x01, 0x02, 0x01, 0x01, 0x01, 0x02, 0x02, 0x02,
    0x02, 0x02, 0x04, 0x03, 0x02, 0x02, 0x02, 0x02, 0x05, 0x04, 0x04, 0x03, 0x04, 0x06, 0x05, 0x06, 0x06, 0x06,
    0x05, 0x06, 0x06, 0x06, 0x07, 0x09, 0x08, 0x06, 0x07, 0x09, 0x07, 0x06, 0x06, 0x08, 0x0b, 0x08, 0x09, 0x0a,
    0x0a, 0x0a, 0x0a, 0x0a, 0x06, 0x08, 0x0b, 0x0c, 0x0b, 0x0a, 0x0c, 0x09, 0x0a, 0x0a, 0x0a, 0xff, 0xc0, 0x00,
    0x14, 0x08, 0x00, 0x08, 0x00, 0x08, 0x04, 0x43, 0x11, 0x00, 0x4d, 0x11, 0x00, 0x59, 0x11, 0x00, 0x4b, 0x11,
    0x00, 0xff, 0xc4, 0x00, 0x15, 0x00, 0x01, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x09, 0x07, 0xff, 0xc4, 0x00, 0x14, 0x10, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xff, 0xda, 0x00, 0x0e, 0x04, 0x43, 0x00, 0x4d,
    0x00, 0x59, 0x00, 0x4b, 0x00, 0x00, 0x3f, 0x00, 0x4c, 0x16, 0x41, 0x96, 0x65, 0x1f, 0xff, 0xd9};

Color straight(const scene::ImageDesc& image) {
    const ImageStore store({image}, "", 64);
    EXPECT_EQ(store.warnings(), std::vector<std::string>{});
    return test::texel(store, 0, 0, 0, AlphaUse::straight);
}

Color associated(const scene::ImageDesc& image) {
    const ImageStore store({image}, "", 64);
    return test::texel(store, 0, 0, 0, AlphaUse::associated);
}

void expect_near(Color color, Color expected, double bound) {
    for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(color[c], expected[c], bound) << "channel " << c;
}

/// A file of one colour.
std::string plain_file(const test::Folder& folder, const char* name, const std::vector<float>& color,
                       OIIO::TypeDesc type = OIIO::TypeUInt8,
                       const std::vector<std::pair<std::string, std::string>>& attributes = {}) {
    const std::string path = folder.file(name);
    test::write_file(path, {64, 64, static_cast<int>(color.size()), type, 0, attributes},
                     [&](int, int, int c) { return color[static_cast<std::size_t>(c)]; });
    return path;
}

TEST(OddFiles, CmykJpegIsConvertedToColours) {
    const test::Folder folder;
    test::write_bytes(folder.file("cmyk.jpg"), k_cmyk_jpeg);
    // Cycles: 0.7176, 0.5373, 0.1804.
    for (const auto& image : {test::file_image(folder.file("cmyk.jpg")), test::packed_image(folder.file("cmyk.jpg"))})
        expect_near(straight(image), {0.7176f, 0.5373f, 0.1804f, 1}, 0.006);
}

TEST(OddFiles, CmykTiffIsConvertedToColours) {
    const test::Folder folder;
    const std::string path =
        plain_file(folder, "cmyk.tif", {0.7f, 0.5f, 0.2f}, OIIO::TypeUInt8, {{"tiff:ColorSpace", "CMYK"}});
    expect_near(straight(test::file_image(path)), {0.7f, 0.5f, 0.2f, 1}, 0.006);
}

TEST(OddFiles, SixteenBitsAreKept) {
    const test::Folder folder;
    const float value = 12345.0f / 65535;
    for (const char* name : {"a.png", "a.tif"}) {
        const std::string path = plain_file(folder, name, {value, 1 - value, value}, OIIO::TypeUInt16);
        expect_near(straight(test::file_image(path)), {value, 1 - value, value, 1}, 1e-6);
        expect_near(straight(test::packed_image(path)), {value, 1 - value, value, 1}, 1e-6);
    }
}

TEST(OddFiles, OneChannelIsGrey) {
    const test::Folder folder;
    for (const char* name : {"a.png", "a.tif", "a.jpg"})
        expect_near(straight(test::file_image(plain_file(folder, name, {0.6f}))), {0.6f, 0.6f, 0.6f, 1}, 0.003);
}

TEST(OddFiles, GreyWithAlphaIsAsInCycles) {
    const test::Folder folder;
    const std::string path = plain_file(folder, "a.png", {200.0f / 255, 100.0f / 255});
    // Cycles divides what it never multiplied.
    expect_near(associated(test::file_image(path, k_linear)), {0.7843f, 0.7843f, 0.7843f, 0.3922f}, 1e-4);
    expect_near(straight(test::file_image(path, k_linear)), {2, 2, 2, 0.3922f}, 1e-3);
    // Packed bytes go through Blender, which knows better.
    expect_near(associated(test::packed_image(path, k_linear)), {0.3076f, 0.3076f, 0.3076f, 0.3922f}, 1e-4);
    expect_near(straight(test::packed_image(path, k_linear)), {0.7843f, 0.7843f, 0.7843f, 0.3922f}, 1e-4);
}

TEST(OddFiles, TargaAlphaIsStraight) {
    const test::Folder folder;
    const std::string path = plain_file(folder, "a.tga", {0.8f, 0.6f, 0.4f, 0.4f});
    // 204, 153, 102 times 102 / 255, cut off: 81, 61, 40 (Cycles).
    expect_near(straight(test::file_image(path, k_linear)), {81.0f / 102, 61.0f / 102, 40.0f / 102, 0.4f}, 1e-5);
    expect_near(associated(test::file_image(path, k_linear)), {81.0f / 255, 61.0f / 255, 40.0f / 255, 0.4f}, 1e-5);
}

TEST(OddFiles, ExrChannelsByTheirNames) {
    const test::Folder folder;
    const std::string path = folder.file("a.exr");
    OIIO::ImageSpec spec(2, 2, 5, OIIO::TypeHalf);
    spec.channelnames = {"B", "Z", "A", "G", "R"};
    spec.alpha_channel = 2;
    const float texel[] = {0.125f, 9, 1, 0.25f, 0.5f};
    std::vector<float> pixels;
    for (int i = 0; i < 4; ++i) pixels.insert(pixels.end(), std::begin(texel), std::end(texel));
    const auto out = OIIO::ImageOutput::create(path);
    ASSERT_TRUE(out && out->open(path, spec) && out->write_image(OIIO::TypeFloat, pixels.data()) && out->close());
    expect_near(straight(test::file_image(path)), {0.5f, 0.25f, 0.125f, 1}, 1e-6);
}

TEST(OddFiles, ChannelsBeyondFourAreDropped) {
    const test::Folder folder;
    const std::string path = plain_file(folder, "a.tif", {0.2f, 0.4f, 0.6f, 1, 0.3f, 0.9f});
    expect_near(straight(test::file_image(path)), {0.2f, 0.4f, 0.6f, 1}, 0.003);
}

TEST(OddFiles, OtherFormatsAreRead) {
    const test::Folder folder;
    int read = 0;
    for (const char* name : {"a.hdr", "a.webp", "a.jp2", "a.bmp", "a.gif", "a.dpx", "a.sgi", "a.ppm", "a.iff"}) {
        if (!OIIO::ImageOutput::create(folder.file(name))) continue;
        ++read;
        SCOPED_TRACE(name);
        const std::string path = plain_file(folder, name, {0.75f, 0.5f, 0.25f});
        expect_near(straight(test::file_image(path)), {0.75f, 0.5f, 0.25f, 1}, 0.03);
        // OpenImageIO 2.4 reads this one from files alone.
        if (std::string(name) == "a.sgi") continue;
        expect_near(straight(test::packed_image(path)), {0.75f, 0.5f, 0.25f, 1}, 0.03);
    }
    EXPECT_GE(read, 5) << "this OpenImageIO can hardly write anything";
}

TEST(OddFiles, ImagesWithoutPixelsAreMagentaAndNamed) {
    for (const auto& [width, height] : {std::pair{0, 0}, {0, 4}, {4, 0}}) {
        const ImageStore store({test::pixel_image(width, height, 4, {})}, "", 64);
        EXPECT_EQ(test::texel(store, 0, 0, 0), (Color{1, 0, 1, 1}));
        ASSERT_EQ(store.warnings().size(), 1u);
        EXPECT_NE(store.warnings()[0].find("\"pixels\""), std::string::npos) << store.warnings()[0];
    }
}

}  // namespace
}  // namespace cardioid::image
