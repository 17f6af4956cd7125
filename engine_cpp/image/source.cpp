// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/source.h"

#include "scene/error.h"
#include "scene/image_path.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

namespace cardioid::image {
using scene::SceneError;
namespace {

/// Floats of the description. They are copied into tiles at once, so nothing is kept.
class PixelSource : public Source {
public:
    explicit PixelSource(const scene::ImageDesc& image) : pixels_(image.pixels) {
        const std::uint64_t expected = std::uint64_t(std::max(image.width, 0)) *
                                       std::uint64_t(std::max(image.height, 0)) *
                                       std::uint64_t(std::max(image.channels, 0));
        if (expected == 0 || expected != pixels_.size() || image.channels > 4) throw SceneError("has no pixels");
        if (image.width > k_largest_side || image.height > k_largest_side) throw SceneError("is too large");
        info_ = {image.width,   image.height, image.channels,
                 Storage::real, false,        image.alpha_mode == scene::AlphaMode::straight};
    }
    void read_all(int first, const RowReceiver& receive) override {
        const std::size_t row = static_cast<std::size_t>(info_.width) * static_cast<std::size_t>(info_.channels);
        std::vector<float> band(row * k_tile);
        for (int y = 0; y < info_.height;) {
            const int rows = std::min(y == 0 ? first : k_tile, info_.height - y);
            for (int r = 0; r < rows; ++r)
                std::memcpy(&band[row * static_cast<std::size_t>(r)],
                            &pixels_[row * static_cast<std::size_t>(info_.height - 1 - y - r)], row * sizeof(float));
            receive(y, rows, reinterpret_cast<const std::byte*>(band.data()));
            y += rows;
        }
    }
    void read_part(int, int, int, int, std::byte*) override { throw SceneError("is read whole"); }
    bool repeatable() const override { return false; }

private:
    const std::vector<float>& pixels_;
};

}  // namespace

std::unique_ptr<Source> open_source(const scene::ImageDesc& image, FileCache& cache) {
    if (image.source == scene::ImageSource::pixels) return std::make_unique<PixelSource>(image);
    if (image.source == scene::ImageSource::packed) {
        if (image.packed.empty()) throw SceneError("is packed but empty");
        return open_file(image, cache);
    }
    std::error_code error;
    if (image.path.empty()) throw SceneError("has no file");
    const std::string file = scene::image_path(image.path).file;
    if (!std::filesystem::exists(file, error)) throw SceneError("is missing: '" + file + "' does not exist");
    if (!std::filesystem::is_regular_file(file, error)) throw SceneError("is not a file: '" + image.path + "'");
    return open_file(image, cache);
}

}  // namespace cardioid::image
