// SPDX-License-Identifier: GPL-3.0-or-later
// Image files for the tests, written through OpenImageIO into a folder that goes away.
#pragma once

#include "scene/scene_desc.h"

#include <OpenImageIO/imageio.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace cardioid::image::test {

class Folder {
public:
    Folder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "cardioid-image-XXXXXX").string();
        if (!::mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
        path_ = pattern;
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::string file(const std::string& name) const { return (path_ / name).string(); }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

struct FileOptions {
    int width = 8, height = 8, channels = 3;
    OIIO::TypeDesc type = OIIO::TypeUInt8;
    int tile = 0;
    std::vector<std::pair<std::string, std::string>> attributes = {};
};

/// Value of channel c at pixel (x, y), y from the top, in 0…1 for integer formats.
using Pattern = std::function<float(int x, int y, int c)>;

inline void write_file(const std::string& path, const FileOptions& o, const Pattern& pattern) {
    OIIO::ImageSpec spec(o.width, o.height, o.channels, o.type);
    if (o.tile > 0) spec.tile_width = spec.tile_height = o.tile;
    // The pattern is what the file shall hold; OIIO would divide by alpha otherwise.
    spec.attribute("oiio:UnassociatedAlpha", 1);
    for (const auto& [key, value] : o.attributes) spec.attribute(key, value);
    std::vector<float> pixels;
    for (int y = 0; y < o.height; ++y)
        for (int x = 0; x < o.width; ++x)
            for (int c = 0; c < o.channels; ++c) pixels.push_back(pattern(x, y, c));
    const auto out = OIIO::ImageOutput::create(path);
    if (!out || !out->open(path, spec) || !out->write_image(OIIO::TypeFloat, pixels.data()) || !out->close())
        throw std::runtime_error("cannot write " + path);
}

inline std::vector<std::uint8_t> bytes_of_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_bytes(const std::string& path, const std::vector<std::uint8_t>& bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

inline scene::ImageDesc file_image(const std::string& path, const std::string& colorspace = "Non-Color") {
    scene::ImageDesc image;
    image.name = std::filesystem::path(path).filename().string();
    image.path = path;
    image.colorspace = colorspace;
    return image;
}

inline scene::ImageDesc packed_image(const std::string& path, const std::string& colorspace = "Non-Color") {
    scene::ImageDesc image = file_image(path, colorspace);
    image.source = scene::ImageSource::packed;
    image.packed = bytes_of_file(path);
    image.path.clear();
    return image;
}

/// Floats, bottom row first.
inline scene::ImageDesc pixel_image(int width, int height, int channels, std::vector<float> pixels,
                                    const std::string& colorspace = "Non-Color") {
    scene::ImageDesc image;
    image.name = "pixels";
    image.source = scene::ImageSource::pixels;
    image.width = width, image.height = height, image.channels = channels;
    image.pixels = std::move(pixels);
    image.colorspace = colorspace;
    return image;
}

}  // namespace cardioid::image::test
