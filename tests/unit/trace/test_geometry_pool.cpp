// SPDX-License-Identifier: GPL-3.0-or-later
#include "soup.h"
#include "trace/geometry_pool.h"
#include "trace/octahedral.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace cardioid::trace_tests {
namespace {

using scene::SceneDesc;
using trace::GeometryPool;

constexpr int k_default = 99;

GeometryPool pool_of(const SceneDesc& desc) { return GeometryPool(desc, {}, k_default); }

Float3 corner(const GeometryPool& pool, int instance, std::uint32_t triangle, int k) {
    Float3 c[3];
    pool.world_triangle(instance, triangle, c);
    return c[k];
}

void expect_near(Float3 a, Float3 b, float bound = 1e-5f) {
    EXPECT_LT(length(a - b), bound) << a.x << " " << a.y << " " << a.z;
}

scene::InstanceDesc placed_group(int group, const Affine& transform) {
    scene::InstanceDesc i;
    i.group = group;
    i.transform = transform;
    return i;
}

TEST(GeometryPool, NestedGroupsAreFlattened) {
    SceneDesc desc;
    desc.meshes = {square()};
    desc.groups.resize(2);
    desc.groups[0].instances = {placed(0, moved(1, 0, 0)), placed(0, moved(2, 0, 0))};
    desc.groups[1].instances = {placed_group(0, scaled(2, 2, 2)), placed(0, moved(0, 0, 5))};
    desc.instances = {placed_group(1, moved(0, 10, 0)), placed_group(0, Affine{})};
    desc.instances[0].visibility = scene::visible_camera | scene::visible_diffuse;
    desc.groups[1].instances[0].visibility = scene::visible_camera | scene::visible_glossy;
    const GeometryPool pool = pool_of(desc);
    ASSERT_EQ(pool.placed().size(), 5u);
    expect_near(corner(pool, 0, 0, 0), {2, 10, 0});
    expect_near(corner(pool, 1, 0, 1), {6, 10, 0});
    expect_near(corner(pool, 2, 0, 0), {0, 10, 5});
    expect_near(corner(pool, 3, 0, 0), {1, 0, 0});
    expect_near(corner(pool, 4, 1, 2), {2, 1, 0});
    // Visibility is what every level allows.
    EXPECT_EQ(pool.placed()[0].visibility, scene::visible_camera);
    EXPECT_EQ(pool.placed()[2].visibility, scene::visible_camera | scene::visible_diffuse);
    EXPECT_EQ(pool.placed()[3].visibility, scene::visible_all);
}

TEST(GeometryPool, OnlyAMeshThatIsPlacedOnceIsBaked) {
    SceneDesc desc;
    desc.meshes = {square(), square(), square()};
    desc.instances = {placed(0, moved(5, 0, 0)), placed(1, moved(6, 0, 0)), placed(1, scaled(3, 3, 3))};
    const GeometryPool pool = pool_of(desc);
    EXPECT_TRUE(pool.baked(0));
    EXPECT_FALSE(pool.baked(1));
    EXPECT_FALSE(pool.baked(2));
    EXPECT_FALSE(pool.meshes()[2].used);
    EXPECT_EQ(pool.positions(0)[0], 5.0f);
    EXPECT_EQ(pool.positions(1)[0], 0.0f);
    expect_near(corner(pool, 2, 0, 1), {3, 0, 0});
}

TEST(GeometryPool, MirroredBakedInstancesTurnTheirNormals) {
    SceneDesc desc;
    desc.meshes = {square(), square(), square()};
    desc.instances = {placed(0, scaled(-1, 1, 1)), placed(1, scaled(-1, -1, 1)), placed(2, scaled(-1, 1, 1)),
                      placed(2, Affine{})};
    const GeometryPool pool = pool_of(desc);
    trace::SceneView view;
    pool.fill(view);
    EXPECT_EQ(view.instances.flip[0], 1);
    EXPECT_EQ(view.instances.flip[1], 0);
    // Instances keep their mesh's space, where the winding is the artist's.
    EXPECT_EQ(view.instances.flip[2], 0);
}

TEST(GeometryPool, MaterialsBySlot) {
    SceneDesc desc;
    desc.meshes = {square(), square()};
    desc.meshes[1].slots.clear();
    desc.instances = {placed(0, Affine{}, {4, 7}), placed(0, Affine{}, {4}), placed(0, Affine{}),
                      placed(0, Affine{}, {-1, 3}), placed(1, Affine{}, {6, 5})};
    const GeometryPool pool = pool_of(desc);
    const auto both = [&](int instance) {
        return std::vector<int>{pool.material(instance, 0), pool.material(instance, 1)};
    };
    EXPECT_EQ(both(0), (std::vector<int>{4, 7}));
    EXPECT_EQ(both(1), (std::vector<int>{4, 4}));
    EXPECT_EQ(both(2), (std::vector<int>{k_default, k_default}));
    EXPECT_EQ(both(3), (std::vector<int>{k_default, 3}));
    EXPECT_EQ(both(4), (std::vector<int>{6, 6}));
    EXPECT_EQ(pool.materials_of(0), (std::vector<int>{4, 7}));
    EXPECT_EQ(pool.materials_of(1), (std::vector<int>{4}));
}

TEST(GeometryPool, SlotsThatNoTriangleUsesDoNotCount) {
    SceneDesc desc;
    desc.meshes = {square()};
    desc.meshes[0].slots = {2, 2};
    desc.instances = {placed(0, Affine{}, {4, 7, 8})};
    EXPECT_EQ(pool_of(desc).materials_of(0), (std::vector<int>{8}));
}

TEST(GeometryPool, BakedNormalsFollowTheInverseTranspose) {
    SceneDesc desc;
    desc.meshes = {square(), square()};
    for (auto& mesh : desc.meshes) {
        for (int k = 0; k < 6; ++k) mesh.corner_normals.insert(mesh.corner_normals.end(), {0.6f, 0, 0.8f});
    }
    desc.instances = {placed(0, scaled(2, 1, 1)), placed(1, scaled(2, 1, 1)), placed(1, Affine{})};
    const GeometryPool pool = pool_of(desc);
    trace::SceneView view;
    pool.fill(view);
    const std::uint32_t baked = view.packed_normals[0];
    EXPECT_EQ(baked, trace::pack_normal(normalize({0.3f, 0, 0.8f})));
    EXPECT_EQ(view.packed_normals[3 * view.instances.first_triangle[1]], trace::pack_normal({0.6f, 0, 0.8f}));
}

TEST(GeometryPool, EmptySceneStillHasTables) {
    const GeometryPool pool = pool_of(SceneDesc{});
    trace::SceneView view;
    pool.fill(view);
    EXPECT_TRUE(pool.placed().empty());
    ASSERT_NE(view.geometry.instances, nullptr);
    EXPECT_EQ(view.slot_materials[view.instances.first_material[0]], k_default);
    EXPECT_FALSE(view.any_holdout);
}

TEST(GeometryPool, AttributesByName) {
    SceneDesc desc;
    desc.meshes = {square(), square()};
    desc.meshes[0].attributes = {{"other", scene::Domain::face, 1, {8, 9}},
                                 {"map", scene::Domain::corner, 2, std::vector<float>(12, 0.5f)}};
    desc.instances = {placed(0, Affine{}), placed(1, Affine{})};
    const GeometryPool pool(desc, {{"map", "other", "missing"}, {}}, k_default);
    trace::SceneView view;
    pool.fill(view);
    ASSERT_EQ(view.geometry.attribute_names, 3);
    const auto& map = view.geometry.attributes[0];
    const auto& other = view.geometry.attributes[1];
    EXPECT_EQ(map.channels, 2);
    EXPECT_EQ(view.geometry.floats[map.offset], 0.5f);
    EXPECT_EQ(other.domain, static_cast<int>(scene::Domain::face));
    EXPECT_EQ(view.geometry.floats[other.offset + 1], 9.0f);
    EXPECT_EQ(view.geometry.attributes[2].channels, 0);
    EXPECT_EQ(view.geometry.attributes[3].channels, 0) << "of the mesh without attributes";
}

scene::InstanceDesc with_values(scene::InstanceDesc instance, std::vector<scene::InstanceValueDesc> values) {
    instance.values = std::move(values);
    return instance;
}

TEST(GeometryPool, ValuesByNameAreTheInnerInstancesOrElseTheGroups) {
    SceneDesc desc;
    desc.meshes = {square()};
    desc.groups.resize(2);
    desc.groups[0].instances = {with_values(placed(0, Affine{}), {{"object:a", {1, 1, 1, 1}}})};
    desc.groups[1].instances = {with_values(placed_group(0, Affine{}), {{"object:b", {2, 3, 4, 1}}})};
    desc.instances = {with_values(placed_group(1, Affine{}),
                                  {{"object:a", {9, 9, 9, 1}}, {"object:b", {9, 9, 9, 1}}, {"c", {5, 5, 5, 1}}}),
                      with_values(placed(0, Affine{}), {{"unread", {7, 7, 7, 1}}, {"c", {6, 6, 6, 1}}})};
    const GeometryPool pool(desc, {{}, {"object:a", "object:b", "c", "missing"}}, k_default);
    trace::SceneView view;
    pool.fill(view);
    const nodes::InstanceValues& values = view.geometry.instance_values;
    ASSERT_EQ(values.names, 4);
    const auto row = [&](int instance, int name) {
        const float* r = values.rows + 4 * (instance * values.names + name);
        return std::array<float, 4>{r[0], r[1], r[2], r[3]};
    };
    using Value = std::array<float, 4>;
    EXPECT_EQ(row(0, 0), (Value{1, 1, 1, 1}));
    EXPECT_EQ(row(0, 1), (Value{2, 3, 4, 1}));
    EXPECT_EQ(row(0, 2), (Value{5, 5, 5, 1}));
    EXPECT_EQ(row(1, 0), (Value{0, 0, 0, 0}));
    EXPECT_EQ(row(1, 2), (Value{6, 6, 6, 1}));
    EXPECT_EQ(row(1, 3), (Value{0, 0, 0, 0}));
}

TEST(GeometryPool, AttributesThatFollowFromTheShapeAreMadeOnlyWhenNamed) {
    SceneDesc desc;
    desc.meshes = {square()};
    desc.instances = {placed(0, Affine{})};
    const GeometryPool plain(desc, {}, k_default);
    const GeometryPool pool(desc, {{"#random_island", "#pointiness"}, {}}, k_default);
    EXPECT_LT(plain.memory_bytes(), pool.memory_bytes());
    trace::SceneView view;
    pool.fill(view);
    const auto& island = view.geometry.attributes[0];
    const auto& point = view.geometry.attributes[1];
    EXPECT_EQ(island.domain, static_cast<int>(scene::Domain::face));
    EXPECT_EQ(island.channels, 1);
    EXPECT_EQ(view.geometry.floats[island.offset], view.geometry.floats[island.offset + 1]);
    EXPECT_EQ(point.domain, static_cast<int>(scene::Domain::point));
    EXPECT_NEAR(view.geometry.floats[point.offset], 0.5f, 1e-6f);
}

}  // namespace
}  // namespace cardioid::trace_tests
