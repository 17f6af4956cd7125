// SPDX-License-Identifier: GPL-3.0-or-later
// An image as the sampler reads it: a table of square tiles, each loaded or not. Rows run from the bottom.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace cardioid::image {

inline constexpr int k_tile_shift = 6;
inline constexpr int k_tile = 1 << k_tile_shift;  ///< texels along a side

/// What a texel's channel is: 0…255, 0…65535, an IEEE half, a float.
enum class Storage : std::uint8_t { byte, ushort, half, real };

constexpr std::size_t channel_bytes(Storage storage) {
    return storage == Storage::byte ? 1 : storage == Storage::real ? 4 : 2;
}

struct Texture {
    int width = 0, height = 0, tiles_x = 0, tiles_y = 0;
    Storage storage = Storage::byte;
    int channels = 4;         ///< 1 (grey, alpha is 1) or 4
    bool srgb = false;        ///< texels are sRGB-encoded: linearised after interpolation, as Cycles does
    bool associate = false;   ///< texels have straight alpha: multiplied before interpolation
    bool may_divide = false;  ///< colour may be divided by alpha (not data, not packed channels)
    bool evictable = false;   ///< tiles may leave the cache, so their use is marked
    std::unique_ptr<std::atomic<const std::byte*>[]> tiles;
    std::unique_ptr<std::atomic<bool>[]> used;

    int tile_count() const { return tiles_x * tiles_y; }
    std::size_t texel_bytes() const { return channel_bytes(storage) * static_cast<std::size_t>(channels); }
    std::size_t tile_bytes() const { return texel_bytes() * k_tile * k_tile; }
    std::int64_t bytes() const { return static_cast<std::int64_t>(tile_bytes()) * tile_count(); }

    void resize(int new_width, int new_height) {
        width = new_width, height = new_height;
        tiles_x = (width + k_tile - 1) >> k_tile_shift, tiles_y = (height + k_tile - 1) >> k_tile_shift;
        const auto count = static_cast<std::size_t>(tile_count());
        tiles = std::make_unique<std::atomic<const std::byte*>[]>(count);
        used = std::make_unique<std::atomic<bool>[]>(count);
    }
};

}  // namespace cardioid::image
