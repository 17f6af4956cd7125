// SPDX-License-Identifier: GPL-3.0-or-later
// Pearson's chi² test of counts against expected counts (the way of pbrt-v4 and Mitsuba 3).
#pragma once

#include "statistics/special_functions.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace cardioid::statistics {

struct Chi2Result {
    double statistic = 0;
    int degrees = 0;          ///< cells after pooling, minus one
    double p = 0;             ///< probability of a fit this bad or worse under the hypothesis; 0 where it is impossible
    bool impossible = false;  ///< negative or non-finite expectation, or counts where nothing is expected
    bool rejected(double level) const { return impossible || !(p >= level); }
};

/// Probability that a chi² variable with k degrees of freedom exceeds x.
inline double chi2_upper(double x, int k) { return gamma_q(0.5 * k, 0.5 * x); }

/// `expected[i]` is n·probability of cell i, the same order as `observed`. Draws that fell in no cell (lost below the
/// horizon) are passed as a cell of their own or left out of both sides. Cells are sorted by expectation and pooled
/// until each has at least `least`. More than `stray`·Σobserved counts in cells that expect under 1e-9 are
/// impossible.
inline Chi2Result chi2_test(const std::vector<double>& observed, const std::vector<double>& expected, double least = 5,
                            double stray = 1e-5) {
    Chi2Result r;
    std::vector<std::size_t> order(expected.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
    const double total = std::accumulate(observed.begin(), observed.end(), 0.0);
    double pool_e = 0, pool_o = 0, strays = 0, last_e = 0, last_o = 0;
    int cells = 0;
    for (const std::size_t i : order) {
        if (!std::isfinite(expected[i]) || expected[i] < 0) r.impossible = true;
        if (expected[i] < 1e-9) {
            strays += observed[i];
            continue;
        }
        pool_e += expected[i];
        pool_o += observed[i];
        if (pool_e < least) continue;
        r.statistic += (pool_o - pool_e) * (pool_o - pool_e) / pool_e;
        last_e = pool_e;
        last_o = pool_o;
        pool_e = pool_o = 0;
        ++cells;
    }
    if (pool_e > 0 && cells > 0) {
        // What is left over is too small for a cell of its own: merge it into the last one.
        r.statistic -= (last_o - last_e) * (last_o - last_e) / last_e;
        last_e += pool_e;
        last_o += pool_o;
        r.statistic += (last_o - last_e) * (last_o - last_e) / last_e;
    }
    if (strays > stray * total) r.impossible = true;
    r.degrees = cells - 1;
    if (r.degrees < 1) r.impossible = true;
    r.p = r.impossible ? 0 : chi2_upper(r.statistic, r.degrees);
    return r;
}

}  // namespace cardioid::statistics
