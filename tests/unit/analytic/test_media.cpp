// SPDX-License-Identifier: GPL-3.0-or-later
// Participating media whose light is known in closed form or by quadrature.
#include "analytic/media_scenes.h"
#include "analytic/replicates.h"

namespace cardioid::test {
namespace {

const Float3 k_tint{0.8f, 0.5f, 0.2f};

double exponential(double color, double density, double length) { return std::exp(-(1 - color) * density * length); }

void expect_channels(const scene::SceneDesc& scene, const double (&expected)[3], double tolerance) {
    const auto frame = render_frame(scene);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(mean_of(*frame, "Combined", c), expected[c], tolerance * std::max(expected[c], 0.1))
            << "channel " << c;
}

/// Looks down at a white environment through whatever is at the origin.
SceneMaker window() {
    SceneMaker m;
    m.world(background(1));
    m.probe({0, 0, 5}, {0, 0, 0});
    m.scene.settings.samples = 4;
    return m;
}

TEST(AnalyticMedia, SlabAbsorbs) {
    SceneMaker m = window();
    m.add(box({-1, -1, -0.25f}, {1, 1, 0.25f}), absorbing(k_tint, 3));
    expect_channels(m.scene, {exponential(0.8, 3, 0.5), exponential(0.5, 3, 0.5), exponential(0.2, 3, 0.5)}, 1e-4);
}

/// The density is three times the height: a medium that is evaluated step by step.
TEST(AnalyticMedia, SlabOfGrowingDensity) {
    GraphMaker g;
    g.node("ShaderNodeNewGeometry").node("ShaderNodeSeparateXYZ").link("Vector", 0, "Position");
    g.node("ShaderNodeMath").param("operation", std::string("MULTIPLY")).link("Value", 1, "Z").value("Value_001", {3});
    g.node("ShaderNodeVolumeAbsorption").value("Color", {k_tint.x, k_tint.y, k_tint.z, 1}).link("Density", 2, "Value");
    SceneMaker m = window();
    m.add(box({-1, -1, 0}, {1, 1, 1}), volume_of(g));
    m.scene.settings.samples = 256;
    const auto seen = [](double c) { return exponential(c, 3, 0.5); };
    expect_channels(m.scene, {seen(0.8), seen(0.5), seen(0.2)}, 0.01);
}

TEST(AnalyticMedia, GlassTintsByItsThickness) {
    SceneMaker m = window();
    m.add(box({-1, -1, -0.25f}, {1, 1, 0.25f}), with_volume(glass(1, 1.0f), absorbing(k_tint, 3)));
    expect_channels(m.scene, {exponential(0.8, 3, 0.5), exponential(0.5, 3, 0.5), exponential(0.2, 3, 0.5)}, 1e-3);
}

TEST(AnalyticMedia, OverlappingMediaAddUp) {
    SceneMaker m = window();
    m.add(box({-1, -1, -0.25f}, {1, 1, 0.25f}), absorbing(k_tint, 3));
    m.add(box({-1, -1, -0.1f}, {1, 1, 1}), absorbing(k_tint, 0.7f));
    const auto both = [](double c) { return exponential(c, 3, 0.5) * exponential(c, 0.7, 1.1); };
    expect_channels(m.scene, {both(0.8), both(0.5), both(0.2)}, 2e-4);
}

TEST(AnalyticMedia, CameraInside) {
    SceneMaker m = window();
    m.add(box({-9, -9, -3}, {9, 9, 9}), absorbing(k_tint, 0.3f));
    m.add(box({-1, -1, 1}, {1, 1, 1.5f}), absorbing(k_tint, 1));
    const auto both = [](double c) { return exponential(c, 0.3, 8 - 1e-3) * exponential(c, 1, 0.5); };
    expect_channels(m.scene, {both(0.8), both(0.5), both(0.2)}, 1e-4);
}

TEST(AnalyticMedia, WorldIsEverywhereAndHidesTheBackground) {
    SceneMaker m;
    m.world(with_volume(background(1), absorbing(k_tint, 0.5f)));
    m.add(floor_quad(0, 4), emission(1));
    m.probe({0, 0, 3}, {0, 0, 0});
    m.scene.settings.samples = 4;
    const auto to = [](double c) { return exponential(c, 0.5, 3 - 1e-3); };
    expect_channels(m.scene, {to(0.8), to(0.5), to(0.2)}, 1e-4);
    m.scene.instances.clear();
    expect_channels(m.scene, {0, 0, 0}, 1e-6);
}

TEST(AnalyticMedia, SlabGlows) {
    SceneMaker m = window();
    m.world(background(0));
    m.add(box({-1, -1, -0.25f}, {1, 1, 0.25f}), glowing(2));
    expect_channels(m.scene, {1, 1, 1}, 1e-4);
    m.scene.materials[0].graph = added(glowing(2), absorbing(k_tint, 3));
    const auto seen = [](double c) { return 2 * (1 - exponential(c, 3, 0.5)) / ((1 - c) * 3); };
    expect_channels(m.scene, {seen(0.8), seen(0.5), seen(0.2)}, 1e-4);
}

TEST(AnalyticMedia, ShadowsAreTinted) {
    SceneMaker m;
    m.add(floor_quad(0, 10), diffuse(1));
    m.add(box({-1, -1, 1}, {1, 1, 1.5f}), absorbing(k_tint, 3));
    m.sun({0, 0, 1}, 1, 0);
    m.probe({0, 0, 0.5f}, {0, 0, 0});
    const auto lit = [](double c) { return exponential(c, 3, 0.5) / k_pi_d; };
    expect_channels(m.scene, {lit(0.8), lit(0.5), lit(0.2)}, 1e-4);
}

SceneMaker furnace(float anisotropy) {
    SceneMaker m;
    m.world(background(1));
    m.add(sphere({0, 0, 0}, 1, 3, false), scattering({1, 1, 1}, 3, anisotropy));
    m.probe({0, 0, 5}, {0, 0, 0}, 1);
    scene::Settings& s = m.scene.settings;
    s.samples = 128;
    s.max_bounces = s.max_volume_bounces = 250;
    return m;
}

TEST(AnalyticMedia, WhiteFurnace) {
    for (const float g : {0.0f, 0.7f, -0.4f}) expect_value(furnace(g).scene, 1.0, "Combined", 0.01, 1e-3);
    SceneMaker grey = furnace(0);
    grey.scene.materials[0].graph = added(scattering({1, 1, 1}, 3), absorbing({0.95f, 0.95f, 0.95f}, 3));
    expect_not(grey.scene, 1.0);
}

/// One scattering in a box of thin fog, seen along its axis, lit by a lamp inside it.
TEST(AnalyticMedia, SingleScattering) {
    constexpr double sigma = 0.2, g = 0.4, power = 50;
    SceneMaker m;
    m.add(box({-50, -50, -2}, {50, 50, 2}), scattering({1, 1, 1}, static_cast<float>(sigma), static_cast<float>(g)));
    m.point_lamp({0.7f, 0, 0.3f}, static_cast<float>(power), 0);
    m.probe({0, 0, 5}, {0, 0, 0}, 1e-3f);
    m.scene.settings.samples = 256;
    m.scene.settings.max_volume_bounces = 0;
    double expected = 0;
    constexpr int steps = 20000;
    for (int k = 0; k < steps; ++k) {
        const double t = 4 * (k + 0.5) / steps, z = 2 - t;
        const double dx = 0.7, dz = 0.3 - z, r = std::sqrt(dx * dx + dz * dz);
        // Light travels from the lamp along (-dx, -dz), then up to the camera.
        const double cosine = -dz / r, d = 1 + g * g - 2 * g * cosine;
        const double phase = (1 - g * g) / (4 * k_pi_d * d * std::sqrt(d));
        expected += 4.0 / steps * sigma * phase * std::exp(-sigma * (t + r)) * power / (4 * k_pi_d) / (r * r);
    }
    expect_value(m.scene, expected, "Combined", 0.02, 1e-3);
    m.scene.instances[0].visibility &= static_cast<std::uint8_t>(~scene::visible_camera);
    expect_not(m.scene, expected);
}

/// A lamp at (1.5, 0.5, 2.5), the ball at the origin from above; measured with Cycles 4.5 (bpy, 1024 samples of 16 × 16 pixels).
SceneMaker lit_ball(scene::GraphDesc graph, int volume_bounces) {
    SceneMaker m;
    m.add(sphere({0, 0, 0}, 1, 5, true), std::move(graph));
    m.point_lamp({1.5f, 0.5f, 2.5f}, 100, 0.2f).soft_falloff = true;
    m.probe({0, 0, 5}, {0, 0, 0}, 1.2f);
    m.scene.settings.samples = 1024;
    m.scene.settings.max_volume_bounces = volume_bounces;
    return m;
}

TEST(MediaAsCycles, PrincipledVolume) {
    GraphMaker g;
    g.node("ShaderNodeVolumePrincipled")
        .value("Color", {0.9f, 0.6f, 0.3f, 1})
        .value("Absorption Color", {0, 0, 0, 1})
        .value("Density", {2})
        .value("Anisotropy", {0.3f});
    SceneMaker m = lit_ball(volume_of(g), 0);
    expect_channels(m.scene, {0.019875, 0.013250, 0.006625}, 0.003);
    m.scene.settings.max_volume_bounces = 4;
    expect_channels(m.scene, {0.057531, 0.025642, 0.008980}, 0.006);
}

TEST(MediaWidths, Agree) {
    SceneMaker m = lit_ball(with_volume(GraphMaker()
                                            .node("ShaderNodeSubsurfaceScattering")
                                            .value("Color", {0.8f, 0.6f, 0.4f, 1})
                                            .value("Radius", {0.2f, 0.1f, 0.05f})
                                            .value("Scale", {1})
                                            .surface("BSSRDF"),
                                        absorbing(k_tint, 1)),
                            2);
    m.world(with_volume(background(0), scattering({0.9f, 0.8f, 0.7f}, 0.1f)));
    m.scene.settings.samples = 256;
    const double whole = mean_of(*render_frame(m.scene, 3, 16));
    for (const int width : {1, 8}) EXPECT_NEAR(mean_of(*render_frame(m.scene, 3, width)), whole, 1e-3 * whole) << width;
}

TEST(MediaAsCycles, WorldOfFog) {
    SceneMaker m = lit_ball(diffuse(0.8f), 4);
    m.world(with_volume(background(0), scattering({0.9f, 0.8f, 0.7f}, 0.1f)));
    expect_channels(m.scene, {0.250269, 0.248295, 0.246289}, 0.01);
}

}  // namespace
}  // namespace cardioid::test
