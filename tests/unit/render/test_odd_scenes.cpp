// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that lack something or are broken: never a crash, always a picture or a readable error.
#include "analytic/replicates.h"
#include "analytic/scenes.h"

#include <cmath>
#include <limits>

namespace cardioid::test {
namespace {

constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
constexpr float k_infinity = std::numeric_limits<float>::infinity();

/// Renders what validation leaves, warnings or not.
std::shared_ptr<const film::Frame> render_repaired(scene::SceneDesc scene) {
    const auto problems = scene::validate(scene);
    EXPECT_FALSE(scene::has_errors(problems)) << problems.front().message;
    render::Session session(std::make_shared<scene::SceneDesc>(std::move(scene)));
    session.start();
    EXPECT_TRUE(session.wait(60));
    EXPECT_EQ(session.progress().phase, render::Phase::done) << session.progress().message;
    EXPECT_NE(session.stats().find("\"non_finite_dropped\": 0"), std::string::npos);
    const auto frame = session.frame();
    for (const auto& pass : frame->passes) {
        for (const float v : pass.data) EXPECT_TRUE(std::isfinite(v)) << pass.name;
    }
    return frame;
}

SceneMaker lit_floor() {
    SceneMaker m;
    m.add(floor_quad(0, 100), diffuse(0.5f));
    m.point_lamp({0, 0, 2}, 100, 0.1f);
    m.probe({0, -1, 1}, {0, 0, 0});
    return m;
}

TEST(OddScenes, WithoutCamera) {
    SceneMaker m = lit_floor();
    m.scene.camera.reset();
    const auto problems = scene::validate(m.scene);
    ASSERT_TRUE(scene::has_errors(problems));
    EXPECT_NE(scene::messages(problems)[0].find("camera"), std::string::npos);
}

TEST(OddScenes, WithoutLight) {
    SceneMaker m = lit_floor();
    m.scene.lights.clear();
    EXPECT_EQ(mean_of(*render_repaired(m.scene)), 0);
}

TEST(OddScenes, WithoutMeshes) {
    SceneMaker m = lit_floor();
    m.scene.instances.clear();
    m.scene.meshes.clear();
    EXPECT_EQ(mean_of(*render_repaired(m.scene)), 0);
    m.world(background(0.25f));
    EXPECT_NEAR(mean_of(*render_repaired(m.scene)), 0.25, 1e-6);
}

TEST(OddScenes, WithoutMaterials) {
    SceneMaker m = lit_floor();
    m.scene.materials.clear();
    m.scene.instances[0].materials.clear();
    m.scene.lights.clear();
    m.world(background(1));
    m.scene.settings.samples = 512;
    EXPECT_NEAR(mean_of(*render_repaired(m.scene)), 0.8, 0.02) << "Blender's default grey";
}

TEST(OddScenes, NothingAtAll) {
    SceneMaker m;
    m.probe({0, -1, 1}, {0, 0, 0});
    EXPECT_EQ(mean_of(*render_repaired(m.scene)), 0);
}

TEST(OddScenes, FramesOfOddSizes) {
    for (const auto& [w, h] : {std::pair{1, 1}, {1, 37}, {37, 1}, {33, 17}}) {
        SceneMaker m = busy_scene();
        m.scene.settings.width = w;
        m.scene.settings.height = h;
        const auto f = render_repaired(m.scene);
        EXPECT_EQ(f->width, w);
        EXPECT_EQ(f->height, h);
        EXPECT_GT(mean_of(*f), 0);
    }
}

TEST(OddScenes, VerticesThatAreNotNumbers) {
    for (const float bad : {k_nan, k_infinity, -k_infinity, 1e38f, 1e20f}) {
        SceneMaker m = lit_floor();
        scene::MeshDesc ball = sphere({0, 0, 0.3f}, 0.2f, 2, true);
        for (std::size_t i = 0; i < ball.positions.size(); i += 7) ball.positions[i] = bad;
        for (std::size_t i = 0; i < ball.corner_normals.size(); i += 5) ball.corner_normals[i] = bad;
        m.add(ball, diffuse(0.5f));
        const auto f = render_repaired(m.scene);
        EXPECT_GE(mean_of(*f), 0) << bad;
    }
}

TEST(OddScenes, ValuesThatAreNotNumbers) {
    for (const float bad : {k_nan, k_infinity, -k_infinity, -5.0f, 1e30f}) {
        for (const char* type : {"ShaderNodeBsdfDiffuse", "ShaderNodeBsdfGlossy", "ShaderNodeBsdfGlass",
                                 "ShaderNodeBsdfPrincipled", "ShaderNodeEmission"}) {
            SceneMaker m = lit_floor();
            GraphMaker g;
            g.node(type);
            for (const char* input : {"Color", "Base Color"}) g.value(input, {bad, 0.5f, 0.2f, 1});
            for (const char* input : {"Roughness", "IOR", "Metallic", "Specular"}) g.value(input, {bad});
            m.scene.materials[0].graph = g.surface(std::string(type) == "ShaderNodeEmission" ? "Emission" : "BSDF");
            scene::SceneDesc scene = m.scene;
            EXPECT_FALSE(scene::has_errors(scene::validate(scene)));
            render::Session session(std::make_shared<scene::SceneDesc>(scene));
            session.start();
            EXPECT_TRUE(session.wait(60));
            // Held: a range over session.frame()->passes would outlive its frame.
            const auto frame = session.frame();
            for (const auto& pass : frame->passes) {
                for (const float v : pass.data) ASSERT_TRUE(std::isfinite(v)) << type << " " << bad << " " << pass.name;
            }
        }
    }
}

TEST(OddScenes, DegenerateTriangles) {
    SceneMaker m = lit_floor();
    scene::MeshDesc flat = floor_quad(0.1f, 1);
    flat.positions[3] = flat.positions[0], flat.positions[4] = flat.positions[1], flat.positions[5] = flat.positions[2];
    m.add(flat, emission(5));
    scene::MeshDesc needle = quad({0.3f, 0, 0.2f}, {1, 0, 0}, {1e-30f, 0, 0});
    m.add(needle, combined("ShaderNodeAddShader", glass(1, 1.5f), emission(5)));
    EXPECT_GT(mean_of(*render_repaired(m.scene)), 0);
}

TEST(OddScenes, FarFromTheOrigin) {
    // The same view a hundred kilometres away: coarse, but finite and lit.
    SceneMaker near_by = lit_floor(), far = lit_floor();
    const Float3 shift{1e5f, -1e5f, 0};
    far.scene.instances[0].transform = moved(shift);
    far.scene.lights[0].transform = moved(shift + Float3{0, 0, 2});
    far.probe(shift + Float3{0, -1, 1}, shift, 1);
    near_by.probe({0, -1, 1}, {0, 0, 0}, 1);
    EXPECT_NEAR(mean_of(*render_repaired(far.scene)) / mean_of(*render_repaired(near_by.scene)), 1, 0.02);
}

TEST(OddScenes, ScaleDoesNotMatter) {
    // No absolute epsilon anywhere: the same scene from 1e-4 to 1e4 times the size.
    double reference = 0;
    for (const float scale : {1.0f, 1e-4f, 1e4f}) {
        SceneMaker m;
        m.add(floor_quad(0, 6 * scale), diffuse(0.8f));
        m.add(sphere({0, 0, 0.5f * scale}, 0.5f * scale, 4, true), diffuse(0.6f));
        m.point_lamp({2 * scale, -2 * scale, 3 * scale}, 500 * scale * scale, 0.2f * scale);
        m.perspective({0, -4 * scale, 2 * scale}, {0, 0, 0.4f * scale}, 0.4f);
        m.scene.camera->clip_start = 1e-3f * scale;
        m.scene.settings.width = m.scene.settings.height = 24;
        const double mean = mean_of(*render_repaired(m.scene));
        if (reference == 0) reference = mean;
        EXPECT_NEAR(mean / reference, 1, 5e-3) << scale;
    }
}

TEST(OddScenes, MirroredAndFlattenedInstances) {
    SceneMaker m = lit_floor();
    scene::InstanceDesc& mirrored = m.add(sphere({0, 0, 0.3f}, 0.2f, 2, true), diffuse(0.5f));
    mirrored.transform.m[0] = -1;
    m.scene.instances.push_back(m.scene.instances.back());
    m.scene.instances.back().transform.m[10] = 0;  // flat: validation drops or repairs it
    m.scene.instances.push_back(m.scene.instances[1]);
    m.scene.instances.back().transform.m[10] = 1e-20f;
    EXPECT_GT(mean_of(*render_repaired(m.scene)), 0);
}

TEST(OddScenes, ManyTransparentLayersAndBounces) {
    SceneMaker m = lit_floor();
    for (int k = 0; k < 40; ++k)
        m.add(floor_quad(0.02f * static_cast<float>(k + 1), 10),
              combined("ShaderNodeMixShader", transparent(1), glass(1, 1.2f)));
    m.scene.settings.max_transparent_bounces = m.scene.settings.max_bounces =
        m.scene.settings.max_transmission_bounces = 1024;
    m.scene.settings.max_glossy_bounces = 1024;
    m.scene.settings.samples = 8;
    EXPECT_GT(mean_of(*render_repaired(m.scene)), 0);
}

}  // namespace
}  // namespace cardioid::test
