// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/sampler.h"

#include "image/half.h"

#include <cstring>

namespace cardioid::image {
namespace {

/// One texel as floats in storage units; grey has alpha 0, which finish() replaces.
template <Storage S, int channels>
Quad decode(const std::byte* texel) {
    if constexpr (channels == 1) {
        float value;
        if constexpr (S == Storage::byte) {
            value = static_cast<float>(*texel);
        } else if constexpr (S == Storage::real) {
            std::memcpy(&value, texel, 4);
        } else {
            std::uint16_t bits;
            std::memcpy(&bits, texel, 2);
            value = S == Storage::half ? float_from_half(bits) : static_cast<float>(bits);
        }
        return Quad{value, value, value, 0};
    } else if constexpr (S == Storage::byte) {
        typedef std::uint8_t Bytes __attribute__((vector_size(4)));
        Bytes bytes;
        std::memcpy(&bytes, texel, 4);
        return __builtin_convertvector(bytes, Quad);
    } else if constexpr (S == Storage::real) {
        Quad value;
        std::memcpy(&value, texel, 16);
        return value;
    } else {
        typedef std::uint16_t Shorts __attribute__((vector_size(8)));
        typedef std::uint32_t Words __attribute__((vector_size(16)));
        Shorts shorts;
        std::memcpy(&shorts, texel, 8);
        if constexpr (S == Storage::ushort) return __builtin_convertvector(shorts, Quad);
        const Words words = __builtin_convertvector(shorts, Words);
        const Quad magnitude = std::bit_cast<Quad>((words & 0x7fffu) << 13) * 0x1p112f;
        return std::bit_cast<Quad>(std::bit_cast<Words>(magnitude) | ((words & 0x8000u) << 16));
    }
}

template <Storage S>
constexpr float k_unit = S == Storage::byte     ? 1.0f / 255
                         : S == Storage::ushort ? 1.0f / 65535
                                                : 1.0f;

struct TileView {
    const std::byte* data;
    int index;
};

TileView tile_at(const Texture& texture, int x, int y) {
    const int index = (y >> k_tile_shift) * texture.tiles_x + (x >> k_tile_shift);
    const std::byte* data = texture.tiles[index].load(std::memory_order_acquire);
    if (texture.evictable && data && !texture.used[index].load(std::memory_order_relaxed))
        texture.used[index].store(true, std::memory_order_relaxed);
    return {data, index};
}

template <Storage S, int channels>
class Fetcher {
public:
    explicit Fetcher(const Texture& texture) : texture_(texture), associate_(channels == 4 && texture.associate) {}

    template <int taps>
    int run(const Footprint& f, int first, int n, Quad* colors, int& missing) const {
        // All addresses come first, so that the memory is asked for 64 texels at once instead of two or three.
        const std::byte* nearest[k_chunk];
        for (int i = first; i < n; ++i) nearest[i] = locate<taps>(f, i);
        for (int i = first; i < n; ++i) {
            if (nearest[i])
                colors[i] = blend<taps>(f, i, nearest[i]);
            else if (!scattered<taps>(f, i, colors[i], missing))
                return i;
        }
        return n;
    }

private:
    static constexpr std::size_t k_texel = channel_bytes(S) * channels;

    Quad read(const std::byte* texel) const {
        const Quad value = decode<S, channels>(texel) * k_unit<S>;
        if constexpr (channels == 1) return value;
        return associate_ ? value * Quad{value[3], value[3], value[3], 1} : value;
    }
    static const std::byte* inside(const std::byte* tile, int x, int y) {
        return tile + static_cast<std::size_t>(((y & (k_tile - 1)) << k_tile_shift) | (x & (k_tile - 1))) * k_texel;
    }

    /// The first texel, if all taps are neighbours in one loaded tile, which they nearly always are; otherwise null.
    template <int taps>
    const std::byte* locate(const Footprint& f, int i) const {
        constexpr int last = taps - 1;
        const int x = f.x.texel[0][i], y = f.y.texel[0][i], far_x = f.x.texel[last][i], far_y = f.y.texel[last][i];
        const bool together =
            (x | y) >= 0 && far_x == x + last && far_y == y + last && ((x ^ far_x) | (y ^ far_y)) < k_tile;
        if (!together) return nullptr;
        const std::byte* tile = tile_at(texture_, x, y).data;
        if (!tile) return nullptr;
        const std::byte* texel = inside(tile, x, y);
        for (int row = 0; row < taps; ++row) __builtin_prefetch(texel + row * k_tile * k_texel);
        return texel;
    }

    template <int taps>
    Quad blend(const Footprint& f, int i, const std::byte* row) const {
        if constexpr (taps == 1) return read(row);
        Quad sum{0, 0, 0, 0};
        for (int b = 0; b < taps; ++b, row += k_tile * k_texel) {
            Quad line{0, 0, 0, 0};
            for (int a = 0; a < taps; ++a) line += f.x.weight[a][i] * read(row + a * k_texel);
            sum += f.y.weight[b][i] * line;
        }
        return sum;
    }

    template <int taps>
    bool scattered(const Footprint& f, int i, Quad& color, int& missing) const {
        Quad sum{0, 0, 0, 0};
        for (int b = 0; b < taps; ++b) {
            for (int a = 0; a < taps; ++a) {
                const int x = f.x.texel[a][i], y = f.y.texel[b][i];
                if ((x | y) < 0) continue;
                const TileView tile = tile_at(texture_, x, y);
                missing = tile.index;
                if (!tile.data) return false;
                const float weight = taps == 1 ? 1.0f : f.x.weight[a][i] * f.y.weight[b][i];
                sum += weight * read(inside(tile.data, x, y));
            }
        }
        color = sum;
        return true;
    }

    const Texture& texture_;
    bool associate_;
};

template <Storage S, int channels>
int fetch_as(const Texture& texture, const Footprint& f, int first, int n, Quad* colors, int& missing) {
    const Fetcher<S, channels> fetcher(texture);
    if (f.taps == 1) return fetcher.template run<1>(f, first, n, colors, missing);
    if (f.taps == 2) return fetcher.template run<2>(f, first, n, colors, missing);
    return fetcher.template run<4>(f, first, n, colors, missing);
}

}  // namespace

int fetch(const Texture& texture, const Footprint& footprint, int first, int n, Quad* colors, int& missing) {
    const auto run = [&]<Storage S>() {
        return texture.channels == 1 ? fetch_as<S, 1>(texture, footprint, first, n, colors, missing)
                                     : fetch_as<S, 4>(texture, footprint, first, n, colors, missing);
    };
    switch (texture.storage) {
        case Storage::byte: return run.template operator()<Storage::byte>();
        case Storage::ushort: return run.template operator()<Storage::ushort>();
        case Storage::half: return run.template operator()<Storage::half>();
        case Storage::real: break;
    }
    return run.template operator()<Storage::real>();
}

void finish(const Texture& texture, const SrgbTable& srgb, AlphaUse alpha, int n, const Quad* colors, Row rgba[4]) {
    const bool grey = texture.channels == 1;
    for (int i = 0; i < n; ++i) {
        rgba[0][i] = colors[i][0];
        rgba[1][i] = colors[i][1];
        rgba[2][i] = colors[i][2];
        rgba[3][i] = grey ? 1.0f : colors[i][3];
    }
    if (alpha == AlphaUse::straight && texture.may_divide && !grey) {
        for (int i = 0; i < n; ++i) {
            const float a = rgba[3][i];
            const float scale = a != 0 && a != 1 ? 1 / a : 1.0f;
            rgba[0][i] *= scale;
            rgba[1][i] *= scale;
            rgba[2][i] *= scale;
        }
    }
    if (!texture.srgb) return;
    for (int c = 0; c < (grey ? 1 : 3); ++c)
        for (int i = 0; i < n; ++i) rgba[c][i] = srgb(rgba[c][i]);
    if (!grey) return;
    for (int i = 0; i < n; ++i) rgba[1][i] = rgba[2][i] = rgba[0][i];
}

}  // namespace cardioid::image
