// SPDX-License-Identifier: GPL-3.0-or-later
// Regularised incomplete gamma and beta functions, in double: the distribution functions of chi² and Student's t.
// Series and continued fractions after Abramowitz & Stegun 6.5.29, 6.5.31 and 26.5.8; relative error about 1e-12.
#pragma once

#include <cmath>
#include <limits>

namespace cardioid::statistics {

namespace detail {

/// Value of the continued fraction b0 + a1/(b1 + a2/(b2 + ...)) by the modified Lentz method; term(n, a, b) gives
/// a_n, b_n.
template <class Term>
double continued_fraction(double b0, Term term) {
    constexpr double k_tiny = 1e-300;
    double f = b0 == 0 ? k_tiny : b0, c = f, d = 0;
    for (int n = 1; n < 100000; ++n) {
        double a = 0, b = 0;
        term(n, a, b);
        d = b + a * d;
        c = b + a / c;
        if (d == 0) d = k_tiny;
        if (c == 0) c = k_tiny;
        d = 1 / d;
        f *= c * d;
        if (std::abs(c * d - 1) < 1e-15) break;
    }
    return f;
}

}  // namespace detail

/// Upper regularised incomplete gamma function Q(a, x) = Γ(a, x)/Γ(a), a > 0; NaN for arguments outside the domain.
inline double gamma_q(double a, double x) {
    if (!(a > 0) || !(x >= 0)) return std::numeric_limits<double>::quiet_NaN();
    if (x == 0) return 1;
    const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
    if (x < a + 1) {
        double term = 1 / a, sum = term;
        for (double k = a + 1; std::abs(term) > 1e-17 * std::abs(sum); k += 1) sum += term *= x / k;
        return 1 - front * sum;
    }
    const double f = detail::continued_fraction(x + 1 - a, [=](int n, double& num, double& den) {
        num = -n * (n - a);
        den = x + 2 * n + 1 - a;
    });
    return front / f;
}

/// Regularised incomplete beta function I_x(a, b), a, b > 0, x in [0, 1]; NaN outside.
inline double beta_i(double a, double b, double x) {
    if (!(a > 0) || !(b > 0) || !(x >= 0 && x <= 1)) return std::numeric_limits<double>::quiet_NaN();
    if (x == 0 || x == 1) return x;
    // The fraction converges fast on this side of the mean only.
    if (x > (a + 1) / (a + b + 2)) return 1 - beta_i(b, a, 1 - x);
    const double front =
        std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x)) / a;
    const double f = detail::continued_fraction(1, [=](int n, double& num, double& den) {
        const int m = n / 2;
        num = n % 2 == 0 ? m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
                         : -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        den = 1;
    });
    return front / f;
}

/// Šidák: the level of each of m tests such that all together have level alpha.
inline double sidak(double alpha, int m) { return -std::expm1(std::log1p(-alpha) / m); }

}  // namespace cardioid::statistics
