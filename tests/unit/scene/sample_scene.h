// SPDX-License-Identifier: GPL-3.0-or-later
// A small scene in which every struct is used and every field differs from its default.
#pragma once

#include "scene/scene_desc.h"

namespace cardioid::scene::test {

inline GraphDesc sample_graph() {
    GraphDesc graph;
    NodeDesc shader{"Principled BSDF", "ShaderNodeBsdfPrincipled", {}, {}};
    shader.params["distribution"] = std::string("GGX");
    shader.params["version"] = 2.0;
    shader.params["use_clamp"] = true;
    shader.params["ramp"] = std::vector<double>{0, 1, 0.5, 0.25, 1};
    shader.inputs["Base Color"] = InputDesc{-1, "", "", {0.1f, 0.2f, 0.3f, 1}};
    shader.inputs["Roughness"] = InputDesc{-1, "", "", {0.5f, 0, 0, 0}};
    shader.inputs["Normal"] = InputDesc{1, "Normal", "VECTOR", {}};
    NodeDesc geometry{"Geometry", "ShaderNodeNewGeometry", {}, {}};
    geometry.inputs["Name"] = InputDesc{-1, "some text", "STRING", {}};
    graph.nodes = {shader, geometry};
    graph.surface = {0, "BSDF"};
    return graph;
}

inline MeshDesc sample_mesh() {
    MeshDesc mesh;
    mesh.name = "Plane";
    mesh.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0.125f};
    mesh.triangles = {0, 1, 2, 0, 2, 3};
    mesh.slots = {0, 1};
    mesh.corner_normals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    mesh.attributes = {{"UVMap", Domain::corner, 2, {0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1}},
                       {"Col", Domain::point, 4, std::vector<float>(16, 0.5f)},
                       {"id", Domain::face, 1, {1, 2}}};
    mesh.edges = {0, 1, 1, 2, 2, 3, 3, 0};
    mesh.active_uv = "UVMap";
    mesh.active_color = "Col";
    mesh.generated_min = {-1, -2, -3};
    mesh.generated_size = {2, 4, 6};
    return mesh;
}

inline std::vector<ImageDesc> sample_images() {
    ImageDesc packed;
    packed.name = "packed.png";
    packed.source = ImageSource::packed;
    packed.packed = {1, 2, 3, 255};
    packed.colorspace = "Non-Color";
    packed.alpha_mode = AlphaMode::channel_packed;
    ImageDesc pixels;
    pixels.name = "generated";
    pixels.source = ImageSource::pixels;
    pixels.width = 2, pixels.height = 1, pixels.channels = 3;
    pixels.pixels = {0.1f, 0.2f, 0.3f, 4, 5, 6};
    return {packed, pixels};
}

inline InstanceDesc sample_instance() {
    InstanceDesc instance;
    instance.name = "Object";
    instance.mesh = 0;
    instance.transform.m = {1, 0, 0, 3, 0, 2, 0, 4, 0, 0, 3, 5};
    instance.materials = {0, -1};
    instance.visibility = visible_camera | visible_shadow;
    instance.holdout = true;
    instance.pass_index = 7;
    instance.random = 0.25f;
    instance.color = {0.1f, 0.2f, 0.3f, 0.4f};
    instance.dupli_generated = {1, 2, 3};
    instance.dupli_uv = {4, 5};
    return instance;
}

inline SceneDesc sample_scene() {
    SceneDesc scene;
    scene.images = sample_images();
    scene.materials = {{"Wood", sample_graph(), {0.1f, 0.2f, 0.3f}, 0.5f, 0.6f, false, false, 3}};
    scene.meshes = {sample_mesh()};
    scene.groups = {{"Collection", {sample_instance()}}};
    InstanceDesc placed = sample_instance();
    placed.mesh = -1;
    placed.group = 0;
    scene.instances = {sample_instance(), placed};
    LightDesc light;
    light.name = "Lamp";
    light.kind = LightKind::area;
    light.shape = AreaShape::ellipse;
    light.energy = -12.5f;
    light.size_x = 0.3f;
    light.legacy_lamp = true;
    light.graph = sample_graph();
    scene.lights = {light};
    scene.world = WorldDesc{"World", sample_graph(), {1, 2, 3}, WorldSampling::manual, 512, visible_camera, 3};
    CameraDesc camera;
    camera.name = "Camera";
    camera.kind = CameraKind::orthographic;
    camera.transform.m[11] = 10;
    camera.view_plane = {-1, 1, -0.5f, 0.5f};
    camera.blades = 5;
    scene.camera = camera;
    Settings& s = scene.settings;
    s.width = 64, s.height = 32, s.crop = {1, 2, 3, 4}, s.samples = 5, s.first_sample = 6, s.seed = 0xffffffffu;
    s.pixel_filter = PixelFilter::gaussian, s.memory_limit = 1ll << 40, s.transparent_film = true;
    s.ocio_config = "/some/config.ocio";
    s.adaptive_threshold = 0.02f, s.adaptive_min_samples = 7, s.record_clusters = false;
    s.filter = {true, FilterMethod::cross_bilateral, 0.25f, 0.125f, 21, false, false, false, 0.3f};
    return scene;
}

}  // namespace cardioid::scene::test
