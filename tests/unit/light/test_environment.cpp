// SPDX-License-Identifier: GPL-3.0-or-later
// The world as a light: directions by density for smooth skies and for a sharp sun, exact densities, energy.
#include "direction_grid.h"
#include "statistics/ttest.h"

#include <gtest/gtest.h>

namespace cardioid::light_tests {
namespace {

constexpr double k_level = 1e-4;
constexpr int k_draws = 200'000;

/// Sky that is brighter upward, with a sun of half a degree and 20 000 times its brightness.
struct Sky {
    Float3 sun = normalize(Float3{0.5f, -0.6f, 0.7f});
    float sun_radiance = 20'000;
    float cos_sun = 0.99996f;
    Float3 operator()(Float3 d) const {
        const float sky = 0.2f + std::max(0.0f, d.z);
        const float value = dot(d, sun) > cos_sun ? sun_radiance : sky;
        return {value, value, value};
    }
};

light::WorldInput world_of(const Sky& sky, int resolution, bool compensate = false) {
    light::WorldInput world;
    world.constant = false;
    world.map_resolution = resolution;
    world.sampling = scene::WorldSampling::manual;
    world.program = 5;
    world.compensate = compensate;
    world.eval = [sky](int n, const Float3* d, Float3* out) {
        EXPECT_LE(n, 64);
        for (int i = 0; i < n; ++i) out[i] = sky(d[i]);
    };
    return world;
}

LightTable table_of_world(const light::WorldInput& world) { return LightTable({}, {}, &world, {}, {}); }

struct Fit {
    statistics::Chi2Result chi2;
    double integral;
};
Fit fit(const LightTable& table, const DirectionGrid& grid, double scale, int sub) {
    const Receiver at{};
    const auto p = grid.probabilities(
        [&](Vec3 d) { return pdf_environment(table.data(), at.lanes(), d, mask_of(true)) * static_cast<float>(scale); },
        sub);
    std::vector<double> observed(DirectionGrid::k_cells, 0.0), expected;
    for_each_draw(table, at, k_draws, 3, [&](const Draw& d) { observed[grid.cell_of(d.wi)] += d.valid ? 1 : 0; });
    for (const double x : p) expected.push_back(x * k_draws);
    return {statistics::chi2_test(observed, expected), grid.integral()};
}

TEST(Environment, MapFitsDensity) {
    Sky smooth;
    smooth.sun_radiance = 0.5f;
    const LightTable table = table_of_world(world_of(smooth, 64));
    const DirectionGrid whole(normalize(Float3{0.2f, 0.3f, 0.9f}), k_pi_d);
    const Fit good = fit(table, whole, 1, 16);
    EXPECT_NEAR(good.integral, 1, 2e-3);
    EXPECT_FALSE(good.chi2.rejected(k_level)) << good.chi2.p;
    EXPECT_TRUE(fit(table, whole, 1.05, 16).chi2.rejected(k_level));
}

TEST(Environment, SharpSunFitsDensity) {
    Sky sky;
    sky.sun_radiance = 60'000;
    const LightTable table = table_of_world(world_of(sky, 512));
    const DirectionGrid around_sun(sky.sun, 0.06);
    const Fit good = fit(table, around_sun, 1, 32);
    EXPECT_GT(good.integral, 0.5) << "most samples belong to the sun";
    EXPECT_FALSE(good.chi2.rejected(k_level)) << good.chi2.p;
    EXPECT_TRUE(fit(table, around_sun, 1.05, 32).chi2.rejected(k_level));
}

TEST(Environment, PolesFitDensity) {
    Sky smooth;
    smooth.sun_radiance = 0.5f;
    const LightTable table = table_of_world(world_of(smooth, 64));
    for (const float pole : {1.0f, -1.0f}) {
        const DirectionGrid cap({0, 0, pole}, 0.3);
        EXPECT_FALSE(fit(table, cap, 1, 24).chi2.rejected(k_level)) << pole;
    }
}

TEST(Environment, DrawHasItsDensity) {
    const Sky sky;
    const LightTable table = table_of_world(world_of(sky, 256));
    const Receiver at{};
    Uniform uniform(9);
    int far_off = 0;
    for (int k = 0; k < 20'000; k += W) {
        const LightSample s = sample_light(table.data(), at.lanes(), uniform.lanes(), mask_of(true));
        const Float pdf = pdf_environment(table.data(), at.lanes(), s.wi, mask_of(true));
        EXPECT_TRUE(all(s.valid & s.infinite & ~s.delta & (s.program == Int(5))));
        for (int i = 0; i < W; ++i) far_off += std::fabs(pdf[i] / s.pdf[i] - 1) > 1e-3f ? 1 : 0;
    }
    // On the border between two cells rounding may read the neighbour.
    EXPECT_LE(far_off, 20);
}

TEST(Environment, EnergyIsExact) {
    const Sky sky;
    const Receiver at{{0, 0, 0}, normalize(Float3{0.2f, -0.1f, 1})};
    for (const int resolution : {32, 256, 1024}) {
        const LightTable table = table_of_world(world_of(sky, resolution));
        statistics::Moments m, wrong;
        for_each_draw(table, at, k_draws, 21, [&](const Draw& d) {
            const double value = static_cast<double>(sky(d.wi).x * std::max(0.0f, dot(d.wi, at.n)) / d.pdf);
            m.add(value);
            wrong.add(value / 1.05);
        });
        // Quadrature of the sky over the sphere, plus the sun's disk in closed form.
        double expected = 0;
        constexpr int k_steps = 1500;
        for (int a = 0; a < k_steps; ++a) {
            for (int b = 0; b < k_steps; ++b) {
                const double z = (a + 0.5) / k_steps * 2 - 1, phi = 2 * k_pi_d * (b + 0.5) / k_steps,
                             r = std::sqrt(1 - z * z);
                const double cosine = r * std::cos(phi) * static_cast<double>(at.n.x) +
                                      r * std::sin(phi) * static_cast<double>(at.n.y) + z * static_cast<double>(at.n.z);
                expected += (0.2 + std::max(0.0, z)) * std::max(0.0, cosine);
            }
        }
        expected *= 4 * k_pi_d / (k_steps * static_cast<double>(k_steps));
        const double disk = 2 * k_pi_d * (1 - static_cast<double>(sky.cos_sun)),
                     above = 0.2 + static_cast<double>(sky.sun.z);
        expected += disk * (static_cast<double>(sky.sun_radiance) - above) * static_cast<double>(dot(sky.sun, at.n));
        EXPECT_FALSE(statistics::t_test(m, expected, 2e-3 * expected).rejected(k_level))
            << resolution << " " << m.mean << " " << expected;
        if (resolution >= 256) { EXPECT_TRUE(statistics::t_test(wrong, expected, 2e-3 * expected).rejected(k_level)); }
    }
}

TEST(Environment, CompensatedSamplesAndEvenOnesTogetherSeeAllLight) {
    const Sky sky;
    const Receiver at{{0, 0, 0}, {0, 0, 0}};
    const LightTable table = table_of_world(world_of(sky, 1024, true));
    const auto power = [](double a, double b) { return a * a / std::max(a * a + b * b, 1e-30); };
    const double even = 1 / (4 * k_pi_d);
    statistics::Moments sampled, by_chance;
    for_each_draw(table, at, k_draws, 33, [&](const Draw& d) {
        const auto pdf = static_cast<double>(d.pdf);
        sampled.add(d.valid ? static_cast<double>(sky(d.wi).x) / pdf * power(pdf, even) : 0);
    });
    Uniform uniform(4);
    for (int k = 0; k < k_draws; k += W) {
        const Vec3 u = uniform.lanes();
        for (int i = 0; i < W; ++i) {
            const float z = 2 * u.x[i] - 1, phi = static_cast<float>(2 * k_pi_d) * u.y[i], r = std::sqrt(1 - z * z);
            const Float3 d{r * std::cos(phi), r * std::sin(phi), z};
            const Vec3 toward{d.x, d.y, d.z};
            const Float pdf = pdf_environment(table.data(), at.lanes(), toward, mask_of(true));
            by_chance.add(static_cast<double>(sky(d).x) / even * power(even, static_cast<double>(pdf[0])));
        }
    }
    const double disk = 2 * k_pi_d * (1 - static_cast<double>(sky.cos_sun));
    const double expected = 4 * k_pi_d * 0.45 + disk * 20'000;
    EXPECT_NEAR(sampled.mean + by_chance.mean, expected, 0.01 * expected);
    // Nothing is spent on what is darker than the mean.
    const Vec3 down{0.0f, 0.0f, -1.0f};
    EXPECT_EQ(pdf_environment(table.data(), at.lanes(), down, mask_of(true))[0], 0.0f);
}

TEST(Environment, SunDrawsMostSamples) {
    // A half degree sun must not be a firefly: its share of the samples is near its share of the energy.
    const Sky sky;
    const LightTable table = table_of_world(world_of(sky, 1024));
    int sun = 0;
    for_each_draw(table, Receiver{}, k_draws, 5,
                  [&](const Draw& d) { sun += dot(d.wi, sky.sun) > sky.cos_sun ? 1 : 0; });
    const double disk = 2 * k_pi_d * (1 - static_cast<double>(sky.cos_sun)) * 20'000, rest = 4 * k_pi_d * 0.45;
    EXPECT_GT(static_cast<double>(sun) / k_draws, 0.6 * disk / (disk + rest));
}

TEST(Environment, ConstantWorld) {
    light::WorldInput world;
    world.color = {0.5f, 0.6f, 0.7f};
    const LightTable table = table_of_world(world);
    for (const Receiver& at : {Receiver{{0, 0, 0}, normalize(Float3{1, 2, -0.5f})}, Receiver{{0, 0, 0}, {0, 0, 0}}}) {
        const DirectionGrid whole({0, 0, 1}, k_pi_d);
        const auto density = [&](Vec3 d) { return pdf_environment(table.data(), at.lanes(), d, mask_of(true)); };
        const auto p = whole.probabilities(density, 16);
        std::vector<double> observed(DirectionGrid::k_cells, 0.0), expected, wrong;
        for_each_draw(table, at, k_draws, 3, [&](const Draw& d) { observed[whole.cell_of(d.wi)] += 1; });
        for (const double x : p) {
            expected.push_back(x * k_draws);
            wrong.push_back(x * k_draws * 1.05);
        }
        EXPECT_FALSE(statistics::chi2_test(observed, expected).rejected(k_level));
        EXPECT_TRUE(statistics::chi2_test(observed, wrong).rejected(k_level));
    }
}

TEST(Environment, SwitchedOffOrBlack) {
    light::WorldInput world;
    world.color = {1, 1, 1};
    world.sampling = scene::WorldSampling::none;
    EXPECT_TRUE(table_of_world(world).empty());
    world.sampling = scene::WorldSampling::automatic;
    world.color = {0, 0, 0};
    EXPECT_TRUE(table_of_world(world).empty());
    world.constant = false;
    world.map_resolution = 16;
    world.eval = [](int n, const Float3*, Float3* out) { std::fill(out, out + n, Float3{0, 0, 0}); };
    EXPECT_TRUE(table_of_world(world).empty());
    world.eval = [](int n, const Float3*, Float3* out) { std::fill(out, out + n, Float3{std::nanf(""), 0, 0}); };
    EXPECT_TRUE(table_of_world(world).empty());
}

}  // namespace
}  // namespace cardioid::light_tests
