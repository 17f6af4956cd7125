// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/half.h"
#include "image/srgb.h"

#include <gtest/gtest.h>

#include <OpenImageIO/imageio.h>

#include <cmath>
#include <random>
#include <vector>

namespace cardioid::image {
namespace {

TEST(Srgb, KnownValues) {
    EXPECT_FLOAT_EQ(linear_from_srgb(0), 0);
    EXPECT_FLOAT_EQ(linear_from_srgb(1), 1);
    EXPECT_NEAR(linear_from_srgb(0.5f), 0.21404114, 1e-7);
    EXPECT_NEAR(linear_from_srgb(128.0f / 255), 0.21586050, 1e-7);
    EXPECT_NEAR(linear_from_srgb(0.04f), 0.04 / 12.92, 1e-8);
    EXPECT_NEAR(srgb_from_linear(0.18f), 0.46135613, 1e-6);
    EXPECT_EQ(linear_from_srgb(-1), 0);
    EXPECT_NEAR(linear_from_srgb(2), std::pow(2.055 / 1.055, 2.4), 1e-5);
    for (float x = 0; x <= 1; x += 0.001f) EXPECT_NEAR(srgb_from_linear(linear_from_srgb(x)), x, 2e-6);
}

TEST(Srgb, TheTableFollowsTheCurve) {
    const SrgbTable table;
    for (double x = -0.5; x < 3; x += 1e-4)
        ASSERT_NEAR(table(static_cast<float>(x)), linear_from_srgb(static_cast<float>(x)),
                    6e-7 * std::max(1.0, x * x * x))
            << x;
    EXPECT_EQ(table(1.0f), 1.0f);
}

std::vector<float> floats_by_library(const std::vector<std::uint16_t>& halves) {
    std::vector<float> floats(halves.size());
    OIIO::convert_pixel_values(OIIO::TypeHalf, halves.data(), OIIO::TypeFloat, floats.data(),
                               static_cast<int>(halves.size()));
    return floats;
}

TEST(Half, EveryFiniteHalfSurvives) {
    std::vector<std::uint16_t> all(65536);
    for (unsigned bits = 0; bits < 65536; ++bits) all[bits] = static_cast<std::uint16_t>(bits);
    const std::vector<float> expected = floats_by_library(all);
    for (unsigned bits = 0; bits < 65536; ++bits) {
        ASSERT_EQ(half_finite(all[bits]), std::isfinite(expected[bits]));
        if (!std::isfinite(expected[bits])) continue;
        ASSERT_EQ(float_from_half(all[bits]), expected[bits]);
        ASSERT_EQ(half_from_float(expected[bits]), all[bits]);
    }
}

TEST(Half, RoundsLikeTheLibrary) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<float> exponent(-27, 15.9f);
    std::vector<float> values;
    for (int i = 0; i < 200000; ++i) values.push_back(std::exp2(exponent(generator)) * (i % 2 == 0 ? 1.0f : -1.0f));
    std::vector<std::uint16_t> expected(values.size());
    OIIO::convert_pixel_values(OIIO::TypeFloat, values.data(), OIIO::TypeHalf, expected.data(),
                               static_cast<int>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(half_from_float(values[i]), expected[i]) << values[i];
    EXPECT_EQ(float_from_half(half_from_float(1e9f)), k_half_max);
    EXPECT_EQ(float_from_half(half_from_float(-1e9f)), -k_half_max);
}

TEST(Half, TruncationIsTheNextOneTowardZero) {
    std::mt19937 generator(11);
    std::uniform_real_distribution<float> exponent(-13.99f, 15.99f);
    for (int i = 0; i < 100000; ++i) {
        const float value = std::exp2(exponent(generator)) * (i % 2 == 0 ? 1.0f : -1.0f);
        const std::uint16_t cut = truncated_half(value);
        ASSERT_LE(std::abs(float_from_half(cut)), std::abs(value));
        ASSERT_GT(std::abs(float_from_half(static_cast<std::uint16_t>(cut + 1))), std::abs(value)) << value;
        ASSERT_EQ(std::signbit(float_from_half(cut)), std::signbit(value));
    }
    EXPECT_EQ(truncated_half(6.0e-5f), 0) << "not a normal half";
    EXPECT_EQ(truncated_half(-6.0e-5f), 0x8000);
    EXPECT_EQ(float_from_half(truncated_half(1e9f)), k_half_max);
}

}  // namespace
}  // namespace cardioid::image
