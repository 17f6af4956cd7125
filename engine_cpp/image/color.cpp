// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/color.h"

#include "image/color_standard.h"
#include "image/srgb.h"

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string_view>

namespace OCIO = OCIO_NAMESPACE;

namespace cardioid::image {

namespace {

class ConfigProcessor : public ColorProcessor {
public:
    explicit ConfigProcessor(OCIO::ConstCPUProcessorRcPtr cpu) : cpu_(std::move(cpu)) {}
    void apply(float* rgba, std::size_t count) const override {
        OCIO::PackedImageDesc pixels(rgba, static_cast<long>(count), 1, 4);
        cpu_->apply(pixels);
    }
    void apply(float rgb[3]) const { cpu_->applyRGB(rgb); }

private:
    OCIO::ConstCPUProcessorRcPtr cpu_;
};

}  // namespace

void ColorSpace::to_linear(float* rgba, std::size_t count) const {
    if (processor) processor->apply(rgba, count);
}

namespace {

// Names and common aliases in the configurations of Blender 3.4 to 5.x.
constexpr std::string_view k_srgb[] = {
    "sRGB",    "sRGB OETF",    "sRGB 2.2",     "sRGB I-D65",        "sRGB - Texture",      "sRGB - Display",
    "srgb_tx", "srgb_texture", "srgb_display", "srgb_rec709_scene", "srgb_rec709_display", "Utility - sRGB - Texture"};
constexpr std::string_view k_linear[] = {"Linear",
                                         "Linear Rec.709",
                                         "Linear BT.709",
                                         "Linear BT.709 I-D65",
                                         "Linear Rec.709 (sRGB)",
                                         "Rec.709",
                                         "scene_linear",
                                         "lin_srgb",
                                         "lin_rec709",
                                         "lin_rec709_srgb",
                                         "lin_rec709_scene",
                                         "Utility - Linear - sRGB",
                                         "Utility - Linear - Rec.709"};
constexpr std::string_view k_data[] = {"Non-Color", "Non-Colour Data", "Raw",  "raw", "Generic Data",
                                       "data",      "Utility - Raw",   "None", ""};

template <std::size_t n>
bool among(const std::string_view (&names)[n], const std::string& name) {
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

ColorSpace built_in(const std::string& name, bool is_float) {
    if (among(k_data, name)) return {Transfer::data, true, nullptr};
    if (among(k_srgb, name)) return {Transfer::srgb, true, nullptr};
    if (among(k_linear, name)) return {Transfer::none, true, nullptr};
    if (auto processor = standard_space(name)) return {Transfer::convert, true, std::move(processor)};
    return {is_float ? Transfer::none : Transfer::srgb, false, nullptr};
}

/// OCIO's messages begin by quoting the file; the end says why.
std::string last_line(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    const auto at = text.rfind('\n');
    return at == std::string::npos ? text : text.substr(at + 1);
}

/// As Cycles judges two values of a curve alike.
bool alike(float a, float b) {
    if (std::abs(a - b) < 1e-6f) return true;
    if ((a < 0) != (b < 0)) return false;
    return std::abs(std::bit_cast<std::int32_t>(a) - std::bit_cast<std::int32_t>(b)) < 64;
}

/// none or srgb if the processor does just that, so that texels can stay as they are; otherwise convert.
Transfer recognise(const ConfigProcessor& processor) {
    bool linear = true, srgb = true;
    for (int i = 0; i < 256; ++i) {
        const float v = static_cast<float>(i) / 255;
        std::array<float, 3> white{v, v, v};
        processor.apply(white.data());
        for (std::size_t c = 0; c < 3; ++c) {
            std::array<float, 3> single{};
            single[c] = v;
            processor.apply(single.data());
            for (std::size_t other = 0; other < 3; ++other)
                if (other != c && std::abs(single[other]) > 1e-5f) return Transfer::convert;
            if (!alike(single[c], white[c]) || !alike(white[c], white[0])) return Transfer::convert;
        }
        linear = linear && alike(white[0], v);
        srgb = srgb && alike(white[0], linear_from_srgb(v));
        if (!linear && !srgb) return Transfer::convert;
    }
    return linear ? Transfer::none : Transfer::srgb;
}

}  // namespace

struct ColorSpaces::Impl {
    std::string path, problem;
    bool loaded = false, checked = false, is_plain = false, is_other = false;
    OCIO::ConstConfigRcPtr config;
    std::map<std::string, ColorSpace> found;

    void load() {
        loaded = true;
        if (path.empty()) return;
        std::error_code error;
        if (!std::filesystem::exists(path, error)) {
            problem = "'" + path + "' does not exist";
            return;
        }
        try {
            config = OCIO::Config::CreateFromFile(path.c_str());
        } catch (const std::exception& bad) { problem = last_line(bad.what()); }
    }

    /// The file's scene_linear role is Rec.709, so that standard names mean what they mean without it. Reading the
    /// whole configuration takes up to a tenth of a second, and most scenes use standard names only.
    bool plain() {
        if (!checked) {
            checked = true;
            std::ifstream file(path);
            std::string line;
            while (!is_plain && std::getline(file, line)) {
                const auto at = line.find("scene_linear:");
                if (at == std::string::npos) continue;
                const auto begin = line.find_first_not_of(" \t", at + 13), end = line.find_last_not_of(" \t\r");
                if (begin == std::string::npos) break;
                is_plain = among(k_linear, line.substr(begin, end - begin + 1));
                is_other = !is_plain;
                break;
            }
        }
        return is_plain;
    }

    /// False: the configuration does not know the name or cannot convert it.
    bool from_config(const std::string& name, ColorSpace& out) const {
        try {
            const OCIO::ConstColorSpaceRcPtr space = config->getColorSpace(name.c_str());
            if (!space) return false;
            if (space->isData()) {
                out = {Transfer::data, true, nullptr};
                return true;
            }
            auto processor = std::make_shared<ConfigProcessor>(
                config->getProcessor(name.c_str(), OCIO::ROLE_SCENE_LINEAR)->getDefaultCPUProcessor());
            out = {recognise(*processor), true, nullptr};
            if (out.transfer == Transfer::convert) out.processor = std::move(processor);
            return true;
        } catch (const std::exception&) { return false; }
    }
};

ColorSpaces::ColorSpaces(const std::string& config_path) : impl_(std::make_unique<Impl>()) {
    impl_->path = config_path;
}
ColorSpaces::~ColorSpaces() = default;

const std::string& ColorSpaces::config_problem() const { return impl_->problem; }

ColorSpace ColorSpaces::find(const std::string& name, bool is_float) {
    const ColorSpace standard = built_in(name, is_float);
    const bool asks_nothing = standard.transfer == Transfer::data || impl_->path.empty();
    if (standard.known && (asks_nothing || (standard.transfer != Transfer::convert && impl_->plain()))) return standard;
    if (!impl_->loaded) impl_->load();
    if (!impl_->config) {
        // Without its primaries nothing comes out in the working space that it asks for.
        ColorSpace guess = standard;
        guess.known = guess.known && !impl_->is_other;
        return guess;
    }
    auto [entry, fresh] = impl_->found.try_emplace(name);
    if (fresh && !impl_->from_config(name, entry->second)) entry->second.known = false;
    if (entry->second.known) return entry->second;
    ColorSpace guess = standard;
    // A matrix to Rec.709 is not one to the working space.
    guess.known = guess.known && (guess.transfer != Transfer::convert || impl_->plain());
    return guess;
}

}  // namespace cardioid::image
