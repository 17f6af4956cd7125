// SPDX-License-Identifier: GPL-3.0-or-later
// Student's t-test against a known mean, Welch's test of two means, and the equivalence bound that "not rejected"
// needs.
#pragma once

#include "statistics/special_functions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace cardioid::statistics {

/// Running mean and variance (Welford).
struct Moments {
    std::int64_t n = 0;
    double mean = 0, m2 = 0;
    void add(double x) {
        ++n;
        const double d = x - mean;
        mean += d / static_cast<double>(n);
        m2 += d * (x - mean);
    }
    /// Unbiased; 0 for fewer than two values.
    double variance() const { return n > 1 ? m2 / static_cast<double>(n - 1) : 0; }
    double variance_of_mean() const { return n > 0 ? variance() / static_cast<double>(n) : 0; }
};

/// Two-sided: probability that |t| with `degrees` degrees of freedom is at least |t| given.
inline double student_two_sided(double t, double degrees) {
    return beta_i(0.5 * degrees, 0.5, degrees / (degrees + t * t));
}

/// The t whose two-sided probability is p (0 < p < 1), by bisection.
inline double student_quantile(double p, double degrees) {
    double lo = 0, hi = 1;
    while (student_two_sided(hi, degrees) > p) hi *= 2;
    for (int k = 0; k < 80; ++k) {
        const double mid = 0.5 * (lo + hi);
        (student_two_sided(mid, degrees) > p ? lo : hi) = mid;
    }
    return 0.5 * (lo + hi);
}

struct TResult {
    double difference = 0;  ///< mean − reference, or first mean − second
    double error = 0;       ///< standard error of the difference
    double degrees = 0;
    double p = 0;  ///< two-sided; NaN when the data are not finite
    bool rejected(double level) const { return !(p >= level); }
    /// Half width of the two-sided confidence interval of the difference at 1 − level.
    double half_width(double level) const { return error * student_quantile(level, degrees); }
    /// The interval at 1 − level lies inside ±bound (two one-sided tests at level/2 each).
    bool equivalent(double bound, double level) const {
        return std::isfinite(difference) && std::abs(difference) + half_width(level) <= bound;
    }
};

namespace detail {
inline TResult t_result(double difference, double variance, double degrees) {
    TResult r;
    r.difference = difference;
    // The floor is for constant data: rounding errors must not look significant.
    r.error = std::sqrt(std::max(variance, 1e-18));
    r.degrees = degrees;
    r.p = student_two_sided(difference / r.error, degrees);
    return r;
}
}  // namespace detail

/// Mean of independent values against the reference `mu`. `rounding` is the error that `mu` or the values may have.
inline TResult t_test(const Moments& m, double mu, double rounding = 0) {
    return detail::t_result(m.mean - mu, m.variance_of_mean() + rounding * rounding, static_cast<double>(m.n - 1));
}

/// Two unknown means with unknown, unequal variances (Welch–Satterthwaite).
inline TResult welch_test(const Moments& a, const Moments& b) {
    const double va = a.variance_of_mean(), vb = b.variance_of_mean();
    const double den = va * va / static_cast<double>(a.n - 1) + vb * vb / static_cast<double>(b.n - 1);
    const double degrees = den > 0 ? (va + vb) * (va + vb) / den : static_cast<double>(a.n + b.n - 2);
    return detail::t_result(a.mean - b.mean, va + vb, degrees);
}

}  // namespace cardioid::statistics
