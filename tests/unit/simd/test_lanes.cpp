// SPDX-License-Identifier: GPL-3.0-or-later
// Masks, selection, integers, gathers and compressing stores, against loops over the lanes.
#include "lanes_of.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <vector>

namespace cardioid::simd_tests {
namespace {

Mask mask_from_bits(std::uint32_t b) {
    return int_lanes_of([&](int i) { return (b >> i) & 1u; }) != Int(0);
}

std::vector<std::uint32_t> mask_patterns() {
    const std::uint32_t full = (1u << W) - 1u;
    std::vector<std::uint32_t> all{0u, full, 1u, 1u << (W - 1)};
    std::mt19937 random(7);
    for (int k = 0; k < 200; ++k) all.push_back(static_cast<std::uint32_t>(random()) & full);
    return all;
}

TEST(Masks, BitsAndReductions) {
    const std::uint32_t full = (1u << W) - 1u;
    for (const std::uint32_t b : mask_patterns()) {
        const Mask m = mask_from_bits(b);
        EXPECT_EQ(bits(m), b);
        EXPECT_EQ(bits(~m), full & ~b);
        EXPECT_EQ(any(m), b != 0);
        EXPECT_EQ(all(m), b == full);
        EXPECT_EQ(none(m), b == 0);
        EXPECT_EQ(count(m), std::popcount(b));
        for (const std::uint32_t other : {0x5555u, 0x00ffu}) {
            const Mask o = mask_from_bits(other & full);
            EXPECT_EQ(bits(m & o), b & other & full);
            EXPECT_EQ(bits(m | o), b | (other & full));
            EXPECT_EQ(bits(m ^ o), b ^ (other & full));
            EXPECT_EQ(bits(select(m, o, ~o)), (b & other & full) | (~b & ~other & full));
        }
    }
    for (int n = 0; n <= W + 2; ++n) EXPECT_EQ(bits(first_lanes(n)), n >= W ? full : (1u << n) - 1u);
    EXPECT_EQ(bits(mask_of(true)), full);
}

TEST(Masks, Select) {
    const Float a = float_lanes_of([](int i) { return 1.0f + static_cast<float>(i); });
    const Float b = float_lanes_of([](int i) { return -1.0f - static_cast<float>(i); });
    const Int ia = int_lanes_of([](int i) { return i; }), ib = int_lanes_of([](int i) { return 100 + i; });
    for (const std::uint32_t pattern : mask_patterns()) {
        const Mask m = mask_from_bits(pattern);
        const Float f = select(m, a, b);
        const Int n = select(m, ia, ib);
        for (int i = 0; i < W; ++i) {
            EXPECT_EQ(f[i], (pattern >> i & 1u) != 0 ? a[i] : b[i]);
            EXPECT_EQ(n[i], (pattern >> i & 1u) != 0 ? ia[i] : ib[i]);
        }
    }
}

TEST(Masks, NotANumberIsNeverLessOrEqual) {
    const Float nan = float_of_bits(Int(0x7fc00000));
    EXPECT_TRUE(none(nan < Float(1.0f)));
    EXPECT_TRUE(none(nan >= Float(1.0f)));
    EXPECT_TRUE(none(nan == nan));
    EXPECT_TRUE(all(nan != nan));
}

TEST(Integers, WrapAndShiftAsUnsigned) {
    std::mt19937 random(11);
    for (int k = 0; k < 300; ++k) {
        const auto a = static_cast<std::uint32_t>(random()), b = static_cast<std::uint32_t>(random());
        const Int x = Int::of_bits(a), y = Int::of_bits(b);
        EXPECT_EQ(static_cast<std::uint32_t>((x + y)[W - 1]), a + b);
        EXPECT_EQ(static_cast<std::uint32_t>((x - y)[W - 1]), a - b);
        EXPECT_EQ(static_cast<std::uint32_t>((x * y)[W - 1]), a * b);
        EXPECT_EQ(static_cast<std::uint32_t>((x >> 5)[W - 1]), a >> 5);
        EXPECT_EQ(static_cast<std::uint32_t>((x << 7)[W - 1]), a << 7);
        EXPECT_EQ(lane_of(x < y, 0), static_cast<std::int32_t>(a) < static_cast<std::int32_t>(b));
        EXPECT_EQ(min(x, y)[0], std::min(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)));
    }
}

TEST(Memory, GatherReadsEachLanesElement) {
    std::vector<float> floats(1000);
    std::vector<std::int32_t> ints(1000);
    for (int i = 0; i < 1000; ++i) {
        floats[static_cast<std::size_t>(i)] = 0.25f * static_cast<float>(i);
        ints[static_cast<std::size_t>(i)] = 7 * i - 3000;
    }
    std::mt19937 random(3);
    for (int k = 0; k < 100; ++k) {
        const Int index = int_lanes_of([&](int) { return random() % 1000; });
        const Float f = gather(floats.data(), index);
        const Int n = gather(ints.data(), index);
        for (int i = 0; i < W; ++i) {
            EXPECT_EQ(f[i], floats[static_cast<std::size_t>(index[i])]);
            EXPECT_EQ(n[i], ints[static_cast<std::size_t>(index[i])]);
        }
    }
}

TEST(Memory, CompressStoreKeepsOrderAndCount) {
    const Int values = int_lanes_of([](int i) { return 1000 + i; });
    for (const std::uint32_t pattern : mask_patterns()) {
        std::vector<std::int32_t> out(2 * W, -1);
        const int n = compress_store(out.data(), values, mask_from_bits(pattern));
        ASSERT_EQ(n, std::popcount(pattern));
        int at = 0;
        for (int i = 0; i < W; ++i) {
            if ((pattern >> i & 1u) == 0) continue;
            EXPECT_EQ(out[static_cast<std::size_t>(at++)], 1000 + i);
        }
        for (std::size_t i = W; i < out.size(); ++i) EXPECT_EQ(out[i], -1) << "wrote more than one register";
    }
}

TEST(Memory, MaskedStoreLeavesTheOthers) {
    std::vector<float> out(W, 5.0f);
    store(out.data(), Float(9.0f), first_lanes(W / 2));
    for (int i = 0; i < W; ++i) EXPECT_EQ(out[static_cast<std::size_t>(i)], i < W / 2 ? 9.0f : 5.0f);
}

}  // namespace
}  // namespace cardioid::simd_tests
