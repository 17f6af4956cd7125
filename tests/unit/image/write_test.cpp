// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/write.h"

#include "image/lookups.h"
#include "image/test_files.h"
#include "image/version.h"
#include "scene/error.h"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <csignal>
#include <random>

namespace cardioid::image {
namespace {

std::size_t files_in(const test::Folder& folder) {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder.path()), {}));
}

std::vector<float> ramp(std::size_t count) {
    std::vector<float> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<float>(i) * 0.37f - 3;
    return values;
}

TEST(WriteExr, ChannelsMetadataAndOrientation) {
    const test::Folder folder;
    const std::string path = folder.file("out.exr");
    const std::vector<std::string> names = {"R", "G", "B", "A", "ViewLayer.Depth.Z", "ViewLayer.Normal.X"};
    const int width = 5, height = 3;
    const std::vector<float> pixels = ramp(5 * 3 * 6);
    write_exr(path, width, height, names, pixels, {{"cardioid/samples", "64"}, {"Software", "Cardioid"}});
    const auto in = OIIO::ImageInput::open(path);
    ASSERT_TRUE(in);
    EXPECT_EQ(in->spec().format, OIIO::TypeFloat);
    EXPECT_EQ(in->spec().get_string_attribute("cardioid/samples"), "64");
    ASSERT_EQ(in->spec().nchannels, 6);
    std::vector<float> read(pixels.size());
    ASSERT_TRUE(in->read_image(0, 0, 0, 6, OIIO::TypeFloat, read.data()));
    for (std::size_t c = 0; c < names.size(); ++c) {
        const int at = in->spec().channelindex(names[c]);
        ASSERT_GE(at, 0) << names[c];
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                EXPECT_EQ(read[static_cast<std::size_t>(((height - 1 - y) * width + x) * 6 + at)],
                          pixels[static_cast<std::size_t>((y * width + x) * 6) + c]);
    }
    EXPECT_EQ(files_in(folder), 1u);
}

TEST(WriteExr, HalfIsClampedAndRoundTrips) {
    const test::Folder folder;
    const std::string path = folder.file("half.exr");
    write_exr(path, 2, 1, {"R", "G", "B"}, std::vector<float>{0.5f, 1e9f, std::nanf(""), -0.25f, 2, 1e-5f}, {},
              Depth::half);
    const ImageStore store({test::file_image(path, "Linear")}, "", 64);
    const test::Color left = test::texel(store, 0, 0, 0), right = test::texel(store, 0, 1, 0);
    EXPECT_EQ(left[0], 0.5f);
    EXPECT_EQ(left[1], 65504.0f);
    EXPECT_EQ(left[2], 0.0f);
    EXPECT_EQ(right[0], -0.25f);
    EXPECT_NEAR(right[2], 1e-5f, 1e-7);
    EXPECT_TRUE(store.warnings().empty());
}

TEST(WritePng, IsAnSrgbView) {
    const test::Folder folder;
    const std::string path = folder.file("view.png");
    write_png(path, 2, 2, 4,
              std::vector<float>{0.25f, 0.25f, 0.25f, 0.5f, 0, 0, 0, 0, /* top: */ 1, 2, -1, 1, 0.18f, std::nanf(""),
                                 0.5f, 1});
    const auto in = OIIO::ImageInput::open(path, nullptr);
    ASSERT_TRUE(in);
    OIIO::ImageSpec raw;
    raw.attribute("oiio:UnassociatedAlpha", 1);
    const auto straight = OIIO::ImageInput::open(path, &raw);
    std::vector<std::uint8_t> bytes(16);
    ASSERT_TRUE(straight->read_image(0, 0, 0, 4, OIIO::TypeUInt8, bytes.data()));
    EXPECT_EQ(bytes, (std::vector<std::uint8_t>{255, 255, 0, 255, 118, 0, 188, 255, 188, 188, 188, 128, 0, 0, 0, 0}));
}

TEST(Write, ErrorsNameThePath) {
    const test::Folder folder;
    const std::string path = folder.file("no/such/folder/out.exr");
    for (const auto& write :
         std::vector<std::function<void()>>{[&] { write_exr(path, 1, 1, {"R"}, std::vector<float>{1}); },
                                            [&] {
                                                write_png(path, 1, 1, 3, std::vector<float>{1, 1, 1});
                                            },
                                            [&] {
                                                write_exr(path, 1, 1, {"R"}, std::vector<float>{1, 2});
                                            },
                                            [&] { write_png(path, 0, 1, 3, {}); },
                                            [&] {
                                                write_png(path, 1, 1, 2, std::vector<float>{1, 1});
                                            }}) {
        try {
            write();
            FAIL() << "no error";
        } catch (const scene::SceneError& error) {
            EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
        }
    }
}

TEST(Write, AFullDiskKeepsTheOldFile) {
    const test::Folder folder;
    std::mt19937 generator(1);
    std::uniform_real_distribution<float> any(0, 1);
    std::vector<float> large(300 * 300 * 3);
    for (float& value : large) value = any(generator);
    for (const std::string name : {"out.exr", "out.png"}) {
        const std::string path = folder.file(name);
        const auto write = [&](int side, std::span<const float> pixels) {
            if (name == "out.exr")
                write_exr(path, side, side, {"R", "G", "B"}, pixels);
            else
                write_png(path, side, side, 3, pixels);
        };
        write(1, std::vector<float>{1, 1, 1});
        const std::vector<std::uint8_t> before = test::bytes_of_file(path);
        rlimit old{};
        ::getrlimit(RLIMIT_FSIZE, &old);
        const auto handler = std::signal(SIGXFSZ, SIG_IGN);
        const rlimit tight{20000, old.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &tight);
        EXPECT_THROW(write(300, large), scene::SceneError) << name;
        ::setrlimit(RLIMIT_FSIZE, &old);
        std::signal(SIGXFSZ, handler);
        EXPECT_EQ(test::bytes_of_file(path), before) << name;
    }
    EXPECT_EQ(files_in(folder), 2u) << "no temporary files are left";
}

TEST(Version, LibrariesReportThemselves) {
    EXPECT_EQ(openimageio_version().find_first_not_of("0123456789."), std::string::npos);
    EXPECT_GE(openimageio_version().front(), '2');
    EXPECT_GE(opencolorio_version().front(), '2');
}

}  // namespace
}  // namespace cardioid::image
