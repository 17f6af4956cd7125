// SPDX-License-Identifier: GPL-3.0-or-later
// What the scene knows of media before anything is rendered.
#include "nodes/graphs.h"
#include "soup.h"
#include "trace/traceable_scene.h"

#include <gtest/gtest.h>

namespace cardioid::trace_tests {
namespace {

scene::MaterialDesc absorbing(bool with_surface) {
    test::GraphMaker g;
    g.node("ShaderNodeVolumeAbsorption").node("ShaderNodeBsdfDiffuse");
    g.graph.volume = {0, "Volume"};
    if (with_surface) g.graph.surface = {1, "BSDF"};
    scene::MaterialDesc material;
    material.graph = g.graph;
    material.use_transparent_shadow = false;
    return material;
}

scene::SceneDesc scene_with(scene::MaterialDesc material) {
    scene::SceneDesc desc;
    desc.meshes = {square()};
    desc.materials = {std::move(material)};
    desc.instances = {placed(0, Affine{}, {0})};
    return desc;
}

trace::TraceableScene built(const scene::SceneDesc& desc) {
    return trace::TraceableScene(desc, [](const std::string&) { return false; });
}

TEST(Media, AMediumWithoutASurfaceLetsShadowRaysIn) {
    const auto scene = built(scene_with(absorbing(false)));
    EXPECT_TRUE(scene.view().has_volumes);
    EXPECT_TRUE(scene.view().has_transparent_shadows);
    EXPECT_TRUE(scene.view().materials[0].info.constant_transparency);
    EXPECT_EQ(scene.view().materials[0].info.transparency_value, (Float3{1, 1, 1}));
    EXPECT_NE(scene.view().materials[0].volume, nullptr);
}

TEST(Media, AnOpaqueSurfaceAroundAMediumStaysOpaque) {
    const auto scene = built(scene_with(absorbing(true)));
    EXPECT_TRUE(scene.view().has_volumes);
    EXPECT_FALSE(scene.view().has_transparent_shadows);
}

TEST(Media, OnlyMaterialsOfPlacedMeshesCount) {
    scene::SceneDesc desc = scene_with(absorbing(false));
    desc.instances[0].materials = {-1};
    EXPECT_FALSE(built(desc).view().has_volumes);
    scene::WorldDesc world;
    test::GraphMaker g;
    g.node("ShaderNodeVolumeScatter");
    g.graph.volume = {0, "Volume"};
    world.graph = g.graph;
    desc.world = world;
    EXPECT_TRUE(built(desc).view().has_volumes);
}

}  // namespace
}  // namespace cardioid::trace_tests
