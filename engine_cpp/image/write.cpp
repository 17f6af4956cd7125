// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/write.h"

#include "image/half.h"
#include "image/srgb.h"
#include "scene/error.h"
#include "scene/replace_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

namespace cardioid::image {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& why) {
    throw scene::SceneError("cannot write '" + path + "': " + why);
}

void check_size(const std::string& path, int width, int height, std::size_t channels, std::size_t values) {
    const bool sane = width > 0 && height > 0 && channels > 0;
    if (!sane || static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channels != values)
        fail(path, std::to_string(values) + " values for " + std::to_string(width) + " × " + std::to_string(height) +
                       " pixels of " + std::to_string(channels) + " channels");
}

struct Stream {
    explicit Stream(std::FILE* opened) : file(opened) {}
    ~Stream() {
        if (file) std::fclose(file);
    }
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;
    /// Everything that was written is in the file.
    bool complete() {
        const bool good = std::fflush(file) == 0 && std::ferror(file) == 0;
        return std::fclose(std::exchange(file, nullptr)) == 0 && good;
    }
    std::FILE* file;
};

template <class T>
void write_rows(const std::string& path, const std::string& format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                const T* pixels) {
    const auto row = static_cast<OIIO::stride_t>(spec.width) * spec.nchannels;
    const T* top = pixels + row * (spec.height - 1);
    scene::replace_file_by_name(path, [&](const std::string& temporary) {
        const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(format);
        if (!out) fail(path, OIIO::geterror());
        // A stream of our own, because OIIO's PNG writer does not report a full disk.
        Stream stream(std::fopen(temporary.c_str(), "wb"));
        if (!stream.file) fail(path, std::strerror(errno));
        OIIO::Filesystem::IOFile proxy(stream.file, OIIO::Filesystem::IOProxy::Write);
        const bool written =
            out->set_ioproxy(&proxy) && out->open(temporary, spec) &&
            out->write_image(type, top, OIIO::AutoStride, -row * static_cast<OIIO::stride_t>(sizeof(T))) &&
            out->close();
        if (!stream.complete()) fail(path, std::strerror(errno));
        if (!written) fail(path, out->has_error() ? out->geterror() : "the file could not be completed");
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
    OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()),
                         depth == Depth::half ? OIIO::TypeHalf : OIIO::TypeFloat);
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
