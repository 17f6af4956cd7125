// SPDX-License-Identifier: GPL-3.0-or-later
// Embree's packets at this width against an intersector that tries every triangle in double precision.
#include "soup.h"
#include "trace/embree_scene.h"
#include "trace/packet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

namespace cardioid::trace_tests {
namespace {

using namespace CD_ISA_NS;  // NOLINT(google-build-using-namespace): the width under test

struct D3 {
    double x, y, z;
};
D3 sub(D3 a, D3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
D3 crossed(D3 a, D3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double dotted(D3 a, D3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
D3 wide(Float3 p) { return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)}; }

struct Hit {
    double t = 1e30, u = 0, v = 0;
    int instance = -1, triangle = -1;
    double margin = 1;  ///< how far inside its triangle, and before the next hit: small means ambiguous in float
};

/// Möller & Trumbore in double.
std::optional<Hit> hit_triangle(const Float3 (&c)[3], Float3 origin, Float3 direction) {
    const D3 a = wide(c[0]), e1 = sub(wide(c[1]), a), e2 = sub(wide(c[2]), a), d = wide(direction),
             s = sub(wide(origin), a);
    const D3 p = crossed(d, e2), q = crossed(s, e1);
    const double det = dotted(e1, p);
    if (std::fabs(det) < 1e-12) return {};
    Hit h;
    h.u = dotted(s, p) / det;
    h.v = dotted(d, q) / det;
    h.t = dotted(e2, q) / det;
    h.margin = std::min({h.u, h.v, 1 - h.u - h.v});
    return h;
}

struct Ray {
    Float3 o, d;
    float t_min = 0, t_max = 1e30f;
};

/// The nearest hit; its margin is 0 when rounding could decide otherwise.
Hit brute_force(const trace::GeometryPool& pool, const Ray& ray) {
    Hit best;
    double second = 1e30, ambiguous = 1e30;
    for (std::size_t i = 0; i < pool.placed().size(); ++i) {
        const auto& range = pool.meshes()[static_cast<std::size_t>(pool.placed()[i].desc->mesh)];
        for (std::uint32_t t = 0; t < range.triangles; ++t) {
            Float3 c[3];
            pool.world_triangle(static_cast<int>(i), t, c);
            std::optional<Hit> h = hit_triangle(c, ray.o, ray.d);
            if (!h || h->t < static_cast<double>(ray.t_min) || h->t > static_cast<double>(ray.t_max) ||
                h->margin < -1e-4)
                continue;
            if (h->margin < 1e-4) {
                ambiguous = std::min(ambiguous, h->t);
                continue;
            }
            h->instance = static_cast<int>(i);
            h->triangle = static_cast<int>(t);
            if (h->t < best.t) {
                second = best.t;
                best = *h;
            } else {
                second = std::min(second, h->t);
            }
        }
    }
    const bool tie = best.instance >= 0 && second - best.t < 1e-4;
    if (tie || ambiguous < std::min(best.t + 1e-4, 1e29)) best.margin = 0;
    return best;
}

scene::SceneDesc soup_scene() {
    scene::SceneDesc desc;
    desc.meshes = {soup(150, 1), soup(40, 2)};
    Affine turned;
    turned.m = {0.6f, -0.8f, 0, 0.5f, 0.8f, 0.6f, 0, -0.2f, 0, 0, 1, 0.1f};
    desc.instances = {placed(0, Affine{}), placed(1, turned), placed(1, scaled(-0.5f, 1, 2))};
    return desc;
}

std::vector<Ray> rays(int n) {
    std::mt19937 random(9);
    std::uniform_real_distribution<float> u(-1.5f, 1.5f);
    std::vector<Ray> all;
    for (int k = 0; k < n; ++k) {
        const Float3 from{u(random), u(random), u(random)}, to{u(random), u(random), u(random)};
        Ray r{from, normalize(to - from)};
        if (k % 3 == 0) r.t_min = 0.4f;
        if (k % 5 == 0) r.t_max = 1.0f;
        all.push_back(r);
    }
    return all;
}

RayLanes lanes_of(const std::vector<Ray>& all, std::size_t first) {
    RayLanes l;
    l.time = 0.0f;
    l.mask = Int(-1);
    l.o = l.d = {0.0f, 0.0f, 0.0f};
    l.t_min = 0.0f;
    l.t_max = 0.0f;
    for (int i = 0; i < W; ++i) {
        const Ray& r = all[std::min(first + static_cast<std::size_t>(i), all.size() - 1)];
        l.o.x.v[i] = r.o.x, l.o.y.v[i] = r.o.y, l.o.z.v[i] = r.o.z;
        l.d.x.v[i] = r.d.x, l.d.y.v[i] = r.d.y, l.d.z.v[i] = r.d.z;
        l.t_min.v[i] = r.t_min;
        l.t_max.v[i] = r.t_max;
    }
    return l;
}

class Packet : public testing::Test {
protected:
    scene::SceneDesc desc = soup_scene();
    trace::GeometryPool pool{desc, {}, 0};
    trace::EmbreeScene embree{pool, false, [](int) { return false; }, [] { return true; }};
};

TEST_F(Packet, ClosestHitsAreThoseOfBruteForce) {
    const auto all = rays(4000);
    int hits = 0, misses = 0;
    for (std::size_t k = 0; k < all.size(); k += W) {
        for (const bool coherent : {false, true}) {
            const HitLanes h = intersect(embree.top(), lanes_of(all, k), mask_of(true), coherent);
            for (std::size_t i = 0; i < W && k + i < all.size(); ++i) {
                const Hit expected = brute_force(pool, all[k + i]);
                if (expected.margin <= 0) continue;
                const int lane = static_cast<int>(i);
                const bool hit = (bits(h.hit) >> lane & 1u) != 0;
                ASSERT_EQ(hit, expected.instance >= 0) << "ray " << k + i;
                ++(hit ? hits : misses);
                if (!hit) continue;
                EXPECT_EQ(h.instance[lane], expected.instance);
                EXPECT_EQ(h.triangle[lane], expected.triangle);
                EXPECT_NEAR(static_cast<double>(h.t[lane]), expected.t, 1e-4);
                EXPECT_NEAR(static_cast<double>(h.u[lane]), expected.u, 2e-3);
                EXPECT_NEAR(static_cast<double>(h.v[lane]), expected.v, 2e-3);
            }
        }
    }
    EXPECT_GT(hits, 1000);
    EXPECT_GT(misses, 1000);
}

TEST_F(Packet, OcclusionIsThatOfBruteForce) {
    const auto all = rays(4000);
    for (std::size_t k = 0; k < all.size(); k += W) {
        const Mask m = occluded(embree.top(), lanes_of(all, k), mask_of(true));
        for (std::size_t i = 0; i < W && k + i < all.size(); ++i) {
            const Hit expected = brute_force(pool, all[k + i]);
            if (expected.margin <= 0) continue;
            EXPECT_EQ((bits(m) >> i & 1u) != 0, expected.instance >= 0) << "ray " << k + i;
        }
    }
}

TEST_F(Packet, LanesThatAreOffHitNothing) {
    const auto all = rays(64);
    for (std::size_t k = 0; k < all.size(); k += W) {
        EXPECT_TRUE(none(intersect(embree.top(), lanes_of(all, k), mask_of(false), false).hit));
        EXPECT_TRUE(none(occluded(embree.top(), lanes_of(all, k), mask_of(false))));
    }
}

TEST(PacketMasks, VisibilityAndKindsOfShadow) {
    scene::SceneDesc desc;
    desc.meshes = {square(), square(), square()};
    desc.instances = {placed(0, moved(-0.5f, -0.5f, 0)), placed(1, moved(9.5f, -0.5f, 0)),
                      placed(2, moved(19.5f, -0.5f, 0))};
    desc.instances[0].visibility = scene::visible_camera;
    desc.instances[2].visibility = scene::visible_shadow;
    const trace::GeometryPool pool(desc, {}, 0);
    const trace::EmbreeScene embree(
        pool, false, [](int i) { return i == 1; }, [] { return true; });
    const auto sees = [&](float x, std::uint32_t mask) {
        RayLanes ray = lanes_of({Ray{{x, 0.1f, 1}, {0, 0, -1}}}, 0);
        ray.mask = Int::of_bits(mask);
        return any(intersect(embree.top(), ray, mask_of(true), false).hit);
    };
    EXPECT_TRUE(sees(0, scene::visible_camera));
    EXPECT_FALSE(sees(0, scene::visible_diffuse));
    EXPECT_FALSE(sees(0, trace::mask_shadow_opaque | trace::mask_shadow_transparent));
    EXPECT_TRUE(sees(10, scene::visible_glossy));
    EXPECT_TRUE(sees(10, trace::mask_shadow_transparent));
    EXPECT_FALSE(sees(10, trace::mask_shadow_opaque));
    EXPECT_FALSE(sees(20, scene::visible_all & ~scene::visible_shadow));
    EXPECT_TRUE(sees(20, trace::mask_shadow_opaque));
}

TEST(EmbreeScene, ABuildThatIsToldToStopStops) {
    scene::SceneDesc desc = soup_scene();
    const trace::GeometryPool pool(desc, {}, 0);
    const trace::EmbreeScene embree(
        pool, false, [](int) { return false; }, [] { return false; });
    EXPECT_TRUE(embree.cancelled());
}

}  // namespace
}  // namespace cardioid::trace_tests
