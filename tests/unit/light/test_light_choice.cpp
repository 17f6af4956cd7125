// SPDX-License-Identifier: GPL-3.0-or-later
// Emitters are picked with the probability that pick_probability tells, those add up to one, and the density of a hit
// triangle is the density of the draws.
#include "light_tests.h"
#include "statistics/chi2.h"
#include "statistics/ttest.h"

#include <gtest/gtest.h>

namespace cardioid::light_tests {
namespace {

constexpr double k_level = 1e-4;

std::vector<LampInput> scattered_lamps(int n, std::uint32_t seed, float extent) {
    Uniform u(seed);
    std::vector<LampInput> lamps;
    const auto at = [&] { return (u() - 0.5f) * extent; };
    for (int i = 0; i < n; ++i) {
        Case c = lamp_case("",
                           i % 3 == 0   ? scene::LightKind::area
                           : i % 3 == 1 ? scene::LightKind::point
                                        : scene::LightKind::spot,
                           10 + 90 * u(), tilted(at(), at(), 1 + 3 * u()));
        c.lamp.desc.radius = i % 2 == 0 ? 0.05f : 0.0f;
        c.lamp.desc.size_x = 0.1f;
        c.lamp.desc.spot_angle = 1.5f;
        lamps.push_back(c.lamp);
    }
    return lamps;
}

std::vector<light::EmissiveTriangle> scattered_triangles(int n, std::uint32_t seed) {
    Uniform u(seed);
    std::vector<light::EmissiveTriangle> all;
    for (int i = 0; i < n; ++i) {
        const Float3 p{4 * u() - 2, 4 * u() - 2, 1 + 2 * u()};
        const auto near = [&] { return p + Float3{u() - 0.5f, u() - 0.5f, u() - 0.5f} * 0.4f; };
        light::EmissiveTriangle t{near(), near(), near(), {u() * 5, u() * 5, 1}, i % 4, i * 3, -1, i % 5 != 0};
        all.push_back(t);
    }
    return all;
}

struct Scene {
    std::string name;
    LightTable table;
};

Scene mixed_scene(int lamps, int triangles, int suns, bool world, float extent = 8) {
    std::vector<LampInput> all = scattered_lamps(lamps, 3, extent);
    for (int i = 0; i < suns; ++i) {
        Case c =
            lamp_case("", scene::LightKind::sun, 0.5f + static_cast<float>(i), tilted(static_cast<float>(i), 0, 0));
        c.lamp.desc.angle = 0.1f * static_cast<float>(i % 3);
        all.push_back(c.lamp);
    }
    light::WorldInput sky;
    sky.color = {0.2f, 0.3f, 0.4f};
    return {
        std::to_string(lamps) + "_" + std::to_string(triangles) + "_" + std::to_string(suns) + (world ? "_world" : ""),
        LightTable(all, scattered_triangles(triangles, 9), world ? &sky : nullptr, {-8, -8, -8}, {8, 8, 8})};
}

int emitters(const LightTable& table) {
    return table.data().lamp_count + table.data().triangle_count + (table.data().environment.emitter >= 0 ? 1 : 0);
}

std::vector<double> probabilities(const LightTable& table, const Receiver& at) {
    std::vector<double> p;
    const int n = emitters(table);
    for (int k = 0; k < n; k += W) {
        Int id = Int(-1);
        for (int i = 0; i < W && k + i < n; ++i) id.v[i] = k + i;
        const Float chance = pick_probability(table.data(), at.lanes(), id, mask_of(true));
        for (int i = 0; i < W && k + i < n; ++i) p.push_back(static_cast<double>(chance[i]));
    }
    return p;
}

std::vector<double> picks(const LightTable& table, const Receiver& at, int draws) {
    std::vector<double> count(static_cast<std::size_t>(emitters(table)), 0.0);
    Uniform uniform(23);
    for (int k = 0; k < draws; k += W) {
        const EmitterPick pick = pick_emitter(table.data(), at.lanes(), uniform.lanes().x, first_lanes(draws - k));
        for (int i = 0; i < W; ++i) {
            if (((bits(pick.valid) >> i) & 1) != 0) count[static_cast<std::size_t>(pick.emitter[i])] += 1;
        }
    }
    return count;
}

std::vector<Receiver> receivers() {
    return {{{0, 0, 0}, {0, 0, 1}}, {{1, 2, 1.5f}, normalize(Float3{1, 1, 0.2f})}, {{0.5f, -1, 2}, {0, 0, 0}}};
}

TEST(Choice, ProbabilitiesAreThoseOfPicks) {
    for (const auto& [lamps, triangles, suns, world] : {std::tuple{1, 0, 0, false},
                                                        {2, 0, 0, false},
                                                        {6, 0, 1, true},
                                                        {40, 0, 0, false},
                                                        {30, 200, 2, true},
                                                        {0, 300, 7, true},
                                                        {0, 1, 9, false}}) {
        const Scene s = mixed_scene(lamps, triangles, suns, world);
        for (const Receiver& at : receivers()) {
            const std::vector<double> p = probabilities(s.table, at);
            double sum = 0;
            for (const double x : p) sum += x;
            EXPECT_LE(sum, 1 + 1e-5) << s.name;
            // Bounds of groups are cautious: a few picks end where nothing can light the receiver. They are lost, not wrong.
            EXPECT_TRUE(sum == 0 || sum >= 0.7) << s.name << " " << sum;
            constexpr int k_draws = 100'000;
            std::vector<double> observed = picks(s.table, at, k_draws), expected, wrong;
            std::size_t possible = 0;
            for (const double x : p) {
                expected.push_back(x * k_draws);
                wrong.push_back(k_draws / static_cast<double>(p.size()));
                possible += x > 1e-4 ? 1 : 0;
            }
            double taken = 0;
            for (const double x : observed) taken += x;
            observed.push_back(k_draws - taken);
            expected.push_back(std::max(0.0, 1 - sum) * k_draws);
            wrong.push_back(0);
            if (sum > 1 - 1e-5) expected.back() = observed.back() = 0;
            if (possible < 3) continue;
            const statistics::Chi2Result fit = statistics::chi2_test(observed, expected);
            EXPECT_FALSE(fit.rejected(k_level)) << s.name << " p " << fit.p;
            EXPECT_TRUE(statistics::chi2_test(observed, wrong).rejected(k_level))
                << s.name << ": a uniform choice must not pass";
        }
    }
}

TEST(Choice, TenThousandLampsAndTriangles) {
    const Scene s = mixed_scene(10'000, 10'000, 3, true, 60);
    for (const Receiver& at : receivers()) {
        double sum = 0;
        for (const double x : probabilities(s.table, at)) sum += x;
        EXPECT_LE(sum, 1 + 1e-3);
        EXPECT_GE(sum, 0.7);
    }
}

/// Sum over all emitters of the irradiance that single-emitter tables give is what the whole table gives: nothing that
/// lights the receiver is ever pruned.
TEST(Choice, WholeIsSumOfParts) {
    std::vector<LampInput> lamps = scattered_lamps(20, 3, 8);
    for (int i = 0; i < 9; ++i) {
        Case c = lamp_case("", scene::LightKind::sun, 1, tilted(0, 0, 0));
        c.lamp.desc.angle = 0.2f * static_cast<float>(i % 3);
        lamps.push_back(c.lamp);
    }
    const std::vector<light::EmissiveTriangle> triangles = scattered_triangles(40, 9);
    light::WorldInput sky;
    sky.color = {0.2f, 0.3f, 0.4f};
    const LightTable table(lamps, triangles, &sky, {-8, -8, -8}, {8, 8, 8});
    std::vector<LightTable> parts;
    for (const LampInput& lamp : lamps) parts.push_back(table_of({lamp}));
    for (const light::EmissiveTriangle& t : triangles) parts.push_back(LightTable({}, {t}, nullptr, {}, {}));
    parts.push_back(LightTable({}, {}, &sky, {}, {}));
    // The last receiver sees the suns cut by its horizon, and most lamps from behind.
    for (const Receiver& at :
         {Receiver{{0, 0, 0}, {0, 0, 1}}, Receiver{{1, 2, 1.0f}, {0, 0.6f, 0.8f}}, receivers()[1]}) {
        statistics::Moments whole;
        for_each_draw(table, at, 400'000, 29, [&](const Draw& d) { whole.add(irradiance_of(d, at)); });
        double sum = 0, variance = 0;
        for (const LightTable& one : parts) {
            statistics::Moments part;
            for_each_draw(one, at, 20'000, 31, [&](const Draw& d) { part.add(irradiance_of(d, at)); });
            sum += part.mean;
            variance += part.variance_of_mean();
        }
        EXPECT_FALSE(statistics::t_test(whole, sum, std::sqrt(variance)).rejected(k_level));
        EXPECT_TRUE(statistics::t_test(whole, sum * 1.05, std::sqrt(variance)).rejected(k_level));
    }
}

TEST(Choice, ImportantLampsAreChosenMore) {
    // A choice by contribution needs far fewer samples than a uniform one: relative deviation of the estimator.
    const std::vector<LampInput> lamps = scattered_lamps(2000, 5, 60);
    const Receiver at{{0, 0, 0}, {0, 0, 1}};
    statistics::Moments m;
    for_each_draw(table_of(lamps), at, 50'000, 37, [&](const Draw& d) { m.add(irradiance_of(d, at)); });
    EXPECT_LT(std::sqrt(m.variance()) / m.mean, 2.5) << "mean " << m.mean;
}

// Triangles ----------------------------------------------------------------------------------------------------------

/// The density of a hit at a drawn point is the density of the draw.
TEST(Choice, TrianglePdfMatchesDraws) {
    const std::vector<light::EmissiveTriangle> triangles = scattered_triangles(60, 9);
    const LightTable table(scattered_lamps(12, 3, 8), triangles, nullptr, {-8, -8, -8}, {8, 8, 8});
    for (const Receiver& at : {Receiver{{0, 0, 0}, {0, 0, 1}}, Receiver{{0.3f, 0.2f, 2}, {0, 0, 0}}}) {
        Uniform uniform(41);
        int compared = 0;
        for (int k = 0; k < 20'000; k += W) {
            const LightSample s = sample_light(table.data(), at.lanes(), uniform.lanes(), mask_of(true));
            const Mask on_triangle = s.valid & (s.triangle >= Int(0));
            const Float pdf =
                pdf_triangle(table.data(), at.lanes(), s.instance, s.triangle, s.position, s.normal, on_triangle);
            for (int i = 0; i < W; ++i) {
                if (((bits(on_triangle) >> i) & 1) == 0) continue;
                EXPECT_NEAR(pdf[i] / s.pdf[i], 1, 1e-3f);
                ++compared;
            }
        }
        EXPECT_GT(compared, 2000);
    }
}

TEST(Choice, TrianglePdfIsFrequency) {
    // Directions by density: the share of draws per triangle is the integral of its density over its solid angle.
    const std::vector<light::EmissiveTriangle> triangles = scattered_triangles(24, 13);
    const LightTable table({}, triangles, nullptr, {-8, -8, -8}, {8, 8, 8});
    const Receiver at{{0.2f, 0.1f, 0}, {0, 0, 1}};
    constexpr int k_draws = 100'000;
    std::vector<double> observed(triangles.size(), 0.0), expected, mutant;
    for_each_draw(table, at, k_draws, 43, [&](const Draw& d) { observed[static_cast<std::size_t>(d.emitter)] += 1; });
    for (const light::EmissiveTriangle& t : triangles) {
        const Float3 twice = cross(t.p1 - t.p0, t.p2 - t.p0), n = normalize(twice);
        const double area = 0.5 * static_cast<double>(length(twice));
        constexpr int k_steps = 24;
        double sum = 0;
        for (int a = 0; a < k_steps; ++a) {
            for (int b = 0; b < k_steps; ++b) {
                const float root = std::sqrt((static_cast<float>(a) + 0.5f) / k_steps),
                            v = (static_cast<float>(b) + 0.5f) / k_steps;
                const Float3 hit = t.p0 + (t.p1 - t.p0) * (root * (1 - v)) + (t.p2 - t.p0) * (root * v);
                const Float pdf = pdf_triangle(table.data(), at.lanes(), Int(t.instance), Int(t.triangle),
                                               {hit.x, hit.y, hit.z}, {n.x, n.y, n.z}, mask_of(true));
                const Float3 to = hit - at.p;
                const double d2 = static_cast<double>(dot(to, to));
                sum += static_cast<double>(pdf[0]) * std::fabs(static_cast<double>(dot(n, normalize(to)))) / d2;
            }
        }
        const double share = sum * area / (k_steps * k_steps);
        // Draws on the dark side of a one-sided triangle are invalid but counted: their density is 0.
        const bool dark = !t.two_sided && dot(n, t.p0 - at.p) > 0;
        expected.push_back(share * k_draws);
        mutant.push_back((t.two_sided ? 0.5 : 1.0) * share * k_draws);
        if (dark) observed[expected.size() - 1] = 0;
    }
    EXPECT_FALSE(statistics::chi2_test(observed, expected).rejected(k_level));
    EXPECT_TRUE(statistics::chi2_test(observed, mutant).rejected(k_level))
        << "half the density on two-sided triangles must not pass";
}

TEST(Choice, UnknownTrianglesHaveNoDensity) {
    const LightTable table({}, scattered_triangles(8, 13), nullptr, {}, {});
    const Receiver at{};
    for (const auto& [instance, triangle] : {std::pair{-1, 0}, {99, 0}, {0, -1}, {0, 1}, {0, 10'000}}) {
        const Float pdf = pdf_triangle(table.data(), at.lanes(), Int(instance), Int(triangle), {0.0f, 0.0f, 1.0f},
                                       {0.0f, 0.0f, 1.0f}, mask_of(true));
        EXPECT_EQ(pdf[0], 0.0f) << instance << " " << triangle;
    }
}

}  // namespace
}  // namespace cardioid::light_tests
