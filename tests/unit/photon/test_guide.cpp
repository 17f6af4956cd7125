// SPDX-License-Identifier: GPL-3.0-or-later
#include "photon/guide_problems.h"
#include "statistics/chi2.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cardioid::photon {
namespace {

constexpr double k_level = 1e-5;

/// Three emitters of different power, of which one is learned in a box and one by chance everywhere; few enough lessons for
/// leaves that a grid of 32⁴ resolves.
Problem coarse() {
    return {"coarse", 3, [](std::int32_t e, const float(&u)[k_cube], Rng& rng) {
                if (e == 1) return in_box(u, {0, 0.25f, 0, 0}, {0.5f, 0.75f, 1, 0.5f}, rng);
                return e == 2 && unit_float(rng) < 0.05f ? 1 + u[3] : 0.0f;
            }};
}

PhotonGuide coarse_guide(Rng& rng) {
    PhotonGuide guide({1, 2, 0.5f});
    std::vector<Lesson> lessons;
    emit(guide, coarse(), 1500, rng, &lessons);
    guide.learn(lessons);
    return guide;
}

TEST(PhotonGuide, StartsByPower) {
    const PhotonGuide guide({1, 0, 3, 0});
    EXPECT_FALSE(guide.empty());
    EXPECT_TRUE(PhotonGuide(std::vector<float>{0, 0}).empty());
    EXPECT_TRUE(PhotonGuide(std::vector<float>{}).empty());
    EXPECT_TRUE(PhotonGuide({-1, std::numeric_limits<float>::quiet_NaN()}).empty());
    const float u[k_cube] = {0.125f, 0.25f, 0.5f, 0.75f};
    int counts[4] = {};
    for (int i = 0; i < 1000; ++i) {
        const Emission e = guide.draw(static_cast<float>(i) / 1000, u);
        ++counts[e.emitter];
        EXPECT_FLOAT_EQ(e.density, e.emitter == 0 ? 0.25f : 0.75f);
        for (int k = 0; k < k_cube; ++k) EXPECT_EQ(e.u[k], u[k]);
    }
    EXPECT_EQ(counts[0], 250);
    EXPECT_EQ(counts[2], 750);
    EXPECT_FLOAT_EQ(guide.density(2, u), 0.75f);
    EXPECT_EQ(guide.density(1, u), 0);
    EXPECT_EQ(guide.gain(0), 1);
    EXPECT_EQ(PhotonGuide({0, 0, 1}).draw(0, u).emitter, 2);
}

TEST(PhotonGuide, DensityIntegratesToOne) {
    Rng rng(1);
    const PhotonGuide guide = coarse_guide(rng);
    constexpr int n = 32;
    double sum = 0, least = 1, most = 0;
    for (std::int32_t e = 0; e < 3; ++e) {
        for (int i = 0; i < n * n * n * n; ++i) {
            const auto at = [](int digit) { return (static_cast<float>(digit % n) + 0.5f) / n; };
            const auto d = static_cast<double>(guide.density(e, {at(i), at(i / n), at(i / n / n), at(i / n / n / n)}));
            sum += d / (n * n * n * n);
            least = std::min(least, d);
            most = std::max(most, d);
        }
    }
    EXPECT_NEAR(sum, 1, 1e-5);
    EXPECT_GT(least, 0);
    EXPECT_GT(most, 10 * least) << "nothing was learned";
}

TEST(PhotonGuide, DrawsByItsDensity) {
    Rng rng(2);
    const PhotonGuide guide = coarse_guide(rng);
    constexpr int n = 4, sub = 8, cells = n * n * n * n, draws = 1 << 20;
    std::vector<double> expected(3 * cells), observed(3 * cells);
    const auto cell = [](std::int32_t e, const float(&u)[k_cube]) {
        std::size_t c = static_cast<std::size_t>(e);
        for (const float x : u) c = c * n + static_cast<std::size_t>(x * n);
        return c;
    };
    for (std::int32_t e = 0; e < 3; ++e) {
        constexpr int m = n * sub;
        for (int i = 0; i < m * m * m * m; ++i) {
            const auto at = [](int digit) { return (static_cast<float>(digit % m) + 0.5f) / m; };
            const float u[k_cube] = {at(i), at(i / m), at(i / m / m), at(i / m / m / m)};
            expected[cell(e, u)] +=
                static_cast<double>(guide.density(e, u)) * draws / (static_cast<double>(m) * m * m * m);
        }
    }
    for (int i = 0; i < draws; ++i) {
        const Emission e = guide.draw(unit_float(rng), random_cube(rng).u);
        ++observed[cell(e.emitter, e.u)];
    }
    const auto result = statistics::chi2_test(observed, expected);
    EXPECT_FALSE(result.rejected(k_level))
        << "p " << result.p << " chi2 " << result.statistic << " / " << result.degrees;
}

TEST(PhotonGuide, DrawAndDensityAgreeOnEveryPhoton) {
    Rng rng(3);
    for (const Problem& problem : {twelve_lamps(), sun(), box(), everything()}) {
        const PhotonGuide guide = trained(problem, 20000, rng);
        for (int i = 0; i < 200000; ++i) {
            // Now and then the ends of the unit interval.
            Cube cube = random_cube(rng);
            if (i % 10 == 0) cube.u[i / 10 % k_cube] = i % 20 == 0 ? 0.0f : 0x1.fffffep-1f;
            const Emission e = guide.draw(i % 50 == 0 ? 0x1.fffffep-1f : unit_float(rng), cube.u);
            for (const float u : e.u) ASSERT_TRUE(u >= 0 && u < 1) << u;
            ASSERT_EQ(e.density, guide.density(e.emitter, e.u)) << problem.name;
            ASSERT_TRUE(e.density > 0 && std::isfinite(e.density));
        }
    }
}

TEST(PhotonGuide, KeepsThePictureAndItsFloor) {
    Rng rng(4);
    for (const Problem& problem : {twelve_lamps(), sun(), box(), everything(), little_of_everything()}) {
        const PhotonGuide start(std::vector<float>(static_cast<std::size_t>(problem.emitters), 1.0f));
        const PhotonGuide guide = trained(problem, 20000, rng);
        const Outcome before = emit(start, problem, 400000, rng), after = emit(guide, problem, 400000, rng);
        EXPECT_FALSE(statistics::welch_test(before.picture, after.picture).rejected(k_level)) << problem.name;
        // A place that no lesson named is as dense as a fifth of the start at least.
        for (int i = 0; i < 10000; ++i) {
            const auto e = static_cast<std::int32_t>(rng() % static_cast<unsigned>(problem.emitters));
            ASSERT_GE(guide.density(e, random_cube(rng).u), 0.1999f / static_cast<float>(problem.emitters));
        }
    }
}

TEST(PhotonGuide, LessonsCountByTheDensityTheyWereEmittedWith) {
    // Both halves bring the same; a pass that knew the left one better has emitted four times as many there.
    Rng rng(14);
    std::vector<Lesson> lessons;
    for (int i = 0; i < 10000; ++i) {
        const Cube c = random_cube(rng);
        const bool right = i % 5 == 0;
        lessons.push_back({0, {0.5f * c.u[0] + (right ? 0.5f : 0.0f), c.u[1], c.u[2], c.u[3]}, 1, right ? 0.4f : 1.6f});
    }
    PhotonGuide guide({1});
    guide.learn(lessons);
    double left = 0;
    for (int i = 0; i < 100000; ++i) left += guide.draw(unit_float(rng), random_cube(rng).u).u[0] < 0.5f ? 1e-5 : 0;
    EXPECT_NEAR(left, 0.5, 0.02);
}

TEST(PhotonGuide, GathersFiveTimesAsManyAtLessError) {
    Rng rng(5);
    for (const Problem& problem : {twelve_lamps(), sun(), box()}) {
        const PhotonGuide start(std::vector<float>(static_cast<std::size_t>(problem.emitters), 1.0f));
        const PhotonGuide guide = trained(problem, 50000, rng);
        const Outcome before = emit(start, problem, 200000, rng), after = emit(guide, problem, 200000, rng);
        const double gathered = after.gathered / before.gathered,
                     variance = before.picture.variance() / after.picture.variance();
        EXPECT_GT(gathered, 30) << problem.name;
        EXPECT_GT(variance, 30) << problem.name;
        std::printf("%s: gathered x %.1f, variance / %.1f\n", problem.name.c_str(), gathered, variance);
    }
}

TEST(PhotonGuide, LearnsNothingFromChance) {
    Rng rng(6);
    for (const Problem& problem : {everything(), little_of_everything()}) {
        const PhotonGuide start(std::vector<float>(static_cast<std::size_t>(problem.emitters), 1.0f));
        const PhotonGuide guide = trained(problem, 20000, rng);
        const Outcome before = emit(start, problem, 400000, rng), after = emit(guide, problem, 400000, rng);
        EXPECT_LT(after.picture.variance() / before.picture.variance(), 1.05) << problem.name;
        EXPECT_NEAR(after.gathered / before.gathered, 1, 0.05) << problem.name;
    }
}

TEST(PhotonGuide, GainIsTheMeanDensityWhereItCounts) {
    Rng rng(7);
    const Problem problem = twelve_lamps();
    const PhotonGuide guide = trained(problem, 50000, rng);
    double sum = 0;
    int n = 0;
    for (int i = 0; i < 200000; ++i) {
        const Cube c = random_cube(rng);
        if (problem.integrand(5, c.u, rng) <= 0) continue;
        sum += static_cast<double>(guide.density(5, c.u)) * 12;
        ++n;
    }
    EXPECT_NEAR(static_cast<double>(guide.gain(5)) / (sum / n), 1, 0.2);
    EXPECT_GT(guide.gain(5), 30);
    for (std::int32_t e = 0; e < 12; ++e) EXPECT_TRUE(guide.gain(e) >= 1 && guide.gain(e) <= 1e4f) << e;
    EXPECT_EQ(guide.gain(-1), 1);
    EXPECT_EQ(guide.gain(12), 1);
}

TEST(PhotonGuide, IgnoresLessonsThatCannotBe) {
    constexpr float k_nan = std::numeric_limits<float>::quiet_NaN(),
                    k_infinity = std::numeric_limits<float>::infinity();
    Rng rng(8);
    std::vector<Lesson> lessons;
    PhotonGuide guide = trained(twelve_lamps(), 20000, rng, &lessons);
    PhotonGuide same(std::vector<float>(12, 1.0f));
    std::vector<Lesson> bad = lessons;
    for (const Lesson& l : {Lesson{5, {.5f, .5f, .5f, .5f}, k_nan, 1}, Lesson{5, {.5f, .5f, .5f, .5f}, k_infinity, 1},
                            Lesson{5, {.5f, .5f, .5f, .5f}, -1e9f, 1}, Lesson{5, {.5f, .5f, .5f, .5f}, 0, 1},
                            Lesson{5, {.5f, .5f, .5f, .5f}, 1e9f, 0}, Lesson{5, {.5f, .5f, .5f, .5f}, 1e9f, -1},
                            Lesson{5, {.5f, .5f, .5f, .5f}, 1e9f, k_nan}, Lesson{-1, {.5f, .5f, .5f, .5f}, 1e9f, 1},
                            Lesson{12, {.5f, .5f, .5f, .5f}, 1e9f, 1}, Lesson{5, {1, .5f, .5f, .5f}, 1e9f, 1},
                            Lesson{5, {k_nan, .5f, .5f, .5f}, 1e9f, 1}, Lesson{5, {.5f, -.5f, .5f, .5f}, 1e9f, 1}}) {
        bad.insert(bad.begin() + static_cast<std::ptrdiff_t>(bad.size() / 2), l);
    }
    same.learn(bad);
    for (int i = 0; i < 10000; ++i) {
        const Cube c = random_cube(rng);
        const auto e = static_cast<std::int32_t>(rng() % 12);
        ASSERT_EQ(guide.density(e, c.u), same.density(e, c.u));
    }
    // Nothing learned, or all of it forgotten: as at the start.
    guide.learn({});
    same.learn({bad[bad.size() / 2], Lesson{5, {.5f, .5f, .5f, .5f}, k_nan, 1}});
    guide.learn({Lesson{5, {.5f, .5f, .5f, .5f}, 0, 1}});
    for (int i = 0; i < 1000; ++i) {
        const Cube c = random_cube(rng);
        const Emission e = guide.draw(unit_float(rng), c.u);
        EXPECT_FLOAT_EQ(e.density, 1.0f / 12);
        EXPECT_EQ(guide.gain(e.emitter), 1);
        for (int k = 0; k < k_cube; ++k) EXPECT_EQ(e.u[k], c.u[k]);
    }
}

TEST(PhotonGuide, ExtremeValuesStayFinite) {
    Rng rng(9);
    for (const float value : {1e-38f, 1e-20f, 1.0f, 1e20f, 3e38f}) {
        PhotonGuide guide({1, 1e-6f});
        std::vector<Lesson> lessons;
        for (int i = 0; i < 1000; ++i) {
            const Cube c = random_cube(rng);
            lessons.push_back(
                {i % 2, {0.1f * c.u[0], c.u[1], 0.5f, 0.25f}, i % 100 == 0 ? value : 1e-3f, i % 2 == 0 ? 1.0f : 1e-6f});
        }
        guide.learn(lessons);
        for (int i = 0; i < 10000; ++i) {
            const Emission e = guide.draw(unit_float(rng), random_cube(rng).u);
            ASSERT_TRUE(e.density > 0 && std::isfinite(e.density)) << value;
            ASSERT_EQ(e.density, guide.density(e.emitter, e.u));
        }
        EXPECT_TRUE(guide.gain(0) >= 1 && guide.gain(0) <= 1e4f);
        EXPECT_TRUE(guide.gain(1) >= 1 && guide.gain(1) <= 1e4f);
    }
}

TEST(PhotonGuide, OneLuckyPhotonDrawsFewAfterIt) {
    Rng rng(10);
    PhotonGuide guide({1, 1});
    std::vector<Lesson> lessons;
    emit(guide, everything(), 0, rng, &lessons);
    for (int i = 0; i < 2000; ++i) {
        const Cube c = random_cube(rng);
        lessons.push_back({0, {c.u[0], c.u[1], c.u[2], c.u[3]}, 1, 0.5f});
    }
    lessons.push_back({1, {0.3f, 0.3f, 0.3f, 0.3f}, 1e6f, 0.5f});
    guide.learn(lessons);
    int second = 0;
    for (int i = 0; i < 10000; ++i) second += guide.draw(static_cast<float>(i) / 10000, random_cube(rng).u).emitter;
    EXPECT_LT(second, 5000);
    EXPECT_GT(second, 1000);
}

TEST(PhotonGuide, IsTheSameEveryTimeForManyLessons) {
    // More lessons than a tree takes: the choice among them is fixed.
    Rng rng(11);
    std::vector<Lesson> lessons;
    PhotonGuide a({1}), b({1});
    emit(a, box(), 1000, rng, &lessons);
    const std::vector<Lesson> few = lessons;
    while (lessons.size() < 300000) lessons.insert(lessons.end(), few.begin(), few.end());
    a.learn(lessons);
    b.learn(few);
    b.learn(lessons);
    for (int i = 0; i < 10000; ++i) {
        const Cube c = random_cube(rng);
        ASSERT_EQ(a.density(0, c.u), b.density(0, c.u));
    }
    EXPECT_LT(a.memory_bytes(), 4 << 20);
}

TEST(PhotonGuide, StratifiedNumbersStayInOrder) {
    Rng rng(12);
    const PhotonGuide guide = trained(box(), 50000, rng);
    for (int k = 0; k < k_cube; ++k) {
        for (int round = 0; round < 50; ++round) {
            Cube c = random_cube(rng);
            float last = -1;
            for (int i = 0; i < 500; ++i) {
                c.u[k] = (static_cast<float>(i) + 0.5f) / 500;
                const Emission e = guide.draw(0.9f, c.u);
                ASSERT_GT(e.u[k], last);
                last = e.u[k];
            }
        }
    }
}

TEST(PhotonGuide, AMillionEmitters) {
    constexpr int n = 1'000'000;
    std::vector<float> power(n);
    Rng rng(13);
    for (float& p : power) p = unit_float(rng);
    power[777] = 0;
    PhotonGuide guide(power);
    std::vector<Lesson> lessons;
    const auto lesson = [&](std::int32_t e) {
        const Cube c = random_cube(rng);
        lessons.push_back({e, {0.25f * c.u[0], c.u[1], c.u[2], c.u[3]}, 1, guide.density(e, c.u)});
    };
    for (int i = 0; i < 5000; ++i) {
        lesson(static_cast<std::int32_t>(1000 + rng() % 20));
        lessons.push_back({777, {0.5f, 0.5f, 0.5f, 0.5f}, 1, 1e-6f});
    }
    guide.learn(lessons);
    EXPECT_LT(guide.memory_bytes(), 40 * n);
    EXPECT_EQ(guide.gain(777), 1);
    int seen = 0;
    for (int i = 0; i < 100000; ++i) {
        const Emission e = guide.draw((static_cast<float>(i) + 0.5f) / 100000, random_cube(rng).u);
        ASSERT_NE(e.emitter, 777);
        ASSERT_EQ(e.density, guide.density(e.emitter, e.u));
        seen += e.emitter >= 1000 && e.emitter < 1020;
    }
    EXPECT_GT(seen, 40000);  // 2 at the start
}

}  // namespace
}  // namespace cardioid::photon
