// SPDX-License-Identifier: GPL-3.0-or-later
// Nothing to catch, nothing to pay: without lobes of class S, or without light, no photon is emitted and
// passes are skipped.
#include "caustics/photon_stats.h"

namespace cardioid::test {
namespace {

using scene::IntegratorKind;

void expect_skipped(const SceneMaker& m, const std::string& what) {
    const Rendered r = render_counted(m.scene);
    EXPECT_EQ(r.photons("emitted"), 0) << what;
    EXPECT_EQ(r.photons("stored"), 0) << what;
    EXPECT_EQ(r.photons("gathered"), 0) << what;
    EXPECT_GT(r.photons("skipped_passes"), 0) << what;
}

SceneMaker chalk() {
    SceneMaker m = small_caustic();
    for (auto& material : m.scene.materials) material.graph = diffuse(0.6f);
    return m;
}

TEST(NothingToCatch, WithoutSpecularLobes) { expect_skipped(chalk(), "chalk"); }

TEST(NothingToCatch, RougherThanTheThreshold) {
    SceneMaker m = chalk();
    m.scene.materials[1].graph = glossy(0.9f, 0.3f);
    m.scene.materials[2].graph = glass(1, 1.5f, 0.2f);
    m.scene.settings.caustic_roughness = 0.1f;
    expect_skipped(m, "rough");
    m.scene.settings.caustic_roughness = 0.25f;
    EXPECT_GT(render_counted(m.scene).photons("emitted"), 0) << "the rough glass is class S now";
}

TEST(NothingToCatch, WithoutLight) {
    for (const IntegratorKind kind : {IntegratorKind::hybrid, IntegratorKind::photon_mapping}) {
        SceneMaker m = small_caustic();
        m.scene.settings.integrator = kind;
        m.scene.lights.clear();
        expect_skipped(m, "no lamps");
        m.world(background(0));
        expect_skipped(m, "black world");
        m.point_lamp({0, 0, 2}, 0, 0.1f);
        expect_skipped(m, "a lamp that is off");
    }
}

TEST(NothingToCatch, PathTracingHasNoPhotons) {
    SceneMaker m = small_caustic();
    m.scene.settings.integrator = IntegratorKind::path_tracing;
    EXPECT_EQ(render_counted(m.scene).photons("emitted"), 0);
}

TEST(NothingToCatch, PhotonMappingNeedsNoSpecularLobes) {
    SceneMaker m = chalk();
    m.scene.settings.integrator = IntegratorKind::photon_mapping;
    const Rendered r = render_counted(m.scene);
    EXPECT_GT(r.photons("emitted"), 0);
    EXPECT_GT(mean_of(*r.frame), 0);
}

TEST(SomethingToCatch, IsCounted) {
    for (const IntegratorKind kind : {IntegratorKind::hybrid, IntegratorKind::photon_mapping}) {
        SceneMaker m = small_caustic();
        m.scene.settings.integrator = kind;
        const Rendered r = render_counted(m.scene);
        EXPECT_EQ(r.photons("emitted"), m.scene.settings.photons * m.scene.settings.samples);
        EXPECT_GT(r.photons("stored"), 0);
        EXPECT_GT(r.photons("gathered"), 0);
        EXPECT_GT(r.photons("passes"), 0);
        EXPECT_EQ(r.photons("skipped_passes"), 0);
    }
}

TEST(NothingToCatch, TheHybridIsPathTracingThen) {
    SceneMaker m = chalk();
    const Rendered hybrid = render_counted(m.scene);
    m.scene.settings.integrator = IntegratorKind::path_tracing;
    const Rendered path_tracing = render_counted(m.scene);
    EXPECT_EQ(hybrid.frame->find("Combined")->data, path_tracing.frame->find("Combined")->data);
}

}  // namespace
}  // namespace cardioid::test
