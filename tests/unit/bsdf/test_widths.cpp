// SPDX-License-Identifier: GPL-3.0-or-later
// Widths 1, 8 and 16 give the same values. Width 1 has no fused multiply-add, so the last bits may differ.
#include "width_probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace cardioid::test {
namespace {

std::vector<float> run(Probe probe) {
    std::vector<float> out(static_cast<std::size_t>(k_probe_lobes * 64 * k_probe_values));
    probe(out.data());
    return out;
}

/// Values that eval gives agree to 1e-4, directions to 1e-4 of their length; the last bits of a sampled direction move what
/// steep lobes have there: 1e-3, more where the density `pdf` shows a peak.
bool agrees(std::size_t value, float a, float b, float pdf) {
    const bool direction = value >= 4 && value < 7;
    const float scale = direction ? 1.0f : std::max({std::abs(a), std::abs(b), 1e-3f});
    const float tolerance = value < 7 ? 1e-4f : 1e-3f * (1 + 0.1f * pdf);
    return std::abs(a - b) <= tolerance * scale;
}

/// Points at which any value differs from width 1.
int points_that_differ(const std::vector<float>& a, const std::vector<float>& b) {
    int differ = 0;
    for (std::size_t p = 0; p < a.size(); p += k_probe_values) {
        bool bad = false;
        for (std::size_t v = p; v < p + k_probe_values; ++v) {
            if (!agrees(v - p, a[v], b[v], a[p + 10])) bad = true;
        }
        differ += bad;
    }
    return differ;
}

TEST(Widths, EightEqualsOne) {
    if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "no AVX2";
    EXPECT_EQ(points_that_differ(run(probe_w1), run(probe_w8)), 0);
}

TEST(Widths, SixteenEqualsOne) {
    if (!__builtin_cpu_supports("avx512dq")) GTEST_SKIP() << "no AVX-512";
    EXPECT_EQ(points_that_differ(run(probe_w1), run(probe_w16)), 0);
}

TEST(Widths, ADifferenceIsSeen) {
    std::vector<float> a = run(probe_w1), b = a;
    b[5] += 0.01f;
    EXPECT_EQ(points_that_differ(a, b), 1);
}

}  // namespace
}  // namespace cardioid::test
