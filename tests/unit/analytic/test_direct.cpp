// SPDX-License-Identifier: GPL-3.0-or-later
// Direct light on planes: form factors of every lamp, emissive meshes, environments, transparent shadows.
#include "analytic/replicates.h"
#include "analytic/scenes.h"

namespace cardioid::test {
namespace {

constexpr float k_albedo = 0.6f;
constexpr double k_rho = static_cast<double>(k_albedo);
const Float3 k_eye{0, -3, 2};

/// A large floor seen at the origin.
SceneMaker floor_scene() {
    SceneMaker m;
    m.add(floor_quad(0, 100), diffuse(k_albedo));
    m.probe(k_eye, {0, 0, 0});
    return m;
}

/// Irradiance at the origin, radiance 1, of a rectangle parallel to the floor: x in [0, a], y in [0, b], at height h.
double corner_irradiance(double a, double b, double h) {
    const double ra = std::sqrt(a * a + h * h), rb = std::sqrt(b * b + h * h);
    return 0.5 * (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb));
}

/// The same for x in [x0, x1], y in [y0, y1], of any sign.
double rectangle_irradiance(double x0, double x1, double y0, double y1, double h) {
    const auto f = [h](double a, double b) {
        return (a < 0 ? -1 : 1) * (b < 0 ? -1 : 1) * corner_irradiance(std::fabs(a), std::fabs(b), h);
    };
    return f(x1, y1) - f(x0, y1) - f(x1, y0) + f(x0, y0);
}

TEST(AnalyticDirect, PointLampInverseSquare) {
    for (const float radius : {0.0f, 0.4f}) {
        SceneMaker m = floor_scene();
        m.point_lamp({1, 0.5f, 2}, 100, radius);
        const double d2 = 1 + 0.25 + 4;
        // A sphere lamp above the horizon lights as a point of the same power does.
        const double expected = k_rho / k_pi_d * 100 / (4 * k_pi_d) * 2 / std::sqrt(d2) / d2;
        expect_value(m.scene, expected, "Combined", 0.01, 1e-4);
        expect_value(m.scene, expected, "D2", 0.01, 1e-4);
        m.scene.lights[0].transform.m[11] = 2.1f;
        expect_not(m.scene, expected);
    }
}

TEST(AnalyticDirect, RectangleFormFactor) {
    SceneMaker m = floor_scene();
    m.area_lamp({0.7f, 0.2f, 1.5f}, {0.7f, 0.2f, 0}, 1.2f, 0.8f, 3);
    const double expected = k_rho / k_pi_d * 3 * rectangle_irradiance(0.1, 1.3, -0.2, 0.6, 1.5);
    expect_value(m.scene, expected, "D2", 0.01, 1e-4);
    m.scene.lights[0].size_x = 1.1f;
    expect_not(m.scene, expected, "D2");
}

TEST(AnalyticDirect, EmissiveMeshLightsAsTheAreaLamp) {
    SceneMaker m = floor_scene();
    m.add(quad({0.7f, 0.2f, 1.5f}, {-1.2f, 0, 0}, {0, 0.8f, 0}), emission(3));
    const double expected = k_rho / k_pi_d * 3 * rectangle_irradiance(0.1, 1.3, -0.2, 0.6, 1.5);
    expect_value(m.scene, expected, "D2", 0.01, 1e-4);
    m.scene.materials[1].sample_emission = false;
    m.scene.settings.samples = 256;
    expect_value(m.scene, expected, "D2", 0.03, 1e-4);
    m.scene.meshes[1] = quad({0.7f, 0.2f, 1.5f}, {-1.1f, 0, 0}, {0, 0.8f, 0});
    m.scene.materials[1].sample_emission = true;
    expect_not(m.scene, expected, "D2");
}

TEST(AnalyticDirect, EmittersAreNotStoppedByThemselves) {
    // The step off the surface grows with the way from the camera; the shadow ray must still end before the emitter.
    for (const float camera_distance : {0.3f, 4.0f, 100.0f}) {
        for (const float height : {0.5f, 2.0f}) {
            SceneMaker m;
            m.add(floor_quad(0, 100), diffuse(k_albedo));
            m.add(floor_quad(height, -0.4f), emission(30));
            m.probe(normalize({0, -3, 1}) * camera_distance, {0, 0, 0});
            const double expected = k_rho / k_pi_d * 30 * 4 * corner_irradiance(0.2, 0.2, static_cast<double>(height));
            expect_value(m.scene, expected, "D2", 0.01, 1e-4);
        }
    }
}

TEST(AnalyticDirect, DiskLampOnItsAxis) {
    SceneMaker m = floor_scene();
    scene::LightDesc& l = m.area_lamp({0, 0, 1}, {0, 0, 0}, 1.6f, 1.6f, 1);
    l.shape = scene::AreaShape::disk;
    // The same watts on a smaller area shine stronger by 4/pi.
    const double expected = k_rho * 4 / k_pi_d * 0.64 / (0.64 + 1);
    expect_value(m.scene, expected, "D2", 0.01, 1e-4);
    m.scene.lights[0].shape = scene::AreaShape::square;
    expect_not(m.scene, expected, "D2");
}

TEST(AnalyticDirect, SunOnATiltedPlane) {
    for (const float angle : {0.0f, 0.3f}) {
        SceneMaker m = floor_scene();
        m.sun({0.6f, 0, 0.8f}, 5, angle);
        // The disk is of radiance E/(pi sin²), its irradiance on a plane that it does not cross is E cos.
        expect_value(m.scene, k_rho / k_pi_d * 5 * 0.8, "D2", 0.01, 1e-4);
        m.scene.lights[0].transform = looking_at({0.64f, 0, 0.768f}, {0, 0, 0});
        expect_not(m.scene, k_rho / k_pi_d * 5 * 0.8, "D2");
    }
}

TEST(AnalyticDirect, SpotInsideItsCone) {
    SceneMaker m = floor_scene();
    scene::LightDesc& l = m.point_lamp({0, 0, 2}, 100, 0);
    l.kind = scene::LightKind::spot;
    l.spot_angle = 1;
    l.spot_blend = 0;
    const double expected = k_rho / k_pi_d * 100 / (4 * k_pi_d) / 4;
    expect_value(m.scene, expected, "D2", 0.01, 1e-4);
    m.probe({2, -3, 2}, {2, 0, 0});
    EXPECT_EQ(replicate(m.scene, "Combined", 1).mean, 0) << "outside the cone";
}

TEST(AnalyticDirect, ManyLampsAddUp) {
    SceneMaker m = floor_scene();
    double expected = 0;
    for (int k = 0; k < 20; ++k) {
        const float x = static_cast<float>(k) - 9.5f, watts = k % 4 == 0 ? 200.0f : 10.0f;
        m.point_lamp({x, 1, 1 + 0.1f * static_cast<float>(k)}, watts, k % 3 == 0 ? 0.1f : 0.0f);
        const double z = 1 + 0.1 * k, d2 = static_cast<double>(x) * static_cast<double>(x) + 1 + z * z;
        expected += k_rho / k_pi_d * static_cast<double>(watts) / (4 * k_pi_d) * z / std::sqrt(d2) / d2;
    }
    m.scene.settings.samples = 256;
    expect_value(m.scene, expected, "D2", 0.01, 1e-4);
    m.scene.lights[8].energy *= 1.5f;
    expect_not(m.scene, expected, "D2");
}

TEST(AnalyticDirect, UniformWorld) {
    for (const auto sampling : {scene::WorldSampling::none, scene::WorldSampling::automatic}) {
        SceneMaker m = floor_scene();
        m.world(background(0.7f));
        m.scene.world->sampling = sampling;
        expect_value(m.scene, k_rho * 0.7);
        m.world(background(0.73f));
        expect_not(m.scene, k_rho * 0.7);
    }
}

/// An equirectangular picture: row j of `height` from below, column i.
template <class F>
void picture_world(SceneMaker& m, int width, int height, F value) {
    scene::ImageDesc image;
    image.name = "sky";
    image.source = scene::ImageSource::pixels;
    image.width = width;
    image.height = height;
    image.channels = 4;
    image.colorspace = "Non-Color";
    for (int j = 0; j < height; ++j) {
        for (int i = 0; i < width; ++i) {
            const float v = value(i, j);
            image.pixels.insert(image.pixels.end(), {v, v, v, 1});
        }
    }
    m.scene.images = {image};
    m.world(GraphMaker()
                .node("ShaderNodeTexEnvironment")
                .param("image", 0.0)
                .node("ShaderNodeBackground")
                .link("Color", 0, "Color")
                .value("Strength", {1})
                .surface("Background"));
}

TEST(AnalyticDirect, EnvironmentGradient) {
    SceneMaker m = floor_scene();
    // Radiance grows with the elevation e from 0 below to 1 above: ∫ (e/π + 1/2) cos dω = 3π/4.
    picture_world(m, 64, 64, [](int, int j) { return (static_cast<float>(j) + 0.5f) / 64; });
    expect_value(m.scene, k_rho * 0.75, "Combined", 0.01, 2e-4);
    picture_world(m, 64, 64, [](int, int j) { return (63.5f - static_cast<float>(j)) / 64; });
    expect_not(m.scene, k_rho * 0.75);
}

TEST(AnalyticDirect, EnvironmentBrightSpotComesFromItsDirection) {
    // Column 0.5 of the picture is +x, 0.25 is +y (Blender's equirectangular map): a spot at +y, 30 degrees up.
    const int width = 256, height = 128, column = 64, row = 85;
    const double elevation = (row + 0.5) / height * k_pi_d - k_pi_d / 2,
                 azimuth = k_pi_d - (column + 0.5) / width * 2 * k_pi_d;
    // Linear interpolation spreads a pixel over the integral of its hat functions: one pixel's solid angle.
    const double solid = 2 * k_pi_d / width * k_pi_d / height * std::cos(elevation);
    const Float3 toward{static_cast<float>(std::cos(elevation) * std::cos(azimuth)),
                        static_cast<float>(std::cos(elevation) * std::sin(azimuth)),
                        static_cast<float>(std::sin(elevation))};
    for (const Float3 n : {Float3{0, 0, 1}, Float3{0, 1, 0}, normalize({1, 1, 1})}) {
        SceneMaker m;
        const Float3 side = normalize(cross(n, {0.3f, 0.1f, 0.2f}));
        m.add(quad({0, 0, 0}, side, cross(n, side)), diffuse(k_albedo));
        m.probe(n * 2.0f + side, {0, 0, 0});
        picture_world(m, width, height, [&](int i, int j) { return i == column && j == row ? 1000.0f : 0.0f; });
        const double expected = k_rho / k_pi_d * 1000 * solid * static_cast<double>(dot(n, toward));
        expect_value(m.scene, expected, "Combined", 0.015, 2e-3);
        picture_world(m, width, height,
                      [&](int i, int j) { return i == column - 20 && j == row + 10 ? 1000.0f : 0.0f; });
        expect_not(m.scene, expected);
    }
}

TEST(AnalyticDirect, TransparentLayersAttenuateShadows) {
    // A point lamp is found by light sampling alone, an area lamp by rays as well.
    for (const bool area : {false, true}) {
        SceneMaker m = floor_scene();
        double unshadowed = 0;
        if (area) {
            m.area_lamp({0, 0, 1.5f}, {0, 0, 0}, 1, 1, 3);
            unshadowed = k_rho / k_pi_d * 3 * 4 * corner_irradiance(0.5, 0.5, 1.5);
        } else {
            m.point_lamp({0, 0, 1.5f}, 100, 0);
            unshadowed = k_rho / k_pi_d * 100 / (4 * k_pi_d) / 2.25;
        }
        m.probe({0, -0.4f, 0.3f}, {0, 0, 0});
        for (int layers = 1; layers <= 2; ++layers) {
            m.add(floor_quad(0.6f + 0.2f * static_cast<float>(layers), 50), transparent(0.5f));
            expect_value(m.scene, unshadowed * std::pow(0.5, layers), "D2", 0.01, 1e-4);
        }
        m.scene.settings.max_transparent_bounces = 1;
        EXPECT_LT(replicate(m.scene, "D2", 2).mean, 1e-3 * unshadowed) << "more layers than allowed";
        m.scene.settings.max_transparent_bounces = 8;
        m.scene.materials[2].use_transparent_shadow = false;
        if (area) continue;  // its share found by rays passes
        EXPECT_LT(replicate(m.scene, "D2", 2).mean, 1e-3 * unshadowed) << "shadow opaque by the material's switch";
    }
}

TEST(AnalyticDirect, OpaqueShareOfATransparentMixBlocks) {
    SceneMaker m = floor_scene();
    m.point_lamp({0, 0, 1.5f}, 100, 0);
    m.add(floor_quad(0.8f, 50), combined("ShaderNodeMixShader", transparent(1), diffuse(0.0f), 0.3f));
    m.probe({0, -0.4f, 0.3f}, {0, 0, 0});
    const double unshadowed = k_rho / k_pi_d * 100 / (4 * k_pi_d) / 2.25;
    expect_value(m.scene, 0.7 * unshadowed, "D2", 0.01, 1e-4);
    m.scene.materials[1].graph.nodes.back().inputs["Fac"].value[0] = 0.35f;
    expect_not(m.scene, 0.7 * unshadowed, "D2");
}

TEST(AnalyticDirect, OpaqueObjectsCastShadowsUnlessToldOtherwise) {
    SceneMaker m = floor_scene();
    m.point_lamp({0, 0, 1.5f}, 100, 0);
    m.add(floor_quad(0.8f, 1), diffuse(0.5f));
    m.probe({0, -0.4f, 0.3f}, {0, 0, 0});
    EXPECT_EQ(replicate(m.scene, "D2", 1).mean, 0);
    const double unshadowed = k_rho / k_pi_d * 100 / (4 * k_pi_d) / 2.25;
    m.scene.instances[1].visibility = scene::visible_all & ~scene::visible_shadow;
    expect_value(m.scene, unshadowed, "D2", 0.01, 1e-4);
    m.scene.instances[1].visibility = scene::visible_all;
    m.scene.lights[0].cast_shadow = false;
    expect_value(m.scene, unshadowed, "D2", 0.01, 1e-4);
}

TEST(AnalyticDirect, TranslucentPlateShinesOnItsBack) {
    SceneMaker m;
    m.add(floor_quad(0, 100), translucent(k_albedo));
    m.sun({0.6f, 0, 0.8f}, 5, 0.1f);
    m.probe({0, -2, -3}, {0, 0, 0});
    expect_value(m.scene, k_rho / k_pi_d * 5 * 0.8, "Combined", 0.01, 1e-4);
    m.probe({0, -2, 3}, {0, 0, 0});
    EXPECT_EQ(replicate(m.scene, "Combined", 1).mean, 0);
}

}  // namespace
}  // namespace cardioid::test
