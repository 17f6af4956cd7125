// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/limits.h"

#include "scene/sample_scene.h"

#include <gtest/gtest.h>

namespace cardioid::scene {
namespace {

TEST(Limits, AnEnormousFrameIsRefusedClearly) {
    SceneDesc scene;
    scene.settings.width = scene.settings.height = 16000;
    scene.settings.memory_limit = 8ll << 30;
    const std::string problem = memory_problem(scene);
    EXPECT_NE(problem.find("16000 × 16000"), std::string::npos) << problem;
    EXPECT_NE(problem.find("8.0 GB"), std::string::npos) << problem;
    EXPECT_GT(memory_estimate(scene).film, 16ll << 30);
    scene.settings.memory_limit = 1ll << 50;
    EXPECT_EQ(memory_problem(scene), "");
}

TEST(Limits, TheCropCountsNotTheFrame) {
    SceneDesc scene;
    scene.settings.width = scene.settings.height = 16000;
    scene.settings.crop = {0, 0, 10, 10};
    EXPECT_LT(memory_estimate(scene).film, 1 << 20);
}

TEST(Limits, WhatTheFilterNeedsCounts) {
    SceneDesc scene;
    scene.settings.width = scene.settings.height = 1000;
    scene.settings.samples = 64;
    const auto per_pixel = [&] { return memory_estimate(scene).film / 1'000'000; };
    const std::int64_t recorded = per_pixel();
    scene.settings.samples = 1;
    EXPECT_LT(per_pixel(), recorded) << "a sample is one cluster in a layer at most";
    scene.settings.samples = 64;
    scene.settings.record_clusters = false;
    const std::int64_t plain = per_pixel();
    EXPECT_GT(recorded, plain + 500);
    EXPECT_LT(recorded, plain + 3 * 8 * 32 + 100) << "lists of eight in three layers, and three passes";
    scene.settings.filter.use_filter = true;
    EXPECT_EQ(per_pixel(), recorded) << "the filter needs clusters whatever is said";
    scene.settings.record_clusters = true;
    scene.settings.adaptive_threshold = 0.01f;
    EXPECT_GT(per_pixel(), recorded);
    scene.settings.adaptive_threshold = 0;
    scene.settings.radius_schedule = RadiusSchedule::per_pixel;
    EXPECT_EQ(per_pixel(), recorded) << "path tracing has no radii";
    scene.settings.integrator = IntegratorKind::hybrid;
    EXPECT_EQ(per_pixel(), recorded + 104);
}

TEST(Limits, WithoutALimitTheMachineDecides) {
    EXPECT_GT(machine_memory(), 1 << 20);
    SceneDesc scene;
    EXPECT_EQ(memory_problem(scene), "");
    scene.settings.width = scene.settings.height = 2000000000;
    EXPECT_NE(memory_problem(scene).find("this machine has"), std::string::npos);
}

TEST(Limits, GeometryGrowsWithTriangles) {
    SceneDesc scene;
    scene.meshes = {test::sample_mesh()};
    const std::int64_t one = memory_estimate(scene).geometry;
    scene.meshes.assign(10, test::sample_mesh());
    EXPECT_EQ(memory_estimate(scene).geometry, 10 * one);
    EXPECT_GT(one, 2 * 100);
}

TEST(Limits, FilesCountTheCacheAndPixelsThemselves) {
    SceneDesc scene;
    scene.images = test::sample_images();
    scene.settings.texture_cache_mb = 64;
    EXPECT_EQ(memory_estimate(scene).textures, (64ll << 20) + 6 * 4 + 4);
    scene.images.erase(scene.images.begin());
    EXPECT_EQ(memory_estimate(scene).textures, 6 * 4);
}

}  // namespace
}  // namespace cardioid::scene
