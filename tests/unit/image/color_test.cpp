// SPDX-License-Identifier: GPL-3.0-or-later
// Colour spaces and alpha.
#include "image/color.h"

#include "image/lookups.h"
#include "image/srgb.h"
#include "image/test_files.h"

#include <gtest/gtest.h>

namespace cardioid::image {
namespace {

using test::Color;

constexpr const char* k_blender_config = "/usr/share/blender/datafiles/colormanagement/config.ocio";

const std::vector<float> k_pixel = {0.5f, 0.25f, 1};

Color convert(const std::string& space, const std::string& config, std::size_t warnings = 0,
              std::vector<float> pixel = k_pixel) {
    const ImageStore store({test::pixel_image(1, 1, static_cast<int>(pixel.size()), pixel, space)}, config, 64);
    EXPECT_EQ(store.warnings().size(), warnings) << space;
    return test::texel(store, 0, 0, 0);
}

void expect_srgb(const std::string& space, const std::string& config) {
    const Color color = convert(space, config);
    EXPECT_NEAR(color[0], 0.21404114, 2e-6) << space;
    EXPECT_NEAR(color[1], 0.05087609, 2e-6) << space;
    EXPECT_NEAR(color[2], 1, 2e-6) << space;
}

void expect_unchanged(const std::string& space, const std::string& config) {
    EXPECT_EQ(convert(space, config), (Color{0.5f, 0.25f, 1, 1})) << space;
}

TEST(ColorSpaces, BuiltInNamesOfEveryVersion) {
    for (const char* name : {"sRGB", "sRGB OETF", "srgb_texture", "Utility - sRGB - Texture"}) expect_srgb(name, "");
    for (const char* name :
         {"Linear", "Linear Rec.709", "Linear BT.709", "lin_rec709_scene", "scene_linear", "Rec.709"})
        expect_unchanged(name, "");
    for (const char* name : {"Non-Color", "Raw", "Non-Colour Data", "Generic Data", ""}) expect_unchanged(name, "");
}

/// Configurations of the Blenders on this machine.
std::vector<std::string> blender_configs() {
    const std::filesystem::path site = std::filesystem::path(CARDIOID_TEST_DATA) / "../../../.venv";
    std::vector<std::string> found;
    for (const std::filesystem::path& path :
         {std::filesystem::path(k_blender_config),
          site / "bpy45/lib/python3.11/site-packages/bpy/4.5/datafiles/colormanagement/config.ocio"})
        if (std::filesystem::exists(path)) found.push_back(path.string());
    return found;
}

TEST(ColorSpaces, SpacesOfACurveAndAMatrixAreThoseOfBlendersConfigurations) {
    if (blender_configs().empty()) GTEST_SKIP() << "no Blender on this machine";
    for (const std::string& config : blender_configs()) {
        ColorSpaces blender(config), own("");
        for (const char* name :
             {"XYZ", "Linear ACES", "Linear ACEScg", "Linear CIE-XYZ E", "Linear CIE-XYZ D65", "Linear DCI-P3 D65",
              "Linear Rec.2020", "ACES2065-1", "ACEScg", "Linear FilmLight E-Gamut", "Display P3", "Rec.1886",
              "Rec.2020", "lin_ap1_scene", "Linear BT.2020"}) {
            const ColorSpace mine = own.find(name, true), theirs = blender.find(name, true);
            EXPECT_TRUE(mine.known && theirs.known) << name;
            std::vector<float> a{0.5f, 0.25f, 1, 1, 0.03f, 0.9f, 0.01f, 1}, b = a;
            mine.to_linear(a.data(), 2);
            theirs.to_linear(b.data(), 2);
            for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 3e-5) << config << name << k;
        }
    }
}

TEST(ColorSpaces, UnknownNamesAreNamedOnce) {
    std::vector<scene::ImageDesc> images;
    for (const char* space : {"AgX Log", "Filmic Log", "AgX Log", "sRGB", "Non-Color"})
        images.push_back(test::pixel_image(1, 1, 3, k_pixel, space));
    for (const std::string config : {"", "/no/such/config.ocio"}) {
        const ImageStore store(images, config, 64);
        ASSERT_EQ(store.warnings().size(), 1u);
        const std::string warning = store.warnings()[0];
        EXPECT_NE(warning.find("\"AgX Log\", \"Filmic Log\""), std::string::npos) << warning;
        EXPECT_EQ(warning.find("sRGB\""), std::string::npos) << warning;
        EXPECT_EQ(warning.find("/no/such") != std::string::npos, !config.empty()) << warning;
        EXPECT_EQ(test::texel(store, 0, 0, 0), (Color{0.5f, 0.25f, 1, 1})) << "floats are taken for linear";
    }
}

TEST(ColorSpaces, UnknownNamesOfBytesAreTakenForSrgb) {
    const test::Folder folder;
    const std::string path = folder.file("a.png");
    test::write_file(path, {1, 1, 3}, [](int, int, int) { return 128.0f / 255; });
    const ImageStore store({test::file_image(path, "No such space")}, "", 64);
    EXPECT_EQ(store.warnings().size(), 1u);
    EXPECT_NEAR(test::texel(store, 0, 0, 0)[0], 0.2158605f, 2e-6);
}

TEST(ColorSpaces, AnUnreadableConfigurationLeavesTheStandardSpaces) {
    const test::Folder folder;
    const std::string path = folder.file("config.ocio");
    for (const std::string content : {"", "ocio_profile_version: 2.9\nroles: {}\n", "not yaml: [", "\x89PNG"}) {
        test::write_bytes(path, {content.begin(), content.end()});
        expect_srgb("sRGB", path);
        expect_unchanged("Linear Rec.709", path);
        expect_unchanged("Non-Color", path);
        const ImageStore store({test::pixel_image(1, 1, 3, k_pixel, "AgX Log")}, path, 64);
        ASSERT_EQ(store.warnings().size(), 1u);
        EXPECT_NE(store.warnings()[0].find("AgX Log"), std::string::npos);
    }
}

/// A configuration whose space "Doubled" is half the linear value and whose "Swapped" exchanges red and blue.
std::string write_config(const test::Folder& folder) {
    const std::string text = R"(ocio_profile_version: 1
roles: {scene_linear: Lin, default: Lin}
displays:
  D:
    - !<View> {name: V, colorspace: Lin}
active_displays: [D]
active_views: [V]
colorspaces:
  - !<ColorSpace>
    name: Lin
    isdata: false
  - !<ColorSpace>
    name: Numbers
    isdata: true
  - !<ColorSpace>
    name: Doubled
    isdata: false
    to_reference: !<MatrixTransform> {matrix: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: Swapped
    isdata: false
    to_reference: !<MatrixTransform> {matrix: [0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: Square
    isdata: false
    to_reference: !<ExponentTransform> {value: [2, 2, 2, 1]}
)";
    const std::string path = folder.file("config.ocio");
    test::write_bytes(path, {text.begin(), text.end()});
    return path;
}

TEST(ColorSpaces, ThroughAConfiguration) {
    const test::Folder folder;
    const std::string config = write_config(folder);
    expect_unchanged("Lin", config);
    expect_unchanged("Numbers", config);
    expect_srgb("sRGB", config);
    EXPECT_EQ(convert("Doubled", config), (Color{1, 0.5f, 2, 1}));
    EXPECT_EQ(convert("Swapped", config), (Color{1, 0.25f, 0.5f, 1}));
    EXPECT_NEAR(convert("Swapped", config, 0, {0.5f})[1], 0.5f, 1e-6) << "grey";
    const Color squared = convert("Square", config);
    EXPECT_NEAR(squared[0], 0.25f, 1e-5);
    EXPECT_NEAR(squared[1], 0.0625f, 1e-5);
}

TEST(ColorSpaces, StandardNamesFollowAConfigurationOfOtherPrimaries) {
    const test::Folder folder;
    // The working space is called something else, so even "sRGB" must be asked for; here it is made twice as bright.
    const std::string text = R"(ocio_profile_version: 1
roles: {scene_linear: Wide, default: Wide}
displays:
  D:
    - !<View> {name: V, colorspace: Wide}
active_displays: [D]
active_views: [V]
colorspaces:
  - !<ColorSpace>
    name: Wide
    isdata: false
  - !<ColorSpace>
    name: sRGB
    isdata: false
    to_reference: !<MatrixTransform> {matrix: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]}
)";
    const std::string path = folder.file("config.ocio");
    test::write_bytes(path, {text.begin(), text.end()});
    EXPECT_EQ(convert("sRGB", path), (Color{1, 0.5f, 2, 1}));
    EXPECT_EQ(convert("Non-Color", path), (Color{0.5f, 0.25f, 1, 1}));
}

TEST(ColorSpaces, BytesAreConvertedBeforeInterpolation) {
    const test::Folder folder;
    const std::string config = write_config(folder), path = folder.file("two.png");
    test::write_file(path, {2, 1, 3}, [](int x, int, int) { return static_cast<float>(x); });
    const ImageStore store({test::file_image(path, "Square")}, config, 64);
    EXPECT_NEAR(test::look(store, 0, 0.5f, 0.5f, Interpolation::linear)[0], 0.5f, 1e-4);
}

TEST(ColorSpaces, AssociatedColoursAreDividedForTheConversion) {
    const test::Folder folder;
    const std::string config = write_config(folder);
    scene::ImageDesc image = test::pixel_image(1, 1, 4, {0.25f, 0.25f, 0.25f, 0.5f}, "Square");
    image.alpha_mode = scene::AlphaMode::premultiplied;
    const ImageStore store({image}, config, 64);
    EXPECT_NEAR(test::texel(store, 0, 0, 0, AlphaUse::straight)[0], 0.25f, 1e-5);
    EXPECT_NEAR(test::texel(store, 0, 0, 0, AlphaUse::associated)[0], 0.125f, 1e-5);
}

TEST(ColorSpaces, BlendersOwnConfiguration) {
    if (!std::filesystem::exists(k_blender_config)) GTEST_SKIP() << "no Blender on this machine";
    expect_srgb("sRGB", k_blender_config);
    expect_unchanged("Linear", k_blender_config);
    expect_unchanged("Non-Color", k_blender_config);
    expect_unchanged("Raw", k_blender_config);
    // The quick answer for standard names is the one that the configuration gives.
    const test::Folder folder;
    std::vector<std::uint8_t> bytes = test::bytes_of_file(k_blender_config);
    std::string text(bytes.begin(), bytes.end());
    text.replace(text.find("scene_linear: Linear"), 20, "scene_linear: 'Linear'");
    const std::string copy = folder.file("config.ocio");
    test::write_bytes(copy, {text.begin(), text.end()});
    std::filesystem::create_directory_symlink(std::filesystem::path(k_blender_config).parent_path() / "luts",
                                              folder.file("luts"));
    std::filesystem::create_directory_symlink(std::filesystem::path(k_blender_config).parent_path() / "filmic",
                                              folder.file("filmic"));
    ColorSpaces slow(copy), quick(k_blender_config);
    for (const char* name : {"sRGB", "Linear", "Non-Color", "Raw"}) {
        EXPECT_EQ(slow.find(name, true).transfer, quick.find(name, true).transfer) << name;
        EXPECT_TRUE(slow.find(name, true).known) << name;
    }
    EXPECT_EQ(slow.config_problem(), "");
    // ACEScg's red in Rec.709.
    const Color red = convert("Linear ACEScg", k_blender_config, 0, {1, 0, 0});
    EXPECT_NEAR(red[0], 1.705f, 0.01f);
    EXPECT_NEAR(red[1], -0.130f, 0.01f);
    EXPECT_NEAR(red[2], -0.024f, 0.01f);
}

// One texel whose file holds straight (0.8, 0.4, 0.2) at alpha 0.5.
class Alpha : public testing::Test {
protected:
    Alpha() : path_(folder_.file("a.png")) {
        test::write_file(path_, {1, 1, 4, OIIO::TypeUInt16}, [](int, int, int c) {
            return std::array{0.8f, 0.4f, 0.2f, 0.5f}[static_cast<std::size_t>(c)];
        });
    }
    void expect(scene::AlphaMode mode, const std::string& space, Color straight, Color associated) const {
        scene::ImageDesc file = test::file_image(path_, space);
        scene::ImageDesc packed = test::packed_image(path_, space);
        scene::ImageDesc pixels = test::pixel_image(1, 1, 4, {0.8f, 0.4f, 0.2f, 0.5f}, space);
        file.alpha_mode = packed.alpha_mode = pixels.alpha_mode = mode;
        const bool premultiplied_pixels = mode == scene::AlphaMode::premultiplied;
        const ImageStore store(premultiplied_pixels ? std::vector{file, packed} : std::vector{file, packed, pixels}, "",
                               64);
        for (int i = 0; i < store.size(); ++i) {
            const Color a = test::texel(store, i, 0, 0, AlphaUse::straight),
                        b = test::texel(store, i, 0, 0, AlphaUse::associated);
            // Products are cut off to a step of 65535; over an alpha of a half and by the slope of the curve: 5.4e-5.
            for (std::size_t c = 0; c < 4; ++c) {
                EXPECT_NEAR(a[c], straight[c], 6e-5) << "straight, image " << i << " channel " << c;
                EXPECT_NEAR(b[c], associated[c], 6e-5) << "associated, image " << i << " channel " << c;
            }
            EXPECT_EQ(store.has_alpha(i), mode != scene::AlphaMode::none);
        }
    }
    test::Folder folder_;
    std::string path_;
};

TEST_F(Alpha, Straight) {
    expect(scene::AlphaMode::straight, "Linear", {0.8f, 0.4f, 0.2f, 0.5f}, {0.4f, 0.2f, 0.1f, 0.5f});
}

TEST_F(Alpha, PremultipliedIsDecidedByTheFile) {
    expect(scene::AlphaMode::premultiplied, "Linear", {0.8f, 0.4f, 0.2f, 0.5f}, {0.4f, 0.2f, 0.1f, 0.5f});
}

TEST_F(Alpha, ChannelPacked) {
    expect(scene::AlphaMode::channel_packed, "Linear", {0.8f, 0.4f, 0.2f, 0.5f}, {0.8f, 0.4f, 0.2f, 0.5f});
}

TEST_F(Alpha, None) { expect(scene::AlphaMode::none, "Linear", {0.8f, 0.4f, 0.2f, 1}, {0.8f, 0.4f, 0.2f, 1}); }

TEST_F(Alpha, DataIsLeftAlone) {
    expect(scene::AlphaMode::straight, "Non-Color", {0.8f, 0.4f, 0.2f, 0.5f}, {0.8f, 0.4f, 0.2f, 0.5f});
}

TEST_F(Alpha, SrgbIsMultipliedEncoded) {
    const auto l = [](float v) { return linear_from_srgb(v); };
    expect(scene::AlphaMode::straight, "sRGB", {l(0.8f), l(0.4f), l(0.2f), 0.5f}, {l(0.4f), l(0.2f), l(0.1f), 0.5f});
}

TEST_F(Alpha, PremultipliedPixelsAreDivided) {
    scene::ImageDesc pixels = test::pixel_image(1, 1, 4, {0.4f, 0.2f, 0.1f, 0.5f}, "Linear");
    pixels.alpha_mode = scene::AlphaMode::premultiplied;
    const ImageStore store({pixels}, "", 64);
    EXPECT_NEAR(test::texel(store, 0, 0, 0)[0], 0.8f, 1e-6);
    EXPECT_NEAR(test::texel(store, 0, 0, 0, AlphaUse::associated)[0], 0.4f, 1e-6);
}

TEST(AlphaOfFiles, ExrIsAssociatedAlready) {
    const test::Folder folder;
    const std::string path = folder.file("a.exr");
    OIIO::ImageSpec spec(1, 1, 4, OIIO::TypeFloat);
    const auto out = OIIO::ImageOutput::create(path);
    const float pixel[] = {0.4f, 0.2f, 0.1f, 0.5f};
    ASSERT_TRUE(out->open(path, spec) && out->write_image(OIIO::TypeFloat, pixel) && out->close());
    const ImageStore store({test::file_image(path, "Linear")}, "", 64);
    EXPECT_NEAR(test::texel(store, 0, 0, 0)[0], 0.8f, 1e-6);
    EXPECT_NEAR(test::texel(store, 0, 0, 0, AlphaUse::associated)[0], 0.4f, 1e-6);
}

TEST(AlphaOfFiles, TransparentTexelsDoNotBleed) {
    const test::Folder folder;
    const std::string path = folder.file("a.png");
    // Red at alpha 1 beside green at alpha 0: halfway the straight colour is still red.
    test::write_file(path, {2, 1, 4}, [](int x, int, int c) {
        return c == 3 ? 1.0f - static_cast<float>(x) : c == x ? 1.0f : 0.0f;
    });
    const ImageStore store({test::file_image(path, "sRGB")}, "", 64);
    const Color color = test::look(store, 0, 0.5f, 0.5f, Interpolation::linear);
    EXPECT_NEAR(color[0], 1, 1e-5);
    EXPECT_NEAR(color[1], 0, 1e-5);
    EXPECT_NEAR(color[3], 0.5f, 1e-5);
}

TEST(MeanColor, IsTheMeanOfLinearColours) {
    const test::Folder folder;
    const std::string path = folder.file("a.png");
    test::write_file(path, {100, 70, 3}, [](int x, int, int c) {
        return c == 0 ? (x < 50 ? 1.0f : 0.0f) : c == 1 ? 128.0f / 255 : 0;
    });
    const ImageStore store({test::file_image(path, "sRGB"), test::pixel_image(2, 1, 1, {1, 3}, "Linear")}, "", 64);
    EXPECT_NEAR(store.mean_color(0).x, 0.5f, 1e-5);
    EXPECT_NEAR(store.mean_color(0).y, 0.2158605f, 1e-5);
    EXPECT_EQ(store.mean_color(0).z, 0.0f);
    EXPECT_EQ(store.mean_color(1), (Float3{2, 2, 2}));
}

}  // namespace
}  // namespace cardioid::image
