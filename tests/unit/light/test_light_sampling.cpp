// SPDX-License-Identifier: GPL-3.0-or-later
// Directions come as often as the density for BSDF-sampled rays says, for every kind of lamp with a surface.
#include "direction_grid.h"

#include <gtest/gtest.h>

namespace cardioid::light_tests {
namespace {

constexpr int k_draws = 100'000;
constexpr double k_level = 1e-4;

struct Fit {
    statistics::Chi2Result chi2;
    double integral;
};

/// chi² of draws against `scale` times the density of hits.
Fit fit(const LightTable& table, const Receiver& at, const DirectionGrid& grid, double scale) {
    const auto p =
        grid.probabilities([&](Vec3 d) { return density(table, at.lanes(), d) * static_cast<float>(scale); }, 32);
    std::vector<double> observed(DirectionGrid::k_cells, 0.0), expected(DirectionGrid::k_cells);
    double invalid = 0;
    for_each_draw(table, at, k_draws, 7, [&](const Draw& d) {
        if (d.valid) {
            observed[grid.cell_of(d.wi)] += 1;
        } else {
            invalid += 1;
        }
    });
    observed.back() += invalid;
    for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = p[i] * k_draws;
    // A cell that the lamp only just touches may hold no quadrature point: few draws may fall there.
    return {statistics::chi2_test(observed, expected, 5, 3e-4), grid.integral()};
}

/// A cap that just holds all directions of the draws.
DirectionGrid grid_around(const LightTable& table, const Receiver& at) {
    Float3 mean{};
    for_each_draw(table, at, 2000, 3, [&](const Draw& d) {
        if (d.valid) mean = mean + d.wi;
    });
    mean = normalize(mean);
    double widest = 0;
    for_each_draw(table, at, 20000, 5, [&](const Draw& d) {
        if (!d.valid) return;
        const Float3 off = d.wi - mean;
        widest = std::max(widest, 2 * std::asin(std::min(1.0, 0.5 * static_cast<double>(length(off)))));
    });
    return DirectionGrid(mean, std::min(widest * 1.05, k_pi_d));
}

class LampSampling : public testing::TestWithParam<Case> {};

TEST_P(LampSampling, FitsDensity) {
    const LightTable table = table_of({GetParam().lamp});
    for (const Receiver& at : {Receiver{}, Receiver{{0.7f, 0.3f, 0.4f}, normalize(Float3{-0.3f, 0.1f, 1})},
                               Receiver{{0.2f, 0, 0.9f}, {0, 0, 0}}}) {
        const DirectionGrid grid = grid_around(table, at);
        const Fit good = fit(table, at, grid, 1);
        EXPECT_FALSE(good.chi2.rejected(k_level))
            << "p " << good.chi2.p << " statistic " << good.chi2.statistic << "/" << good.chi2.degrees;
        EXPECT_TRUE(fit(table, at, grid, 1.05).chi2.rejected(k_level)) << "density 5 % too large must not pass";
    }
}

std::string case_name(const testing::TestParamInfo<Case>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Kinds, LampSampling, testing::ValuesIn(surface_lamps()), case_name);

TEST(LampSampling, InsideSphere) {
    Case c = lamp_case("around", scene::LightKind::point, 10, tilted(0, 0, 0.5f));
    c.lamp.desc.radius = 2;
    const LightTable table = table_of({c.lamp});
    for (const Receiver& at : {Receiver{}, Receiver{{0.5f, 0.2f, 0}, {0, 0, 0}}}) {
        const DirectionGrid grid({0, 0, 1}, k_pi_d);
        EXPECT_FALSE(fit(table, at, grid, 1).chi2.rejected(k_level));
        EXPECT_TRUE(fit(table, at, grid, 1.05).chi2.rejected(k_level));
    }
}

/// The density of a hit and of a draw at the same direction are the same number.
TEST_P(LampSampling, DrawHasDensityOfHit) {
    const LightTable table = table_of({GetParam().lamp});
    const Receiver at{{0.7f, 0.3f, 0.4f}, {0, 0, 1}};
    Uniform uniform(11);
    int compared = 0, missed = 0;
    for (int k = 0; k < 4000; k += W) {
        const LightSample s = sample_light(table.data(), at.lanes(), uniform.lanes(), mask_of(true));
        if (hittable_lamps(table.data()) == 0) break;
        const LampHit h = intersect_lamp(table.data(), 0, at.lanes(), s.wi, 1e30f, mask_of(true));
        for (int i = 0; i < W; ++i) {
            if (((bits(s.valid) >> i) & 1) == 0) continue;
            ++compared;
            if (((bits(h.hit) >> i) & 1) == 0) {
                ++missed;  // on the very edge rounding decides
                continue;
            }
            EXPECT_NEAR(h.pdf[i] / s.pdf[i], 1, 2e-2f);
            EXPECT_NEAR(h.radiance.r[i], s.radiance.r[i], 2e-2f * std::fabs(s.radiance.r[i]) + 1e-2f);
        }
    }
    EXPECT_GT(compared, 100);
    EXPECT_LE(missed, compared / 500);
}

}  // namespace
}  // namespace cardioid::light_tests
