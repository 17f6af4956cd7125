// SPDX-License-Identifier: GPL-3.0-or-later
// Against Cycles itself: cycles_reference.txt was rendered by Blender 4.5 (Blender 3.4.1 gives the same numbers where
// it knows the case), see make_cycles_reference.py.
#include "image/lookups.h"
#include "image/srgb.h"
#include "image/test_files.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace cardioid::image {
namespace {

constexpr const char* k_blender_config = "/usr/share/blender/datafiles/colormanagement/config.ocio";

struct Case {
    std::string depth, space, alpha, interpolation, extension;
    std::vector<float> values;  ///< per point: associated RGB, straight RGB, alpha
};

struct CyclesReference {
    int width = 0, height = 0;
    std::vector<int> texels;  ///< 0…255 RGBA, bottom row first
    std::vector<float> u, v;
    std::vector<Case> cases;
};

template <class T>
std::vector<T> numbers(const std::string& line) {
    std::istringstream stream(line);
    return {std::istream_iterator<T>(stream), {}};
}

CyclesReference read_reference() {
    std::ifstream file(std::string(CARDIOID_TEST_DATA) + "/cycles_reference.txt");
    CyclesReference r;
    std::string line;
    std::getline(file, line);
    std::getline(file, line);
    const std::vector<int> size = numbers<int>(line);
    r.width = size.at(0), r.height = size.at(1);
    std::getline(file, line);
    r.texels = numbers<int>(line);
    std::getline(file, line);
    const std::vector<float> points = numbers<float>(line);
    for (std::size_t i = 0; i < points.size(); i += 2) r.u.push_back(points[i]), r.v.push_back(points[i + 1]);
    while (std::getline(file, line)) {
        Case c;
        std::istringstream(line) >> c.depth >> c.space >> c.alpha >> c.interpolation >> c.extension;
        std::replace(c.space.begin(), c.space.end(), '_', ' ');
        std::getline(file, line);
        c.values = numbers<float>(line);
        r.cases.push_back(std::move(c));
    }
    return r;
}

template <class E>
E choose(const std::string& name, const std::map<std::string, E>& names) {
    return names.at(name);
}

/// Cycles reads what it will convert as halves, rounded toward zero, and keeps the result as halves: in a logarithmic
/// space that is up to 0.7 %.
double of_halves(const Case& c, float value) {
    return c.space == "Filmic Log" ? 5e-5 + 8e-3 * static_cast<double>(value) : 0.0;
}

/// Cycles cuts colour × alpha off to whole steps of the file's depth; a difference of one step, seen through the curve
/// and, for straight colours, the division by alpha.
double allowed(const Case& c, float cycles, float alpha, bool straight) {
    const bool data = c.space == "Non-Color";
    const double halves = of_halves(c, cycles);
    if (data || c.alpha == "CHANNEL_PACKED" || c.alpha == "NONE")
        return halves + 2e-5 + 2e-5 * static_cast<double>(cycles);
    // Cycles converts what it cut off, and leaves the colour of black (0.0005) where alpha is 0.
    if (c.space == "Filmic Log")
        return halves + (c.depth == "8" ? 3e-3 : 1e-3) / (straight && alpha > 0 ? static_cast<double>(alpha) : 1.0);
    const double step = (c.depth == "8" ? 1.0 / 255 : 1.0 / 65535) /
                        (straight && alpha > 0 ? static_cast<double>(std::min(alpha, 1.0f)) : 1.0);
    const double encoded = static_cast<double>(srgb_from_linear(cycles));
    return halves + 3e-5 +
           (static_cast<double>(linear_from_srgb(static_cast<float>(encoded + step))) - static_cast<double>(cycles));
}

TEST(Cycles, EveryCaseOfTheReference) {
    const CyclesReference r = read_reference();
    ASSERT_EQ(r.u.size(), 64u);
    ASSERT_GE(r.cases.size(), 30u);
    const test::Folder folder;
    for (const auto& [depth, type] : {std::pair{"8", OIIO::TypeUInt8}, {"16", OIIO::TypeUInt16}})
        test::write_file(
            folder.file(std::string("a") + depth + ".png"), {r.width, r.height, 4, type},
            [&, &rows = r](int x, int y, int ch) {
                return static_cast<float>(
                           rows.texels[static_cast<std::size_t>(((rows.height - 1 - y) * rows.width + x) * 4 + ch)]) /
                       255;
            });
    const bool blender = std::filesystem::exists(k_blender_config);
    int compared = 0;
    for (const Case& c : r.cases) {
        if (c.space == "Filmic Log" && !blender) continue;
        // Here Cycles divides packed channels by what is not an alpha: colours of 34000. Ours are converted as they
        // are.
        if (c.space == "Filmic Log" && c.alpha == "CHANNEL_PACKED") continue;
        SCOPED_TRACE(c.depth + ' ' + c.space + ' ' + c.alpha + ' ' + c.interpolation + ' ' + c.extension);
        using scene::AlphaMode;
        scene::ImageDesc image = test::file_image(folder.file("a" + c.depth + ".png"), c.space);
        image.alpha_mode = choose<AlphaMode>(c.alpha, {{"STRAIGHT", AlphaMode::straight},
                                                       {"PREMUL", AlphaMode::premultiplied},
                                                       {"CHANNEL_PACKED", AlphaMode::channel_packed},
                                                       {"NONE", AlphaMode::none}});
        const auto interpolation = choose<Interpolation>(
            c.interpolation,
            {{"Closest", Interpolation::closest}, {"Linear", Interpolation::linear}, {"Cubic", Interpolation::cubic}});
        const auto extension = choose<Extension>(c.extension, {{"REPEAT", Extension::repeat},
                                                               {"EXTEND", Extension::extend},
                                                               {"CLIP", Extension::clip},
                                                               {"MIRROR", Extension::mirror}});
        const ImageStore store({image}, blender ? k_blender_config : "", 64);
        Row associated[4], straight[4];
        store.lookup(0, interpolation, extension, 64, r.u.data(), r.v.data(), associated, AlphaUse::associated);
        store.lookup(0, interpolation, extension, 64, r.u.data(), r.v.data(), straight, AlphaUse::straight);
        for (std::size_t i = 0; i < 64; ++i) {
            const float* cycles = &c.values[7 * i];
            const float alpha = cycles[6];
            ASSERT_NEAR(associated[3][i], alpha, 2e-5 + of_halves(c, alpha)) << "alpha of point " << i;
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_NEAR(associated[k][i], cycles[k], allowed(c, cycles[k], alpha, false))
                    << "associated, point " << i;
                EXPECT_NEAR(straight[k][i], cycles[3 + k], allowed(c, cycles[3 + k], alpha, true))
                    << "straight, point " << i << " alpha " << alpha;
            }
        }
        ++compared;
    }
    EXPECT_EQ(compared, blender ? 34 : 28);
}

}  // namespace
}  // namespace cardioid::image
