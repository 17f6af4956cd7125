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

/// Points at which any value differs from width 1 by more than 1e-4 of the larger of it and the point's scale.
int points_that_differ(const std::vector<float>& a, const std::vector<float>& b) {
    int differ = 0;
    for (std::size_t p = 0; p < a.size(); p += k_probe_values) {
        bool bad = false;
        for (std::size_t v = p; v < p + k_probe_values; ++v) {
            const float scale = std::max({std::abs(a[v]), std::abs(b[v]), 1e-3f});
            if (!(std::abs(a[v] - b[v]) <= 1e-4f * scale)) bad = true;
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
