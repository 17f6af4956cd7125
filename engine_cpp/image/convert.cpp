// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/convert.h"

#include "image/half.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <type_traits>

namespace cardioid::image {
namespace {

template <class T>
T load(const std::byte* at) {
    T value;
    std::memcpy(&value, at, sizeof(T));
    return value;
}

struct Half {
    std::uint16_t bits;
};

constexpr std::uint8_t one_of(std::uint8_t) { return 255; }
constexpr std::uint16_t one_of(std::uint16_t) { return 65535; }
constexpr Half one_of(Half) { return {0x3c00}; }
constexpr float one_of(float) { return 1; }

float to_float(std::uint8_t v) { return static_cast<float>(v) * (1.0f / 255); }
float to_float(std::uint16_t v) { return static_cast<float>(v) * (1.0f / 65535); }
float to_float(Half v) { return half_finite(v.bits) ? float_from_half(v.bits) : std::nanf(""); }
float to_float(float v) { return v; }

bool finite(std::uint8_t) { return true; }
bool finite(std::uint16_t) { return true; }
bool finite(Half v) { return half_finite(v.bits); }
bool finite(float v) { return std::isfinite(v); }

/// Spreads 1…4 delivered channels over red, green, blue and alpha.
template <class T>
void spread(const std::byte* texel, int channels, bool ignore_alpha, T out[4]) {
    const auto channel = [&](int c) { return load<T>(texel + sizeof(T) * static_cast<std::size_t>(c)); };
    out[0] = channel(0);
    out[1] = channels >= 3 ? channel(1) : out[0];
    out[2] = channels >= 3 ? channel(2) : out[0];
    const bool has_alpha = !ignore_alpha && channels % 2 == 0;
    out[3] = has_alpha ? channel(channels - 1) : one_of(T{});
}

/// Integers are cut off, not rounded, as Cycles does it.
std::uint8_t product(std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(unsigned{a} * b / 255); }
std::uint16_t product(std::uint16_t a, std::uint16_t b) { return static_cast<std::uint16_t>(unsigned{a} * b / 65535); }
Half product(Half a, Half b) { return {truncated_half(to_float(a) * to_float(b))}; }
float product(float a, float b) { return a * b; }

template <class T>
std::size_t copy_row(std::byte* to, const Texture& texture, const Conversion& c, const std::byte* from, int width) {
    const int delivered = c.source.delivered();
    const std::size_t step = sizeof(T) * static_cast<std::size_t>(delivered);
    std::size_t bad = 0;
    for (int x = 0; x < width; ++x, from += step, to += texture.texel_bytes()) {
        T texel[4];
        spread(from, delivered, c.ignore_alpha, texel);
        if (!(finite(texel[0]) && finite(texel[1]) && finite(texel[2]) && finite(texel[3]))) {
            std::fill_n(texel, 4, T{});
            ++bad;
        }
        if (c.multiply)
            for (int k = 0; k < 3; ++k) texel[k] = product(texel[k], texel[3]);
        std::memcpy(to, texel, texture.texel_bytes());
    }
    return bad;
}

/// Colours that will be converted: integers go through halves, as in Cycles.
template <class T>
float read(T v) {
    return std::is_integral_v<T> ? float_from_half(half_from_float(to_float(v))) : to_float(v);
}

template <class T>
void read_floats(const std::byte* from, const Conversion& c, int width, float* rgba) {
    const int delivered = c.source.delivered();
    for (int x = 0; x < width; ++x, from += sizeof(T) * static_cast<std::size_t>(delivered)) {
        T texel[4];
        spread(from, delivered, c.ignore_alpha, texel);
        for (int k = 0; k < 4; ++k) rgba[4 * x + k] = read(texel[k]);
    }
}

bool divides(float alpha) { return !(alpha <= 0 || alpha == 1); }

/// Scene-linear colours; returns the number of texels that are not finite, before or after. `halves`: they are kept so.
std::size_t linearise(float* rgba, int width, const Conversion& c, bool halves) {
    const bool associated = c.associated || c.multiply;
    std::size_t bad = 0;
    for (int x = 0; x < width; ++x) {
        float* p = rgba + 4 * x;
        if (!std::isfinite(p[0] + p[1] + p[2] + p[3])) {
            std::fill_n(p, 4, 0.0f);
            ++bad;
            continue;
        }
        if (c.multiply)
            for (int k = 0; k < 3; ++k) p[k] = halves ? float_from_half(truncated_half(p[k] * p[3])) : p[k] * p[3];
        if (associated && divides(p[3]))
            for (int k = 0; k < 3; ++k) p[k] /= p[3];
    }
    c.space.to_linear(rgba, static_cast<std::size_t>(width));
    for (int x = 0; x < width; ++x) {
        float* p = rgba + 4 * x;
        if (associated && divides(p[3]))
            for (int k = 0; k < 3; ++k) p[k] *= p[3];
        if (std::isfinite(p[0] + p[1] + p[2])) continue;
        std::fill_n(p, 3, 0.0f);
        ++bad;
    }
    return bad;
}

void write_row(std::byte* to, const Texture& texture, const float* rgba, int width) {
    for (int x = 0; x < width; ++x, to += texture.texel_bytes()) {
        const float* p = rgba + 4 * x;
        // A grey image stays grey, as in Cycles.
        const float grey = (p[0] + p[1] + p[2]) / 3;
        float texel[4] = {p[0], p[1], p[2], p[3]};
        if (texture.channels == 1) texel[0] = grey;
        for (int k = 0; k < texture.channels; ++k) {
            const std::size_t at = channel_bytes(texture.storage) * static_cast<std::size_t>(k);
            if (texture.storage == Storage::half) {
                const std::uint16_t half = truncated_half(texel[k]);
                std::memcpy(to + at, &half, sizeof half);
            } else {
                std::memcpy(to + at, &texel[k], sizeof(float));
            }
        }
    }
}

template <class T>
std::size_t fill_row(std::byte* to, const Texture& texture, const Conversion& c, const std::byte* from, int width) {
    if (c.space.transfer != Transfer::convert) return copy_row<T>(to, texture, c, from, width);
    float rgba[4 * k_tile];
    read_floats<T>(from, c, width, rgba);
    const std::size_t bad = linearise(rgba, width, c, texture.storage == Storage::half);
    write_row(to, texture, rgba, width);
    return bad;
}

}  // namespace

void choose_format(Texture& texture, const Conversion& conversion) {
    texture.channels = conversion.source.channels == 1 ? 1 : 4;
    texture.storage = conversion.source.storage;
    if (conversion.space.transfer == Transfer::convert && texture.storage != Storage::real)
        texture.storage = Storage::half;
    texture.srgb = conversion.space.transfer == Transfer::srgb;
}

std::size_t fill_tile(std::byte* tile, const Texture& texture, const Conversion& conversion, const std::byte* texels,
                      std::size_t stride, int width, int height) {
    const std::size_t texel =
        channel_bytes(conversion.source.storage) * static_cast<std::size_t>(conversion.source.delivered());
    std::size_t bad = 0;
    for (int y = 0; y < height; ++y) {
        std::byte* to = tile + static_cast<std::size_t>(y) * k_tile * texture.texel_bytes();
        const std::byte* from = texels + static_cast<std::size_t>(height - 1 - y) * stride * texel;
        switch (conversion.source.storage) {
            case Storage::byte: bad += fill_row<std::uint8_t>(to, texture, conversion, from, width); break;
            case Storage::ushort: bad += fill_row<std::uint16_t>(to, texture, conversion, from, width); break;
            case Storage::half: bad += fill_row<Half>(to, texture, conversion, from, width); break;
            case Storage::real: bad += fill_row<float>(to, texture, conversion, from, width); break;
        }
    }
    return bad;
}

}  // namespace cardioid::image
