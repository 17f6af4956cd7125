// SPDX-License-Identifier: GPL-3.0-or-later
#include "photon/radius.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cardioid::photon {
namespace {

TEST(MemorylessScale, IsTheLiteralProduct) {
    for (const double alpha : {0.1, 0.5, 2.0 / 3.0, 0.7, 0.9, 1.0}) {
        double product = 1;
        for (std::int64_t i = 0; i <= 100000; ++i) {
            if (i > 0) product *= (static_cast<double>(i) + alpha) / (static_cast<double>(i) + 1);
            if (i < 100 || i % 997 == 0) {
                ASSERT_NEAR(memoryless_scale(i, alpha) / product, 1, 1e-9) << i << ' ' << alpha;
            }
        }
    }
}

TEST(MemorylessScale, FallsAsThePowerLawSays) {
    // Π (j + a)/(j + 1) ~ n^(a - 1)/Γ(1 + a).
    for (const double alpha : {0.5, 2.0 / 3.0, 0.7}) {
        for (const std::int64_t n : {std::int64_t{1'000'000}, std::int64_t{1} << 33}) {
            const double law = std::pow(static_cast<double>(n), alpha - 1) / std::tgamma(1 + alpha);
            EXPECT_NEAR(memoryless_scale(n, alpha) / law, 1, 1e-6) << n << ' ' << alpha;
        }
    }
}

TEST(MemorylessScale, IsMonotoneAndOneForAlphaOne) {
    for (std::int64_t i = 0; i < 5000; ++i) {
        EXPECT_LT(memoryless_scale(i + 1, 2.0 / 3.0), memoryless_scale(i, 2.0 / 3.0)) << i;
        EXPECT_EQ(memoryless_scale(i, 1), 1) << i;
        EXPECT_GT(memoryless_scale(i, 0), 0) << i;
    }
    EXPECT_EQ(memoryless_scale(0, 0.5), 1);
    EXPECT_EQ(memoryless_scale(-3, 0.5), 1);
}

TEST(PixelUpdate, NumbersOfTheThesis) {
    // By hand from 5.2, 5.3 and 5.5: N = 10, M = 10, alpha = 0.7: N' = 17, R' = 2·sqrt(17/20), tau' = (tau + phi)·17/20.
    PixelStatistics pixel;
    pixel.n = 10;
    pixel.radius = 2;
    pixel.tau[0][0] = 3;
    pixel.tau[3][2] = 5;
    const float phi[k_photon_classes][3] = {{1, 0, 0}, {}, {}, {0, 0, 15}};
    update(pixel, 10, phi, 0.7f);
    EXPECT_FLOAT_EQ(pixel.n, 17);
    EXPECT_FLOAT_EQ(pixel.radius, 1.8439089f);
    EXPECT_FLOAT_EQ(pixel.tau[0][0], 3.4f);
    EXPECT_FLOAT_EQ(pixel.tau[3][2], 17);
    EXPECT_EQ(pixel.tau[0][1], 0);
    // The next pass finds nothing: photons count on, nothing changes.
    const PixelStatistics before = pixel;
    const float none[k_photon_classes][3] = {};
    update(pixel, 0, none, 0.7f);
    EXPECT_EQ(pixel.n, before.n);
    EXPECT_EQ(pixel.radius, before.radius);
    EXPECT_EQ(pixel.tau[0][0], before.tau[0][0]);
    // First photons of a pixel: N' = alpha·M, R'² = alpha·R².
    PixelStatistics fresh;
    fresh.radius = 1;
    update(fresh, 4, phi, 0.7f);
    EXPECT_FLOAT_EQ(fresh.n, 2.8f);
    EXPECT_FLOAT_EQ(fresh.radius, 0.83666003f);
    EXPECT_FLOAT_EQ(fresh.tau[3][2], 10.5f);
}

TEST(PixelUpdate, NothingFoundEverChangesNothing) {
    PixelStatistics pixel;
    pixel.radius = 0.25f;
    const float none[k_photon_classes][3] = {};
    update(pixel, 0, none, 0.7f);
    EXPECT_EQ(pixel.n, 0);
    EXPECT_EQ(pixel.radius, 0.25f);
    EXPECT_EQ(pixel.tau[0][0], 0);
}

TEST(PixelUpdate, AlphaOneKeepsRadiusAndAddsUp) {
    PixelStatistics pixel;
    pixel.radius = 0.5f;
    const float phi[k_photon_classes][3] = {{1, 2, 3}, {}, {}, {4, 5, 6}};
    for (int i = 0; i < 10; ++i) update(pixel, 3, phi, 1);
    EXPECT_FLOAT_EQ(pixel.n, 30);
    EXPECT_FLOAT_EQ(pixel.radius, 0.5f);
    EXPECT_FLOAT_EQ(pixel.tau[3][0], 40);
}

TEST(PixelUpdate, SteadyFluxKeepsItsRadiance) {
    // Uniform irradiance: M and phi follow the area; radiance tau/(emitted·R²) must settle on it.
    PixelStatistics pixel;
    pixel.radius = 1;
    for (int i = 0; i < 2000; ++i) {
        const float area = pixel.radius * pixel.radius;
        const float phi[k_photon_classes][3] = {{3 * area, 0, 0}};
        update(pixel, 100 * area, phi, 0.7f);
    }
    EXPECT_NEAR(pixel.tau[0][0] / (2000 * pixel.radius * pixel.radius), 3, 0.001);
    EXPECT_LT(pixel.radius, 0.4f);
}

}  // namespace
}  // namespace cardioid::photon
