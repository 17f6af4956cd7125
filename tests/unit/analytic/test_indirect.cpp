// SPDX-License-Identifier: GPL-3.0-or-later
// Light after several bounces: spheres seen from inside, plates that face each other, furnaces, mirrors, slabs of glass.
#include "analytic/closed_forms.h"
#include "analytic/replicates.h"
#include "analytic/scenes.h"

#include <algorithm>

namespace cardioid::test {
namespace {

/// Inside a unit sphere of albedo 1/2 (pbrt-v4's analytic scenes): direct light of 1/2 adds up to 1.
SceneMaker inside_sphere(bool orthographic) {
    SceneMaker m;
    m.add(sphere({0, 0, 0}, 1, 5, true), diffuse(0.5f));
    m.scene.settings.max_bounces = m.scene.settings.max_diffuse_bounces = 64;
    m.scene.settings.samples = 32;
    if (orthographic)
        m.probe({0.1f, 0, 0.2f}, {1, 0.1f, 0}, 0.3f);
    else
        m.perspective({0.1f, 0, 0.2f}, {1, 0.1f, 0}, 1);
    return m;
}

constexpr double k_watts_of_pi = 4 * k_pi_d * k_pi_d;  // intensity π

TEST(AnalyticIndirect, SphereAroundOnePointLamp) {
    for (const bool orthographic : {false, true}) {
        SceneMaker m = inside_sphere(orthographic);
        m.point_lamp({0, 0, 0}, static_cast<float>(k_watts_of_pi), 0);
        expect_value(m.scene, 1, "Combined", 0.01, 1e-3);
    }
}

TEST(AnalyticIndirect, SphereAroundFourLamps) {
    SceneMaker m = inside_sphere(false);
    for (int k = 0; k < 4; ++k) m.point_lamp({0, 0, 0}, static_cast<float>(k_watts_of_pi / 4), 0);
    expect_value(m.scene, 1, "Combined", 0.01, 1e-3);
    m.scene.materials[0].graph = diffuse(0.52f);
    expect_not(m.scene, 1);
}

TEST(AnalyticIndirect, SphereThatShinesItself) {
    for (const bool sampled : {true, false}) {
        SceneMaker m = inside_sphere(false);
        m.scene.materials[0].graph = combined("ShaderNodeAddShader", diffuse(0.5f), emission(0.5f));
        m.scene.materials[0].sample_emission = sampled;
        expect_value(m.scene, 1, "Combined", 0.01, 1e-4);
        m.scene.materials[0].graph = combined("ShaderNodeAddShader", diffuse(0.5f), emission(0.52f));
        expect_not(m.scene, 1);
    }
}

/// Two endless plates of albedo ρ; the lower one shines with 1 and is seen.
SceneMaker plates(float rho) {
    SceneMaker m;
    m.add(floor_quad(0, 4000), combined("ShaderNodeAddShader", diffuse(rho), emission(1.0f)));
    m.add(floor_quad(1, -4000), diffuse(rho));
    m.probe({0, -0.5f, 0.5f}, {0, 0, 0});
    m.scene.settings.samples = 128;
    return m;
}

TEST(AnalyticIndirect, FacingPlatesAreAGeometricSeries) {
    SceneMaker m = plates(0.5f);
    m.scene.settings.max_bounces = m.scene.settings.max_diffuse_bounces = 64;
    expect_value(m.scene, 1 / (1 - 0.25), "Combined", 0.01, 1e-3);
    expect_value(m.scene, 1 / (1 - 0.25) - 1, "D3", 0.02, 1e-3);
    m.scene.materials[1].graph = diffuse(0.56f);
    expect_not(m.scene, 1 / (1 - 0.25));
}

TEST(AnalyticIndirect, TheBounceLimitCutsTheSeries) {
    for (const bool by_kind : {false, true}) {
        for (int limit = 0; limit <= 4; ++limit) {
            SceneMaker m = plates(0.5f);
            (by_kind ? m.scene.settings.max_diffuse_bounces : m.scene.settings.max_bounces) = limit;
            m.scene.settings.samples = 256;
            // n bounces: light sampling at the vertex after them, so n + 1 reflections.
            double expected = 0;
            for (int reflections = 0; reflections <= limit + 1; reflections += 2)
                expected += std::pow(0.5, reflections);
            const statistics::Moments mean = replicate(m.scene, "Combined", 6);
            const statistics::TResult t = statistics::t_test(mean, expected, 1e-3);
            EXPECT_FALSE(t.rejected(k_level)) << limit << ": " << mean.mean << " for " << expected;
            EXPECT_TRUE(statistics::t_test(mean, expected + std::pow(0.5, 6), 1e-3).rejected(k_level)) << limit;
        }
    }
}

struct White {
    const char* name;
    scene::GraphDesc graph;
    double noise;  ///< what the mean may be off with confidence
};

std::vector<White> white_materials() {
    return {{"diffuse", diffuse(1.0f), 0.01},
            {"mirror", glossy(1, 0), 0.01},
            {"glass", glass(1, 1.5f), 0.02},
            {"translucent", translucent(1), 0.02},
            {"transparent", transparent(1), 0.01},
            {"diffuse and translucent", combined("ShaderNodeMixShader", diffuse(1.0f), translucent(1), 0.3f), 0.02},
            {"diffuse and mirror", combined("ShaderNodeMixShader", diffuse(1.0f), glossy(1, 0), 0.4f), 0.01},
            {"glass and transparent", combined("ShaderNodeMixShader", glass(1, 1.33f), transparent(1), 0.6f), 0.02}};
}

TEST(AnalyticIndirect, WhiteThingsVanishInAWhiteWorld) {
    for (const White& white : white_materials()) {
        SCOPED_TRACE(white.name);
        SceneMaker m;
        // Flat faces: smooth normals bend light at the rim and lose some.
        m.add(sphere({0, 0, 0}, 1, 3, false), white.graph);
        m.world(background(1));
        m.perspective({0, -3, 1}, {0, 0, 0}, 0.3f);
        scene::Settings& s = m.scene.settings;
        s.max_bounces = s.max_diffuse_bounces = s.max_glossy_bounces = s.max_transmission_bounces =
            s.max_transparent_bounces = 128;
        s.samples = 64;
        expect_value(m.scene, 1, "Combined", white.noise, 1e-4);
        s.max_bounces = 12;
        m.world(background(0.97f));
        expect_not(m.scene, 1);
    }
}

/// Directional albedo of GGX without Fresnel, height-correlated Smith, by the midpoint rule over incoming directions.
double ggx_albedo(double mu, double alpha) {
    const double a2 = alpha * alpha, sin_o = std::sqrt(1 - mu * mu);
    const auto lambda = [a2](double m) { return 0.5 * (std::sqrt(1 + a2 * (1 - m * m) / (m * m)) - 1); };
    double sum = 0;
    const int n = 400;
    for (int i = 0; i < n; ++i) {
        const double c = (i + 0.5) / n, s = std::sqrt(1 - c * c);
        for (int j = 0; j < n; ++j) {
            const double phi = 2 * k_pi_d * (j + 0.5) / n;
            const double hx = sin_o + s * std::cos(phi), hy = s * std::sin(phi), hz = mu + c;
            const double cos2 = hz * hz / (hx * hx + hy * hy + hz * hz), t = cos2 * (a2 - 1) + 1;
            sum += a2 / (k_pi_d * t * t) / (4 * mu) / (1 + lambda(mu) + lambda(c));
        }
    }
    return sum * 2 * k_pi_d / n / n;
}

TEST(AnalyticIndirect, RoughGlossyLosesWhatGgxLoses) {
    for (const float roughness : {0.4f, 0.7f, 1.0f}) {
        SceneMaker m;
        m.add(floor_quad(0, 100), glossy(1, roughness));
        m.world(background(1));
        m.probe({0, -1, 2}, {0, 0, 0});
        const double alpha = static_cast<double>(roughness * roughness);
        expect_value(m.scene, ggx_albedo(2 / std::sqrt(5.0), alpha), "Combined", 0.01, 1e-3);
    }
}

TEST(AnalyticIndirect, FlatMirrorShowsTheLamp) {
    SceneMaker m;
    m.add(floor_quad(0, 100), glossy(0.8f, 0));
    m.area_lamp({0, 2, 2}, {0, 0, 0}, 1, 1, 3);
    m.probe({0, -2, 2}, {0, 0, 0});
    expect_value(m.scene, 0.8 * 3, "D1", 1e-3, 1e-4);
    m.point_lamp({0, 2, 2}, 100, 0.2f);
    // The sphere's front is before the middle of the area lamp, which stays behind it.
    m.scene.lights.erase(m.scene.lights.begin());
    expect_value(m.scene, 0.8 * 100 / (4 * k_pi_d * k_pi_d * 0.04), "D1", 1e-3, 1e-4);
    m.scene.lights[0].visibility &= static_cast<std::uint8_t>(~scene::visible_glossy);
    EXPECT_EQ(replicate(m.scene, "Combined", 1).mean, 0);
}

TEST(AnalyticIndirect, MirrorsInARow) {
    // A corridor of mirrors: the view bounces three times before it meets the white end.
    SceneMaker m;
    m.add(quad({0, 0, 0}, {100, 0, 0}, {0, 100, 0}), glossy(0.9f, 0));
    m.add(quad({0, 0, 1}, {100, 0, 0}, {0, 100, 0}), glossy(0.7f, 0));
    m.add(quad({2.5f, 0, 0.5f}, {0, 2, 0}, {0, 0, 1}), emission(2));
    m.probe({-0.5f, 0, 0.5f}, {0, 0, 0});
    expect_value(m.scene, 2 * 0.9 * 0.7 * 0.9, "D1", 0.02, 1e-4);
}

/// Mean of T(θ) cos θ over the disk of a sun whose middle has the cosine `cos_middle`; irradiance 1 across the light.
double sun_through_slab(double cos_middle, double half_angle, double ior) {
    const double sin_middle = std::sqrt(1 - cos_middle * cos_middle);
    double sum = 0, weight = 0;
    const int n = 400;
    for (int i = 0; i < n; ++i) {
        const double t = (i + 0.5) / n * half_angle;
        for (int j = 0; j < n; ++j) {
            const double phi = 2 * k_pi_d * (j + 0.5) / n;
            const double c = cos_middle * std::cos(t) + sin_middle * std::sin(t) * std::cos(phi);
            sum += std::sin(t) * c * slab_transmittance(c, ior);
            weight += std::sin(t) * std::cos(t);
        }
    }
    return sum / weight;
}

/// A floor of albedo 0.6 below an endless slab of glass under a large sun.
SceneMaker slab_scene(float ior) {
    SceneMaker m;
    m.add(floor_quad(0, 1000), diffuse(0.6f));
    m.add(floor_quad(0.5f, -1000), glass(1, ior));
    m.add(floor_quad(0.7f, 1000), glass(1, ior));
    m.sun({0.6f, 0, 0.8f}, 5, 0.7f);
    m.probe({0, -0.4f, 0.3f}, {0, 0, 0});
    m.scene.settings.max_diffuse_bounces = 1;  // what the slab throws back to the floor is another path
    m.scene.settings.max_bounces = m.scene.settings.max_transmission_bounces = m.scene.settings.max_glossy_bounces = 64;
    m.scene.settings.samples = 2048;
    return m;
}

TEST(AnalyticIndirect, CausticThroughASlab) {
    SceneMaker m = slab_scene(1.5f);
    const double expected = 0.6 / k_pi_d * 5 * sun_through_slab(0.8, 0.35, 1.5);
    expect_value(m.scene, expected, "C1", 0.03, 1e-4);
    expect_value(m.scene, expected, "Combined", 0.03, 1e-4);
    expect_not(slab_scene(1.8f).scene, expected, "C1");
    m.scene.settings.refractive_caustics = false;
    EXPECT_EQ(replicate(m.scene, "Combined", 1).mean, 0) << "Refractive Caustics off";
}

TEST(AnalyticIndirect, TheCausticSeenInAMirror) {
    SceneMaker m = slab_scene(1.5f);
    // The view goes down by way of a mirror that stands on the floor.
    m.add(quad({0, 1, 0.2f}, {1, 0, 0}, {0, 0, 0.3f}), glossy(0.9f, 0));
    m.probe({0, 0.4f, 0.26f}, {0, 1, 0.1f});
    m.scene.settings.samples = 8192;
    const double expected = 0.9 * 0.6 / k_pi_d * 5 * sun_through_slab(0.8, 0.35, 1.5);
    // The mirror hides a part of the sky that lies beyond the sun: none of the light.
    expect_value(m.scene, expected, "C1", 0.03, 1e-4);
}

TEST(AnalyticIndirect, RoughGlassOfTheSameIorAsAirIsClear) {
    SceneMaker m;
    m.add(floor_quad(0, 100), emission(2));
    m.add(floor_quad(1, 100), glass(1, 1.0f));
    m.probe({0, -1, 2}, {0, 0, 0});
    expect_value(m.scene, 2, "Combined", 1e-3, 1e-4);
}

}  // namespace
}  // namespace cardioid::test
