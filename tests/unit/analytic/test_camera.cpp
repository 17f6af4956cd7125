// SPDX-License-Identifier: GPL-3.0-or-later
// Cameras: coverage, projections, blur that keeps energy, clipping, alpha, depth and normals.
#include "analytic/replicates.h"
#include "analytic/scenes.h"

#include <algorithm>

namespace cardioid::test {
namespace {

float pixel(const film::Frame& f, const char* pass, int x, int y, int channel = 0) {
    const film::Pass& p = *f.find(pass);
    return p.data[static_cast<std::size_t>((y * f.width + x) * p.channels + channel)];
}

/// A shining square of side 1 at distance 4, seen from above.
SceneMaker shining_square() {
    SceneMaker m;
    m.add(floor_quad(0, 1), emission(2));
    m.perspective({0, 0, 4}, {0, 0, 0}, 0.5f);
    m.scene.settings.width = m.scene.settings.height = 16;
    return m;
}

TEST(AnalyticCamera, CoverageOfThePicture) {
    SceneMaker m = shining_square();
    // The view plane at distance 1 is 1 wide, the square there 1/4.
    expect_value(m.scene, 2.0 / 16);
    m.scene.camera->view_plane = {-1, 1, -0.5f, 0.5f};
    expect_value(m.scene, 2.0 / 32);
    m.probe({0, 0, 4}, {0, 0, 0}, 3);
    expect_value(m.scene, 2.0 / 9);
    m.probe({0, 0, 4}, {0, 0, 0}, 3.1f);
    expect_not(m.scene, 2.0 / 9);
}

TEST(AnalyticCamera, PictureIsTheRightWayRound) {
    SceneMaker m;
    m.add(quad({1, 1, 0}, {1, 0, 0}, {0, 1, 0}), emission(1));
    m.perspective({0, 0, 4}, {0, 0, 0}, 0.5f);
    const auto f = render_frame(m.scene);
    EXPECT_GT(pixel(*f, "Combined", 6, 6), 0.9f) << "right and above";
    EXPECT_EQ(pixel(*f, "Combined", 1, 6), 0.0f);
    EXPECT_EQ(pixel(*f, "Combined", 6, 1), 0.0f);
}

TEST(AnalyticCamera, DepthOfFieldKeepsEnergy) {
    struct Lens {
        int blades;
        float rotation, ratio, focus;
    };
    for (const Lens lens : {Lens{0, 0, 1, 4}, Lens{0, 0, 1, 2.5f}, Lens{0, 0, 1, 7}, Lens{5, 0.4f, 1, 3},
                            Lens{3, 0, 2, 3}, Lens{0, 0, 0.5f, 3}}) {
        SceneMaker m = shining_square();
        m.scene.camera->aperture_radius = 0.1f;
        m.scene.camera->focus_distance = lens.focus;
        m.scene.camera->blades = lens.blades;
        m.scene.camera->blade_rotation = lens.rotation;
        m.scene.camera->aperture_ratio = lens.ratio;
        expect_value(m.scene, 2.0 / 16);
        m.scene.meshes[0] = floor_quad(0, 1.03f);
        expect_not(m.scene, 2.0 / 16);
    }
}

TEST(AnalyticCamera, BlurIsThatOfTheThinLens) {
    // Focus at 2, the object at 4: each of its points becomes the lens's shape of radius 0.1·(4 − 2)/(2·4) on the view plane.
    SceneMaker m = shining_square();
    m.scene.meshes[0] = quad({50, 0, 0}, {100, 0, 0}, {0, 100, 0});
    m.scene.camera->aperture_radius = 0.2f;
    m.scene.camera->focus_distance = 2;
    m.scene.settings.samples = 512;
    const auto f = render_frame(m.scene);
    const double blur = 0.2 * (4.0 - 2.0) / (2.0 * 4.0);
    for (int x = 0; x < 16; ++x) {
        // Share of the disk beyond the edge, averaged over the pixel.
        double expected = 0;
        for (int k = 0; k < 64; ++k) {
            const double s = std::clamp(((x + (k + 0.5) / 64) / 16 - 0.5) / blur, -1.0, 1.0);
            expected += (std::acos(-s) + s * std::sqrt(1 - s * s)) / k_pi_d / 64;
        }
        EXPECT_NEAR(static_cast<double>(pixel(*f, "Combined", x, 8)), 2 * expected, 0.06) << x;
    }
}

TEST(AnalyticCamera, PixelFilterKeepsEnergyAndWidens) {
    for (const auto filter :
         {scene::PixelFilter::box, scene::PixelFilter::gaussian, scene::PixelFilter::blackman_harris}) {
        SceneMaker m = shining_square();
        m.scene.settings.pixel_filter = filter;
        m.scene.settings.filter_width = 3;
        expect_value(m.scene, 2.0 / 16);
        // The square's edge runs between pixels 9 and 10: a wide filter carries light across it.
        const float outside = pixel(*render_frame(m.scene), "Combined", 10, 8);
        EXPECT_EQ(outside > 1e-3f, filter != scene::PixelFilter::box) << outside;
    }
}

TEST(AnalyticCamera, ClippingIsAlongTheAxis) {
    SceneMaker m = shining_square();
    m.scene.meshes[0] = floor_quad(0, 100);
    for (const auto& [start, end, seen] :
         {std::tuple{0.1f, 100.0f, true}, {3.99f, 4.01f, true}, {4.01f, 100.0f, false}, {0.1f, 3.99f, false}}) {
        m.scene.camera->clip_start = start;
        m.scene.camera->clip_end = end;
        const auto f = render_frame(m.scene);
        EXPECT_NEAR(mean_of(*f), seen ? 2 : 0, 1e-5) << start << " " << end;
    }
}

TEST(AnalyticCamera, DepthAndNormal) {
    SceneMaker m = shining_square();
    m.scene.meshes[0] = floor_quad(0, 100);
    const auto f = render_frame(m.scene);
    for (int x = 0; x < 16; ++x) {
        EXPECT_NEAR(pixel(*f, "Depth", x, 3), 4, 1e-4);
        EXPECT_NEAR(pixel(*f, "Normal", x, 3, 2), 1, 1e-5);
    }
    m.scene.meshes[0] = quad({1000, 0, 0}, {1, 0, 0}, {0, 1, 0});
    EXPECT_EQ(pixel(*render_frame(m.scene), "Depth", 3, 3), 1e10f);
}

TEST(AnalyticCamera, TransparentFilmHoldsTheCoverage) {
    SceneMaker m = shining_square();
    m.world(background(0.5f));
    m.scene.settings.transparent_film = true;
    const auto f = render_frame(m.scene);
    EXPECT_NEAR(mean_of(*f, "Combined", 3), 1.0 / 16, 1e-3);
    EXPECT_NEAR(mean_of(*f), 2.0 / 16, 2e-3) << "the world does not show";
    m.scene.materials[0].graph = combined("ShaderNodeMixShader", emission(2), transparent(1), 0.25f);
    statistics::Moments alpha;
    for (std::uint32_t seed = 0; seed < 8; ++seed) alpha.add(mean_of(*render_frame(m.scene, seed), "Combined", 3));
    expect_value(alpha, 0.75 / 16, 0.02);
}

TEST(AnalyticCamera, HoldoutCutsAHole) {
    SceneMaker m = shining_square();
    m.add(floor_quad(-1, 100), emission(1));
    m.scene.settings.transparent_film = true;
    m.scene.instances[0].holdout = true;
    const auto f = render_frame(m.scene);
    EXPECT_NEAR(mean_of(*f, "Combined", 3), 15.0 / 16, 1e-3);
    EXPECT_EQ(pixel(*f, "Combined", 8, 8, 3), 0.0f);
    EXPECT_EQ(pixel(*f, "Combined", 8, 8), 0.0f) << "a holdout shows nothing of itself";
}

TEST(AnalyticCamera, HoldoutLightsOtherThings) {
    // In the picture a hole, to the floor below an emitter.
    SceneMaker m;
    m.add(floor_quad(0, 100), diffuse(0.5f));
    m.add(floor_quad(1, -4000), emission(1)).holdout = true;
    m.scene.settings.transparent_film = true;
    m.probe({0, -0.5f, 0.5f}, {0, 0, 0});
    expect_value(m.scene, 0.5, "Combined", 0.01, 1e-3);
    m.scene.materials[1].sample_emission = false;
    expect_value(m.scene, 0.5, "Combined", 0.01, 1e-3);
}

TEST(AnalyticCamera, HiddenFromTheCameraStillLights) {
    SceneMaker m;
    m.add(floor_quad(0, 100), diffuse(0.5f));
    m.add(floor_quad(1, -100), emission(1)).visibility = scene::visible_all & ~scene::visible_camera;
    m.perspective({0, 0, 4}, {0, 0, 0}, 0.1f);
    // The ceiling is seen as an endless plane of radiance 1.
    expect_value(m.scene, 0.5, "Combined", 0.01, 1e-3);
    m.scene.instances[1].visibility = scene::visible_all;
    EXPECT_NEAR(replicate(m.scene, "Combined", 1).mean, 1, 1e-5);
}

TEST(AnalyticCamera, LampsShowToTheCameraWhenAsked) {
    SceneMaker m;
    m.point_lamp({0, 0, 0}, 100, 0.5f).visibility = scene::visible_all;
    m.probe({0, 0, 4}, {0, 0, 0}, 2);
    m.scene.settings.width = m.scene.settings.height = 16;
    expect_value(m.scene, 100 / (4 * k_pi_d * k_pi_d * 0.25) * k_pi_d * 0.25 / 4, "D1", 0.01, 1e-4);
    m.scene.lights[0].visibility &= static_cast<std::uint8_t>(~scene::visible_camera);
    EXPECT_EQ(replicate(m.scene, "Combined", 1).mean, 0);
}

}  // namespace
}  // namespace cardioid::test
