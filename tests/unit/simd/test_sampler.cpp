// SPDX-License-Identifier: GPL-3.0-or-later
// Samples of a pair are a (0,2) net in every aligned block of 2^k, pairs and pixels do not know of each other, and every width
// gives the same numbers. Each property is shown to fail for a sampler with one part missing.
#include "lanes_of.h"
#include "simd/sampler.h"
#include "statistics/chi2.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace cardioid::simd_tests {
namespace {

struct Point {
    double x, y;
};

enum class Variant { real, no_shuffle, wrong_matrix, plain_hash, shuffle_from_low_bit };

Vec2 variant_pair(Variant v, Int pixel_seed, Int index, Int dimension) {
    if (v == Variant::real) return sample_pair(pixel_seed, reverse_bits(index), dimension);
    const Int seed = hash(pixel_seed, dimension);
    const Int a = hash(seed ^ Int::of_bits(0xa511e9b3u)), b = hash(seed ^ Int::of_bits(0x63d83595u));
    if (v == Variant::plain_hash) return {unit_float(hash(index, a)), unit_float(hash(index, b))};
    Int shuffled = reverse_bits(owen_scramble(reverse_bits(index), seed));
    // Only the scrambles of the values differ from pair to pair: which index gives which stratum stays the same.
    if (v == Variant::no_shuffle) shuffled = index;
    if (v == Variant::shuffle_from_low_bit) shuffled = owen_scramble(index, seed);
    Int second = sobol_second(shuffled);
    if (v == Variant::wrong_matrix) second = shuffled ^ (shuffled >> 1);
    return {unit_float(reverse_bits(owen_scramble(shuffled, a))), unit_float(reverse_bits(owen_scramble(second, b)))};
}

std::vector<Point> points(Variant v, std::uint32_t pixel_seed, int dimension, int first, int n) {
    std::vector<Point> all;
    for (int k = 0; k < n; k += W) {
        const Vec2 u = variant_pair(v, Int::of_bits(pixel_seed), Int(first + k) + lane_index(), Int(dimension));
        for (int i = 0; i < W && k + i < n; ++i)
            all.push_back({static_cast<double>(u.x[i]), static_cast<double>(u.y[i])});
    }
    return all;
}

/// Every elementary rectangle 2^-a × 2^-(k-a) holds exactly one of the 2^k points.
bool is_net(const std::vector<Point>& p, int k) {
    for (int a = 0; a <= k; ++a) {
        std::vector<int> cells(p.size(), 0);
        for (const Point& q : p) {
            const auto cx = static_cast<std::size_t>(q.x * (1 << a)),
                       cy = static_cast<std::size_t>(q.y * (1 << (k - a)));
            if (cells[(cx << (k - a)) + cy]++ != 0) return false;
        }
    }
    return true;
}

bool always_net(Variant v) {
    for (const std::uint32_t seed : {0u, 1u, 0x9e3779b9u, 0xffffffffu}) {
        for (const int dimension : {0, 1, 4, 57}) {
            for (int k = 0; k <= 10; ++k) {
                for (const int block : {0, 1, 2, 5, 1000}) {
                    if (!is_net(points(v, seed, dimension, block << k, 1 << k), k)) return false;
                }
            }
        }
    }
    return true;
}

TEST(Sampler, EveryAlignedBlockIsANet) { EXPECT_TRUE(always_net(Variant::real)); }

TEST(Sampler, TheNetTestRejectsWrongSamplers) {
    EXPECT_FALSE(always_net(Variant::wrong_matrix));
    EXPECT_FALSE(always_net(Variant::plain_hash));
    EXPECT_FALSE(always_net(Variant::shuffle_from_low_bit));
}

/// chi² of the joint cells 16 × 16 of two coordinates; one sample index of many pixels (or one pixel's many samples).
constexpr int k_cells = 16;
class Joint {
public:
    void add(double a, double b) {
        const auto i = static_cast<std::size_t>(a * k_cells), j = static_cast<std::size_t>(b * k_cells);
        ++count_[i * k_cells + j];
        ++n_;
    }
    statistics::Chi2Result test() const {
        return statistics::chi2_test({count_.begin(), count_.end()},
                                     std::vector<double>(count_.size(), n_ / static_cast<double>(count_.size())));
    }

private:
    std::array<double, k_cells * k_cells> count_{};
    double n_ = 0;
};

constexpr int k_pairs = 10;

/// Σ over coordinates of all pairs of dimensions 0…k_pairs-1: how many joint tests of 65536 values reject at `level`.
/// Stratified points fill cells too evenly for one pixel's block, so pixels are mixed: 16 samples of each of 4096 pixels.
int correlated_pairs(Variant v, double level) {
    std::vector<std::vector<Point>> by_dimension(k_pairs);
    for (int d = 0; d < k_pairs; ++d) {
        for (std::uint32_t pixel = 0; pixel < 4096; ++pixel) {
            const auto p = points(v, static_cast<std::uint32_t>(hash(Int::of_bits(pixel), Int(99))[0]), d, 16, 16);
            by_dimension[static_cast<std::size_t>(d)].insert(by_dimension[static_cast<std::size_t>(d)].end(), p.begin(),
                                                             p.end());
        }
    }
    int rejected = 0;
    for (std::size_t a = 0; a < k_pairs; ++a) {
        for (std::size_t b = a + 1; b < k_pairs; ++b) {
            Joint xx, xy, yy;
            for (std::size_t i = 0; i < by_dimension[a].size(); ++i) {
                xx.add(by_dimension[a][i].x, by_dimension[b][i].x);
                xy.add(by_dimension[a][i].x, by_dimension[b][i].y);
                yy.add(by_dimension[a][i].y, by_dimension[b][i].y);
            }
            rejected += xx.test().rejected(level) + xy.test().rejected(level) + yy.test().rejected(level);
        }
    }
    return rejected;
}

constexpr double k_level = 1e-4;

TEST(Sampler, PairsOfManyPixelsAreIndependent) { EXPECT_EQ(correlated_pairs(Variant::real, k_level / 135), 0); }

/// Within one pixel: does the stratum of one pair tell that of another? Counts how often sample i and sample j of a block of 16
/// share the coarse half in both pairs; independent shuffles make that a fair coin.
double agreement(Variant v, int n_pixels) {
    double agree = 0, total = 0;
    for (int pixel = 0; pixel < n_pixels; ++pixel) {
        const auto seed = static_cast<std::uint32_t>(hash(Int(pixel), Int(5))[0]);
        const auto a = points(v, seed, 3, 0, 16), b = points(v, seed, 7, 0, 16);
        for (std::size_t i = 0; i < 16; i += 2) {
            // Neighbours i and i+1: opposite halves of one pair imply opposite halves of the other without a shuffle.
            const auto quarter = [](double x) { return static_cast<int>(4 * x); };
            const bool in_a = quarter(a[i].x) / 2 == quarter(a[(i + 3) % 16].x) / 2;
            const bool in_b = quarter(b[i].x) / 2 == quarter(b[(i + 3) % 16].x) / 2;
            agree += in_a == in_b;
            total += 1;
        }
    }
    return agree / total;
}

TEST(Sampler, StrataOfOnePairSayNothingOfAnother) {
    // 16000 flips, the eight of a pixel not independent of each other: 0.04 is four standard errors of 2000 pixels' halves.
    EXPECT_NEAR(agreement(Variant::real, 2000), 0.5, 0.04);
    EXPECT_GT(agreement(Variant::no_shuffle, 2000), 0.9);
}

TEST(Sampler, EachCoordinateIsUniformAcrossPixels) {
    for (const int sample : {0, 1, 2, 3, 63, 1024}) {
        std::vector<double> x(64, 0.0), y(64, 0.0), expected(64, 65536 / 64.0);
        for (std::uint32_t pixel = 0; pixel < 65536; ++pixel) {
            const Point p = points(Variant::real, static_cast<std::uint32_t>(hash(Int::of_bits(pixel), Int(1))[0]), 2,
                                   sample, 1)[0];
            x[static_cast<std::size_t>(p.x * 64)] += 1;
            y[static_cast<std::size_t>(p.y * 64)] += 1;
        }
        EXPECT_FALSE(statistics::chi2_test(x, expected).rejected(k_level / 12)) << sample;
        EXPECT_FALSE(statistics::chi2_test(y, expected).rejected(k_level / 12)) << sample;
    }
}

TEST(Sampler, NumbersAreInTheHalfOpenInterval) {
    EXPECT_EQ(unit_float(Int::of_bits(0xffffffffu))[0], 1.0f - 0x1p-24f);
    EXPECT_EQ(unit_float(Int(0))[0], 0.0f);
    EXPECT_LT(unit_float(Int::of_bits(0xffffffffu))[W - 1], 1.0f);
}

TEST(Sampler, ReverseBitsIsAnInvolution) {
    for (const std::uint32_t x : {0u, 1u, 0x80000000u, 0x12345678u, 0xffffffffu, 0x0f0f0f0fu}) {
        std::uint32_t expected = 0;
        for (int b = 0; b < 32; ++b) expected |= (x >> b & 1u) << (31 - b);
        EXPECT_EQ(static_cast<std::uint32_t>(reverse_bits(Int::of_bits(x))[0]), expected);
        EXPECT_EQ(static_cast<std::uint32_t>(reverse_bits(reverse_bits(Int::of_bits(x)))[0]), x);
    }
}

/// FNV over the bits of many samples: the same constant at every width, so a width that differs is seen.
TEST(Sampler, SameNumbersAtEveryWidth) {
    std::uint64_t h = 1469598103934665603ull;
    for (const std::uint32_t seed : {0u, 12345u, 0xdeadbeefu}) {
        for (int d = 0; d < 8; ++d) {
            for (const Point& p : points(Variant::real, seed, d, 0, 64)) {
                for (const double c : {p.x, p.y}) h = (h ^ static_cast<std::uint64_t>(c * 0x1p24)) * 1099511628211ull;
            }
        }
    }
    EXPECT_EQ(h, 14649307833235280649ull);
}

}  // namespace
}  // namespace cardioid::simd_tests
