// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/source.h"

#include "image/memory_file.h"
#include "scene/error.h"
#include "scene/image_path.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>

namespace cardioid::image {
namespace {

using scene::SceneError;

OIIO::TypeDesc oiio_type(Storage storage) {
    switch (storage) {
        case Storage::byte: return OIIO::TypeUInt8;
        case Storage::ushort: return OIIO::TypeUInt16;
        case Storage::half: return OIIO::TypeHalf;
        case Storage::real: break;
    }
    return OIIO::TypeFloat;
}

Storage storage_for(const OIIO::ImageSpec& spec) {
    bool real = spec.format.is_floating_point(), half = spec.format == OIIO::TypeHalf;
    for (const OIIO::TypeDesc& channel : spec.channelformats) {
        real = real || channel.is_floating_point();
        half = half && channel == OIIO::TypeHalf;
    }
    if (half) return Storage::half;
    if (real) return Storage::real;
    return spec.format.basesize() > 1 ? Storage::ushort : Storage::byte;
}

OIIO::ImageSpec open_options() {
    OIIO::ImageSpec options;
    // Multiplying bytes by alpha would lose what is under low alphas; it is done in floats later.
    options.attribute("oiio:UnassociatedAlpha", 1);
    return options;
}

/// Formats whose readers do not say it: Targa is straight unless it is marked, DDS and PSD always.
bool has_straight_alpha(const OIIO::ImageSpec& spec, std::string_view format) {
    if (spec.get_int_attribute("oiio:UnassociatedAlpha") != 0) return true;
    if (spec.alpha_channel < 0) return false;
    constexpr int premultiplied = 4;
    if (format == "targa") return spec.get_int_attribute("targa:alpha_type", -1) != premultiplied;
    return format == "dds" || format == "psd";
}

/// A name with the extension of the format that the bytes begin like, so that the right reader is tried first; else
/// empty.
std::string name_by_content(const std::vector<std::uint8_t>& bytes) {
    struct Format {
        std::string_view start;
        std::size_t at;
        const char* name;
    };
    using namespace std::string_view_literals;
    static constexpr Format formats[] = {{"\x89PNG"sv, 0, "packed.png"},
                                         {"\xff\xd8\xff"sv, 0, "packed.jpg"},
                                         {"\x76\x2f\x31\x01"sv, 0, "packed.exr"},
                                         {"#?"sv, 0, "packed.hdr"},
                                         {"II*\0"sv, 0, "packed.tif"},
                                         {"MM\0*"sv, 0, "packed.tif"},
                                         {"BM"sv, 0, "packed.bmp"},
                                         {"WEBP"sv, 8, "packed.webp"},
                                         {"SDPX"sv, 0, "packed.dpx"},
                                         {"XPDS"sv, 0, "packed.dpx"},
                                         {"GIF8"sv, 0, "packed.gif"},
                                         {"DDS "sv, 0, "packed.dds"},
                                         {"8BPS"sv, 0, "packed.psd"},
                                         {"jP  "sv, 4, "packed.jp2"},
                                         {"TRUEVISION"sv, std::string::npos, "packed.tga"}};
    const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (const Format& format : formats) {
        // Targa files sign at their end, 18 bytes before it.
        const std::size_t at = format.at != std::string::npos ? format.at : all.size() < 18 ? 0 : all.size() - 18;
        if (all.size() > at && all.substr(at, format.start.size()) == format.start) return format.name;
    }
    return {};
}

std::string first_line(std::string text) {
    if (const auto end = text.find('\n'); end != std::string::npos) text.resize(end);
    return text;
}

}  // namespace

struct FileCache::Impl {
    OIIO::ImageCache* cache = OIIO::ImageCache::create(false);
    ~Impl() { OIIO::ImageCache::destroy(cache); }
};

FileCache::FileCache(int megabytes) : impl_(std::make_unique<Impl>()) {
    impl_->cache->attribute("max_memory_MB", static_cast<float>(megabytes));
    impl_->cache->attribute("max_open_files", 100);
    impl_->cache->attribute("autotile", k_tile);
    impl_->cache->attribute("autoscanline", 1);
    impl_->cache->attribute("unassociatedalpha", 1);
}
FileCache::~FileCache() = default;

std::int64_t FileCache::memory_bytes() const {
    long long used = 0;
    impl_->cache->getattribute("stat:cache_memory_used", OIIO::TypeInt64, &used);
    return used;
}

/// Opened for each reading, so that no file stays open.
class FileSource : public Source {
public:
    FileSource(const scene::ImageDesc& image, FileCache& cache)
        : cache_(*cache.impl_->cache),
          path_(scene::image_path(image.path).file),
          frame_(scene::image_path(image.path).frame),
          packed_(image.packed),
          in_memory_(image.source == scene::ImageSource::packed) {
        const Opened in = open();
        const OIIO::ImageSpec& spec = in.input->spec();
        if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) throw SceneError("has no pixels");
        if (spec.width > k_largest_side || spec.height > k_largest_side)
            throw SceneError("has a size of " + std::to_string(spec.width) + " × " + std::to_string(spec.height) +
                             ", which is too large");
        if (spec.depth > 1) throw SceneError("is a volume, not a picture");
        info_.width = spec.width, info_.height = spec.height, info_.channels = spec.nchannels;
        info_.storage = storage_for(spec);
        info_.straight_alpha = has_straight_alpha(spec, in.input->format_name());
        info_.tiled = spec.tile_width > 0 && !in_memory_;
        left_ = spec.x, top_ = spec.y;
        tile_height_ = spec.tile_width > 0 ? spec.tile_height : 0;
    }

    void read_all(int first, const RowReceiver& receive) override {
        const Opened in = open();
        if (in.input->spec().width != info_.width || in.input->spec().height != info_.height ||
            in.input->spec().nchannels != info_.channels)
            throw SceneError("changed while it was read");
        if (tile_height_ > 0) return read_tile_rows(*in.input, first, receive);
        std::vector<std::byte> band(row_bytes() * k_tile);
        for (int y = 0; y < info_.height;) {
            const int rows = std::min(y == 0 ? first : k_tile, info_.height - y);
            if (!in.input->read_scanlines(frame_, 0, top_ + y, top_ + y + rows, 0, 0, info_.delivered(),
                                          oiio_type(info_.storage), band.data()))
                throw SceneError("is damaged: " + first_line(in.input->geterror()));
            receive(y, rows, band.data());
            y += rows;
        }
    }

    void read_part(int x, int y, int width, int height, std::byte* texels) override {
        const OIIO::ustring name(path_);
        if (cache_.get_pixels(name, frame_, 0, left_ + x, left_ + x + width, top_ + y, top_ + y + height, 0, 1, 0,
                              info_.delivered(), oiio_type(info_.storage), texels))
            return;
        throw SceneError("is damaged: " + first_line(cache_.geterror()));
    }

private:
    struct Opened {
        // Both outlive the input that reads from them.
        std::unique_ptr<OIIO::Filesystem::IOMemReader> memory;
        std::unique_ptr<MemoryFile> file;
        std::unique_ptr<OIIO::ImageInput> input;
    };

    Opened open() const {
        const OIIO::ImageSpec options = open_options();
        Opened in;
        if (in_memory_) {
            if (const std::string name = name_by_content(packed_); !name.empty()) {
                in.memory = std::make_unique<OIIO::Filesystem::IOMemReader>(packed_.data(), packed_.size());
                in.input = OIIO::ImageInput::open(name, &options, in.memory.get());
            }
            if (!in.input) {
                (void)OIIO::geterror();
                in.file = std::make_unique<MemoryFile>(packed_);
                in.input = OIIO::ImageInput::open(in.file->path(), &options);
            }
        } else {
            in.input = OIIO::ImageInput::open(path_, &options);
        }
        if (!in.input) throw SceneError("cannot be read: " + first_line(OIIO::geterror()));
        if (frame_ > 0 && !in.input->seek_subimage(frame_, 0))
            throw SceneError("has no frame " + std::to_string(frame_ + 1));
        return in;
    }

    std::size_t row_bytes() const {
        return static_cast<std::size_t>(info_.width) * channel_bytes(info_.storage) *
               static_cast<std::size_t>(info_.delivered());
    }

    /// Files of tiles deliver whole rows of tiles; cut them into the bands that are wanted.
    void read_tile_rows(OIIO::ImageInput& in, int first, const RowReceiver& receive) const {
        std::vector<std::byte> held;  // rows [begin, end)
        int begin = 0, end = 0;
        for (int y = 0; y < info_.height;) {
            const int rows = std::min(y == 0 ? first : k_tile, info_.height - y);
            held.erase(held.begin(),
                       held.begin() + static_cast<std::ptrdiff_t>(row_bytes() * static_cast<std::size_t>(y - begin)));
            begin = y;
            while (end < y + rows) {
                const int next = std::min(end + tile_height_, info_.height);
                held.resize(row_bytes() * static_cast<std::size_t>(next - begin));
                std::byte* to = held.data() + row_bytes() * static_cast<std::size_t>(end - begin);
                if (!in.read_tiles(frame_, 0, left_, left_ + info_.width, top_ + end, top_ + next, 0, 1, 0,
                                   info_.delivered(), oiio_type(info_.storage), to))
                    throw SceneError("is damaged: " + first_line(in.geterror()));
                end = next;
            }
            receive(y, rows, held.data());
            y += rows;
        }
    }

    OIIO::ImageCache& cache_;
    std::string path_;
    int frame_;  ///< of a file of several pictures
    std::vector<std::uint8_t> packed_;
    bool in_memory_;
    int left_ = 0, top_ = 0, tile_height_ = 0;
};

std::unique_ptr<Source> open_file(const scene::ImageDesc& image, FileCache& cache) {
    return std::make_unique<FileSource>(image, cache);
}

}  // namespace cardioid::image
