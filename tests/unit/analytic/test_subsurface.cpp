// SPDX-License-Identifier: GPL-3.0-or-later
// Subsurface scattering in an even environment, against Cycles.
#include "analytic/replicates.h"
#include "analytic/scenes.h"

namespace cardioid::test {
namespace {

/// Radiance over the node's colour of the ball below, measured with Cycles 4.5 (1024 samples, bpy) and, without a roughness, 3.4:
/// its fit from albedo to coefficients is exact only for a half space that light enters by a cosine.
struct Case {
    const char* name;
    const char* method;
    bool before_4;
    Float3 radius;
    float anisotropy;
    double measured[3];
};
const Float3 k_color{0.8f, 0.5f, 0.2f};

scene::GraphDesc subsurface(const Case& c) {
    GraphMaker g;
    g.node("ShaderNodeSubsurfaceScattering")
        .value("Color", {k_color.x, k_color.y, k_color.z, 1})
        .value("Radius", {c.radius.x, c.radius.y, c.radius.z})
        .value("Scale", {1})
        .value("IOR", {1.4f})
        .value("Anisotropy", {c.anisotropy})
        .param("falloff", std::string(c.method));
    if (!c.before_4) g.value("Roughness", {1});
    return g.surface("BSSRDF");
}

SceneMaker ball(scene::GraphDesc graph) {
    SceneMaker m;
    m.add(sphere({0, 0, 0}, 1, 4, true), std::move(graph));
    m.world(background(1));
    m.probe({0, 0, 5}, {0, 0, 0}, 0.8f);
    m.scene.settings.samples = 256;
    return m;
}

class Subsurface : public testing::TestWithParam<Case> {};

TEST_P(Subsurface, AsCycles) {
    const Case& c = GetParam();
    const SceneMaker m = ball(subsurface(c));
    const float color[] = {k_color.x, k_color.y, k_color.z};
    statistics::Moments sums[3];
    for (std::uint32_t seed = 0; seed < 4; ++seed) {
        const auto frame = render_frame(m.scene, 50 + seed);
        for (int channel = 0; channel < 3; ++channel) sums[channel].add(mean_of(*frame, "Combined", channel));
    }
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(sums[channel].mean / static_cast<double>(color[channel]), c.measured[channel], 0.015) << channel;
}

INSTANTIATE_TEST_SUITE_P(
    Lobes, Subsurface,
    testing::Values(
        Case{"walk", "RANDOM_WALK", false, {0.3f, 0.1f, 0.05f}, 0, {1.0138, 0.9215, 0.8530}},
        Case{"wide", "RANDOM_WALK", false, {2, 1, 0.5f}, 0, {1.1590, 1.0167, 0.8904}},
        Case{"forward", "RANDOM_WALK", false, {0.3f, 0.1f, 0.05f}, 0.6f, {0.9891, 0.8664, 0.7185}},
        Case{"skin", "RANDOM_WALK_SKIN", false, {0.1f, 0.05f, 0.02f}, 0, {1.0041, 0.9767, 0.9460}},
        Case{"burley", "BURLEY", false, {0.1f, 0.05f, 0.02f}, 0, {1.0010, 1.0006, 1.0003}},
        Case{"walk_3_4", "RANDOM_WALK_FIXED_RADIUS", true, {0.3f, 0.1f, 0.05f}, 0, {1.0428, 1.0198, 1.0107}},
        Case{"wide_3_4", "RANDOM_WALK_FIXED_RADIUS", true, {2, 1, 0.5f}, 0, {1.1704, 1.1209, 1.0651}},
        Case{"forward_3_4", "RANDOM_WALK_FIXED_RADIUS", true, {0.3f, 0.1f, 0.05f}, 0.6f, {1.0255, 0.9970, 0.9949}},
        Case{"no_depth", "RANDOM_WALK", false, {0, 0, 0}, 0, {1, 1, 1}}),
    [](const auto& c) { return std::string(c.param.name); });

/// Walks may leave through the far side: a thin plate shines on its dark side.
TEST(SubsurfacePlate, ShinesThrough) {
    const Case c{"plate", "RANDOM_WALK", false, {6, 6, 6}, 0, {}};
    SceneMaker m;
    scene::MeshDesc box = sphere({0, 0, 0}, 1, 4, true);
    for (std::size_t k = 2; k < box.positions.size(); k += 3) box.positions[k] *= 0.1f;
    m.add(box, subsurface(c));
    m.sun({0, 0, 1}, 1, 0.01f);
    m.probe({0, 0, -5}, {0, 0, 0}, 0.4f);
    m.scene.settings.samples = 128;
    EXPECT_GT(mean_of(*render_frame(m.scene)), 0.01);
    m.scene.materials[0].graph = diffuse(k_color);
    EXPECT_LT(mean_of(*render_frame(m.scene)), 1e-6);
}

}  // namespace
}  // namespace cardioid::test
