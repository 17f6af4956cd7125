// SPDX-License-Identifier: GPL-3.0-or-later
// The buffers of the five classes: their sum is the picture, each holds its own paths, and the threshold between S and D does
// not change the picture.
#include "analytic/replicates.h"
#include "analytic/scenes.h"

#include <algorithm>

namespace cardioid::test {
namespace {

const char* const k_classes[] = {"D1", "D2", "D3", "C1", "C2"};

void expect_exact_sum(const film::Frame& f) {
    const auto& combined = f.find("Combined")->data;
    for (std::size_t i = 0; i < combined.size() / 4; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            float sum = 0;
            for (const char* name : k_classes) sum += f.find(name)->data[3 * i + k];
            ASSERT_EQ(sum, combined[4 * i + k]);
        }
    }
}

TEST(Classes, TheBuffersSumToThePicture) {
    for (const float threshold : {0.0f, 0.35f}) {  // with photons: PT's threshold is always 0
        SceneMaker m = busy_scene();
        m.scene.settings.integrator = scene::IntegratorKind::hybrid;
        m.scene.settings.caustic_roughness = threshold;
        const auto f = render_frame(m.scene);
        expect_exact_sum(*f);
        for (const char* name : k_classes) EXPECT_GT(mean_of(*f, name), 1e-4) << name;
    }
}

/// Only the named classes have light.
void expect_only(const scene::SceneDesc& scene, std::initializer_list<const char*> lit) {
    const auto f = render_frame(scene);
    expect_exact_sum(*f);
    for (const char* name : k_classes) {
        const bool expected =
            std::find_if(lit.begin(), lit.end(), [&](const char* l) { return std::string(l) == name; }) != lit.end();
        EXPECT_EQ(mean_of(*f, name) > 0, expected) << name;
    }
}

TEST(Classes, EachSceneLightsItsOwnClass) {
    SceneMaker emitter;
    emitter.add(floor_quad(0, 10), emission(1));
    emitter.probe({0, -1, 1}, {0, 0, 0});
    expect_only(emitter.scene, {"D1"});

    SceneMaker mirror;
    mirror.add(floor_quad(0, 10), glossy(1, 0));
    mirror.area_lamp({0, 2, 2}, {0, 0, 0}, 1, 1, 3);
    mirror.probe({0, -2, 2}, {0, 0, 0});
    expect_only(mirror.scene, {"D1"});

    SceneMaker direct;
    direct.add(floor_quad(0, 10), diffuse(0.5f));
    direct.area_lamp({0, 2, 2}, {0, 0, 0}, 1, 1, 3);
    direct.probe({0, -2, 2}, {0, 0, 0});
    expect_only(direct.scene, {"D2"});
    // The same floor in a mirror is D2 still.
    direct.add(quad({0, 4, 0}, {4, 0, 0}, {0, 0, 4}), glossy(1, 0));
    direct.probe({0, 1, 1}, {0, 4, 0.2f});
    direct.scene.lights.clear();
    direct.point_lamp({0, 3, 2}, 50, 0);
    expect_only(direct.scene, {"D2"});

    SceneMaker behind_glass;
    behind_glass.add(floor_quad(0, 100), diffuse(0.5f));
    behind_glass.add(floor_quad(0.5f, 100), glass(1, 1.5f));
    behind_glass.sun({0, 0, 1}, 3, 0.8f);
    behind_glass.probe({0, -0.4f, 0.3f}, {0, 0, 0});
    behind_glass.scene.settings.samples = 256;
    behind_glass.scene.settings.max_diffuse_bounces = 1;
    expect_only(behind_glass.scene, {"C1"});

    // A delta lamp over the glass lights a ceiling, whose light comes down through the glass.
    SceneMaker indirect;
    indirect.add(floor_quad(0, 100), diffuse(0.5f));
    indirect.add(floor_quad(0.5f, 100), glass(1, 1.5f));
    indirect.add(floor_quad(2, -100), diffuse(0.8f));
    indirect.point_lamp({0, 0, 1}, 50, 0);
    indirect.probe({0, -0.4f, 0.3f}, {0, 0, 0});
    indirect.scene.settings.max_diffuse_bounces = 1;
    expect_only(indirect.scene, {"C2"});
}

/// Welch's test of the two scenes' means, and their closeness.
void expect_same(const scene::SceneDesc& a, const scene::SceneDesc& b, double bound) {
    const statistics::Moments ma = replicate(a, "Combined", 16), mb = replicate(b, "Combined", 16);
    const statistics::TResult t = statistics::welch_test(ma, mb);
    EXPECT_FALSE(t.rejected(k_level)) << ma.mean << " against " << mb.mean;
    EXPECT_TRUE(t.equivalent(bound * ma.mean, 0.02)) << ma.mean << " against " << mb.mean << " ± " << t.error;
}

TEST(Classes, TheThresholdDoesNotChangeHighlights) {
    // A small lamp in rough metal: D1 by light sampling and by hits, on either side of the threshold.
    SceneMaker m;
    m.add(floor_quad(0, 10), glossy(0.8f, 0.3f));
    m.area_lamp({0, 2, 2}, {0, 0, 0}, 1, 1, 3);
    m.probe({0, -2, 2}, {0, 0, 0}, 2);
    SceneMaker specular = m;
    specular.scene.settings.integrator = scene::IntegratorKind::hybrid;
    specular.scene.settings.caustic_roughness = 0.4f;
    specular.scene.settings.photons =
        500;  // where the number is open, photons are given up here, and the threshold with them
    expect_same(m.scene, specular.scene, 0.02);
    const auto f = render_frame(specular.scene);
    EXPECT_EQ(mean_of(*f, "D2"), 0);
    EXPECT_GT(mean_of(*f, "D1"), 0);
    EXPECT_EQ(mean_of(*render_frame(m.scene), "D1"), 0);
}

TEST(Classes, TheThresholdDoesNotChangeCaustics) {
    SceneMaker m;
    m.add(floor_quad(0, 10), diffuse(0.7f));
    m.add(quad({0, 1, 1}, {6, 0, 0}, {0, 0, 2}), glossy(0.9f, 0.35f));
    m.area_lamp({0, -1.5f, 2.5f}, {0, 0.5f, 0.5f}, 2, 2, 3);
    m.probe({0, -2, 1}, {0, 0.3f, 0}, 1);
    SceneMaker specular = m;
    specular.scene.settings.integrator = scene::IntegratorKind::hybrid;
    specular.scene.settings.caustic_roughness = 0.4f;
    expect_same(m.scene, specular.scene, 0.02);
}

TEST(Classes, TheThresholdDoesNotChangeMixedSurfaces) {
    SceneMaker m;
    m.add(floor_quad(0, 10), combined("ShaderNodeMixShader", diffuse(0.7f), glossy(0.9f, 0.3f), 0.4f));
    m.area_lamp({0, 2, 2}, {0, 0, 0}, 1, 1, 3);
    m.world(background(0.2f));
    m.probe({0, -2, 2}, {0, 0, 0}, 1);
    SceneMaker specular = m;
    specular.scene.settings.integrator = scene::IntegratorKind::hybrid;
    specular.scene.settings.caustic_roughness = 0.4f;
    expect_same(m.scene, specular.scene, 0.02);
}

}  // namespace
}  // namespace cardioid::test
