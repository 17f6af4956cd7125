// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/validate.h"

#include "scene/json.h"
#include "scene/sample_scene.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

namespace cardioid::scene {
namespace {

constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
constexpr float k_inf = std::numeric_limits<float>::infinity();

SceneDesc good_scene() {
    SceneDesc scene = test::sample_scene();
    scene.settings.ocio_config.clear();
    return scene;
}

std::string all(const std::vector<Problem>& problems) {
    std::string text;
    for (const std::string& message : messages(problems)) text += message + '\n';
    return text;
}

/// Validates, and expects one message that contains every given text and whose severity is as given.
void expect_problem(SceneDesc& scene, Severity severity, std::vector<std::string> texts) {
    const std::vector<Problem> problems = validate(scene);
    const bool found = std::any_of(problems.begin(), problems.end(), [&](const Problem& p) {
        return p.severity == severity && std::all_of(texts.begin(), texts.end(), [&](const std::string& text) {
                   return p.message.find(text) != std::string::npos;
               });
    });
    EXPECT_TRUE(found) << "wanted: " << texts.front() << ", got:\n" << all(problems);
    EXPECT_EQ(has_errors(problems), severity == Severity::error) << all(problems);
}

void expect_warning(SceneDesc& scene, std::vector<std::string> texts) {
    expect_problem(scene, Severity::warning, std::move(texts));
    EXPECT_EQ(all(validate(scene)), "") << "what was repaired is not reported again";
}

void expect_error(SceneDesc& scene, std::vector<std::string> texts) {
    expect_problem(scene, Severity::error, std::move(texts));
}

TEST(Validate, AGoodSceneIsLeftAlone) {
    SceneDesc scene = good_scene();
    const Json before = write_json(scene);
    EXPECT_EQ(all(validate(scene)), "");
    EXPECT_EQ(write_json(scene), before);
}

TEST(Validate, ValuesByNameAreNamedAndFinite) {
    SceneDesc scene = good_scene();
    scene.instances[0].values = {{"object:a", {1, k_nan, 3, 1}}, {"", {1, 1, 1, 1}}, {"object:b", {4, 5, 6, 1}}};
    expect_warning(scene, {"value \"object:a\"", "not finite"});
    ASSERT_EQ(scene.instances[0].values.size(), 2u);
    EXPECT_EQ(scene.instances[0].values[0].value, (std::array<float, 4>{1, 0, 3, 1}));
}

TEST(Validate, EdgesBeyondTheVerticesAreIgnored) {
    for (const std::vector<std::uint32_t>& edges : {std::vector<std::uint32_t>{0, 1, 2}, {0, 99}}) {
        SceneDesc scene = good_scene();
        scene.meshes[0].edges = edges;
        expect_warning(scene, {"mesh \"Plane\"", "edges"});
        EXPECT_TRUE(scene.meshes[0].edges.empty());
    }
}

TEST(Validate, NanPositionsDropTheirTriangles) {
    SceneDesc scene = good_scene();
    scene.meshes[0].positions[9] = k_nan;
    expect_warning(scene, {"mesh \"Plane\"", "not finite", "1 triangle "});
    const MeshDesc& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.triangles, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(mesh.slots, (std::vector<std::int32_t>{0}));
    EXPECT_EQ(mesh.corner_normals.size(), 9u);
    EXPECT_EQ(mesh.attributes[0].data, (std::vector<float>{0, 0, 1, 0, 1, 1}));
    EXPECT_EQ(mesh.attributes[1].data.size(), 16u);
    EXPECT_EQ(mesh.attributes[2].data, (std::vector<float>{1}));
    EXPECT_EQ(mesh.positions[9], 0.0f);
}

TEST(Validate, TheFirstTriangleCanBeTheBadOne) {
    SceneDesc scene = good_scene();
    scene.meshes[0].positions[3] = k_inf;
    expect_warning(scene, {"1 triangle "});
    EXPECT_EQ(scene.meshes[0].triangles, (std::vector<std::uint32_t>{0, 2, 3}));
    EXPECT_EQ(scene.meshes[0].slots, (std::vector<std::int32_t>{1}));
    EXPECT_EQ(scene.meshes[0].attributes[0].data, (std::vector<float>{0, 0, 1, 1, 0, 1}));
}

TEST(Validate, AMeshWithNothingLeftTakesItsInstancesAlong) {
    SceneDesc scene = good_scene();
    scene.meshes[0].positions[0] = -k_inf;
    validate(scene);
    EXPECT_TRUE(scene.meshes[0].triangles.empty());
    EXPECT_TRUE(scene.groups[0].instances.empty());
    ASSERT_EQ(scene.instances.size(), 1u) << "the placed group stays";
    EXPECT_EQ(scene.instances[0].group, 0);
}

TEST(Validate, IndicesOutOfRange) {
    SceneDesc scene = good_scene();
    scene.meshes[0].triangles[5] = 4;
    expect_warning(scene, {"mesh \"Plane\"", "1 triangle ", "out of range"});
    EXPECT_EQ(scene.meshes[0].triangles.size(), 3u);
}

TEST(Validate, EmptyMeshes) {
    SceneDesc scene = good_scene();
    scene.meshes[0].triangles.clear();
    expect_problem(scene, Severity::warning, {"mesh \"Plane\"", "no faces"});
    EXPECT_EQ(scene.instances.size(), 1u);
}

TEST(Validate, WrongArraySizes) {
    SceneDesc scene = good_scene();
    scene.meshes[0].slots.push_back(0);
    scene.meshes[0].corner_normals.pop_back();
    scene.meshes[0].attributes[1].data.pop_back();
    scene.meshes[0].attributes[2].channels = 5;
    const std::string text = all(validate(scene));
    EXPECT_NE(text.find("3 material slots where 2"), std::string::npos) << text;
    EXPECT_NE(text.find("17 values of normals where 18"), std::string::npos) << text;
    EXPECT_NE(text.find("\"Col\" of 15 values"), std::string::npos) << text;
    EXPECT_NE(text.find("\"id\""), std::string::npos) << text;
    EXPECT_NE(text.find("no colour attribute \"Col\""), std::string::npos) << text;
    EXPECT_EQ(scene.meshes[0].attributes.size(), 1u);
    EXPECT_TRUE(scene.meshes[0].slots.empty());
    scene.meshes[0].positions.pop_back();
    EXPECT_NE(all(validate(scene)).find("three numbers a vertex"), std::string::npos);
    EXPECT_TRUE(scene.meshes[0].triangles.empty());
}

TEST(Validate, NonFiniteMeshData) {
    SceneDesc scene = good_scene();
    scene.meshes[0].corner_normals[4] = k_nan;
    scene.meshes[0].attributes[0].data[3] = k_inf;
    scene.meshes[0].generated_size.y = k_nan;
    const std::string text = all(validate(scene));
    EXPECT_NE(text.find("1 normal that is not finite"), std::string::npos) << text;
    EXPECT_NE(text.find("1 value in attribute \"UVMap\""), std::string::npos) << text;
    EXPECT_NE(text.find("texture space"), std::string::npos) << text;
    EXPECT_EQ(scene.meshes[0].corner_normals[5], 1.0f);
    EXPECT_EQ(scene.meshes[0].corner_normals[4], 0.0f);
    EXPECT_EQ(scene.meshes[0].attributes[0].data[3], 0.0f);
    EXPECT_EQ(all(validate(scene)), "");
}

TEST(Validate, InstancesThatCannotBePlaced) {
    SceneDesc scene = good_scene();
    scene.instances.resize(1);
    InstanceDesc bad = scene.instances[0];
    bad.name = "nan", bad.transform.m[3] = k_nan;
    scene.instances.push_back(bad);
    bad = scene.instances[0];
    bad.name = "zero", bad.transform.m.fill(0);
    scene.instances.push_back(bad);
    bad = scene.instances[0];
    bad.name = "nothing", bad.mesh = -1;
    scene.instances.push_back(bad);
    bad.name = "unknown mesh", bad.mesh = 1;
    scene.instances.push_back(bad);
    bad.name = "unknown group", bad.mesh = -1, bad.group = 1;
    scene.instances.push_back(bad);
    bad = scene.instances[0];
    bad.name = "parallel axes", bad.transform.m = {1, 2, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0};
    scene.instances.push_back(bad);
    const std::string text = all(validate(scene));
    for (const char* name : {"nan", "zero", "nothing", "unknown mesh", "unknown group", "parallel axes"})
        EXPECT_NE(text.find("object \"" + std::string(name) + '"'), std::string::npos) << name << '\n' << text;
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].name, "Object");
    EXPECT_EQ(all(validate(scene)), "");
}

TEST(Validate, FlatObjectsStayVisible) {
    SceneDesc scene = good_scene();
    scene.instances[0].transform.m = {2, 0, 0, 1, 0, 2, 0, 2, 0, 0, 0, 3};
    expect_warning(scene, {"object \"Object\"", "thin sheet"});
    const Affine& t = scene.instances[0].transform;
    EXPECT_GT(std::abs(t.determinant()), 0.0f);
    EXPECT_EQ(t.translation(), (Float3{1, 2, 3}));
    EXPECT_EQ(t.column(0), (Float3{2, 0, 0}));
}

TEST(Validate, TinyObjectsAreNotSingular) {
    SceneDesc scene = good_scene();
    scene.instances[0].transform.m = {1e-6f, 0, 0, 0, 0, 1e-6f, 0, 0, 0, 0, 1e-6f, 0};
    EXPECT_EQ(all(validate(scene)), "");
    EXPECT_EQ(scene.instances.size(), 2u);
}

TEST(Validate, ManyBadInstancesStayReadable) {
    SceneDesc scene = good_scene();
    InstanceDesc bad = scene.instances[0];
    bad.transform.m.fill(0);
    scene.instances.assign(1000, bad);
    const std::vector<Problem> problems = validate(scene);
    EXPECT_EQ(problems.size(), 6u);
    EXPECT_NE(all(problems).find("and 995 more"), std::string::npos) << all(problems);
}

TEST(Validate, UnknownMaterialsAndImages) {
    SceneDesc scene = good_scene();
    scene.instances[0].materials = {0, 1};
    expect_warning(scene, {"object \"Object\"", "material that does not exist"});
    EXPECT_EQ(scene.instances[0].materials, (std::vector<int>{0, -1}));
    for (const ParamValue& bad : {ParamValue(2.0), ParamValue(0.5), ParamValue(-2.0), ParamValue(std::string("x"))}) {
        scene = good_scene();
        scene.materials[0].graph.nodes[0].params["image"] = bad;
        expect_warning(scene, {"material \"Wood\", node \"Principled BSDF\"", "image"});
        EXPECT_EQ(std::get<double>(scene.materials[0].graph.nodes[0].params["image"]), -1.0);
    }
    scene.materials[0].graph.nodes[0].params["image"] = 1.0;
    EXPECT_EQ(all(validate(scene)), "");
}

TEST(Validate, GraphLinks) {
    SceneDesc scene = good_scene();
    scene.materials[0].graph.nodes[0].inputs["Normal"].node = 2;
    expect_warning(scene, {"material \"Wood\", node \"Principled BSDF\"", "\"Normal\"", "does not exist"});
    scene = good_scene();
    scene.lights[0].graph.surface.node = 5;
    expect_warning(scene, {"light \"Lamp\"", "surface output"});
    scene = good_scene();
    scene.world->graph.nodes[1].inputs["Back"] = {0, "BSDF", "SHADER", {}};
    expect_warning(scene, {"world \"World\"", "1 link", "loop"});
    scene = good_scene();
    scene.materials[0].graph.nodes[0].inputs["Roughness"].value[0] = k_nan;
    expect_warning(scene, {"\"Roughness\"", "not finite"});
}

TEST(Validate, LongChainsOfNodes) {
    SceneDesc scene = good_scene();
    GraphDesc& graph = scene.materials[0].graph;
    graph.nodes.assign(200000, {"Math", "ShaderNodeMath", {}, {}});
    for (int i = 0; i + 1 < 200000; ++i)
        graph.nodes[static_cast<std::size_t>(i)].inputs["Value"] = {i + 1, "Value", "VALUE", {}};
    EXPECT_EQ(all(validate(scene)), "");
}

TEST(Validate, GroupLoopsAreErrors) {
    SceneDesc scene = good_scene();
    InstanceDesc inner = scene.instances[1];
    inner.name = "itself";
    scene.groups[0].instances.push_back(inner);
    expect_error(scene, {"group \"Collection\"", "itself"});
    scene = good_scene();
    scene.groups.resize(3);
    for (int i = 0; i < 3; ++i) {
        inner.group = (i + 1) % 3;
        scene.groups[static_cast<std::size_t>(i)].instances = {inner};
    }
    expect_error(scene, {"contains itself"});
    scene.groups[2].instances.clear();
    EXPECT_EQ(all(validate(scene)), "");
}

TEST(Validate, Lamps) {
    SceneDesc scene = good_scene();
    scene.lights[0].energy = k_nan;
    expect_warning(scene, {"light \"Lamp\"", "energy"});
    EXPECT_TRUE(scene.lights.empty());
    scene = good_scene();
    scene.lights[0].size_x = scene.lights[0].size_y = scene.lights[0].radius = 0;
    EXPECT_EQ(all(validate(scene)), "") << "a lamp of size zero is fine";
    EXPECT_EQ(scene.lights.size(), 1u);
    scene.lights[0].radius = -1;
    expect_warning(scene, {"light \"Lamp\"", "radius -1"});
    scene.lights[0].transform.m[3] = k_nan;
    expect_warning(scene, {"light \"Lamp\"", "transform"});
}

TEST(Validate, FlatLampTransforms) {
    SceneDesc scene = good_scene();
    scene.lights[0].transform.m = {0, 0, 0, 1, 0, 0, 3, 2, 0, 0, 0, 3};
    EXPECT_EQ(all(validate(scene)), "");
    const LightDesc& light = scene.lights.at(0);
    EXPECT_NEAR(light.transform.determinant(), 1, 1e-5);
    EXPECT_EQ(light.transform.column(2), (Float3{0, 1, 0}));
    EXPECT_EQ(light.transform.translation(), (Float3{1, 2, 3}));
    EXPECT_EQ(light.size_x, 0.0f);
    scene.lights[0].transform.m = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0};
    expect_warning(scene, {"light \"Lamp\"", "no direction"});
    EXPECT_TRUE(scene.lights.empty());
}

TEST(Validate, CameraErrors) {
    SceneDesc scene = good_scene();
    scene.camera.reset();
    expect_error(scene, {"no camera"});
    scene = good_scene();
    scene.camera->transform.m.fill(0);
    expect_error(scene, {"camera \"Camera\"", "transform"});
    scene = good_scene();
    scene.camera->view_plane = {1, 1, 0, 1};
    expect_error(scene, {"camera \"Camera\"", "empty view"});
    scene = good_scene();
    scene.camera->aperture_radius = k_nan;
    expect_warning(scene, {"camera \"Camera\"", "aperture_radius"});
    scene.camera->clip_end = 0.05f;
    expect_problem(scene, Severity::warning, {"clips everything"});
}

TEST(Validate, SettingsErrors) {
    SceneDesc scene = good_scene();
    scene.settings.samples = 0;
    expect_error(scene, {"0 samples"});
    scene = good_scene();
    scene.settings.width = 0;
    expect_error(scene, {"0 × 32"});
    for (const std::array<int, 4> crop :
         {std::array{0, 0, 65, 1}, {60, 0, 5, 5}, {-1, 0, 5, 5}, {0, 0, 5, 0}, {2147483647, 0, 5, 5}}) {
        scene = good_scene();
        scene.settings.crop = crop;
        expect_error(scene, {"render border"});
    }
    scene = good_scene();
    scene.settings.first_sample = 2147483647;
    expect_error(scene, {"first_sample"});
    scene = good_scene();
    scene.settings.width = scene.settings.height = 16000;
    scene.settings.crop = {};
    scene.settings.memory_limit = 4ll << 30;
    expect_error(scene, {"16000 × 16000", "4.0 GB"});
    scene = good_scene();
    scene.settings.clamp_direct = k_nan;
    expect_warning(scene, {"clamp_direct"});
}

TEST(Validate, FilterSettingsAtTheirLimits) {
    FilterSettings s;
    s.firefly_density = 0, s.luminance_sensitivity = 0, s.filter_size = 1, s.texture_width = 1e-4f;
    EXPECT_EQ(all(validate(s)), "");
    EXPECT_EQ(s.filter_size, 1);
    s.filter_size = k_largest_filter;
    EXPECT_EQ(all(validate(s)), "");
    // A kernel has a middle.
    s.filter_size = 10;
    EXPECT_EQ(all(validate(s)), "");
    EXPECT_EQ(s.filter_size, 11);
    for (const int size : {0, -5, 64, 2147483647}) {
        s.filter_size = size;
        EXPECT_NE(all(validate(s)).find("filter_size"), std::string::npos) << size;
        EXPECT_EQ(s.filter_size, size < 1 ? 1 : 63);
    }
}

TEST(Validate, FilterSettingsOverTheirLimits) {
    for (const float bad : {k_nan, -1.0f, std::numeric_limits<float>::infinity()}) {
        FilterSettings s;
        s.firefly_density = s.luminance_sensitivity = s.texture_width = bad;
        const std::string messages = all(validate(s));
        for (const char* key : {"firefly_density", "luminance_sensitivity", "texture_width"})
            EXPECT_NE(messages.find(key), std::string::npos) << messages;
        EXPECT_TRUE(s.firefly_density >= 0 && std::isfinite(s.firefly_density));
        EXPECT_TRUE(s.luminance_sensitivity >= 0 && s.luminance_sensitivity < 1);
        EXPECT_TRUE(s.texture_width > 0 && std::isfinite(s.texture_width));
    }
    SceneDesc scene = good_scene();
    scene.settings.filter.filter_size = 99;
    scene.settings.adaptive_threshold = k_nan;
    scene.settings.adaptive_min_samples = -1;
    expect_warning(scene, {"filter_size"});
    scene.settings.adaptive_threshold = k_nan;
    expect_warning(scene, {"adaptive_threshold"});
    scene.settings.adaptive_min_samples = -1;
    expect_warning(scene, {"adaptive_min_samples"});
}

TEST(Validate, OnePixelIsFine) {
    SceneDesc scene = good_scene();
    scene.settings.width = scene.settings.height = 1;
    scene.settings.crop = {};
    EXPECT_EQ(all(validate(scene)), "");
}

TEST(Validate, Images) {
    SceneDesc scene = good_scene();
    ImageDesc file;
    file.name = "wood.png";
    file.path = "/no/such/folder/wood.png";
    scene.images.push_back(file);
    expect_problem(scene, Severity::warning, {"image \"wood.png\"", "/no/such/folder/wood.png"});
    scene.images[2].path = "/no/such/folder/wood.<UDIM>.png";
    scene.images[1].pixels.pop_back();
    expect_problem(scene, Severity::warning, {"image \"generated\"", "5 values"});
    EXPECT_TRUE(scene.images[1].pixels.empty());
}

}  // namespace
}  // namespace cardioid::scene
