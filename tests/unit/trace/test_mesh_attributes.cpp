// SPDX-License-Identifier: GPL-3.0-or-later
#include "soup.h"
#include "trace/mesh_attributes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace cardioid::trace_tests {
namespace {

/// The cube of Blender's primitive with its vertices, faces as two triangles, and its 12 edges.
scene::MeshDesc cube() {
    scene::MeshDesc mesh;
    for (int v = 0; v < 8; ++v) {
        for (const int bit : {4, 2, 1}) mesh.positions.push_back((v & bit) != 0 ? 1.0f : -1.0f);
    }
    const std::uint32_t quads[6][4] = {{0, 1, 3, 2}, {2, 3, 7, 6}, {6, 7, 5, 4},
                                       {4, 5, 1, 0}, {2, 6, 4, 0}, {7, 3, 1, 5}};
    for (const auto& q : quads) mesh.triangles.insert(mesh.triangles.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
    mesh.edges = {2, 0, 0, 1, 1, 3, 3, 2, 6, 2, 3, 7, 7, 6, 4, 6, 7, 5, 5, 4, 0, 4, 5, 1};
    return mesh;
}

TEST(MeshAttributes, VertexNormalsWeighCornersByAngle) {
    // Faces of a cube are split into triangles unevenly; the angles still add up to a right one each.
    const auto normals = trace::vertex_normals(cube());
    for (int v = 0; v < 8; ++v) {
        const Float3 expected =
            normalize({(v & 4) != 0 ? 1.0f : -1.0f, (v & 2) != 0 ? 1.0f : -1.0f, (v & 1) != 0 ? 1.0f : -1.0f});
        EXPECT_LT(length(normals[v] - expected), 1e-6f) << v;
    }
}

TEST(MeshAttributes, PointinessOfACubeIsTheClosedForm) {
    // The mean of three unit edges is 1/√3 long and opposite to the normal; all vertices are alike, so the blur changes nothing.
    const float expected = std::acos(-1 / std::sqrt(3.0f)) / std::numbers::pi_v<float>;
    for (const float p : trace::pointiness(cube())) EXPECT_NEAR(p, expected, 1e-6f);
}

TEST(MeshAttributes, PointinessSeesVerticesAtOnePlaceAsOne) {
    // The same cube with a vertex for every corner of every triangle.
    const scene::MeshDesc whole = cube();
    scene::MeshDesc split;
    for (const std::uint32_t v : whole.triangles) {
        split.triangles.push_back(static_cast<std::uint32_t>(split.positions.size() / 3));
        split.positions.insert(split.positions.end(), &whole.positions[3 * v], &whole.positions[3 * v] + 3);
    }
    scene::MeshDesc same = whole;
    same.edges.clear();
    const auto expected = trace::pointiness(same), got = trace::pointiness(split);
    for (std::size_t c = 0; c < whole.triangles.size(); ++c)
        EXPECT_NEAR(got[c], expected[whole.triangles[c]], 0.03f) << "normals weigh split corners alike, not by angle";
}

/// A grid of 7×7 vertices bent by `bend`, faces as two triangles, edges of the quads.
scene::MeshDesc bent_grid(float bend) {
    scene::MeshDesc mesh;
    for (std::uint32_t v = 0; v < 49; ++v) {
        const float x = static_cast<float>(v % 7) - 3, y = static_cast<float>(v / 7) - 3;
        mesh.positions.insert(mesh.positions.end(), {x, y, bend * (x * x + y * y)});
        if (v % 7 < 6) mesh.edges.insert(mesh.edges.end(), {v, v + 1});
        if (v / 7 < 6) mesh.edges.insert(mesh.edges.end(), {v, v + 7});
        if (v % 7 < 6 && v / 7 < 6) mesh.triangles.insert(mesh.triangles.end(), {v, v + 1, v + 8, v, v + 8, v + 7});
    }
    return mesh;
}

TEST(MeshAttributes, PointinessIsHighOnDomesLowInBowlsAndHalfOnPlanes) {
    const auto dome = trace::pointiness(bent_grid(-0.05f)), bowl = trace::pointiness(bent_grid(0.05f));
    const auto plane = trace::pointiness(bent_grid(0));
    EXPECT_GT(dome[24], 0.51f);
    EXPECT_LT(bowl[24], 0.49f);
    EXPECT_NEAR(dome[24] + bowl[24], 1, 1e-5f);
    for (const float p : plane) EXPECT_NEAR(p, 0.5f, 1e-6f);
}

TEST(MeshAttributes, PointinessTakesTheHostsNormals) {
    scene::MeshDesc mesh = bent_grid(0);
    std::vector<float> tilted;
    for (int v = 0; v < 49; ++v) tilted.insert(tilted.end(), {1, 0, 0});
    mesh.attributes.push_back({trace::k_vertex_normal, scene::Domain::point, 3, tilted});
    const auto got = trace::pointiness(mesh);
    // At the ends of x the mean of three edges is a third of the normal; blurred with one neighbour inside.
    const float end = std::acos(1.0f / 3) / std::numbers::pi_v<float>;
    EXPECT_NEAR(got[21], (3 * end + 0.5f) / 4, 1e-6f);
    EXPECT_NEAR(got[27], 1 - got[21], 1e-6f);
}

TEST(MeshAttributes, IslandsAreConnectedParts) {
    scene::MeshDesc mesh = cube();
    const std::size_t one = mesh.triangles.size();
    const scene::MeshDesc second = cube();
    for (const float p : second.positions) mesh.positions.push_back(p + 5);
    for (const std::uint32_t v : second.triangles) mesh.triangles.push_back(v + 8);
    for (const std::uint32_t v : second.edges) mesh.edges.push_back(v + 8);
    const auto random = trace::random_per_island(mesh);
    ASSERT_EQ(random.size(), 2 * one / 3);
    for (std::size_t t = 0; t < random.size(); ++t) {
        EXPECT_EQ(random[t], random[t < one / 3 ? 0 : one / 3]);
        EXPECT_GE(random[t], 0.0f);
        EXPECT_LE(random[t], 1.0f);
    }
    EXPECT_NE(random.front(), random.back());
}

}  // namespace
}  // namespace cardioid::trace_tests
