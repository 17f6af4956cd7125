// SPDX-License-Identifier: GPL-3.0-or-later
// Black, broken and extreme lamps: no crash, nothing that is not finite, and the good lamps beside them still shine.
#include "light_tests.h"

#include <gtest/gtest.h>

#include <limits>

namespace cardioid::light_tests {
namespace {

void expect_sane(const LightTable& table, const Receiver& at) {
    Uniform uniform(3);
    for (int k = 0; k < 512; k += W) {
        const Vec3 u = uniform.lanes();
        const LightSample s = sample_light(table.data(), at.lanes(), u, mask_of(true));
        for (const Float& f : {s.wi.x, s.wi.y, s.wi.z, s.radiance.r, s.radiance.g, s.radiance.b, s.pdf, s.distance,
                               s.position.x, s.position.z}) {
            EXPECT_TRUE(none(s.valid & ~is_finite(f)));
        }
        EXPECT_TRUE(none(s.valid & (abs(length_squared(s.wi) - 1.0f) > Float(1e-4f))));
        EXPECT_TRUE(none(s.valid & (s.pdf <= Float(0.0f))));
        const Vec3 d = normalize(u - Vec3{0.5f, 0.5f, 0.2f});
        for (int which = 0; which < hittable_lamps(table.data()); ++which) {
            const LampHit h = intersect_lamp(table.data(), which, at.lanes(), d, 1e30f, mask_of(true));
            for (const Float& f : {h.t, h.pdf, h.radiance.r}) EXPECT_TRUE(none(h.hit & ~is_finite(f)));
        }
    }
}

const std::vector<Receiver> k_receivers = {{{0, 0, 0}, {0, 0, 1}},
                                           {{0.3f, -0.2f, 2}, {0, 0, 1}},
                                           {{0, 0, 1e6f}, {0, 0, -1}},
                                           {{0.3f, -0.2f, 1.999999f}, {0, 0, 0}}};

TEST(BadLamps, AreIgnored) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    for (const scene::LightKind kind :
         {scene::LightKind::point, scene::LightKind::spot, scene::LightKind::sun, scene::LightKind::area}) {
        std::vector<LampInput> broken(7, lamp_case("", kind, 10).lamp);
        broken[0].desc.energy = 0;
        broken[1].desc.energy = nan;
        broken[2].desc.transform.m[5] = nan;
        broken[3].desc.transform.m[3] = inf;
        broken[4].desc.color = {0, 0, 0};
        broken[5].program_estimate = {0, 0, 0};
        broken[6].desc.portal = true;
        const LightTable table = table_of(broken);
        EXPECT_TRUE(table.empty());
        EXPECT_EQ(hittable_lamps(table.data()), 0);
        for (const Receiver& at : k_receivers) expect_sane(table, at);
        // One good lamp beside them keeps its place in the list and gets every sample.
        broken.push_back(lamp_case("", scene::LightKind::point, 10).lamp);
        for_each_draw(table_of(broken), Receiver{}, 64, 1, [&](const Draw& d) {
            EXPECT_TRUE(d.valid);
            EXPECT_EQ(d.emitter, 7);
        });
    }
}

TEST(BadLamps, ExtremesStayFinite) {
    for (const Case& c : surface_lamps()) {
        for (const float size : {0.0f, 1e-30f, 1e-9f, 1e-5f, 1e4f}) {
            for (const float scale : {0.0f, 1e-6f, 1.0f, 1e5f}) {
                Case changed = c;
                changed.lamp.desc.radius *= size;
                changed.lamp.desc.size_x *= size;
                changed.lamp.desc.size_y *= size;
                changed.lamp.desc.angle *= size;
                for (const int i : {0, 1, 2, 4, 5, 6, 8, 9, 10})
                    changed.lamp.desc.transform.m[static_cast<std::size_t>(i)] *= scale;
                const LightTable table = table_of({changed.lamp});
                SCOPED_TRACE(c.name + " size " + std::to_string(size) + " scale " + std::to_string(scale));
                for (const Receiver& at : k_receivers) expect_sane(table, at);
            }
        }
    }
}

TEST(BadLamps, TinySphereIsAPoint) {
    Case tiny = lamp_case("", scene::LightKind::point, 100), point = tiny;
    tiny.lamp.desc.radius = 1e-9f;
    const Receiver at{{1, 0, 0}, {0, 0, 1}};
    Draw a, b;
    for_each_draw(table_of({tiny.lamp}), at, 1, 1, [&](const Draw& d) { a = d; });
    for_each_draw(table_of({point.lamp}), at, 1, 1, [&](const Draw& d) { b = d; });
    EXPECT_TRUE(a.valid && a.delta && b.delta);
    EXPECT_FLOAT_EQ(a.radiance.x, b.radiance.x);
}

TEST(BadLamps, NegativeEnergyTakesLightAway) {
    for_each_draw(table_of({lamp_case("", scene::LightKind::area, -10).lamp}), Receiver{}, 64, 1, [&](const Draw& d) {
        EXPECT_TRUE(d.valid);
        EXPECT_LT(d.radiance.x, 0);
    });
}

TEST(BadLamps, DegenerateTriangles) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    light::EmissiveTriangle flat{{0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {1, 1, 1}, 0, 0, -1, true};
    light::EmissiveTriangle broken{{0, nan, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, 0, 1, -1, true};
    light::EmissiveTriangle black{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0, 0, 0}, 0, 2, -1, true};
    const LightTable table({}, {flat, broken, black}, nullptr, {}, {});
    EXPECT_TRUE(table.empty());
    for (const Receiver& at : k_receivers) expect_sane(table, at);
}

TEST(BadLamps, ManyInOnePlace) {
    const std::vector<LampInput> lamps(3000, lamp_case("", scene::LightKind::point, 1).lamp);
    const LightTable table = table_of(lamps);
    for (const Receiver& at : k_receivers) expect_sane(table, at);
    std::vector<int> seen(3000, 0);
    for_each_draw(table, Receiver{}, 30'000, 1, [&](const Draw& d) { ++seen[static_cast<std::size_t>(d.emitter)]; });
    EXPECT_LT(*std::max_element(seen.begin(), seen.end()), 60);
}

// What rays hit --------------------------------------------------------------------------------------------------------

TEST(LampHits, VisibilityAndMis) {
    Case c = lamp_case("", scene::LightKind::area, 10);
    c.lamp.desc.visibility = scene::visible_all;
    const Vec3 up{0.0f, 0.0f, 1.0f};
    const LampHit seen = intersect_lamp(table_of({c.lamp}).data(), 0, Receiver{{0.3f, -0.2f, 0}, {0, 0, 1}}.lanes(), up,
                                        1e30f, mask_of(true));
    EXPECT_TRUE(all(seen.hit));
    EXPECT_EQ(seen.visibility, scene::visible_all);
    EXPECT_GT(seen.pdf[0], 0);
    c.lamp.desc.use_mis = false;
    const LampHit camera_only = intersect_lamp(table_of({c.lamp}).data(), 0,
                                               Receiver{{0.3f, -0.2f, 0}, {0, 0, 1}}.lanes(), up, 1e30f, mask_of(true));
    EXPECT_EQ(camera_only.visibility, scene::visible_camera);
    EXPECT_EQ(camera_only.pdf[0], 0);
    // Rays never find such a lamp, so its samples must not be weighed against rays.
    for_each_draw(table_of({c.lamp}), Receiver{}, 16, 1, [&](const Draw& d) { EXPECT_TRUE(d.delta && d.valid); });
    c.lamp.desc.visibility = scene::visible_all & ~scene::visible_camera;
    EXPECT_EQ(hittable_lamps(table_of({c.lamp}).data()), 0);
    EXPECT_FALSE(table_of({c.lamp}).empty());
    // From behind, and beyond t_max, nothing is hit.
    c.lamp.desc.use_mis = true;
    for_each_draw(table_of({c.lamp}), Receiver{}, 16, 1, [&](const Draw& d) { EXPECT_FALSE(d.delta); });
    const LightTable table = table_of({c.lamp});
    const Vec3 down{0.0f, 0.0f, -1.0f};
    EXPECT_TRUE(
        none(intersect_lamp(table.data(), 0, Receiver{{0.3f, -0.2f, 5}, {0, 0, 0}}.lanes(), down, 1e30f, mask_of(true))
                 .hit));
    EXPECT_TRUE(none(
        intersect_lamp(table.data(), 0, Receiver{{0.3f, -0.2f, 0}, {0, 0, 1}}.lanes(), up, 1.5f, mask_of(true)).hit));
}

TEST(LampHits, SunNeedsAFreeRay) {
    Case c = lamp_case("", scene::LightKind::sun, 1, Affine{});
    c.lamp.desc.angle = 0.1f;
    const LightTable table = table_of({c.lamp});
    const Vec3 up{0.0f, 0.0f, 1.0f};
    EXPECT_TRUE(all(intersect_lamp(table.data(), 0, Receiver{}.lanes(), up, 1e30f, mask_of(true)).hit));
    EXPECT_TRUE(none(intersect_lamp(table.data(), 0, Receiver{}.lanes(), up, 100.0f, mask_of(true)).hit));
}

TEST(LampHits, WalkFindsEveryLampOfTheRay) {
    Uniform u(5);
    std::vector<LampInput> lamps;
    for (int i = 0; i < 500; ++i) {
        Case c = lamp_case("",
                           i % 50 == 0  ? scene::LightKind::sun
                           : i % 2 == 0 ? scene::LightKind::point
                                        : scene::LightKind::area,
                           1, tilted(8 * u() - 4, 8 * u() - 4, 8 * u() - 4));
        c.lamp.desc.radius = 0.3f;
        c.lamp.desc.size_x = 0.8f;
        c.lamp.desc.angle = 0.5f;
        lamps.push_back(c.lamp);
    }
    const LightTable table = table_of(lamps);
    int visits = 0, hits = 0, rays = 0;
    for (int k = 0; k < 200; ++k) {
        const LightReceiver at{u.lanes() * 6.0f - Vec3{3.0f, 3.0f, 3.0f}, {0.0f, 0.0f, 0.0f}};
        const Vec3 d = normalize(u.lanes() - Vec3{0.5f, 0.5f, 0.5f});
        const Float t_max = k % 2 == 0 ? Float(1e30f) : Float(3.0f);
        const Mask active = first_lanes(W == 1 ? 1 : W - 1);
        std::vector<int> visited(static_cast<std::size_t>(hittable_lamps(table.data())), 0);
        LampWalk walk(table.data(), at.p, d, t_max, active);
        for (int which = walk.next(); which >= 0; which = walk.next()) {
            ++visited[static_cast<std::size_t>(which)];
            ++visits;
        }
        for (int which = 0; which < hittable_lamps(table.data()); ++which) {
            const bool hit = any(intersect_lamp(table.data(), which, at, d, t_max, active).hit);
            hits += hit ? 1 : 0;
            EXPECT_LE(visited[static_cast<std::size_t>(which)], 1);
            EXPECT_TRUE(!hit || visited[static_cast<std::size_t>(which)] == 1) << which;
        }
        rays += W;
    }
    EXPECT_GT(hits, 100);
    EXPECT_LT(visits, 80 * rays) << "the walk should skip most of 500 lamps";
}

}  // namespace
}  // namespace cardioid::light_tests
