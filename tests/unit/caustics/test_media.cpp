// SPDX-License-Identifier: GPL-3.0-or-later
// Photons through coloured glass, through fog and onto skin: path tracing, the hybrid and photon mapping are one picture.
#include "analytic/media_scenes.h"
#include "caustics/compare.h"

namespace cardioid::test {
namespace {

using scene::IntegratorKind;

constexpr int k_few = 10;

void expect_one_picture(const CausticCase& c) {
    const Pictures judge = pictures(path_traced(c), 1000, k_few);
    for (const auto kind : {IntegratorKind::hybrid, IntegratorKind::photon_mapping}) {
        const bool hybrid = kind == IntegratorKind::hybrid;
        const Pictures tested = photon_pictures(c, with_photons(c, kind), hybrid ? 2000 : 3000, k_few);
        const Agreement a = compare_pass(judge, tested, 0, c.bound, 0);
        std::printf("%-40s %s\n", (c.name + (hybrid ? ", hybrid" : ", photons")).c_str(), a.report.c_str());
        EXPECT_TRUE(a.agree) << c.name << ": " << a.report;
    }
}

SceneMaker room_with_ball(scene::GraphDesc ball) {
    SceneMaker m;
    add_room(m, 0.7f);
    m.add(sphere({0, 0.2f, 0.9f}, 0.7f, 4, true), std::move(ball));
    m.perspective({0, -5, 2.4f}, {0, 0, 0.5f}, 0.3f);
    set_bounces(m, 8);
    return m;
}

CausticCase media_case(const std::string& name, SceneMaker& m) {
    CausticCase c = caustic_case(name, m);
    c.scene.settings.width = c.scene.settings.height = 16;
    c.bound = 0.025;
    c.path_samples = 192;
    c.photon_samples = 24;
    return c;
}

TEST(CausticMedia, ColouredGlass) {
    SceneMaker m = room_with_ball(with_volume(glass(1, 1.5f), absorbing({0.95f, 0.5f, 0.3f}, 1.2f)));
    expect_one_picture(media_case("coloured glass", m));
}

TEST(CausticMedia, Fog) {
    SceneMaker m = room_with_ball(glass(1, 1.5f));
    m.add(box({-2.4f, -2.4f, 0.02f}, {2.4f, 2.4f, 3.2f}), scattering({1, 0.8f, 0.6f}, 0.15f, 0.3f));
    m.scene.settings.max_volume_bounces = 3;
    expect_one_picture(media_case("fog", m));
}

TEST(CausticMedia, SubsurfaceFloor) {
    SceneMaker m = room_with_ball(glass(1, 1.5f));
    m.add(box({-2, -2, -0.5f}, {2, 2, 0.1f}), GraphMaker()
                                                  .node("ShaderNodeSubsurfaceScattering")
                                                  .value("Color", {0.8f, 0.6f, 0.5f, 1})
                                                  .value("Radius", {0.3f, 0.2f, 0.1f})
                                                  .value("Scale", {1})
                                                  .value("Roughness", {1})
                                                  .param("falloff", std::string("RANDOM_WALK"))
                                                  .surface("BSSRDF"));
    expect_one_picture(media_case("subsurface floor", m));
}

}  // namespace
}  // namespace cardioid::test
