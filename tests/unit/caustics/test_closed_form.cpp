// SPDX-License-Identifier: GPL-3.0-or-later
// Caustics whose brightness is known: lamps that no camera path can meet, furnaces, scenes at other sizes.
#include "analytic/closed_forms.h"
#include "caustics/compare.h"

namespace cardioid::test {
namespace {

using scene::IntegratorKind;

constexpr IntegratorKind k_photon_kinds[] = {IntegratorKind::hybrid, IntegratorKind::photon_mapping};

const char* name_of(IntegratorKind k) {
    return k == IntegratorKind::path_tracing ? "path tracing" : k == IntegratorKind::hybrid ? "hybrid" : "photons";
}

void use_photons(SceneMaker& m, IntegratorKind kind, int samples, std::int64_t photons) {
    scene::Settings& s = m.scene.settings;
    s.integrator = kind;
    s.samples = samples;
    s.photons = photons;
    s.photon_radius = 0.5f;
    s.radius_shrink = 1;
    s.width = s.height = 16;
}

/// What a slab throws back of light from all sides.
double slab_albedo(double ior) {
    double sum = 0;
    const int n = 4000;
    for (int i = 0; i < n; ++i) {
        const double c = (i + 0.5) / n;
        sum += 2 * c * (1 - slab_transmittance(c, ior)) / n;
    }
    return sum;
}

constexpr double k_floor_albedo = 0.1;

/// Parallel light of irradiance 5 comes down through a pane of glass; the camera is under it.
SceneMaker slab_scene(double cos_sun, float ior, IntegratorKind kind) {
    SceneMaker m;
    m.add(floor_quad(0, 4), diffuse(static_cast<float>(k_floor_albedo)));
    m.add(floor_quad(0.25f, -4), glass(1, ior));
    m.add(floor_quad(0.3f, 4), glass(1, ior));
    m.sun({static_cast<float>(std::sqrt(1 - cos_sun * cos_sun)), 0, static_cast<float>(cos_sun)}, 5, 0);
    m.perspective({0, 0, 0.24f}, {0, 0, 0}, 1.5f);
    set_bounces(m, 64);
    use_photons(m, kind, 64, 8000);
    return m;
}

/// With all that goes back and forth between floor and slab.
double slab_radiance(double cos_sun, double ior) {
    return k_floor_albedo / k_pi_d * 5 * cos_sun * slab_transmittance(cos_sun, ior) /
           (1 - k_floor_albedo * slab_albedo(ior));
}

/// What the size of the pane and of the floor cuts off.
constexpr double k_edges = 3e-3;

TEST(ClosedForm, SunThroughASlab) {
    for (const IntegratorKind kind : k_photon_kinds) {
        for (const double cos_sun : {0.9, 0.5}) {
            SCOPED_TRACE(std::string(name_of(kind)) + " " + std::to_string(cos_sun));
            const SceneMaker m = slab_scene(cos_sun, 1.5f, kind);
            expect_value(m.scene, slab_radiance(cos_sun, 1.5), "Combined", 0.02, k_edges);
            if (kind == IntegratorKind::hybrid)
                expect_value(replicate(m.scene, "C1", 10), slab_radiance(cos_sun, 1.5), 0.02, k_edges);
        }
    }
    expect_not(slab_scene(0.5, 1.8f, IntegratorKind::hybrid).scene, slab_radiance(0.5, 1.5));
}

TEST(ClosedForm, TheSlabsCausticInAMirror) {
    for (const IntegratorKind kind : k_photon_kinds) {
        SCOPED_TRACE(name_of(kind));
        SceneMaker m = slab_scene(0.8, 1.5f, kind);
        // Parallel to the sun: it takes no light away from the floor.
        m.add(quad({0, 0.3f, 0.12f}, {3, 0, 0}, {0, 0, 0.2f}), glossy(0.9f, 0));
        m.perspective({0, -0.2f, 0.2f}, {0, 0.3f, 0.08f}).view_plane = {-0.5f, 0.5f, -0.1f, 0.1f};
        expect_value(m.scene, 0.9 * slab_radiance(0.8, 1.5), "Combined", 0.02, k_edges);
    }
}

constexpr float k_bulb_ior = 1.5f;

/// A point of light in a bulb of glass in the middle of a hollow ball of albedo 1/2. No camera path ends at the lamp,
/// and glass keeps all light: the wall's irradiance is that of the bare lamp times 1/(1 − 1/2): all has radiance 1.
SceneMaker bulb_in_a_ball(IntegratorKind kind, bool hollow) {
    SceneMaker m;
    m.add(sphere({0, 0, 0}, 1, 5, true), diffuse(0.5f));
    m.add(sphere({0, 0, 0}, 0.3f, 5, true), glass(1, k_bulb_ior));
    if (hollow) m.add(sphere({0, 0, 0}, -0.2f, 5, true), glass(1, k_bulb_ior));
    m.point_lamp({0, 0, 0}, static_cast<float>(4 * k_pi_d * k_pi_d), 0);
    m.perspective({0.6f, 0.1f, 0.2f}, {0.2f, -0.8f, 0}, 0.6f);
    set_bounces(m, 100);
    use_photons(m, kind, 32, 4000);
    return m;
}

TEST(ClosedForm, BulbInABall) {
    for (const IntegratorKind kind : k_photon_kinds) {
        SCOPED_TRACE(name_of(kind));
        SceneMaker m = bulb_in_a_ball(kind, true);
        expect_value(m.scene, 1, "Combined", 0.02, 3e-3);
        if (kind == IntegratorKind::hybrid) expect_value(m.scene, 1, "C1", 0.02, 3e-3);
        m.scene.materials[0].graph = diffuse(0.52f);
        expect_not(m.scene, 1);
    }
}

/// Where lamp and camera are in different media the conventions differ: Cycles does not scale radiance at a surface, so
/// a lamp in solid glass gives off η² times its watts.
TEST(ClosedForm, LampInSolidGlass) {
    for (const IntegratorKind kind : k_photon_kinds) {
        for (const bool physical : {false, true}) {
            SCOPED_TRACE(std::string(name_of(kind)) + (physical ? ", physical" : ""));
            SceneMaker m = bulb_in_a_ball(kind, false);
            m.scene.settings.physical_refraction = physical;
            const double ior = static_cast<double>(k_bulb_ior);
            expect_value(m.scene, physical ? 1 : ior * ior, "Combined", 0.02, 3e-3);
        }
    }
}

TEST(ClosedForm, BrightnessDoesNotDependOnTheFocalLength) {
    for (const IntegratorKind kind : k_photon_kinds) {
        for (const float half_width : {0.15f, 0.3f, 1.5f}) {
            SCOPED_TRACE(std::string(name_of(kind)) + " " + std::to_string(half_width));
            SceneMaker m = bulb_in_a_ball(kind, true);
            m.perspective({0.6f, 0.1f, 0.2f}, {0.9f, -0.4f, 0}, half_width);
            // Radii follow the footprint, and few photons fall into a narrow view.
            const bool narrow = half_width < 0.2f;
            m.scene.settings.photon_radius = narrow ? 4 : 1.5f;
            m.scene.settings.photons = narrow ? 32000 : 8000;
            expect_value(m.scene, 1, "Combined", 0.03, 3e-3);
        }
    }
}

/// The lamp shines under water, and the camera looks at it from air: radiance is 1/η² as large in air by physics.
TEST(ClosedForm, RadianceAcrossAWaterSurface) {
    for (const bool physical : {false, true}) {
        SceneMaker m;
        m.add(floor_quad(0, 20), emission(2));
        m.add(floor_quad(1, 20), glass(1, 1.33f));
        m.probe({0, -1, 3}, {0, 0, 1});
        m.scene.settings.physical_refraction = physical;
        const double cos_i = 2 / std::sqrt(5.0);
        const double expected = 2 * (1 - fresnel(cos_i, 1.33)) / (physical ? 1.33 * 1.33 : 1);
        m.scene.settings.samples = 1024;
        expect_value(m.scene, expected, "D1", 0.01, 1e-4);
    }
}

/// White things of all kinds vanish in a white world.
SceneMaker furnace(IntegratorKind kind) {
    SceneMaker m;
    m.add(floor_quad(0, 3), diffuse(1.0f));
    // Flat faces: smooth normals bend light at the rim and lose some.
    m.add(sphere({-0.6f, 0, 0.8f}, 0.5f, 3, false), glass(1, 1.5f));
    m.add(sphere({0.6f, 0, 0.8f}, 0.5f, 3, false), glossy(1, 0));
    m.add(quad({0, 1, 0.7f}, {1, 0, 0}, {0, 0.3f, 0.8f}),
          combined("ShaderNodeMixShader", diffuse(1.0f), glossy(1, 0), 0.4f));
    m.world(background(1));
    m.perspective({0, -3, 1.8f}, {0, 0, 0.5f}, 0.35f);
    set_bounces(m, 128);
    // The world's photons are far between.
    use_photons(m, kind, 64, kind == IntegratorKind::photon_mapping ? 40000 : 10000);
    m.scene.settings.photon_radius = 0.25f;
    return m;
}

TEST(ClosedForm, WhiteThingsVanishInAWhiteWorld) {
    const double level = statistics::sidak(k_alarm, k_blocks);
    for (const IntegratorKind kind :
         {IntegratorKind::path_tracing, IntegratorKind::hybrid, IntegratorKind::photon_mapping}) {
        SCOPED_TRACE(name_of(kind));
        const SceneMaker m = furnace(kind);
        scene::SceneDesc finer = m.scene;
        finer.settings.photon_radius /= 2;  // edges make the bias linear in the radius
        const Pictures p = kind == IntegratorKind::path_tracing
                               ? pictures(m.scene, 100)
                               : extrapolated(pictures(m.scene, 100), pictures(finer, 100));
        expect_value(moments_of(p, [](const auto& v) { return v[0].whole; }), 1, 0.02, 1e-4);
        for (std::size_t b = 0; b < k_blocks; ++b) {
            const auto t = statistics::t_test(moments_of(p, [b](const auto& v) { return v[0].block[b]; }), 1, 1e-3);
            EXPECT_FALSE(t.rejected(level)) << b << ": " << t.difference << " +- " << t.error;
            EXPECT_TRUE(t.equivalent(0.1, 0.02)) << b << ": " << t.difference << " +- " << t.error;
        }
        SceneMaker grey = m;
        grey.world(background(0.97f));
        expect_not(grey.scene, 1);
    }
}

scene::SceneDesc scaled(scene::SceneDesc scene, float factor) {
    const auto moved_by = [factor](Affine& a) {
        for (const std::size_t k : {3u, 7u, 11u}) a.m[k] *= factor;
    };
    for (scene::MeshDesc& m : scene.meshes) {
        for (float& v : m.positions) v *= factor;
    }
    for (scene::InstanceDesc& i : scene.instances) moved_by(i.transform);
    for (scene::LightDesc& l : scene.lights) {
        moved_by(l.transform);
        l.size_x *= factor;
        l.size_y *= factor;
        l.radius *= factor;
        if (l.kind != scene::LightKind::sun) l.energy *= factor * factor;
    }
    moved_by(scene.camera->transform);
    scene.camera->clip_start *= factor;
    scene.camera->clip_end *= factor;
    return scene;
}

TEST(Scale, AMillimetreAndAKilometre) {
    for (const IntegratorKind kind : k_photon_kinds) {
        const CausticCase c = glass_and_chrome();
        scene::SceneDesc scene = with_photons(c, kind);
        // A lamp of every shape of emission.
        scene::LightDesc point;
        point.name = "point";
        point.transform = moved({0.5f, -1, 2.5f});
        point.energy = 40;
        scene.lights.push_back(point);
        scene.world = scene::WorldDesc{};
        scene.world->color = {0.1f, 0.1f, 0.2f};
        const Pictures judge = pictures(scene, 10);
        for (const float factor : {1e-3f, 1e3f}) {
            const Agreement a = compare_pass(judge, pictures(scaled(scene, factor), 10), 0, 0.02, 0.12);
            std::printf("%s × %g: %s\n", name_of(kind), static_cast<double>(factor), a.report.c_str());
            EXPECT_TRUE(a.agree) << name_of(kind) << " × " << factor << ": " << a.report;
        }
    }
}

}  // namespace
}  // namespace cardioid::test
