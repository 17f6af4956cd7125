// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes for the tests of whole renders: shapes, materials, lamps and cameras in one line each.
#pragma once

#include "nodes/graphs.h"
#include "scene/scene_desc.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace cardioid::test {

inline constexpr double k_pi_d = std::numbers::pi;

inline Affine moved(Float3 p) {
    Affine a;
    a.m[3] = p.x;
    a.m[7] = p.y;
    a.m[11] = p.z;
    return a;
}

/// At `eye`, -z toward `target`, x to the right of the picture.
inline Affine looking_at(Float3 eye, Float3 target) {
    const Float3 back = normalize(eye - target);
    const Float3 up = std::fabs(back.z) > 0.99f ? Float3{0, 1, 0} : Float3{0, 0, 1};
    const Float3 x = normalize(cross(up, back)), y = cross(back, x);
    Affine a;
    a.m = {x.x, y.x, back.x, eye.x, x.y, y.y, back.y, eye.y, x.z, y.z, back.z, eye.z};
    return a;
}

// Meshes --------------------------------------------------------------------------------------------------

/// Parallelogram around `centre`; its normal is u × v.
inline scene::MeshDesc quad(Float3 centre, Float3 u, Float3 v) {
    scene::MeshDesc m;
    m.name = "quad";
    for (const auto& [a, b] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
        const Float3 p = centre + u * (0.5f * a) + v * (0.5f * b);
        m.positions.insert(m.positions.end(), {p.x, p.y, p.z});
    }
    m.triangles = {0, 1, 2, 0, 2, 3};
    return m;
}

/// Square of side `size` in the plane z, facing up, or down for a negative size.
inline scene::MeshDesc floor_quad(float z, float size) {
    return quad({0, 0, z}, {size, 0, 0}, {0, std::fabs(size), 0});
}

/// Octahedron split `levels` times, vertices on the sphere; `smooth` gives it the sphere's normals.
inline scene::MeshDesc sphere(Float3 centre, float radius, int levels, bool smooth) {
    std::vector<Float3> p{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    std::vector<std::uint32_t> t{0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
        const auto between = [&](std::uint32_t a, std::uint32_t b) {
            const auto key = std::minmax(a, b);
            const auto [at, fresh] = middle.try_emplace({key.first, key.second}, static_cast<std::uint32_t>(p.size()));
            if (fresh) p.push_back(normalize(p[a] + p[b]));
            return at->second;
        };
        std::vector<std::uint32_t> finer;
        for (std::size_t k = 0; k < t.size(); k += 3) {
            const std::uint32_t a = t[k], b = t[k + 1], c = t[k + 2], ab = between(a, b), bc = between(b, c),
                                ca = between(c, a);
            finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
        }
        t = finer;
    }
    scene::MeshDesc m;
    m.name = "sphere";
    m.triangles = t;
    for (const Float3& q : p)
        m.positions.insert(m.positions.end(),
                           {centre.x + radius * q.x, centre.y + radius * q.y, centre.z + radius * q.z});
    if (smooth) {
        for (const std::uint32_t i : t) m.corner_normals.insert(m.corner_normals.end(), {p[i].x, p[i].y, p[i].z});
    }
    return m;
}

// Graphs --------------------------------------------------------------------------------------------------

inline scene::GraphDesc diffuse(Float3 c) {
    return GraphMaker().node("ShaderNodeBsdfDiffuse").value("Color", {c.x, c.y, c.z, 1}).surface("BSDF");
}
inline scene::GraphDesc diffuse(float c) { return diffuse(Float3{c, c, c}); }
inline scene::GraphDesc emission(Float3 c) {
    return GraphMaker()
        .node("ShaderNodeEmission")
        .value("Color", {c.x, c.y, c.z, 1})
        .value("Strength", {1})
        .surface("Emission");
}
inline scene::GraphDesc emission(float c) { return emission(Float3{c, c, c}); }
inline scene::GraphDesc glossy(float c, float roughness) {
    return GraphMaker()
        .node("ShaderNodeBsdfGlossy")
        .value("Color", {c, c, c, 1})
        .value("Roughness", {roughness})
        .param("distribution", std::string("GGX"))
        .surface("BSDF");
}
inline scene::GraphDesc glass(float c, float ior, float roughness = 0) {
    return GraphMaker()
        .node("ShaderNodeBsdfGlass")
        .value("Color", {c, c, c, 1})
        .value("Roughness", {roughness})
        .value("IOR", {ior})
        .surface("BSDF");
}
inline scene::GraphDesc transparent(float c) {
    return GraphMaker().node("ShaderNodeBsdfTransparent").value("Color", {c, c, c, 1}).surface("BSDF");
}
inline scene::GraphDesc translucent(float c) {
    return GraphMaker().node("ShaderNodeBsdfTranslucent").value("Color", {c, c, c, 1}).surface("BSDF");
}
inline scene::GraphDesc background(float c) {
    return GraphMaker()
        .node("ShaderNodeBackground")
        .value("Color", {c, c, c, 1})
        .value("Strength", {1})
        .surface("Background");
}

/// Both surfaces through one mixing node: "ShaderNodeMixShader" (share `fac` of b) or "ShaderNodeAddShader".
inline scene::GraphDesc combined(const char* type, const scene::GraphDesc& a, const scene::GraphDesc& b,
                                 float fac = 0.5f) {
    GraphMaker maker;
    maker.graph.nodes = a.nodes;
    const int shift = static_cast<int>(a.nodes.size());
    for (scene::NodeDesc node : b.nodes) {
        for (auto& [id, input] : node.inputs) {
            if (input.linked()) input.node += shift;
        }
        maker.graph.nodes.push_back(node);
    }
    maker.node(type)
        .link("Shader", a.surface.node, a.surface.socket)
        .link("Shader_001", b.surface.node + shift, b.surface.socket);
    if (std::string(type) == "ShaderNodeMixShader") maker.value("Fac", {fac});
    return maker.surface("Shader");
}

// Scenes --------------------------------------------------------------------------------------------------

class SceneMaker {
public:
    SceneMaker() {
        scene.settings.width = scene.settings.height = 8;
        scene.settings.samples = 64;
        scene.settings.threads = 2;
        scene.settings.pixel_filter = scene::PixelFilter::box;
        scene.settings.max_bounces = 12;
    }

    /// A mesh with a material of its own; returns the instance for further settings.
    scene::InstanceDesc& add(scene::MeshDesc mesh, scene::GraphDesc graph) {
        scene::MaterialDesc material;
        material.name = "material " + std::to_string(scene.materials.size());
        material.graph = std::move(graph);
        scene.materials.push_back(material);
        scene::InstanceDesc instance;
        instance.name = "object " + std::to_string(scene.instances.size());
        instance.mesh = static_cast<int>(scene.meshes.size());
        instance.materials = {static_cast<int>(scene.materials.size()) - 1};
        scene.meshes.push_back(std::move(mesh));
        scene.instances.push_back(instance);
        return scene.instances.back();
    }

    /// Watts; a sphere of the radius, or a point.
    scene::LightDesc& point_lamp(Float3 at, float energy, float radius) {
        scene::LightDesc l;
        l.name = "lamp " + std::to_string(scene.lights.size());
        l.kind = scene::LightKind::point;
        l.transform = moved(at);
        l.energy = energy;
        l.radius = radius;
        scene.lights.push_back(l);
        return scene.lights.back();
    }

    /// Shines from `at` toward `target` with radiance `radiance`.
    scene::LightDesc& area_lamp(Float3 at, Float3 target, float size_x, float size_y, float radiance) {
        scene::LightDesc l;
        l.name = "area";
        l.kind = scene::LightKind::area;
        l.shape = scene::AreaShape::rectangle;
        l.transform = looking_at(at, target);
        l.size_x = size_x;
        l.size_y = size_y;
        l.energy = radiance * static_cast<float>(k_pi_d) * size_x * size_y;
        scene.lights.push_back(l);
        return scene.lights.back();
    }

    /// Irradiance on a plane across the light, from the direction `toward`.
    scene::LightDesc& sun(Float3 toward, float irradiance, float angle) {
        scene::LightDesc l;
        l.name = "sun";
        l.kind = scene::LightKind::sun;
        l.transform = looking_at(toward, {0, 0, 0});
        l.energy = irradiance;
        l.angle = angle;
        scene.lights.push_back(l);
        return scene.lights.back();
    }

    void world(scene::GraphDesc graph) {
        scene::WorldDesc w;
        w.name = "world";
        w.graph = std::move(graph);
        scene.world = w;
    }

    /// Orthographic view of a square of side `size` around `target`.
    scene::CameraDesc& probe(Float3 eye, Float3 target, float size = 0.01f) {
        scene::CameraDesc c;
        c.name = "probe";
        c.kind = scene::CameraKind::orthographic;
        c.transform = looking_at(eye, target);
        c.view_plane = {-size / 2, size / 2, -size / 2, size / 2};
        c.clip_start = 1e-3f;
        c.clip_end = 1e6f;
        scene.camera = c;
        return *scene.camera;
    }

    /// Perspective; `half_width` is the tangent of half the angle of view.
    scene::CameraDesc& perspective(Float3 eye, Float3 target, float half_width = 0.5f) {
        scene::CameraDesc& c = probe(eye, target);
        c.kind = scene::CameraKind::perspective;
        c.view_plane = {-half_width, half_width, -half_width, half_width};
        return c;
    }

    scene::SceneDesc scene;
};

/// Everything at once: lamps, an emitter, a mirror, glass, rough metal, a world, in a box.
inline SceneMaker busy_scene() {
    SceneMaker m;
    m.add(floor_quad(0, 6), diffuse(Float3{0.8f, 0.6f, 0.5f}));
    m.add(quad({0, 3, 1.5f}, {6, 0, 0}, {0, 0, 3}), diffuse(Float3{0.3f, 0.6f, 0.8f}));
    m.add(sphere({-1, 0.5f, 0.7f}, 0.7f, 3, true), glass(1, 1.5f));
    m.add(sphere({1, 0.5f, 0.7f}, 0.7f, 3, true), glossy(0.9f, 0));
    m.add(sphere({0, -0.7f, 0.4f}, 0.4f, 3, true), glossy(0.8f, 0.3f));
    m.add(quad({0, 0, 2.9f}, {-1, 0, 0}, {0, 1, 0}), emission(4));
    m.point_lamp({2, -1, 2}, 60, 0.2f);
    m.world(background(0.1f));
    m.perspective({0, -5, 1.5f}, {0, 0, 0.7f}, 0.5f);
    m.scene.settings.width = m.scene.settings.height = 32;
    m.scene.settings.samples = 16;
    return m;
}

}  // namespace cardioid::test
