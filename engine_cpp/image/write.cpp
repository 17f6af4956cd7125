// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/write.h"

#include "image/half.h"
#include "image/srgb.h"
#include "scene/error.h"
#include "scene/replace_file.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>

namespace cardioid::image {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& why) {
    throw scene::SceneError("cannot write '" + path + "': " + why);
}

void check_size(const std::string& path, int width, int height, std::size_t channels, std::size_t values) {
    const bool sane = width > 0 && height > 0 && channels > 0;
    if (!sane || static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channels != values)
        fail(path, std::to_string(values) + " values for " + std::to_string(width) + " × " + std::to_string(height) + " pixels of " +
                       std::to_string(channels) + " channels");
}

/// `top`: the first value of the top row; rows follow at -row values.
template <class T>
void write_rows(const std::string& path, const std::string& format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const T* pixels) {
    const auto row = static_cast<OIIO::stride_t>(spec.width) * spec.nchannels;
    const T* top = pixels + row * (spec.height - 1);
    scene::replace_file_by_name(path, [&](const std::string& temporary) {
        const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(format);
        if (!out) fail(path, OIIO::geterror());
        const bool written = out->open(temporary, spec) &&
                             out->write_image(type, top, OIIO::AutoStride, -row * static_cast<OIIO::stride_t>(sizeof(T)));
        // Closing writes what is still held, so it can be the call that finds the disk full.
        const bool closed = written && out->close();
        if (!closed) fail(path, out->has_error() ? out->geterror() : "the file could not be completed");
    });
}

std::uint8_t encoded(float linear) {
    const float value = linear > 0 ? srgb_from_linear(std::min(linear, 1.0f)) : 0.0f;
    return static_cast<std::uint8_t>(value * 255.0f + 0.5f);
}

}  // namespace

void write_exr(const std::string& path, int width, int height, const std::vector<std::string>& channels,
               std::span<const float> pixels, const std::map<std::string, std::string>& metadata, Depth depth) {
    check_size(path, width, height, channels.size(), pixels.size());
    OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()), depth == Depth::half ? OIIO::TypeHalf : OIIO::TypeFloat);
    spec.channelnames = channels;
    spec.alpha_channel = -1;
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    for (const auto& [key, text] : metadata) spec.attribute(key, text);
    if (depth == Depth::real) return write_rows(path, "openexr", spec, OIIO::TypeFloat, pixels.data());
    std::vector<std::uint16_t> halves(pixels.size());
    std::transform(pixels.begin(), pixels.end(), halves.begin(),
                   [](float value) { return half_from_float(std::isnan(value) ? 0.0f : value); });
    write_rows(path, "openexr", spec, OIIO::TypeHalf, halves.data());
}

void write_png(const std::string& path, int width, int height, int channels, std::span<const float> pixels) {
    if (channels != 3 && channels != 4) fail(path, "a PNG has 3 or 4 channels, not " + std::to_string(channels));
    check_size(path, width, height, static_cast<std::size_t>(channels), pixels.size());
    std::vector<std::uint8_t> bytes(pixels.size());
    const auto step = static_cast<std::size_t>(channels);
    for (std::size_t at = 0; at < pixels.size(); at += step) {
        const float alpha = channels == 4 ? std::clamp(pixels[at + 3], 0.0f, 1.0f) : 1.0f;
        const float scale = alpha > 0 ? 1 / alpha : 1.0f;
        for (std::size_t c = 0; c < 3; ++c) bytes[at + c] = encoded(pixels[at + c] * scale);
        if (channels == 4) bytes[at + 3] = static_cast<std::uint8_t>(alpha * 255.0f + 0.5f);
    }
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeUInt8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    // The bytes are straight already.
    spec.attribute("oiio:UnassociatedAlpha", 1);
    write_rows(path, "png", spec, OIIO::TypeUInt8, bytes.data());
}

}  // namespace cardioid::image
