// SPDX-License-Identifier: GPL-3.0-or-later
// Phase functions: each integrates to 1, has its known mean cosine, and sample_phase draws from it (chi²).
#include "bsdf/phase.h"
#include "model.h"
#include "statistics/chi2.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace cardioid::test {
namespace {

using bsdf::PhaseKind;

struct PhaseCase {
    const char* name;
    PhaseKind kind;
    Vec3 parameter;
    double peak;  ///< cosines above this are too steep for a histogram: one cell
};

std::vector<PhaseCase> phase_cases() {
    const auto p = [](float a, float b = 0) { return Vec3{a, b, 0.0f}; };
    return {{"isotropic", PhaseKind::henyey_greenstein, p(0), 1},
            {"hg 0.7", PhaseKind::henyey_greenstein, p(0.7f), 1},
            {"hg -0.9", PhaseKind::henyey_greenstein, p(-0.9f), 1},
            {"rayleigh", PhaseKind::rayleigh, p(0), 1},
            {"draine 0, 1", PhaseKind::draine, p(0, 1), 1},
            {"draine 0.05, 250", PhaseKind::draine, p(0.05f, 250), 1},
            {"draine -0.3, 20", PhaseKind::draine, p(-0.3f, 20), 1},
            {"draine 0.8, 0.5", PhaseKind::draine, p(0.8f, 0.5f), 1},
            {"mie 0.05", PhaseKind::mie, p(0.05f), 1},
            {"mie 0.8", PhaseKind::mie, p(0.8f), 1},
            {"mie 3", PhaseKind::mie, p(3), 1},
            {"mie 20", PhaseKind::mie, p(20), 0.999},
            {"fournier-forand 0.1, 1.33", PhaseKind::fournier_forand, p(0.1f, 1.33f), 0.999},
            {"fournier-forand 0.4, 1.1", PhaseKind::fournier_forand, p(0.4f, 1.1f), 0.999}};
}

double density(const PhaseCase& c, double cosine) {
    return static_cast<double>(eval_phase(c.kind, c.parameter, Float(static_cast<float>(cosine)))[0]);
}

/// 2π∫ f(cos)·cos^power between two cosines of one sign; steps crowd toward ±1 like those of a peak.
double half_integral(const PhaseCase& c, double from, double to, int power, double sign) {
    constexpr int steps = 4000;
    const double a = std::pow(1 - to, 0.25), b = std::pow(1 - from, 0.25);
    double sum = 0;
    for (int k = 0; k < steps; ++k) {
        const double t = a + (b - a) * (k + 0.5) / steps, cosine = sign * (1 - t * t * t * t);
        sum += density(c, cosine) * std::pow(cosine, power) * 4 * t * t * t;
    }
    return 2 * 3.14159265358979 * sum * (b - a) / steps;
}
double integral(const PhaseCase& c, double from, double to, int power) {
    return (to > 0 ? half_integral(c, std::max(from, 0.0), to, power, 1) : 0) +
           (from < 0 ? half_integral(c, -std::min(to, 0.0), -from, power, -1) : 0);
}

TEST(Phase, IntegratesToOne) {
    for (const PhaseCase& c : phase_cases()) {
        const double tolerance = c.kind == PhaseKind::fournier_forand ? 0.01 : 1e-3;
        EXPECT_NEAR(integral(c, -1, 1, 0), 1, tolerance) << c.name;
    }
}

TEST(Phase, MeanCosineIsTheKnownOne) {
    for (const PhaseCase& c : phase_cases()) {
        if (c.kind == PhaseKind::fournier_forand) continue;
        EXPECT_NEAR(integral(c, -1, 1, 1), static_cast<double>(mean_cosine(c.kind, c.parameter)[0]), 2e-3) << c.name;
    }
}

TEST(Phase, SpecialCasesAgree) {
    for (const float x : {-0.9f, -0.2f, 0.3f, 0.99f}) {
        const auto at = [x](PhaseKind k, float a, float b) { return eval_phase(k, {a, b, 0.0f}, Float(x))[0]; };
        EXPECT_NEAR(at(PhaseKind::draine, 0, 1), at(PhaseKind::rayleigh, 0, 0), 1e-5);
        EXPECT_NEAR(at(PhaseKind::draine, 0.6f, 0) / at(PhaseKind::henyey_greenstein, 0.6f, 0), 1, 1e-5);
    }
}

TEST(Phase, BackscatterOfFournierForandIsTheGivenFraction) {
    for (const float b : {0.05f, 0.2f, 0.4f}) {
        const PhaseCase c{"", PhaseKind::fournier_forand, {b, 1.33f, 0.0f}, 1};
        EXPECT_NEAR(integral(c, -1, 0, 0), static_cast<double>(b), 0.01) << b;
    }
}

statistics::Chi2Result chi2(const PhaseCase& c, PhaseKind claimed, int draws, std::uint32_t seed) {
    constexpr int rows = 40, columns = 4;
    const Vec3 wo = direction(0.3f, 1.1f);
    const Frame frame(-wo);
    std::vector<double> observed(rows * columns + 1, 0.0), expected(observed.size(), 0.0);
    const auto row_of = [&](double cosine) {
        return cosine >= c.peak ? -1 : std::min(rows - 1, static_cast<int>((cosine + 1) / (c.peak + 1) * rows));
    };
    Uniform uniform(seed);
    for (int k = 0; k < draws; k += W) {
        const PhaseSample s = sample_phase(c.kind, c.parameter, wo, uniform.lanes(), uniform.lanes());
        const Vec3 local = frame.to_local(s.wi);
        for (int l = 0; l < W; ++l) {
            const int row = row_of(static_cast<double>(local.z[l]));
            const float turn = std::atan2(local.y[l], local.x[l]) / 6.2831853f;
            const int column = std::min(columns - 1, static_cast<int>((turn < 0 ? turn + 1 : turn) * columns));
            observed[row < 0 ? observed.size() - 1 : static_cast<std::size_t>(row * columns + column)] += 1;
        }
    }
    const double drawn = (draws + W - 1) / W * W;
    const PhaseCase shape{c.name, claimed, c.parameter, c.peak};
    double total = 0;
    for (int r = 0; r < rows; ++r) {
        const double a = -1 + r * (c.peak + 1) / rows, b = -1 + (r + 1) * (c.peak + 1) / rows;
        for (int k = 0; k < columns; ++k)
            total += expected[static_cast<std::size_t>(r * columns + k)] = drawn * integral(shape, a, b, 0) / columns;
    }
    expected.back() = std::max(drawn - total, 0.0);
    return statistics::chi2_test(observed, expected);
}

TEST(PhaseSampling, DirectionsFollowTheDensity) {
    const auto cases = phase_cases();
    const double level = statistics::sidak(0.01, static_cast<int>(cases.size()));
    std::uint32_t seed = 7;
    for (const PhaseCase& c : cases) {
        const auto r = chi2(c, c.kind, 60000, seed++);
        EXPECT_FALSE(r.rejected(level)) << c.name << ": chi² " << r.statistic << " for " << r.degrees << ", p " << r.p;
    }
}

TEST(PhaseSampling, AnotherPhaseFunctionIsRejected) {
    const PhaseCase rayleigh{"rayleigh", PhaseKind::rayleigh, {0.3f, 1.0f, 0.0f}, 1};
    EXPECT_TRUE(chi2(rayleigh, PhaseKind::henyey_greenstein, 60000, 3).rejected(1e-4));
    const PhaseCase draine{"draine", PhaseKind::draine, {0.3f, 1.0f, 0.0f}, 1};
    EXPECT_TRUE(chi2(draine, PhaseKind::henyey_greenstein, 60000, 3).rejected(1e-4));
}

}  // namespace
}  // namespace cardioid::test
