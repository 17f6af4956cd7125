// SPDX-License-Identifier: GPL-3.0-or-later
// Which emitters send photons and how much power they start with; where photons start and what they are aimed at.
#include <gtest/gtest.h>

#include "emit_tests.h"
#include "statistics/ttest.h"

#include <limits>

namespace cardioid::light_tests {
namespace {

const Float3 k_low{-3, -2, -0.1f}, k_high{3, 2, 2.5f};
const light::PhotonTargets k_casters = casters_in({0.5f, 0.4f, 0.3f}, 0.3f);

Float3 at(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

bool is_finite(Float3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Smallest distance of the photon's ray to a point.
float distance_to(const Photon& photon, Float3 p) {
    const Float3 to = p - photon.origin;
    return length(to - photon.direction * std::max(dot(to, photon.direction), 0.0f));
}

TEST(EmissionPower, OnlyOfWhatSamplingPicks) {
    std::vector<LampInput> lamps(6, lamp_case("", scene::LightKind::point, 10).lamp);
    lamps[1].desc.energy = 0;
    lamps[2].desc.energy = std::numeric_limits<float>::quiet_NaN();
    lamps[3].desc.portal = true;
    lamps[4].desc.visibility = scene::visible_camera;
    lamps[5].desc.kind = scene::LightKind::sun;
    light::EmissiveTriangle triangle{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {5, 4, 3}, 0, 0, -1, true}, black = triangle,
                                                                                                  thin = triangle;
    black.radiance = {0, 0, 0};
    black.triangle = 1;
    thin.p2 = thin.p1;
    thin.triangle = 2;
    for (const bool shines : {false, true}) {
        light::WorldInput world;
        world.color = shines ? Float3{1, 1, 1} : Float3{0, 0, 0};
        const LightTable table(lamps, {triangle, black, thin}, &world, k_low, k_high);
        const light::LightData& data = table.data();
        ASSERT_EQ(data.emitter_count, 10);
        const std::vector<bool> expected{true, false, false, false, false, true, true, false, false, shines};
        for (int i = 0; i < data.emitter_count; ++i) {
            EXPECT_EQ(data.emission_power[i] > 0, expected[static_cast<std::size_t>(i)]) << i;
            EXPECT_EQ(data.leaf_of[i] >= 0, expected[static_cast<std::size_t>(i)]) << i;
        }
    }
}

/// Without casters the power of an emitter in the scene is all of its flux.
TEST(EmissionPower, IsTheFluxOfThePhotons) {
    for (const Source& source : all_sources()) {
        if (source.has_world || (!source.lamps.empty() && source.lamps.front().desc.kind == scene::LightKind::sun))
            continue;
        // A stretched spot lights less than the round cone around it.
        if (source.name == "spot_stretched") continue;
        SCOPED_TRACE(source.name);
        const LightTable table = table_of(source, k_low, k_high);
        const double power = static_cast<double>(table.data().emission_power[only_emitter(table)]);
        statistics::Moments m;
        double inside = 0;
        for_each_photon(table, 200'000, 1, [&](const Photon& photon) {
            const Float3 c = photon.flux;
            const double flux = static_cast<double>(std::fabs(c.x) + std::fabs(c.y) + std::fabs(c.z)) / 3;
            const bool is_inside = photon.t_max < 1e29f;
            m.add(is_inside ? 0 : flux);
            inside += is_inside ? 1 : 0;
        });
        const bool legacy_spot = !source.lamps.empty() && source.lamps.front().desc.legacy_lamp &&
                                 source.lamps.front().desc.kind == scene::LightKind::spot;
        // The cosine of old spots is left out: their power is rough.
        EXPECT_NEAR(m.mean, power, (legacy_spot ? 0.6 : 0.02) * power);
        EXPECT_LT(inside, 200'000 * 0.07);
    }
}

TEST(EmissionPower, OfPointLampsIsTheirWatts) {
    for (const bool legacy : {false, true}) {
        Case c = lamp_case("", scene::LightKind::point, 80);
        c.lamp.desc.legacy_lamp = legacy;
        c.lamp.desc.radius = 0.3f;
        EXPECT_NEAR(table_of(lamp_source(c), k_low, k_high).data().emission_power[0], 80, 0.01);
    }
}

/// Aimed photons carry the same flux whatever emitter they come from, if emitters are chosen by their power.
TEST(EmissionPower, MakesAimedPhotonsEqual) {
    for (const Source& source : all_sources()) {
        const bool is_world = source.name == "world";
        if (source.name != "point" && source.name != "tiny_sphere" && source.name != "delta_sun" && !is_world) continue;
        // Smaller ones leave point lamps the least share of their power.
        const LightTable table = table_of(source, k_low, k_high, casters_in({0.5f, 0.4f, 0.3f}, 0.5f));
        const float power = table.data().emission_power[only_emitter(table)];
        const light::Sphere& casters = table.data().casters;
        int aimed = 0;
        for_each_photon(table, 20'000, 1, [&](const Photon& photon) {
            if (!photon.valid || photon.t_max < 1e29f || !(distance_to(photon, at(casters.center)) < casters.radius))
                return;
            ++aimed;
            // The mean over colours is the power's; the sphere's own inside takes a share of its photons.
            const float flux = (std::fabs(photon.flux.x) + std::fabs(photon.flux.y) + std::fabs(photon.flux.z)) / 3;
            EXPECT_NEAR(flux, power, 0.07f * power) << source.name;
        });
        EXPECT_GT(aimed, 20'000 / 5) << source.name;
    }
}

TEST(EmissionAim, HalfGoesToTheCasters) {
    const light::PhotonTargets small = casters_in({0.5f, 0.4f, 0.3f}, 0.15f);
    for (const Source& source : all_sources()) {
        const bool flat = !source.triangles.empty() ||
                          (!source.lamps.empty() && source.lamps.front().desc.kind == scene::LightKind::area);
        if (flat || source.name == "spot_narrow") continue;
        const auto share = [&](const LightTable& table) {
            const light::Sphere sphere = table_of(source, k_low, k_high, small).data().casters;
            int aimed = 0;
            for_each_photon(table, 20'000, 1, [&](const Photon& photon) {
                aimed += distance_to(photon, at(sphere.center)) < sphere.radius ? 1 : 0;
            });
            return aimed / 20'000.0;
        };
        const double with = share(table_of(source, k_low, k_high, small));
        const double without = share(table_of(source, k_low, k_high));
        // Rays of lamps as large as the casters often pass beside them.
        const float radius = source.lamps.empty() ? 0 : source.lamps.front().desc.radius;
        const bool is_small =
            source.has_world || radius < 0.05f || source.lamps.front().desc.kind == scene::LightKind::sun;
        EXPECT_GT(with, (is_small ? 2.0 : 1.2) * without) << source.name;
        EXPECT_GT(with, is_small ? 0.3 : 0.03) << source.name;
        EXPECT_LT(with, 0.6) << source.name;
    }
}

TEST(EmissionTargets, SpheresHoldTheBoxes) {
    const LightTable table({}, {}, nullptr, k_low, k_high, {}, casters_in({2.9f, 0, 0}, 0.5f));
    const light::LightData& data = table.data();
    for (const float x : {k_low.x, 3.4f}) {
        for (const float y : {k_low.y, k_high.y}) {
            for (const float z : {-0.5f, k_high.z}) {
                EXPECT_LE(length(Float3{x, y, z} - at(data.scene.center)), data.scene.radius * 1.0001f);
            }
        }
    }
    EXPECT_NEAR(data.casters.radius, 0.5 * std::sqrt(3.0), 1e-4);
    EXPECT_EQ(LightTable({}, {}, nullptr, k_low, k_high).data().casters.radius, 0);
}

/// Suns and the world start outside of the scene and near it, and go in.
TEST(EmissionTargets, FarPhotonsStartOnTheBox) {
    for (const Source& source : all_sources()) {
        for (const float size : {1e-3f, 1.0f, 1e4f}) {
            const Float3 shift = Float3{40, -20, 10} * size;
            const Float3 low = k_low * size + shift, high = k_high * size + shift;
            const LightTable table =
                table_of(source, low, high, casters_in(shift + Float3{0, 0, 0.5f} * size, 0.3f * size));
            for_each_photon(table, 5000, 1, [&](const Photon& photon) {
                if (!photon.infinite || !photon.valid) return;
                const Float3 o = photon.origin, d = photon.direction;
                // Outside, by a little, of at least one side; within a little of all others.
                const float slack = 2e-4f * size;
                float farthest = -1e30f;
                for (const float out :
                     {low.x - o.x, o.x - high.x, low.y - o.y, o.y - high.y, low.z - o.z, o.z - high.z})
                    farthest = std::max(farthest, out);
                EXPECT_GT(farthest, 0) << source.name << size;
                EXPECT_LT(farthest, slack) << source.name << size;
                EXPECT_GT(dot((low + high) * 0.5f + d * (10 * size) - o, d), 0);
            });
        }
    }
}

/// A scene without geometry, targets that are not finite, casters around a lamp: nothing that is not a number.
TEST(EmissionTargets, BadBoundsGiveNoBadPhotons) {
    const float inf = std::numeric_limits<float>::infinity();
    struct Bounds {
        Float3 low, high;
        light::PhotonTargets targets;
    };
    const Bounds all[] = {{{0, 0, 0}, {0, 0, 0}, {}},
                          {{inf, inf, inf}, {-inf, -inf, -inf}, {}},
                          {{-inf, 0, 0}, {inf, 1, 1}, {}},
                          {k_low, k_high, casters_in({0.3f, -0.2f, 2}, 1)},
                          {k_low, k_high, casters_in({0.3f, -0.2f, 2}, 0)},
                          {k_low, k_high, casters_in({inf, 0, 0}, 1)},
                          {{-1e18f, -1e18f, -1e18f}, {1e18f, 1e18f, 1e18f}, k_casters}};
    for (const Bounds& b : all) {
        for (const Source& source : all_sources()) {
            const LightTable table = table_of(source, b.low, b.high, b.targets);
            if (only_emitter(table) < 0) continue;
            EXPECT_TRUE(std::isfinite(table.data().emission_power[only_emitter(table)])) << source.name;
            for_each_photon(table, 256, 1, [&](const Photon& photon) {
                if (!photon.valid) return;
                EXPECT_TRUE(is_finite(photon.origin) && is_finite(photon.flux) && std::isfinite(photon.density));
                EXPECT_NEAR(length(photon.direction), 1, 1e-5);
                EXPECT_NEAR(length(photon.normal), 1, 1e-3) << source.name;
                EXPECT_GT(photon.density, 0);
            });
        }
    }
}

}  // namespace
}  // namespace cardioid::light_tests
