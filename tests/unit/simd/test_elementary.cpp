// SPDX-License-Identifier: GPL-3.0-or-later
// Elementary functions against <cmath> in double, over the ranges that simd/elementary.h promises.
#include "lanes_of.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace cardioid::simd_tests {
namespace {

/// Largest |f(x) - reference(x)| / max(|reference(x)|, floor) over n equidistant arguments.
template <class F, class R>
double worst(F f, R reference, double from, double to, double floor_value, int n = 200'000) {
    double most = 0;
    for (int k = 0; k < n; k += W) {
        const Float x = float_lanes_of([&](int i) { return static_cast<float>(from + (to - from) * (k + i) / n); });
        const Float y = f(x);
        for (int i = 0; i < W; ++i) {
            const double expected = reference(static_cast<double>(x[i]));
            const double error =
                std::fabs(static_cast<double>(y[i]) - expected) / std::max(std::fabs(expected), floor_value);
            // Not `max`, which would lose a NaN.
            if (!(error <= most)) most = error;
        }
    }
    return most;
}

double sine_of(double x) { return std::sin(x); }
double cosine_of(double x) { return std::cos(x); }

TEST(Elementary, Exp2) {
    EXPECT_LT(worst([](Float x) { return exp2(x); }, [](double x) { return std::exp2(x); }, -125.9, 126.9, 1e-300),
              2.5e-7);
    EXPECT_EQ(exp2(Float(-1000.0f))[0], exp2(Float(-126.0f))[0]);
    EXPECT_TRUE(std::isfinite(exp2(Float(1e30f))[0]));
    for (int k = -126; k <= 127; ++k) EXPECT_EQ(exp2(Float(static_cast<float>(k)))[0], std::ldexp(1.0f, k)) << k;
}

TEST(Elementary, Log2) {
    EXPECT_LT(worst([](Float x) { return log2(x); }, [](double x) { return std::log2(x); }, 1e-4, 4, 0.2), 4e-7);
    EXPECT_LT(worst([](Float x) { return log2(x); }, [](double x) { return std::log2(x); }, 1, 1e30, 1), 2e-7);
    EXPECT_NEAR(log2(Float(0.0f))[0], -126, 1e-4);
    EXPECT_NEAR(log2(Float(-5.0f))[0], -126, 1e-4);
    EXPECT_EQ(log2(Float(1.0f))[0], 0.0f);
}

TEST(Elementary, ExpAndLog) {
    // The rounding of x·log2(e) grows with x.
    EXPECT_LT(worst([](Float x) { return exp(x); }, [](double x) { return std::exp(x); }, -10, 10, 1e-300), 1.2e-6);
    EXPECT_LT(worst([](Float x) { return log(x); }, [](double x) { return std::log(x); }, 1e-3, 100, 0.2), 5e-7);
}

TEST(Elementary, Pow) {
    for (const float y : {0.0f, 0.5f, 1.0f, 2.2f, 5.0f, -1.5f}) {
        const auto reference = [y](double x) { return std::pow(x, static_cast<double>(y)); };
        EXPECT_LT(worst([y](Float x) { return pow(x, Float(y)); }, reference, 1e-3, 8, 1e-300), 6e-6) << y;
    }
    EXPECT_EQ(pow(Float(0.0f), Float(0.0f))[0], 1.0f);
    EXPECT_EQ(pow(Float(0.0f), Float(3.0f))[0], 0.0f);
}

TEST(Elementary, SinAndCos) {
    const auto s = [](Float x) {
        Float a, b;
        sincos(x, a, b);
        return a;
    };
    const auto c = [](Float x) {
        Float a, b;
        sincos(x, a, b);
        return b;
    };
    EXPECT_LT(worst(s, sine_of, -10, 10, 1), 3e-7);
    EXPECT_LT(worst(c, cosine_of, -10, 10, 1), 3e-7);
    EXPECT_LT(worst(s, sine_of, -8000, 8000, 1), 1e-6);
    EXPECT_LT(worst(c, cosine_of, -8000, 8000, 1), 1e-6);
}

TEST(Elementary, InverseTrigonometry) {
    EXPECT_LT(worst([](Float x) { return atan(x); }, [](double x) { return std::atan(x); }, -30, 30, 1e-3), 4e-7);
    EXPECT_LT(worst([](Float x) { return acos(x); }, [](double x) { return std::acos(x); }, -1, 1, 1e-2), 1e-6);
    EXPECT_LT(worst([](Float x) { return asin(x); }, [](double x) { return std::asin(x); }, -1, 1, 1), 6e-7);
    EXPECT_EQ(acos(Float(7.0f))[0], 0.0f);
    EXPECT_NEAR(acos(Float(-7.0f))[0], 3.14159265, 1e-6);
}

TEST(Elementary, Atan2AllAround) {
    for (const double r : {1e-20, 1e-3, 1.0, 1e15}) {
        for (int k = 0; k < 7200; ++k) {
            const double a = -3.14159 + k * 2 * 3.14159 / 7200;
            const auto y = static_cast<float>(r * std::sin(a)), x = static_cast<float>(r * std::cos(a));
            ASSERT_NEAR(atan2(Float(y), Float(x))[0], std::atan2(static_cast<double>(y), static_cast<double>(x)), 1e-6)
                << r << " " << a;
        }
    }
    EXPECT_EQ(atan2(Float(0.0f), Float(0.0f))[0], 0.0f);
    EXPECT_NEAR(atan2(Float(0.0f), Float(-1.0f))[0], 3.14159265, 1e-6);
    EXPECT_NEAR(atan2(Float(1.0f), Float(0.0f))[0], 1.57079633, 1e-6);
    EXPECT_NEAR(atan2(Float(-1.0f), Float(0.0f))[0], -1.57079633, 1e-6);
}

TEST(Elementary, HardwareFunctionsAreExact) {
    const std::vector<float> values{0.0f,  -0.0f,      0.5f,        -0.5f, 1.0f,  -1.0f,  2.5f,
                                    -2.5f, 8388607.5f, -8388607.5f, 1e9f,  -1e9f, 3e-39f, 1e30f};
    for (const float x : values) {
        EXPECT_EQ(floor(Float(x))[0], std::floor(x));
        EXPECT_EQ(ceil(Float(x))[0], std::ceil(x));
        EXPECT_EQ(abs(Float(x))[0], std::fabs(x));
        EXPECT_EQ(safe_sqrt(Float(x))[0], std::sqrt(std::max(x, 0.0f)));
        for (const float y : values) {
            EXPECT_EQ(min(Float(x), Float(y))[0], std::min(x, y));
            EXPECT_EQ(max(Float(x), Float(y))[0], std::max(x, y));
            // By lanes: the constructor from a float adds 0, which turns -0 into +0.
            const Float signed_x = copysign(Float(x), float_lanes_of([y](int) { return y; }));
            EXPECT_EQ(std::signbit(signed_x[0]), std::signbit(y));
            EXPECT_EQ(std::fabs(signed_x[0]), std::fabs(x));
        }
    }
    EXPECT_EQ(to_int(Float(-2.9f))[0], -2);
    EXPECT_EQ(to_int(Float(2.9f))[0], 2);
}

TEST(Elementary, TheComparisonNoticesAWrongFunction) {
    const auto cubic = [](Float x) { return x - x * x * x * (1.0f / 6.0f); };
    EXPECT_GT(worst(cubic, sine_of, -0.5, 0.5, 1), 1e-4);
    EXPECT_FALSE(worst([](Float x) { return x * Float(std::numeric_limits<float>::quiet_NaN()); }, sine_of, 0, 1, 1) <
                 1e9);
}

TEST(Elementary, FiniteOrNot) {
    EXPECT_TRUE(all(is_finite(Float(3e38f))));
    EXPECT_TRUE(none(is_finite(Float(std::numeric_limits<float>::infinity()))));
    EXPECT_TRUE(none(is_finite(Float(-std::numeric_limits<float>::infinity()))));
    EXPECT_TRUE(none(is_finite(Float(std::numeric_limits<float>::quiet_NaN()))));
}

}  // namespace
}  // namespace cardioid::simd_tests
