// SPDX-License-Identifier: GPL-3.0-or-later
// From hits to materials, normals and ray origins.
#include "soup.h"
#include "trace/geometry_pool.h"
#include "trace/octahedral.h"
#include "trace/surface.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cardioid::trace_tests {
namespace {

using namespace CD_ISA_NS;  // NOLINT(google-build-using-namespace): the width under test

Float3 lane(Vec3 v, int i) { return {v.x[i], v.y[i], v.z[i]}; }
Vec3 lanes(Float3 v) { return {v.x, v.y, v.z}; }

double angle(Float3 a, Float3 b) {
    const Float3 c = cross(a, b);
    return std::atan2(static_cast<double>(length(c)), static_cast<double>(dot(a, b)));
}

TEST(PackedNormals, ErrorIsUnderItsBound) {
    std::mt19937 random(4);
    std::normal_distribution<float> normal;
    double worst = 0;
    for (int k = 0; k < 100'000; ++k) {
        const Float3 n = normalize(Float3{normal(random), normal(random), normal(random)});
        const Float3 back = normalize(lane(unpack_normal(Int::of_bits(trace::pack_normal(n))), 0));
        worst = std::max(worst, angle(n, back));
    }
    EXPECT_LT(worst, 7e-5);
    EXPECT_GT(worst, 1e-6) << "the measure sees no quantisation at all";
}

TEST(PackedNormals, AxesAreExact) {
    for (const Float3 n :
         {Float3{1, 0, 0}, Float3{-1, 0, 0}, Float3{0, 1, 0}, Float3{0, -1, 0}, Float3{0, 0, 1}, Float3{0, 0, -1}}) {
        const Float3 back = normalize(lane(unpack_normal(Int::of_bits(trace::pack_normal(n))), W - 1));
        EXPECT_LT(angle(n, back), 2e-7) << n.x << " " << n.y << " " << n.z;
    }
    const Float3 zero = lane(unpack_normal(Int::of_bits(trace::pack_normal({0, 0, 0}))), 0);
    EXPECT_TRUE(std::isfinite(zero.x + zero.y + zero.z));
}

struct Placed {
    scene::SceneDesc desc;
    trace::GeometryPool pool;
    trace::SceneView view;
    explicit Placed(scene::SceneDesc d) : desc(std::move(d)), pool(desc, {}, 50) { pool.fill(view); }
};

TEST(Surface, MaterialOfEqualsThePool) {
    scene::SceneDesc desc;
    desc.meshes = {soup(40, 3), square(), square()};
    desc.meshes[2].slots.clear();
    for (int t = 0; t < 40; ++t) desc.meshes[0].slots.push_back(t % 5);
    desc.instances = {placed(1, Affine{}, {3, 8}), placed(0, Affine{}, {10, 11, 12}),
                      placed(0, Affine{}, {20, -1, 22, 23, 24}), placed(2, Affine{}, {7})};
    const Placed p(desc);
    for (int instance = 0; instance < 4; ++instance) {
        const int triangles = instance == 0 || instance == 3 ? 2 : 40;
        for (int t = 0; t < triangles; t += W) {
            const Int triangle = min(Int(t) + lane_index(), Int(triangles - 1));
            const Int material = material_of(p.view, Int(instance), triangle);
            for (int i = 0; i < W; ++i)
                EXPECT_EQ(material[i], p.pool.material(instance, static_cast<std::uint32_t>(triangle[i])));
        }
    }
}

SurfaceNormals normals_of(const trace::SceneView& view, int instance, Float3 raw, Float3 wo) {
    return surface_normals(view, Int(instance), Int(0), lanes(raw), 0.25f, 0.25f, lanes(wo));
}

TEST(Surface, NormalsAreOnTheSideOfTheViewer) {
    scene::SceneDesc desc;
    desc.meshes = {square()};
    desc.instances = {placed(0, Affine{})};
    const Placed p(desc);
    for (const float side : {1.0f, -1.0f}) {
        const SurfaceNormals s = normals_of(p.view, 0, {0, 0, 3}, {0.6f, 0, side * 0.8f});
        EXPECT_EQ(lane(s.ng, 0), (Float3{0, 0, side}));
        EXPECT_EQ(lane(s.n, 0), (Float3{0, 0, side}));
        EXPECT_EQ(any(s.backfacing), side < 0);
    }
}

TEST(Surface, MirroredInstancesShowTheSameSide) {
    // The square seen from +z shows its front, mirrored or not, baked or not.
    for (const bool baked : {true, false}) {
        scene::SceneDesc desc;
        desc.meshes = {square()};
        desc.instances = {placed(0, scaled(-1, 1, 1))};
        if (!baked) desc.instances.push_back(placed(0, moved(9, 9, 9)));
        const Placed p(desc);
        ASSERT_EQ(p.pool.baked(0), baked);
        // Embree's raw normal: of the mirrored triangle when baked, else in the mesh's space.
        const SurfaceNormals s = normals_of(p.view, 0, {0, 0, baked ? -1.0f : 1.0f}, {0, 0, 1});
        EXPECT_TRUE(none(s.backfacing)) << baked;
        EXPECT_NEAR(s.ng.z[0], 1, 1e-6);
    }
}

TEST(Surface, SmoothNormalsAgreeBakedAndInstanced) {
    Affine t;
    t.m = {1.5f, 0.3f, 0, 2, 0, -0.7f, 0.2f, 1, 0.1f, 0, 2, -3};
    Float3 found[2];
    for (const bool baked : {true, false}) {
        scene::SceneDesc desc;
        desc.meshes = {square()};
        for (int k = 0; k < 6; ++k) {
            const Float3 n = normalize(Float3{0.1f * static_cast<float>(k), 0.2f, 1});
            desc.meshes[0].corner_normals.insert(desc.meshes[0].corner_normals.end(), {n.x, n.y, n.z});
        }
        desc.instances = {placed(0, t)};
        if (!baked) desc.instances.push_back(placed(0, Affine{}));
        const Placed p(desc);
        const Float3 raw = baked ? cross(t.vector({1, 0, 0}), t.vector({1, 1, 0})) : Float3{0, 0, 1};
        const Float3 world = normalize(inverse(t).transposed_vector({0, 0, 1}));
        const SurfaceNormals s = normals_of(p.view, 0, raw, world);
        EXPECT_LT(angle(lane(s.ng, 0), world), 1e-5);
        EXPECT_GT(dot(lane(s.n, 0), world), 0.5f);
        found[baked ? 0 : 1] = lane(s.n, 0);
    }
    // Interpolated before or after the transform: equal up to the scale's unevenness across the triangle.
    EXPECT_LT(angle(found[0], found[1]), 2e-2);
}

TEST(Surface, EdgesAreInWorldSpace) {
    for (const bool baked : {true, false}) {
        scene::SceneDesc desc;
        desc.meshes = {square()};
        desc.instances = {placed(0, scaled(2, 3, 4))};
        if (!baked) desc.instances.push_back(placed(0, Affine{}));
        const Placed p(desc);
        Vec3 e1, e2;
        triangle_edges(p.view, Int(0), Int(1), e1, e2);
        EXPECT_EQ(lane(e1, 0), (Float3{2, 3, 0}));
        EXPECT_EQ(lane(e2, W - 1), (Float3{0, 3, 0}));
    }
}

TEST(Surface, OriginsLeaveOnTheSideOfTheDirection) {
    for (const float far : {0.0f, 1.0f, 1e4f, 1e7f}) {
        for (const float side : {1.0f, -1.0f}) {
            const Float3 p{far, 2, far}, n{0, 0.8f, 0.6f}, d{0, 0, side};
            const Float3 o = lane(offset_origin(lanes(p), lanes(n), lanes(d), Float(1.0f)), 0);
            EXPECT_GT(dot(o - p, n) * side, 0.0f) << far << " " << side;
            EXPECT_LT(length(o - p), 1e-5f * std::max(far, 2.0f));
        }
    }
    // A long way travelled means rounding at a near point, too.
    const Float3 o = lane(offset_origin(lanes({0, 0, 0}), lanes({0, 0, 1}), lanes({0, 0, 1}), Float(1000.0f)), 0);
    EXPECT_NEAR(o.z, 4e-3, 1e-5);
}

}  // namespace
}  // namespace cardioid::trace_tests
