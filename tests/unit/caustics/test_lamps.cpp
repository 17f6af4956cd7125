// SPDX-License-Identifier: GPL-3.0-or-later
// The caustic of every kind of lamp: the hybrid against path tracing where camera paths can meet the lamp, otherwise against
// photons alone, whose weights know nothing of camera paths.
#include "caustics/compare.h"

namespace cardioid::test {
namespace {

using scene::IntegratorKind;

struct Lamp {
    std::string name;
    bool met = true;     ///< by camera paths
    bool chosen = true;  ///< by light samples, else noisy
    SceneMaker scene;
};

SceneMaker ball_on_a_floor() {
    SceneMaker m;
    m.add(floor_quad(0, 4), diffuse(0.6f));
    m.add(sphere({0, 0, 0.9f}, 0.6f, 4, true), glass(1, 1.5f));
    m.perspective({0, -3, 2.5f}, {0, 0, 0}, 0.25f);
    return m;
}

template <class Add>
Lamp lamp(const std::string& name, bool met, Add add) {
    Lamp l{name, met, true, ball_on_a_floor()};
    add(l.scene);
    for (const scene::MaterialDesc& material : l.scene.scene.materials) l.chosen &= material.sample_emission;
    return l;
}

std::vector<Lamp> lamps() {
    const Float3 above{-0.5f, 0.3f, 3};
    const auto spot = [above](SceneMaker& m, float radius) {
        scene::LightDesc& l = m.point_lamp(above, 200, radius);
        l.kind = scene::LightKind::spot;
        l.transform = looking_at(above, {0, 0, 0.9f});
        l.spot_angle = 0.7f;
    };
    std::vector<Lamp> all{
        lamp("point", false, [=](SceneMaker& m) { m.point_lamp(above, 200, 0); }),
        lamp("sphere", true, [=](SceneMaker& m) { m.point_lamp(above, 200, 0.5f); }),
        lamp("facing disk", true, [=](SceneMaker& m) { m.point_lamp(above, 200, 0.5f).soft_falloff = true; }),
        lamp("spot of a point", false, [=](SceneMaker& m) { spot(m, 0); }),
        lamp("spot", true, [=](SceneMaker& m) { spot(m, 0.4f); }),
        lamp("sun of no size", false,
             [](SceneMaker& m) {
                 m.sun({-0.4f, 0.2f, 1}, 3, 0);
             }),
        lamp("sun", true,
             [](SceneMaker& m) {
                 m.sun({-0.4f, 0.2f, 1}, 3, 0.5f);
             }),
        lamp("area", true,
             [=](SceneMaker& m) {
                 m.area_lamp(above, {0, 0, 1}, 1, 1, 6);
             }),
        lamp("area met by no ray", false,
             [=](SceneMaker& m) {
                 m.area_lamp(above, {0, 0, 1}, 1, 1, 6).use_mis = false;
             }),
        lamp("narrow disk", true,
             [=](SceneMaker& m) {
                 scene::LightDesc& l = m.area_lamp(above, {0, 0, 1}, 1.2f, 1, 6);
                 l.shape = scene::AreaShape::ellipse;
                 l.spread = 1;
             }),
        lamp("emitter", true,
             [](SceneMaker& m) {
                 m.add(quad({-0.5f, 0.3f, 3}, {-1, 0, 0}, {0, 1, 0}), emission(6));
             }),
        lamp("emitter met by rays alone", true,
             [](SceneMaker& m) {
                 m.add(quad({-0.5f, 0.3f, 3}, {-1, 0, 0}, {0, 1, 0}), emission(6));
                 m.scene.materials.back().sample_emission = false;
             }),
        lamp("world", true, [](SceneMaker& m) { m.world(background(1)); }),
    };
    return all;
}

TEST(Lamps, EveryKindMakesItsCaustic) {
    for (Lamp& l : lamps()) {
        CausticCase c = caustic_case(l.name, l.scene);
        c.bound = 0.03;
        c.path_samples *= 3;
        if (!l.chosen) c.photon_samples *= 4;
        const scene::SceneDesc hybrid = with_photons(c, IntegratorKind::hybrid);
        const bool traced = l.met;
        const Pictures judge = traced ? pictures(path_traced(c), 1000)
                                      : photon_pictures(c, with_photons(c, IntegratorKind::photon_mapping), 3000);
        const Pictures tested = photon_pictures(c, hybrid, 2000);
        const double picture = moments_of(judge, [](const auto& m) { return m[0].whole; }).mean;
        for (const std::size_t k : {std::size_t{0}, std::size_t{4}}) {
            const double own = moments_of(judge, [k](const auto& m) { return m[k].whole; }).mean;
            EXPECT_GT(own, 0) << l.name;
            const Agreement a =
                compare_pass(judge, tested, k, k == 0 ? c.bound : 0.06, 0, std::max(own, 0.1 * picture));
            std::printf("%-28s %s\n", l.name.c_str(), a.report.c_str());
            EXPECT_TRUE(a.agree) << l.name << ": " << a.report;
        }
    }
}

}  // namespace
}  // namespace cardioid::test
