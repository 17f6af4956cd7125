// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/balance.h"

#include <gtest/gtest.h>

#include <random>

namespace cardioid::render {
namespace {

constexpr film::Region k_region{3, 5, 64, 64};

/// Noise of the parts of one sample; every part has the mean 1, but `found` of the photons' light for hits.
struct Noise {
    double camera = 0.5, photons = 0.5, hits = 0.5;
    double found = 1;
};

double factor_of(const Noise& noise, double camera_cost = 1, double photon_cost = 1) {
    BalanceMeter meter(k_region);
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (int pass = 0; pass < k_training_passes; ++pass) {
        const int samples = pass < 2 ? 1 : 1 << (pass - 1);
        for (int y = 0; y < k_region.height; ++y) {
            for (int x = 0; x < k_region.width; ++x) {
                for (int s = 0; s < samples; ++s) {
                    const auto value = [&](double sigma) { return static_cast<float>(1 + sigma * normal(random)); };
                    Halves h{value(noise.camera), value(noise.photons), value(noise.hits)};
                    h.hits *= static_cast<float>(noise.found);
                    meter.add(pass, k_region.x + x, k_region.y + y, h);
                }
            }
        }
    }
    return meter.factor(camera_cost, 0, photon_cost);
}

TEST(Balance, FollowsNoiseAndCost) {
    const Noise bad_hits{0.5, 0.5, 50, 1};
    EXPECT_NEAR(factor_of(bad_hits), 1, 0.1);
    EXPECT_NEAR(factor_of({0.25, 0.5, 50, 1}), 2, 0.2);
    EXPECT_NEAR(factor_of({0.5, 0.25, 50, 1}), 0.5, 0.05);
    EXPECT_NEAR(factor_of(bad_hits, 4, 1), 2, 0.2);
    EXPECT_NEAR(factor_of(bad_hits, 1, 4), 0.5, 0.05);
    EXPECT_EQ(factor_of({0.5, 0.01, 50, 1}), 0.25);
    EXPECT_EQ(factor_of({0.01, 0.9, 50, 1}), 8);
}

TEST(Balance, GivesPhotonsUpOnlyWhereCameraPathsFindAllTheirLight) {
    EXPECT_EQ(factor_of({0.5, 0.5, 0.1, 1}), 0);
    EXPECT_GT(factor_of({0.5, 0.5, 0.1, 0.8}), 0) << "a lamp that no ray meets";
    EXPECT_GT(factor_of({0.5, 0.5, 0.1, 0}), 0);
    EXPECT_GT(factor_of({0.5, 0.5, 3, 1}), 0) << "photons have less noise";
}

TEST(Balance, WithoutLightOrWorkNothingChanges) {
    const BalanceMeter empty(k_region);
    EXPECT_EQ(empty.factor(1, 1, 1), 1);
    EXPECT_EQ(factor_of({}, 0, 1), 1);
    EXPECT_EQ(factor_of({}, 1, 0), 1);
}

}  // namespace
}  // namespace cardioid::render
