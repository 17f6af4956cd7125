// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of filter offsets against the filters' distribution functions, integrated here in another way.
#include "film/pixel_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace cardioid::film {
namespace {

using scene::PixelFilter;
using Density = std::function<double(double)>;

Density density(PixelFilter filter, double width) {
    if (filter == PixelFilter::box) return [](double) { return 1.0; };
    if (filter == PixelFilter::gaussian) {
        return [width](double x) { return std::exp(-2 * std::pow(6 * x / width, 2)); };
    }
    return [width](double x) {
        const double v = 2 * std::numbers::pi * (x / width + 0.5);
        return 0.35875 - 0.48829 * std::cos(v) + 0.14128 * std::cos(2 * v) - 0.01168 * std::cos(3 * v);
    };
}

/// Full support for Blender's width, which is nominal (Cycles, scene/film.cpp).
double support(PixelFilter filter, double width) {
    if (filter == PixelFilter::box) return 1;
    return filter == PixelFilter::gaussian ? 3 * width : 2 * width;
}

/// Simpson's rule.
double integral(const std::function<double(double)>& f, double a, double b, int n = 4000) {
    double sum = f(a) + f(b);
    for (int i = 1; i < n; ++i) sum += (i % 2 != 0 ? 4 : 2) * f(a + (b - a) * i / n);
    return sum * (b - a) / (3 * n);
}

/// Mean of x^power when the table is read as the tracer does, with linear interpolation.
double table_moment(const FilterTable& t, int power) {
    double sum = 0;
    for (int i = 0; i < k_filter_steps; ++i) {
        for (const double f : {0.25, 0.75}) {
            const double a = static_cast<double>(t[static_cast<std::size_t>(i)]),
                         b = static_cast<double>(t[static_cast<std::size_t>(i) + 1]);
            sum += std::pow(a + f * (b - a), power);
        }
    }
    return sum / (2 * k_filter_steps);
}

/// Largest |F(table[q]) - q| over the quantiles.
double cdf_error(const FilterTable& t, const Density& f, double width) {
    const double total = integral(f, -width / 2, width / 2);
    double most = 0;
    for (int q = 0; q <= k_filter_steps; q += 8) {
        const double x = static_cast<double>(t[static_cast<std::size_t>(q)]);
        most = std::max(most, std::fabs(integral(f, -width / 2, x) / total - static_cast<double>(q) / k_filter_steps));
    }
    return most;
}

TEST(PixelFilter, TablesInvertTheDistribution) {
    for (const PixelFilter filter : {PixelFilter::box, PixelFilter::gaussian, PixelFilter::blackman_harris}) {
        for (const float width : {1.0f, 1.5f, 3.0f}) {
            const double w = support(filter, static_cast<double>(width));
            const FilterTable t = make_filter_table(filter, width);
            const Density f = density(filter, w);
            EXPECT_LT(cdf_error(t, f, w), 1e-5) << static_cast<int>(filter) << " " << width;
            EXPECT_GT(cdf_error(t, density(PixelFilter::blackman_harris, 1.05 * w), 1.05 * w), 1e-3);
            EXPECT_NEAR(table_moment(t, 1), 0, 1e-5);
            const double variance =
                integral([&](double x) { return x * x * f(x); }, -w / 2, w / 2) / integral(f, -w / 2, w / 2);
            // The last of 1024 steps spreads its share evenly over the tail: 1.9 % more variance for the Gaussian, 0.3 % for the other.
            EXPECT_NEAR(table_moment(t, 2), variance, (filter == PixelFilter::gaussian ? 0.025 : 0.004) * variance);
        }
    }
}

TEST(PixelFilter, SupportAndOrder) {
    for (const PixelFilter filter : {PixelFilter::box, PixelFilter::gaussian, PixelFilter::blackman_harris}) {
        const FilterTable t = make_filter_table(filter, 1.5f);
        const double half = 0.5 * support(filter, 1.5);
        EXPECT_GE(static_cast<double>(t.front()), -half);
        EXPECT_LE(static_cast<double>(t.back()), half);
        for (std::size_t i = 1; i < t.size(); ++i) ASSERT_GE(t[i], t[i - 1]);
        for (std::size_t i = 0; i < t.size(); ++i) ASSERT_NEAR(t[i], -t[t.size() - 1 - i], 1e-4);
    }
    EXPECT_NEAR(make_filter_table(PixelFilter::box, 7.0f).back(), 0.5, 1e-6);
}

TEST(PixelFilter, TinyWidthsStayFinite) {
    for (const float width : {0.0f, 1e-20f, 0.01f}) {
        for (const float x : make_filter_table(PixelFilter::gaussian, width))
            ASSERT_TRUE(std::isfinite(x) && std::fabs(x) <= 0.0151f);
    }
}

}  // namespace
}  // namespace cardioid::film
