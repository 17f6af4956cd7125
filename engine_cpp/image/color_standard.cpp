// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/color_standard.h"

#include "image/srgb.h"

#include <cmath>
#include <initializer_list>
#include <string_view>

namespace cardioid::image {
namespace {

/// From the encoded value to linear light. `video`: a power of 2.4, nothing under zero.
enum class Curve : std::uint8_t { linear, srgb, video };

/// Columns: Rec.709 colours of the space's three primaries. Numbers of Blender 4.5's configuration, adapted to D65.
struct Primaries {
    float r[3], g[3], b[3];
};

constexpr Primaries k_rec709{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr Primaries k_xyz_e{{3.1462348f, -0.99553651f, 0.063597888f},
                            {-1.6661153f, 1.9557664f, -0.21459663f},
                            {-0.48012465f, 0.039771624f, 1.1509991f}};
constexpr Primaries k_xyz_d65{{3.2404373f, -0.96926749f, 0.055643447f},
                              {-1.5371306f, 1.8760136f, -0.20402597f},
                              {-0.49852884f, 0.041556079f, 1.0572255f}};
constexpr Primaries k_p3{
    {1.2247329f, -0.042057782f, -0.019642176f}, {-0.22490749f, 1.0421025f, -0.078656435f}, {0, 0, 1.098371f}};
constexpr Primaries k_rec2020{{1.6602063f, -0.12455265f, -0.018154996f},
                              {-0.58755386f, 1.1329457f, -0.10060465f},
                              {-0.072827056f, -0.0083483858f, 1.118832f}};
constexpr Primaries k_ap0{{2.5212717f, -0.27648672f, -0.01538176f},
                          {-1.1339446f, 1.3727529f, -0.1530121f},
                          {-0.38749152f, -0.096241541f, 1.1686342f}};
constexpr Primaries k_ap1{{1.7047708f, -0.13025962f, -0.024009123f},
                          {-0.62168992f, 1.1408328f, -0.12899996f},
                          {-0.083245188f, -0.010548579f, 1.1532494f}};
constexpr Primaries k_e_gamut{{1.9069349f, -0.16250192f, -0.12762369f},
                              {-0.69285268f, 1.3766892f, -0.23529504f},
                              {-0.21424656f, -0.21416268f, 1.3631591f}};

struct Space {
    Curve curve;
    const Primaries& primaries;
    std::initializer_list<std::string_view> names;
};

const Space k_spaces[] = {
    {Curve::linear, k_xyz_e, {"Linear CIE-XYZ E", "Linear CIE-XYZ I-E", "FilmLight: Linear - XYZ"}},
    {Curve::linear,
     k_xyz_d65,
     {"XYZ", "Linear CIE-XYZ D65", "Linear CIE-XYZ I-D65", "CIE-XYZ-D65", "cie_xyz_d65", "lin_ciexyzd65_scene"}},
    {Curve::linear,
     k_p3,
     {"Linear DCI-P3 D65", "Linear DCI-P3 I-D65", "Linear P3-D65", "lin_p3d65", "lin_p3d65_scene",
      "Utility - Linear - P3-D65", "Apple DCI-P3 D65"}},
    {Curve::linear,
     k_rec2020,
     {"Linear Rec.2020", "Linear BT.2020", "Linear BT.2020 I-D65", "lin_rec2020", "lin_rec2020_scene",
      "Utility - Linear - Rec.2020"}},
    {Curve::linear,
     k_ap0,
     {"ACES2065-1", "Linear ACES", "aces2065_1", "ACES - ACES2065-1", "lin_ap0", "lin_ap0_scene",
      "ACES: Linear - AP0"}},
    {Curve::linear,
     k_ap1,
     {"ACEScg", "Linear ACEScg", "lin_ap1", "lin_ap1_scene", "ACES - ACEScg", "ACEScg: Linear - AP1"}},
    {Curve::linear, k_e_gamut, {"Linear FilmLight E-Gamut", "Linear E-Gamut I-D65", "FilmLight: Linear - E-Gamut"}},
    {Curve::srgb,
     k_p3,
     {"Display P3", "Display P3 2.2", "Display P3 I-D65", "P3-D65 - Display", "p3_d65_display", "p3d65_display",
      "srgb_p3d65_display", "srgb_p3d65_scene", "AppleP3 sRGB OETF"}},
    {Curve::video,
     k_rec709,
     {"Rec.1886", "BT.1886", "BT.1886 2.4", "BT.1886 EOTF", "BT.1886 I-D65", "g24_rec709_display",
      "Rec.1886 / Rec.709 Video - Display", "Rec.1886 Rec.709 - Display", "rec1886_rec709_display",
      "rec1886_rec709_video_display", "Rec1886: 2.4 Gamma - Rec.709"}},
    {Curve::video,
     k_rec2020,
     {"Rec.2020", "BT.2020", "BT.2020 2.4", "BT.2020 I-D65", "g24_rec2020_display",
      "Rec.1886 / Rec.2020 Video - Display", "Rec.1886 Rec.2020 - Display", "rec1886_rec2020_display",
      "rec1886_rec2020_video_display", "Rec1886: 2.4 Gamma - Rec.2020"}},
};

class StandardProcessor : public ColorProcessor {
public:
    explicit StandardProcessor(const Space& space) : space_(space) {}

    void apply(float* rgba, std::size_t count) const override {
        const Primaries& p = space_.primaries;
        for (float* end = rgba + 4 * count; rgba != end; rgba += 4) {
            const float r = linear(rgba[0]), g = linear(rgba[1]), b = linear(rgba[2]);
            for (int c = 0; c < 3; ++c) rgba[c] = p.r[c] * r + p.g[c] * g + p.b[c] * b;
        }
    }

private:
    float linear(float v) const {
        if (space_.curve == Curve::srgb) return linear_from_srgb(v);
        return space_.curve == Curve::video ? std::pow(std::fmax(v, 0.0f), 2.4f) : v;
    }

    const Space& space_;
};

}  // namespace

std::shared_ptr<const ColorProcessor> standard_space(const std::string& name) {
    for (const Space& space : k_spaces) {
        for (const std::string_view known : space.names)
            if (known == name) return std::make_shared<StandardProcessor>(space);
    }
    return nullptr;
}

}  // namespace cardioid::image
