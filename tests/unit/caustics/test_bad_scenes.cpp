// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that lack something, or that are unkind to photons: no crash, nothing that is not finite, nothing dropped.
#include "caustics/photon_stats.h"

#include <limits>

namespace cardioid::test {
namespace {

using scene::IntegratorKind;

/// In both modes with photons; the mean of each picture, hybrid first.
std::array<double, 2> means_of_modes(SceneMaker m) {
    std::array<double, 2> means{};
    for (const IntegratorKind kind : {IntegratorKind::hybrid, IntegratorKind::photon_mapping}) {
        m.scene.settings.integrator = kind;
        means[kind == IntegratorKind::photon_mapping] = mean_of(*render_counted(m.scene).frame);
    }
    return means;
}

void expect_light(const SceneMaker& m) {
    for (const double mean : means_of_modes(m)) EXPECT_GT(mean, 0);
}

TEST(BadScenes, NoLampsOrObjects) {
    SceneMaker m = small_caustic();
    m.scene.lights.clear();
    for (const double mean : means_of_modes(m)) EXPECT_EQ(mean, 0);
    SceneMaker empty = small_caustic();
    empty.scene.instances.clear();
    for (const double mean : means_of_modes(empty)) EXPECT_EQ(mean, 0);
}

TEST(BadScenes, LampInAnOpaqueObject) {
    SceneMaker m = small_caustic();
    for (const double open : means_of_modes(m)) EXPECT_GT(open, 0);
    m.add(sphere({0, 0, 3}, 1.2f, 2, true), diffuse(0.5f));
    const auto closed = means_of_modes(m);
    EXPECT_EQ(closed[0], 0);
    EXPECT_EQ(closed[1], 0);
}

TEST(BadScenes, TenThousandLamps) {
    SceneMaker m = small_caustic();
    m.scene.lights.clear();
    for (int k = 0; k < 10000; ++k) {
        const float x = static_cast<float>(k % 100) / 50 - 1, y = static_cast<float>(k / 100) / 50 - 1;
        m.point_lamp({x, y, 3}, 0.02f, k % 3 == 0 ? 0.0f : 0.01f);
    }
    expect_light(m);
}

TEST(BadScenes, BlackLamps) {
    SceneMaker m = small_caustic();
    const auto lit = means_of_modes(m);
    m.point_lamp({0.5f, 0, 2}, 0, 0.1f);
    m.point_lamp({-0.5f, 0, 2}, 100, 0.1f).color = {0, 0, 0};
    m.sun({0, 0, 1}, 0, 0.1f);
    m.area_lamp({0, 1, 2}, {0, 0, 0}, 1, 1, 0);
    const auto with_black = means_of_modes(m);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(with_black[k] / lit[k], 1, 0.1);
}

TEST(BadScenes, NegativeLampsTakeLightAway) {
    SceneMaker m = small_caustic();
    m.scene.settings.samples = 64;
    m.scene.lights[0].energy *= 0.6f;
    const auto expected = means_of_modes(m);
    m.scene.lights[0].energy /= 0.6f;
    m.scene.lights.push_back(m.scene.lights[0]);
    m.scene.lights[1].energy *= -0.4f;
    const auto means = means_of_modes(m);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(means[k] / expected[k], 1, 0.05);
    m.scene.lights.erase(m.scene.lights.begin());
    for (const double mean : means_of_modes(m)) EXPECT_LT(mean, 0);
}

TEST(BadScenes, IndicesOfRefraction) {
    for (const float ior : {1.0f, 0.7f, 1.0f + 1e-6f, 0.0f, 1e-3f, 100.0f}) {
        SCOPED_TRACE(ior);
        SceneMaker m = small_caustic();
        m.scene.materials[1].graph = glass(1, ior);
        expect_light(m);
        m.scene.settings.physical_refraction = true;
        expect_light(m);
    }
}

TEST(BadScenes, GlassOfIndexOneIsNotThere) {
    SceneMaker clear = small_caustic();
    clear.scene.instances.pop_back();
    clear.scene.materials[1].graph = glass(1, 1);
    clear.scene.settings.samples = 256;
    clear.scene.settings.photon_radius = 0.5f;
    SceneMaker bare = clear;
    bare.scene.instances.pop_back();
    const auto expected = means_of_modes(bare), means = means_of_modes(clear);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(means[k] / expected[k], 1, 0.02) << k;
}

TEST(BadScenes, GlassWithoutThickness) {
    SceneMaker m = small_caustic();
    m.add(floor_quad(2, 6), glass(1, 1.5f));
    expect_light(m);
    m.add(floor_quad(2, 6), glass(1, 1.5f));  // twice at the same place
    expect_light(m);
}

TEST(BadScenes, OverlappingAndNestedGlass) {
    SceneMaker m = small_caustic();
    m.add(sphere({-0.2f, 0, 0.7f}, 0.5f, 3, true), glass(1, 1.33f));
    m.add(sphere({-0.5f, 0, 0.7f}, 0.3f, 3, true), glass(1, 2.4f));
    m.add(sphere({-0.5f, 0, 0.7f}, 0.3f, 3, true), glass(0.5f, 1.2f));  // the same surface again
    expect_light(m);
}

TEST(BadScenes, RoughnessAtTheEnds) {
    for (const float roughness : {0.0f, 1e-8f, 1e-4f, 0.1f, 0.10000001f, 1.0f}) {
        SCOPED_TRACE(roughness);
        SceneMaker m = small_caustic();
        m.scene.materials[1].graph = glass(1, 1.5f, roughness);
        m.scene.materials[2].graph = glossy(0.9f, roughness);
        m.scene.settings.caustic_roughness = 0.1f;
        expect_light(m);
    }
}

TEST(BadScenes, CameraInGlass) {
    SceneMaker m = small_caustic();
    m.perspective({-0.5f, -0.1f, 0.7f}, {0.2f, 0.3f, 0}, 0.8f);
    expect_light(m);
    m.scene.settings.physical_refraction = true;
    expect_light(m);
}

TEST(BadScenes, FromAMillimetreToTenKilometres) {
    SceneMaker m;
    m.add(floor_quad(0, 1e4f), diffuse(0.6f));
    m.add(sphere({0, 0, 0.002f}, 0.001f, 3, true), glass(1, 1.5f));
    m.add(sphere({2000, 3000, 500}, 400, 3, true), glossy(0.9f, 0));
    m.sun({0.3f, 0, 1}, 3, 0.01f);
    m.area_lamp({0, 0, 0.02f}, {0, 0, 0}, 0.01f, 0.01f, 5);
    m.perspective({0, -0.01f, 0.01f}, {0, 0, 0.001f}, 0.3f);
    m.scene.camera->clip_start = 1e-5f;
    m.scene.settings.width = m.scene.settings.height = 24;
    m.scene.settings.samples = 16;
    m.scene.settings.photons = 5000;
    // A few photons on a hundred square kilometres: photon mapping alone finds none near the small ball.
    EXPECT_GT(means_of_modes(m)[0], 0);
    m.perspective({0, -9000, 3000}, {0, 0, 0}, 0.5f);
    expect_light(m);
}

TEST(BadScenes, PhotonCounts) {
    SceneMaker m = small_caustic();
    m.scene.settings.photons = 0;
    expect_light(m);
    m.scene.settings.photons = 1;
    means_of_modes(m);
    for (const std::int64_t many : {std::int64_t{1000000000}, std::numeric_limits<std::int64_t>::max()}) {
        SceneMaker refused = small_caustic();
        refused.scene.settings.photons = many;
        refused.scene.settings.memory_limit = std::int64_t{16} << 30;
        const auto problems = scene::validate(refused.scene);
        ASSERT_TRUE(scene::has_errors(problems)) << many;
        const std::string message = scene::messages(problems)[0];
        EXPECT_NE(message.find("hoton"), std::string::npos) << message;
        EXPECT_TRUE(message.find("GB") != std::string::npos || message.find("GiB") != std::string::npos) << message;
    }
    SceneMaker negative = small_caustic();
    negative.scene.settings.photons = -5;
    EXPECT_FALSE(scene::validate(negative.scene).empty());
}

TEST(BadScenes, SettingsAtTheEnds) {
    for (const float radius : {1e-3f, 100.0f}) {
        SceneMaker m = small_caustic();
        m.scene.settings.photon_radius = radius;
        means_of_modes(m);
    }
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), -1.0f, 0.0f, 1e30f}) {
        SceneMaker m = small_caustic();
        m.scene.settings.photon_radius = bad;
        m.scene.settings.radius_shrink = bad;
        m.scene.settings.caustic_roughness = bad;
        scene::SceneDesc checked = m.scene;
        if (scene::has_errors(scene::validate(checked))) continue;
        means_of_modes(m);
    }
}

TEST(BadScenes, FewBounces) {
    for (const int limit : {0, 1, 2}) {
        SceneMaker m = small_caustic();
        m.scene.settings.max_bounces = limit;
        means_of_modes(m);
    }
}

TEST(BadScenes, OnePixel) {
    for (const auto& [w, h] : {std::pair{1, 1}, {1, 37}, {37, 1}}) {
        SceneMaker m = small_caustic();
        m.scene.settings.width = w;
        m.scene.settings.height = h;
        expect_light(m);
    }
}

}  // namespace
}  // namespace cardioid::test
