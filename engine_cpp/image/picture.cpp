// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/picture.h"

#include "image/half.h"
#include "scene/error.h"

#include <cstring>
#include <vector>

namespace cardioid::image {
namespace {

using scene::AlphaMode;

/// Magenta in any format.
void fill_magenta(std::byte* tile, const Texture& texture) {
    const float color[4] = {1, texture.channels == 1 ? 1.0f : 0.0f, 1, 1};
    std::byte texel[16];
    for (int c = 0; c < texture.channels; ++c) {
        const std::size_t size = channel_bytes(texture.storage);
        const std::uint8_t byte = color[c] != 0 ? 255 : 0;
        const std::uint16_t ushort = color[c] != 0 ? 65535 : 0, half = half_from_float(color[c]);
        const void* from = texture.storage == Storage::byte     ? static_cast<const void*>(&byte)
                           : texture.storage == Storage::ushort ? static_cast<const void*>(&ushort)
                           : texture.storage == Storage::half   ? static_cast<const void*>(&half)
                                                                : static_cast<const void*>(&color[c]);
        std::memcpy(texel + size * static_cast<std::size_t>(c), from, size);
    }
    for (std::size_t at = 0; at < texture.tile_bytes(); at += texture.texel_bytes())
        std::memcpy(tile + at, texel, texture.texel_bytes());
}

/// Texels of the tile that lie in the picture.
int tile_width(const Texture& t, int tile) { return std::min(k_tile, t.width - (tile % t.tiles_x) * k_tile); }
int tile_height(const Texture& t, int tile) { return std::min(k_tile, t.height - (tile / t.tiles_x) * k_tile); }

}  // namespace

Picture::Picture() {
    texture_.storage = Storage::real;
    texture_.resize(1, 1);
}

Picture::Picture(const scene::ImageDesc& image, std::string label, std::unique_ptr<Source> source, ColorSpace space)
    : label_(std::move(label)), source_(std::move(source)) {
    const SourceInfo& info = source_->info();
    const bool data = space.transfer == Transfer::data, alpha_in_file = info.delivered() % 2 == 0;
    const bool separate = data || image.alpha_mode == AlphaMode::channel_packed || image.alpha_mode == AlphaMode::none;
    has_alpha_ = alpha_in_file && image.alpha_mode != AlphaMode::none;
    conversion_.source = info;
    conversion_.space = std::move(space);
    conversion_.ignore_alpha = image.alpha_mode == AlphaMode::none;
    conversion_.associated = has_alpha_ && !separate && !info.straight_alpha;
    choose_format(texture_, conversion_);
    // Cycles forgets to multiply the colours of grey files by their alpha, and then divides by it.
    const bool forgotten = image.source == scene::ImageSource::file && info.channels != 4;
    const bool multiplied = has_alpha_ && !separate && info.straight_alpha && !forgotten;
    conversion_.multiply = multiplied && info.channels == 4;
    texture_.associate = multiplied && !conversion_.multiply;
    texture_.may_divide = has_alpha_ && !separate;
    texture_.resize(info.width, info.height);
}

void Picture::make_evictable(SpillFile& spill) {
    texture_.evictable = true;
    if (tiled()) return;
    spill_ = &spill;
    spill_begin_ = spill.allocate(texture_.bytes());
}

void Picture::publish(int tile, TileMemory memory, TileCache& cache) {
    if (!cache.publish(texture_, tile, std::move(memory)))
        cache.release(static_cast<std::int64_t>(texture_.tile_bytes()));
}

std::string Picture::load(int tile, TileCache& cache) {
    // Without the lock: any number of threads can read tiles back.
    if (spilled_.load() && load_spilled(tile, cache)) return {};
    const std::lock_guard one_at_a_time(loading_);
    if (texture_.tiles[tile].load() || (spilled_.load() && load_spilled(tile, cache))) return {};
    std::string problem;
    try {
        if (!source_ || failed_)
            load_magenta(tile, cache);
        else if (in_parts())
            load_part(tile, cache);
        else
            load_whole(cache);
        return {};
    } catch (const scene::SceneError& error) { problem = error.what(); } catch (const std::exception& error) {
        problem = std::string("cannot be loaded: ") + error.what();
    }
    const bool first = !failed_;
    failed_ = true;
    if (!texture_.tiles[tile].load()) load_magenta(tile, cache);
    return first ? problem : std::string();
}

void Picture::load_whole(TileCache& cache) {
    const std::int64_t tile_bytes = static_cast<std::int64_t>(texture_.tile_bytes());
    int row = texture_.tiles_y - 1;
    bool all_spilled = spill_ != nullptr;
    source_->read_all(texture_.height - row * k_tile, [&](int, int rows, const std::byte* texels) {
        for (int column = 0; column < texture_.tiles_x; ++column) {
            const int tile = row * texture_.tiles_x + column;
            if (!all_spilled && texture_.tiles[tile].load()) continue;
            cache.reserve(tile_bytes);
            TileMemory memory = new_tile(texture_);
            const std::size_t texel =
                channel_bytes(conversion_.source.storage) * static_cast<std::size_t>(conversion_.source.delivered());
            non_finite_ += fill_tile(memory.get(), texture_, conversion_,
                                     texels + texel * static_cast<std::size_t>(column) * k_tile,
                                     static_cast<std::size_t>(texture_.width), tile_width(texture_, tile), rows);
            all_spilled = all_spilled && spill_->write(spill_place(tile), {memory.get(), texture_.tile_bytes()});
            publish(tile, std::move(memory), cache);
        }
        --row;
    });
    spilled_ = all_spilled;
}

bool Picture::load_spilled(int tile, TileCache& cache) {
    cache.reserve(static_cast<std::int64_t>(texture_.tile_bytes()));
    TileMemory memory = new_tile(texture_);
    const bool read = spill_->read(spill_place(tile), {memory.get(), texture_.tile_bytes()});
    if (read)
        publish(tile, std::move(memory), cache);
    else
        cache.release(static_cast<std::int64_t>(texture_.tile_bytes()));
    return read;
}

void Picture::load_part(int tile, TileCache& cache) {
    const int width = tile_width(texture_, tile), height = tile_height(texture_, tile);
    const int x = (tile % texture_.tiles_x) * k_tile, bottom = (tile / texture_.tiles_x) * k_tile;
    std::vector<std::byte> texels(std::size_t{k_tile} * k_tile * 16);
    source_->read_part(x, texture_.height - bottom - height, width, height, texels.data());
    cache.reserve(static_cast<std::int64_t>(texture_.tile_bytes()));
    TileMemory memory = new_tile(texture_);
    non_finite_ +=
        fill_tile(memory.get(), texture_, conversion_, texels.data(), static_cast<std::size_t>(width), width, height);
    publish(tile, std::move(memory), cache);
}

void Picture::load_magenta(int tile, TileCache& cache) {
    cache.reserve(static_cast<std::int64_t>(texture_.tile_bytes()));
    TileMemory memory = new_tile(texture_);
    fill_magenta(memory.get(), texture_);
    publish(tile, std::move(memory), cache);
}

}  // namespace cardioid::image
