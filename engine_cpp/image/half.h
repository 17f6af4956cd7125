// SPDX-License-Identifier: GPL-3.0-or-later
// IEEE half precision, for texels of high-dynamic-range images.
#pragma once

#include <bit>
#include <cstdint>

namespace cardioid::image {

inline constexpr float k_half_max = 65504.0f;

/// Nearest half; clamped to the finite range. `value` is finite.
inline std::uint16_t half_from_float(float value) {
    const float clamped = value > k_half_max ? k_half_max : value < -k_half_max ? -k_half_max : value;
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(clamped), sign = (bits >> 16) & 0x8000u;
    const std::uint32_t magnitude = bits & 0x7fffffffu;
    if (magnitude < 0x38800000u) {
        // Below the smallest normal half: adding 0.5 lets the float unit round to multiples of 2^-24.
        const float shifted = std::bit_cast<float>(magnitude) + 0.5f;
        return static_cast<std::uint16_t>(sign | (std::bit_cast<std::uint32_t>(shifted) - 0x3f000000u));
    }
    const std::uint32_t odd = (magnitude >> 13) & 1u;
    return static_cast<std::uint16_t>(sign | ((magnitude - 0x38000000u + 0xfffu + odd) >> 13));
}

/// The half that `value` is cut off to; halves that are not normal become 0. What Cycles stores after it has changed a colour
/// (util/half.h, float_to_half_image).
inline std::uint16_t truncated_half(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t magnitude = bits & 0x7fffffffu;
    if (magnitude < 0x38800000u) return static_cast<std::uint16_t>(bits >> 16 & 0x8000u);
    const std::uint32_t cut = magnitude >= 0x47800000u ? 0x7bffu : (magnitude >> 13) - 0x1c000u;
    return static_cast<std::uint16_t>((bits >> 16 & 0x8000u) | cut);
}

inline float float_from_half(std::uint16_t half) {
    // The exponent is moved by a multiplication, which also handles subnormals. Infinities were removed on loading.
    const std::uint32_t magnitude = (half & 0x7fffu) << 13, sign = (half & 0x8000u) << 16;
    const float scaled = std::bit_cast<float>(magnitude) * 0x1p112f;
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(scaled) | sign);
}

/// Neither infinite nor NaN.
inline bool half_finite(std::uint16_t half) { return (half & 0x7c00u) != 0x7c00u; }

}  // namespace cardioid::image
