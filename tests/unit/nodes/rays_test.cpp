// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes that send rays, in scenes whose answers are known: half spaces.
#include "nodes/chunks.h"
#include "nodes/compile.h"
#include "nodes/graphs.h"

#include <gtest/gtest.h>

namespace cardioid {
namespace {

using nodes::NodeHits;
using nodes::NodeRays;

/// Solid where x < 0 and z < 0: a right edge along y, one smooth-less object, instance 0.
void hit_edge(const void*, const NodeRays& rays, NodeHits& hits, int lanes) {
    for (int i = 0; i < lanes; ++i) {
        hits.instance[i] = -1;
        hits.t[i] = 1e30f;
        for (const int axis : {0, 2}) {
            const int other = 2 - axis;
            const float d = rays.direction[axis][i], t = -rays.origin[axis][i] / d;
            if (d == 0 || !(t >= rays.t_min[i]) || !(t <= rays.t_max[i]) || t >= hits.t[i]) continue;
            if (rays.origin[other][i] + t * rays.direction[other][i] > 0) continue;
            hits.instance[i] = 0;
            hits.t[i] = t;
            for (int c = 0; c < 3; ++c) hits.normal[c][i] = hits.normal_geometric[c][i] = c == axis ? 1.0f : 0.0f;
        }
    }
}

/// A wall at x = 1, seen from its left.
void hit_wall(const void*, const NodeRays& rays, NodeHits& hits, int lanes) {
    for (int i = 0; i < lanes; ++i) {
        const float t = (1 - rays.origin[0][i]) / rays.direction[0][i];
        const bool hit = rays.t_max[i] >= rays.t_min[i] && t > rays.t_min[i] && t < rays.t_max[i];
        hits.instance[i] = hit ? 7 : -1;
        hits.t[i] = t;
        for (int c = 0; c < 3; ++c) hits.normal[c][i] = hits.normal_geometric[c][i] = c == 0 ? 1.0f : 0.0f;
    }
}

struct Scene {
    nodes::RayService service;
    std::unique_ptr<test::Machine> m = std::make_unique<test::Machine>();

    Scene(void (*closest)(const void*, const NodeRays&, NodeHits&, int), Float3 at) {
        service.closest = closest;
        m->chunk.rays = &service;
        for (int i = 0; i < k_chunk; ++i) {
            for (int c = 0; c < 3; ++c) {
                m->chunk.position[c][i] = c == 0 ? at.x : c == 1 ? at.y : at.z;
                m->chunk.normal[c][i] = m->chunk.normal_geometric[c][i] = c == 2;
            }
            m->chunk.backfacing[i] = 0;
            m->chunk.instance[i] = 0;
            m->chunk.random_seed[i] = 1234567 + 91 * i;
        }
    }
    /// Mean over the lanes of the emission of the node's output.
    Float3 run(test::GraphMaker& g, const char* output) {
        const int node = g.index();
        g.node("ShaderNodeEmission").link("Color", node, output).value("Strength", {1});
        nodes::Warnings warnings;
        nodes::CompileContext context;
        const auto compiled = nodes::compile(g.surface("Emission"), context, warnings);
        EXPECT_TRUE(compiled.info.sends_rays);
        CD_ISA_NS::run_program(compiled.of(nodes::Purpose::emission), m->chunk, m->out, m->scratch);
        Float3 sum;
        for (int i = 0; i < k_chunk; ++i)
            sum = sum + Float3{m->out.emission[0][i], m->out.emission[1][i], m->out.emission[2][i]} * (1.0f / k_chunk);
        return sum;
    }
};

test::GraphMaker occlusion(float distance, bool local = false) {
    test::GraphMaker g;
    g.node("ShaderNodeAmbientOcclusion").value("Distance", {distance}).value("Color", {1, 0.5f, 0, 1});
    g.param("samples", 64.0).param("only_local", local);
    return g;
}

TEST(Rays, HalfOfTheDirectionsMeetAWall) {
    auto g = occlusion(1e6f);
    const Float3 c = Scene(hit_wall, {0, 0, 0}).run(g, "Color");
    EXPECT_NEAR(c.x, 0.5f, 0.01f);
    EXPECT_NEAR(c.y, 0.25f, 0.005f);
    EXPECT_EQ(c.z, 0);
}

TEST(Rays, NothingIsWithinReach) {
    auto g = occlusion(0.9f);
    EXPECT_NEAR(Scene(hit_wall, {0, 0, 0}).run(g, "AO").x, 1, 1e-5f);
}

TEST(Rays, WithoutASceneNothingIsOccludedOrBevelled) {
    Scene scene(nullptr, {0, 0, 0});
    auto g = occlusion(1e6f);
    EXPECT_EQ(scene.run(g, "AO").x, 1);
}

Float3 bevelled(float x, float radius, std::int32_t seed_bits = 0) {
    test::GraphMaker g;
    g.node("ShaderNodeBevel").value("Radius", {radius}).param("samples", 64.0);
    Scene scene(hit_edge, {x, 0, 0});
    for (auto& seed : scene.m->chunk.random_seed) seed |= seed_bits;
    return scene.run(g, "Normal");
}

TEST(Rays, BevelsTurnAroundAnEdge) {
    // On the edge both sides weigh the same; the node's result is of unit length at each point.
    const Float3 edge = bevelled(-1e-5f, 0.1f);
    EXPECT_NEAR(edge.x, 0.7071f, 0.02f);
    EXPECT_NEAR(edge.y, 0, 0.01f);
    EXPECT_NEAR(edge.z, 0.7071f, 0.02f);
    const Float3 near = bevelled(-0.03f, 0.1f);
    EXPECT_GT(near.x, 0.1f);
    EXPECT_LT(near.x, 0.6f);
    const Float3 far = bevelled(-0.2f, 0.1f);
    EXPECT_NEAR(far.x, 0, 1e-5f);
    EXPECT_NEAR(far.z, 1, 1e-5f);
}

TEST(Rays, BlurredPathsSeeNoBevel) { EXPECT_EQ(bevelled(-1e-5f, 0.1f, static_cast<std::int32_t>(0x80000000u)).z, 1); }

Float3 cast(const char* output) {
    test::GraphMaker g;
    g.node("ShaderNodeCombineXYZ").value("X", {0.5f}).value("Y", {0}).value("Z", {0});
    g.node("ShaderNodeRaycast").value("Length", {5}).link("Direction", 0, "Vector");
    return Scene(hit_wall, {0, 2, 3}).run(g, output);
}

TEST(Rays, RaycastTellsWhatItMeets) {
    EXPECT_EQ(cast("Is Hit").x, 1);
    EXPECT_EQ(cast("Self Hit").x, 0);
    EXPECT_NEAR(cast("Hit Distance").x, 2, 1e-4f);
    const Float3 p = cast("Hit Position"), n = cast("Hit Normal");
    EXPECT_NEAR(p.x, 1, 1e-4f);
    EXPECT_NEAR(p.y, 2, 1e-4f);
    EXPECT_EQ(n.x, -1);
}

}  // namespace
}  // namespace cardioid
