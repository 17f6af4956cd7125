// SPDX-License-Identifier: GPL-3.0-or-later
// The threshold between class S and class D moves work between the halves and not the picture.
#include "caustics/compare.h"

namespace cardioid::test {
namespace {

using scene::IntegratorKind;

void expect_thresholds(const CausticCase& c, IntegratorKind kind, std::initializer_list<float> thresholds) {
    const Pictures judge = pictures(path_traced(c), 1000);
    for (const float threshold : thresholds) {
        scene::SceneDesc scene = with_photons(c, kind);
        scene.settings.caustic_roughness = threshold;
        const Agreement a = compare_pass(judge, photon_pictures(c, scene, 2000), 0, c.bound, c.block_bound);
        std::printf("%-26s threshold %.2f  %s\n", c.name.c_str(), static_cast<double>(threshold), a.report.c_str());
        EXPECT_TRUE(a.agree) << c.name << " at " << threshold << ": " << a.report;
    }
}

TEST(Threshold, MetalsOnEitherSide) {
    // Roughness 0.2 and 0.25, a delta pane for the threshold 0 to have something to catch.
    CausticCase c = rough_metal();
    SceneMaker m;
    m.scene = c.scene;
    m.add(quad({-1.2f, -0.3f, 0.6f}, {0.6f, 0, 0.2f}, {0, 0.6f, 0}), glossy(0.8f, 0.08f));
    c.scene = m.scene;
    expect_thresholds(c, IntegratorKind::hybrid, {0, 0.1f, 0.3f});
}

TEST(Threshold, RoughGlass) {
    SceneMaker m;
    m.add(floor_quad(0, 8), diffuse(0.6f));
    m.add(sphere({0, 0, 1}, 0.6f, 4, true), glass(1, 1.5f, 0.2f));
    m.area_lamp({-0.5f, 0, 3.2f}, {0, 0, 0}, 2, 2, 5);
    m.perspective({0, -3, 2.5f}, {0, 0, 0.3f}, 0.3f);
    const CausticCase c = caustic_case("rough glass", m);
    expect_thresholds(c, IntegratorKind::hybrid, {0.1f, 0.3f});
}

/// The metal's highlight of a point of light (D1 by connection) and the caustic that it throws on the floor.
CausticCase point_over_metal() {
    SceneMaker m;
    m.add(floor_quad(0, 8), diffuse(0.6f));
    m.add(quad({0, 1, 0.75f}, {3, 0, 0}, {0, 0, 1.5f}), glossy(0.9f, 0.15f));
    m.point_lamp({0, -0.5f, 1}, 60, 0);
    m.perspective({0, -2, 2.2f}, {0, 0.5f, 0.25f}, 0.35f);
    CausticCase c = caustic_case("point lamp over metal", m);
    c.rough = true;
    return c;
}

TEST(Threshold, PointLampOverMetal) {
    // 0.15 is the metal's own roughness: "at or under".
    expect_thresholds(point_over_metal(), IntegratorKind::hybrid, {0.15f, 0.3f});
    // Below it the metal is class D: the caustic comes by connections from camera paths, which are noisy.
    CausticCase connected = point_over_metal();
    connected.photon_samples = connected.path_samples;
    expect_thresholds(connected, IntegratorKind::hybrid, {0.1f});
    // Photons on something so shiny are found too rarely to tell.
    expect_thresholds(point_over_metal(), IntegratorKind::photon_mapping, {0.3f});
}

TEST(Threshold, AtTheRoughnessItselfIsSpecular) {
    CausticCase c = point_over_metal();
    const auto lit = [&c](float threshold) {
        scene::SceneDesc scene = with_photons(c, IntegratorKind::hybrid);
        scene.settings.caustic_roughness = threshold;
        return mean_of(*render_frame(scene), "C1");
    };
    EXPECT_GT(lit(0.15f), 0);
    EXPECT_EQ(lit(0.1499f), 0);
}

TEST(Threshold, HighlightsStay) {
    // While every vertex before is S, lamps are connected to rough S lobes: otherwise a point has no highlight.
    CausticCase c = point_over_metal();
    c.scene.settings.max_bounces = 0;
    scene::SceneDesc scene = with_photons(c, IntegratorKind::hybrid);
    scene.settings.caustic_roughness = 0.3f;
    const Pictures judge = pictures(path_traced(c), 1000), tested = pictures(scene, 2000);
    const double highlight = moments_of(tested, [](const auto& m) { return m[1].whole; }).mean;
    // Path tracing has the highlight and the floor's direct light in D2, all at the first vertex.
    const double direct = moments_of(judge, [](const auto& m) { return m[2].whole; }).mean;
    const double floor = moments_of(tested, [](const auto& m) { return m[2].whole; }).mean;
    EXPECT_GT(highlight, 0.02 * direct);
    EXPECT_NEAR((highlight + floor) / direct, 1, 0.02);
}

TEST(Threshold, APointIsTheLimitOfASmallSphere) {
    CausticCase c = point_over_metal();
    c.scene.settings.caustic_roughness = 0.3f;
    CausticCase sphere_lamp = c;
    sphere_lamp.scene.lights[0].radius = 0.01f;
    const Pictures judge = pictures(path_traced(sphere_lamp), 3000);
    const Pictures tested = photon_pictures(c, with_photons(c, IntegratorKind::hybrid), 2000);
    const Agreement a = compare_pass(judge, tested, 0, c.bound, c.block_bound);
    EXPECT_TRUE(a.agree) << a.report;
}

}  // namespace
}  // namespace cardioid::test
