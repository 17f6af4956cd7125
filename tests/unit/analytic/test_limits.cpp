// SPDX-License-Identifier: GPL-3.0-or-later
// Clamping, bounce limits by kind, exposure, switches.
#include "analytic/replicates.h"
#include "analytic/scenes.h"

namespace cardioid::test {
namespace {

TEST(Limits, ClampDirect) {
    SceneMaker m;
    m.add(floor_quad(0, 100), diffuse(Float3{0.8f, 0.4f, 0.0f}));
    m.point_lamp({0, 0, 1}, static_cast<float>(4 * k_pi_d * k_pi_d * 10), 0);  // radiance 10 · albedo
    m.probe({0, -1, 1}, {0, 0, 0}, 1e-3f);
    EXPECT_NEAR(replicate(m.scene, "Combined", 1).mean, 8, 0.01);
    m.scene.settings.clamp_direct = 2;
    const auto f = render_frame(m.scene);
    // The sum of the components is held under three times the limit, the hue stays.
    EXPECT_NEAR(mean_of(*f, "Combined", 0), 4, 1e-3);
    EXPECT_NEAR(mean_of(*f, "Combined", 1), 2, 1e-3);
    m.scene.settings.clamp_direct = 0;
    m.scene.settings.clamp_indirect = 0.01f;
    EXPECT_NEAR(replicate(m.scene, "Combined", 1).mean, 8, 0.01) << "direct light is not indirect";
}

TEST(Limits, ClampIndirectLeavesDirectAlone) {
    // Two bounces of a sphere seen from inside: direct 1/2, the rest 1/2 in many small contributions.
    SceneMaker m;
    m.add(sphere({0, 0, 0}, 1, 4, true), diffuse(0.5f));
    m.point_lamp({0, 0, 0}, static_cast<float>(4 * k_pi_d * k_pi_d), 0);
    m.perspective({0.1f, 0, 0.2f}, {1, 0, 0}, 1);
    m.scene.settings.samples = 16;
    m.scene.settings.clamp_indirect = 0.05f;
    m.scene.settings.max_diffuse_bounces = 4;
    const auto f = render_frame(m.scene);
    EXPECT_NEAR(mean_of(*f, "D2"), 0.5, 3e-3);
    // Without a clamp 0.25, 0.125, … Each contribution is held to 0.05; roulette from the third vertex keeps a share of the paths:
    // the root of their throughput, 1/8, then of half of what that left.
    const double third = std::sqrt(1.0 / 8), fourth = third * std::sqrt(0.5 * third);
    EXPECT_NEAR(mean_of(*f, "D3"), 0.05 * (1 + 1 + third + fourth), 2e-3);
}

/// `n` panes in z > 0, seen from above, before a white floor.
SceneMaker panes(int n, const scene::GraphDesc& graph) {
    SceneMaker m;
    m.add(floor_quad(0, 100), emission(1));
    for (int k = 1; k <= n; ++k) m.add(floor_quad(static_cast<float>(k), 100), graph);
    m.probe({0, 0, 10}, {0, 0, 0});
    return m;
}

TEST(Limits, TransparentSurfacesInARow) {
    for (int limit = 0; limit <= 4; ++limit) {
        SceneMaker m = panes(3, transparent(0.5f));
        m.scene.settings.max_transparent_bounces = limit;
        EXPECT_NEAR(replicate(m.scene, "Combined", 1).mean, limit >= 3 ? 0.125 : 0.0, 1e-5) << limit;
    }
}

TEST(Limits, TransparentPassesAreNotBounces) {
    SceneMaker m = panes(6, transparent(1));
    m.scene.settings.max_bounces = 0;
    EXPECT_NEAR(replicate(m.scene, "Combined", 1).mean, 1, 1e-5);
}

TEST(Limits, TransmissionByKindAndInAll) {
    for (const bool by_kind : {false, true}) {
        for (int limit = 0; limit <= 3; ++limit) {
            SceneMaker m = panes(3, glass(1, 1.0f));
            (by_kind ? m.scene.settings.max_transmission_bounces : m.scene.settings.max_bounces) = limit;
            // The surface after the last bounce still shows its emission: three panes need two.
            const statistics::Moments mean = replicate(m.scene, "Combined", 3);
            EXPECT_NEAR(mean.mean, limit >= 2 ? 1.0 : 0.0, 0.05) << limit << " " << by_kind;
        }
    }
}

TEST(Limits, GlossyByKind) {
    for (int limit = 0; limit <= 3; ++limit) {
        // Mirrors at 45 degrees: down, sideways, up, to the white ceiling.
        SceneMaker m;
        m.add(quad({0, 0, 0}, {1, 0, 1}, {0, 2, 0}), glossy(1, 0));
        m.add(quad({-4, 0, 0}, {-1, 0, 1}, {0, 2, 0}), glossy(1, 0));
        m.add(quad({-4, 0, 4}, {1, 0, 0}, {0, 2, 0}), emission(1));
        m.probe({0, 0, 3}, {0, 0, 0});
        m.scene.settings.max_glossy_bounces = limit;
        EXPECT_NEAR(replicate(m.scene, "Combined", 1).mean, limit >= 1 ? 1.0 : 0.0, 1e-5) << limit;
    }
}

TEST(Limits, LampsAndWorldCountBounces) {
    // A lamp that may light only the first surface.
    SceneMaker m;
    m.add(sphere({0, 0, 0}, 1, 4, true), diffuse(0.5f));
    m.point_lamp({0, 0, 0}, static_cast<float>(4 * k_pi_d * k_pi_d), 0).max_bounces = 0;
    m.perspective({0.1f, 0, 0.2f}, {1, 0, 0}, 1);
    EXPECT_NEAR(replicate(m.scene, "Combined", 2).mean, 0.5, 0.01);
}

TEST(Limits, ExposureScales) {
    SceneMaker m = panes(0, {});
    m.scene.settings.exposure = 3;
    EXPECT_NEAR(replicate(m.scene, "Combined", 1).mean, 3, 1e-5);
}

TEST(Limits, NegativeLampsTakeLightAway) {
    SceneMaker m;
    m.add(floor_quad(0, 100), diffuse(0.6f));
    m.point_lamp({0, 0, 2}, 100, 0);
    m.point_lamp({0, 0, 2}, -40, 0);
    m.probe({0, -1, 1}, {0, 0, 0});
    m.scene.settings.samples = 256;
    expect_value(m.scene, 0.6 / k_pi_d * 60 / (4 * k_pi_d) / 4, "Combined", 0.02, 1e-4);
}

TEST(Limits, FilterGlossyKeepsDirectViewsOfMirrorsSharp) {
    SceneMaker m;
    m.add(floor_quad(0, 100), glossy(0.8f, 0));
    m.add(quad({0, 2, 2}, {1, 0, 0}, {0, -0.7f, 0.7f}), emission(3));
    m.probe({0, -2, 2}, {0, 0, 0});
    m.scene.settings.filter_glossy = 1;
    EXPECT_NEAR(replicate(m.scene, "Combined", 1).mean, 2.4, 1e-4);
}

}  // namespace
}  // namespace cardioid::test
