// SPDX-License-Identifier: GPL-3.0-or-later
// True displacement, measured by rays against planes whose height is known.
#include "light/light_data.h"
#include "nodes/graphs.h"
#include "nodes/run.h"
#include "soup.h"
#include "trace/displaced_normals.h"
#include "trace/surface.h"
#include "trace/traceable_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>

namespace cardioid::trace_tests {
namespace {

using namespace CD_ISA_NS;  // NOLINT(google-build-using-namespace): width 1

constexpr float k_slope = 0.5f;

/// The square [-1, 1]² in z = 0 as n × n quads.
scene::MeshDesc grid(int n, bool smooth) {
    scene::MeshDesc mesh;
    mesh.name = "grid";
    for (int k = 0; k < (n + 1) * (n + 1); ++k) {
        const auto place = [n](int i) { return -1 + 2 * static_cast<float>(i) / static_cast<float>(n); };
        mesh.positions.insert(mesh.positions.end(), {place(k % (n + 1)), place(k / (n + 1)), 0});
    }
    const auto side = static_cast<std::uint32_t>(n + 1);
    for (std::uint32_t y = 0; y + 1 < side; ++y) {
        for (std::uint32_t x = 0; x + 1 < side; ++x) {
            const std::uint32_t a = y * side + x;
            mesh.triangles.insert(mesh.triangles.end(), {a, a + 1, a + side + 1, a, a + side + 1, a + side});
        }
    }
    if (smooth) {
        for (std::size_t c = 0; c < mesh.triangles.size(); ++c)
            mesh.corner_normals.insert(mesh.corner_normals.end(), {0, 0, 1});
    }
    mesh.generated_min = {-1, -1, -1};
    mesh.generated_size = {2, 2, 2};
    return mesh;
}

/// Height k_slope · x of `coordinates` along the normal, over a shader of one input.
scene::MaterialDesc sloped(scene::DisplacementMethod method, const char* shader, const char* coordinates = "Object") {
    test::GraphMaker g;
    g.node(shader).value("Color", {1, 1, 1, 1}).value("Strength", {3});
    g.node("ShaderNodeTexCoord");
    g.node("ShaderNodeSeparateXYZ").link("Vector", 1, coordinates);
    g.node("ShaderNodeDisplacement").value("Scale", {k_slope}).value("Midlevel", {0}).link("Height", 2, "X");
    g.graph.surface = {0, "Emission"};
    if (std::string(shader) != "ShaderNodeEmission") g.graph.surface.socket = "BSDF";
    g.graph.displacement = {3, "Displacement"};
    scene::MaterialDesc material;
    material.name = "sloped";
    material.graph = g.graph;
    material.displacement_method = method;
    return material;
}

/// Moves by 1 along the normal, times `scale`.
scene::MaterialDesc lifted(float scale, const char* space) {
    test::GraphMaker g;
    g.node("ShaderNodeBsdfDiffuse");
    g.node("ShaderNodeDisplacement").value("Height", {1}).value("Scale", {scale}).value("Midlevel", {0});
    g.param("space", std::string(space));
    g.graph.surface = {0, "BSDF"};
    g.graph.displacement = {1, "Displacement"};
    scene::MaterialDesc material;
    material.graph = g.graph;
    material.displacement_method = scene::DisplacementMethod::displacement;
    return material;
}

scene::SceneDesc scene_of(scene::MeshDesc mesh, scene::MaterialDesc material, const Affine& transform = {}) {
    scene::SceneDesc desc;
    desc.meshes = {std::move(mesh)};
    desc.materials = {std::move(material)};
    desc.instances = {placed(0, transform, {0})};
    return desc;
}

struct Down {
    float z;
    Float3 n, ng;
    int instance;
};

/// What a ray straight down at (x, y) meets.
Down look_down(const trace::SceneView& view, float x, float y) {
    RayLanes ray{{x, y, 8.0f}, {0.0f, 0.0f, -1.0f}, 0.0f, 1e30f, 0.0f, ~0};
    const HitLanes h = intersect(view.embree, ray, mask_of(true), false);
    EXPECT_TRUE(all(h.hit)) << x << " " << y;
    const SurfaceNormals s = surface_normals(view, h.instance, h.triangle, h.ng, h.u, h.v, {0.0f, 0.0f, 1.0f});
    const auto value = [](Vec3 v) { return Float3{v.x[0], v.y[0], v.z[0]}; };
    return {8 - h.t[0], value(s.n), value(s.ng), h.instance[0]};
}

trace::TraceableScene built(const scene::SceneDesc& desc) {
    return trace::TraceableScene(desc, [](const std::string&) { return false; });
}

void expect_near(Float3 a, Float3 b, float bound = 2e-4f) {
    EXPECT_LT(length(a - b), bound) << a.x << " " << a.y << " " << a.z;
}

TEST(Displacement, AGradientTiltsThePlaneAndItsNormals) {
    const Float3 tilted = normalize(Float3{-k_slope, 0, 1});
    for (const bool smooth : {false, true}) {
        const auto scene =
            built(scene_of(grid(6, smooth), sloped(scene::DisplacementMethod::displacement, "ShaderNodeBsdfDiffuse")));
        for (const auto& [x, y] : {std::pair{0.31f, 0.2f}, {-0.77f, 0.52f}, {0.9f, -0.83f}}) {
            const Down d = look_down(scene.view(), x, y);
            EXPECT_NEAR(d.z, k_slope * x, 1e-5f);
            expect_near(d.n, tilted);
            expect_near(d.ng, tilted);
        }
    }
}

TEST(Displacement, BothKeepsTheNormalsThatBumpTurns) {
    const auto scene = built(scene_of(grid(6, true), sloped(scene::DisplacementMethod::both, "ShaderNodeBsdfDiffuse")));
    const Down d = look_down(scene.view(), 0.4f, 0.3f);
    EXPECT_NEAR(d.z, k_slope * 0.4f, 1e-5f);
    expect_near(d.n, {0, 0, 1});
    expect_near(d.ng, normalize(Float3{-k_slope, 0, 1}));
}

TEST(Displacement, BumpLeavesTheSurfaceWhereItIs) {
    const auto scene = built(scene_of(grid(6, true), sloped(scene::DisplacementMethod::bump, "ShaderNodeBsdfDiffuse")));
    EXPECT_NEAR(look_down(scene.view(), 0.4f, 0.3f).z, 0, 1e-6f);
}

TEST(Displacement, ObjectSpaceScalesWithTheObjectAndWorldSpaceDoesNot) {
    const Affine place = moved(3, 0, 1) * scaled(2, 2, 2);
    EXPECT_NEAR(look_down(built(scene_of(grid(2, true), lifted(0.3f, "OBJECT"), place)).view(), 3.2f, 0.1f).z, 1.6f,
                1e-5f);
    EXPECT_NEAR(look_down(built(scene_of(grid(2, true), lifted(0.3f, "WORLD"), place)).view(), 3.2f, 0.1f).z, 1.3f,
                1e-5f);
}

TEST(Displacement, InstancesSeeTheWorldOfTheFirst) {
    scene::SceneDesc desc = scene_of(grid(2, true), lifted(0.3f, "WORLD"), scaled(1, 1, 2));
    desc.instances.push_back(placed(0, moved(5, 0, 0), {0}));
    const auto scene = built(desc);
    EXPECT_NEAR(look_down(scene.view(), 0.2f, 0.1f).z, 0.3f, 1e-5f);
    EXPECT_NEAR(look_down(scene.view(), 5.2f, 0.1f).z, 0.15f, 1e-5f);
}

TEST(Displacement, OneMeshUnderDifferentMaterialsMovesDifferently) {
    scene::SceneDesc desc = scene_of(grid(2, true), lifted(0.3f, "OBJECT"));
    desc.materials.push_back(lifted(0.7f, "OBJECT"));
    desc.instances.push_back(placed(0, moved(5, 0, 0), {1}));
    desc.instances.push_back(placed(0, moved(10, 0, 0), {-1}));
    desc.instances.push_back(placed(0, moved(15, 0, 0), {0}));
    const auto scene = built(desc);
    const float expected[] = {0.3f, 0.7f, 0, 0.3f};
    for (int i = 0; i < 4; ++i) {
        const Down d = look_down(scene.view(), 5.0f * static_cast<float>(i) + 0.2f, 0.1f);
        EXPECT_EQ(d.instance, i);
        EXPECT_NEAR(d.z, expected[i], 1e-5f) << i;
    }
    EXPECT_EQ(scene.view().instances.mesh[0], scene.view().instances.mesh[3]);
}

TEST(Displacement, OnlyTrianglesOfTheMaterialMove) {
    // The left half is in slot 1, which stays; the vertices between belong to both and move.
    scene::MeshDesc mesh = grid(4, true);
    for (std::size_t t = 0; t < mesh.triangles.size() / 3; ++t) mesh.slots.push_back(t % 8 < 4 ? 1 : 0);
    scene::SceneDesc desc = scene_of(mesh, lifted(0.5f, "OBJECT"));
    desc.instances[0].materials = {0, -1};
    const auto scene = built(desc);
    EXPECT_NEAR(look_down(scene.view(), 0.6f, 0.1f).z, 0.5f, 1e-5f);
    EXPECT_NEAR(look_down(scene.view(), -0.7f, 0.1f).z, 0, 1e-6f);
    EXPECT_NEAR(look_down(scene.view(), -0.25f, 0.1f).z, 0.25f, 1e-5f);
    // There the normals are still those of before.
    expect_near(look_down(scene.view(), -0.25f, 0.1f).n, {0, 0, 1});
}

TEST(Displacement, EmissiveTrianglesStandWhereTheSurfaceIs) {
    const auto scene =
        built(scene_of(grid(3, false), sloped(scene::DisplacementMethod::displacement, "ShaderNodeEmission")));
    const light::LightData& lights = *scene.view().lights;
    ASSERT_EQ(scene.stats().emissive_triangles, 18);
    double area = 0;
    for (int t = 0; t < 18; ++t) {
        const float* record = lights.triangle + t * light::k_triangle_floats;
        EXPECT_NEAR(record[2], k_slope * record[0], 1e-5f);
        area += record[light::triangle::area];
    }
    EXPECT_NEAR(area, 4 * std::sqrt(1 + k_slope * k_slope), 1e-4);
}

TEST(Displacement, GeneratedAndObjectCoordinatesOfTheMovedSurface) {
    // Emission = Generated z (undisplaced: 1/2 everywhere) and Object z (the height).
    for (const char* coordinates : {"Generated", "Object"}) {
        scene::MaterialDesc material = lifted(0.25f, "OBJECT");
        test::GraphMaker g;
        g.graph = material.graph;
        g.node("ShaderNodeTexCoord");
        g.node("ShaderNodeEmission").link("Color", 2, coordinates);
        g.graph.surface = {3, "Emission"};
        material.graph = g.graph;
        const auto scene = built(scene_of(grid(2, true), material));
        const trace::SceneView& view = scene.view();
        nodes::ShadingChunk chunk{};
        chunk.n = 1;
        chunk.geometry = &view.geometry;
        chunk.mesh[0] = view.instances.mesh[0];
        chunk.position[2][0] = 0.25f;
        nodes::SurfaceOutput out;
        auto scratch = std::make_unique<nodes::Scratch>();
        run_program(*view.materials[0].emission, chunk, out, *scratch);
        EXPECT_NEAR(out.emission[2][0], coordinates[0] == 'G' ? 0.5f : 0.25f, 1e-5f) << coordinates;
    }
}

TEST(Displacement, ThreadsChangeNothing) {
    scene::SceneDesc desc =
        scene_of(grid(60, true), sloped(scene::DisplacementMethod::displacement, "ShaderNodeBsdfDiffuse"));
    desc.settings.threads = 1;
    const auto one = built(desc);
    desc.settings.threads = 2;
    const auto two = built(desc);
    const std::size_t count = 3 * std::size_t{61} * 61;
    const float *a = one.view().geometry.positions, *b = two.view().geometry.positions;
    EXPECT_TRUE(std::equal(a, a + count, b));
    EXPECT_NE(a[count - 1], 0.0f);
}

TEST(Displacement, OffsetsThatAreNotFiniteLeaveTheVertex) {
    const auto scene = built(scene_of(grid(2, true), lifted(std::numeric_limits<float>::infinity(), "OBJECT")));
    EXPECT_NEAR(look_down(scene.view(), 0.2f, 0.1f).z, 0, 1e-6f);
}

TEST(DisplacedNormals, FlatFacesOfASmoothMeshStayFlat) {
    // Two faces meet at a right angle: the first is flat, the second smooth.
    scene::MeshDesc mesh;
    mesh.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    mesh.triangles = {0, 1, 2, 0, 2, 3};
    const Float3 n = normalize(Float3{1, 0, 1});
    mesh.corner_normals = {0, 0, 1, 0, 0, 1, 0, 0, 1, n.x, n.y, n.z, n.x, n.y, n.z, 1, 0, 0};
    std::vector<float> positions = mesh.positions;
    positions[5] = 1;  // vertex 1 up: the first face has the normal (-1, 0, 1)/√2 now
    const auto normals = trace::displaced_normals(mesh, positions, [](std::size_t) { return true; });
    const auto at = [&](std::size_t c) { return Float3{normals[3 * c], normals[3 * c + 1], normals[3 * c + 2]}; };
    const Float3 first = normalize(Float3{-1, 0, 1});
    for (const std::size_t c : {0, 1, 2}) expect_near(at(c), first, 1e-5f);
    for (const std::size_t c : {3, 4}) expect_near(at(c), normalize(first + Float3{1, 0, 0}), 1e-5f);
    expect_near(at(5), {1, 0, 0}, 1e-5f);
    const auto kept = trace::displaced_normals(mesh, positions, [](std::size_t t) { return t == 1; });
    EXPECT_EQ(kept[2], 1) << "a triangle that is not reshaded";
}

}  // namespace
}  // namespace cardioid::trace_tests
