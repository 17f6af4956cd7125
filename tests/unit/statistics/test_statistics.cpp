// SPDX-License-Identifier: GPL-3.0-or-later
// The test tools themselves: against published table values, and their false alarm rate and power on synthetic data.
#include "statistics/chi2.h"
#include "statistics/ttest.h"

#include <gtest/gtest.h>

#include <random>

namespace cardioid::statistics {
namespace {

TEST(SpecialFunctions, GammaMatchesClosedForms) {
    for (const double x : {0.1, 1.0, 3.0, 20.0}) {
        EXPECT_NEAR(gamma_q(1, x), std::exp(-x), 1e-13);
        EXPECT_NEAR(gamma_q(0.5, x), std::erfc(std::sqrt(x)), 1e-12);
        EXPECT_NEAR(gamma_q(3, x), std::exp(-x) * (1 + x + x * x / 2), 1e-12);
    }
    EXPECT_TRUE(std::isnan(gamma_q(-1, 1)));
}

TEST(SpecialFunctions, BetaMatchesClosedForms) {
    for (const double x : {0.01, 0.3, 0.5, 0.9}) {
        EXPECT_NEAR(beta_i(1, 1, x), x, 1e-13);
        EXPECT_NEAR(beta_i(2, 3, x), x * x * (6 - 8 * x + 3 * x * x), 1e-12);
        EXPECT_NEAR(beta_i(40, 7, x) + beta_i(7, 40, 1 - x), 1, 1e-12);
    }
}

TEST(Distributions, TableValues) {
    // Abramowitz & Stegun tables 26.8 and 26.10.
    EXPECT_NEAR(chi2_upper(3.84146, 1), 0.05, 1e-6);
    EXPECT_NEAR(chi2_upper(18.3070, 10), 0.05, 1e-6);
    EXPECT_NEAR(chi2_upper(135.807, 100), 0.01, 1e-6);
    EXPECT_NEAR(student_two_sided(12.706, 1), 0.05, 1e-5);
    EXPECT_NEAR(student_two_sided(2.228, 10), 0.05, 1e-4);
    EXPECT_NEAR(student_quantile(0.01, 60), 2.660, 1e-3);
    EXPECT_NEAR(1 - std::pow(1 - sidak(0.01, 50), 50), 0.01, 1e-12);
}

Chi2Result die(std::mt19937& random, const std::vector<double>& true_weights) {
    std::discrete_distribution<int> draw(true_weights.begin(), true_weights.end());
    constexpr int k_draws = 4000;
    std::vector<double> observed(20), expected(20, k_draws / 20.0);
    for (int k = 0; k < k_draws; ++k) observed[static_cast<std::size_t>(draw(random))] += 1;
    return chi2_test(observed, expected);
}

TEST(Chi2, FalseAlarmRateIsTheLevelAndABiasIsSeen) {
    std::mt19937 random(1);
    std::vector<double> fair(20, 1.0), loaded(20, 1.0);
    loaded[3] = 2;
    int alarms = 0, found = 0;
    for (int k = 0; k < 1000; ++k) alarms += die(random, fair).rejected(0.05);
    for (int k = 0; k < 50; ++k) found += die(random, loaded).rejected(0.01);
    EXPECT_GT(alarms, 25);
    EXPECT_LT(alarms, 80);
    EXPECT_EQ(found, 50);
}

TEST(Chi2, CountsWhereNothingIsExpectedAreRejected) {
    EXPECT_TRUE(chi2_test({50, 50, 3}, {50, 50, 0}).rejected(1e-9));
    EXPECT_TRUE(chi2_test({50, 50}, {50, std::nan("")}).rejected(1e-9));
    EXPECT_FALSE(chi2_test({50, 50, 0}, {50, 50, 0}).rejected(0.01));
}

TEST(Chi2, SmallCellsArePooled) {
    const Chi2Result r = chi2_test({1, 1, 1, 1, 1, 1, 94}, {1, 1, 1, 1, 1, 1, 94});
    EXPECT_EQ(r.degrees, 1);
    EXPECT_NEAR(r.statistic, 0, 1e-12);
}

Moments exponential(std::mt19937& random, double mean, int n) {
    std::exponential_distribution<double> draw(1 / mean);
    Moments m;
    for (int k = 0; k < n; ++k) m.add(draw(random));
    return m;
}

TEST(TTest, FalseAlarmRateAndPower) {
    std::mt19937 random(2);
    int alarms = 0, welch_alarms = 0, found = 0, welch_found = 0;
    for (int k = 0; k < 1000; ++k) {
        const Moments a = exponential(random, 1, 200), b = exponential(random, 1, 400);
        alarms += t_test(a, 1).rejected(0.05);
        welch_alarms += welch_test(a, b).rejected(0.05);
        found += t_test(a, 1.5).rejected(0.05);
        welch_found += welch_test(a, exponential(random, 1.5, 400)).rejected(0.05);
    }
    EXPECT_NEAR(alarms, 50, 30);
    EXPECT_NEAR(welch_alarms, 50, 30);
    EXPECT_GT(found, 950);
    EXPECT_GT(welch_found, 950);
}

TEST(TTest, EquivalenceNeedsEnoughData) {
    std::mt19937 random(3);
    const Moments few = exponential(random, 1, 20), many = exponential(random, 1, 200000);
    EXPECT_FALSE(t_test(few, 1).equivalent(0.02, 0.02));
    EXPECT_TRUE(t_test(many, 1).equivalent(0.02, 0.02));
    EXPECT_FALSE(t_test(many, 1.05).equivalent(0.02, 0.02));
}

TEST(TTest, NotANumberIsRejected) {
    Moments m;
    m.add(1);
    m.add(std::nan(""));
    EXPECT_TRUE(t_test(m, 1).rejected(0.01));
}

}  // namespace
}  // namespace cardioid::statistics
