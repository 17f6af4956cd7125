// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes with caustics whose lamps are large, so that path tracing can reach the caustic and be the judge of photons.
// Views avoid the edges of what they show: photons are counted on disks, and a disk over an edge is in part empty.
#pragma once

#include "analytic/scenes.h"

#include <cstdlib>
#include <string>

namespace cardioid::test {

/// CARDIOID_HEAVY=1: more samples and more variants, for a nightly run.
inline bool heavy() { return std::getenv("CARDIOID_HEAVY") != nullptr; }

/// One comparison of photons with path tracing; samples and photons are chosen for the intervals that tests ask for.
struct CausticCase {
    std::string name;
    scene::SceneDesc scene;
    int path_samples = heavy() ? 1024 : 384;  ///< of path tracing
    int photon_samples = heavy() ? 192 : 48;  ///< camera paths a pixel of the other two
    std::int64_t photons = 4000;              ///< emitted for each of them
    float radius = 0.4f;                      ///< first of the two radii, in footprints
    float finer =
        0.70710678f;     ///< second radius over the first: 1/√2 for a quadratic bias, 1/2 for the linear one of edges
    bool rough = false;  ///< lobes of class S that are no deltas: path tracing classes them otherwise
    double bound = 0.02;        ///< of whole pictures, relative
    double block_bound = 0.15;  ///< of each of the 16 blocks, relative to the larger of its own and the picture's mean
};

inline scene::GraphDesc tinted_glass(Float3 c, float ior) {
    return GraphMaker()
        .node("ShaderNodeBsdfGlass")
        .value("Color", {c.x, c.y, c.z, 1})
        .value("Roughness", {0})
        .value("IOR", {ior})
        .surface("BSDF");
}

inline void set_bounces(SceneMaker& m, int n) {
    scene::Settings& s = m.scene.settings;
    s.max_bounces = s.max_diffuse_bounces = s.max_glossy_bounces = s.max_transmission_bounces = n;
}

inline CausticCase caustic_case(const std::string& name, SceneMaker& m) {
    scene::Settings& s = m.scene.settings;
    s.width = s.height = 24;
    s.caustic_roughness = 0.1f;
    s.indirect_caustics = scene::IndirectCaustics::photons;  // photons make all they can
    CausticCase c;
    c.name = name;
    c.scene = m.scene;
    return c;
}

/// Room of 5 × 5 × 3.5 m without a front; a lamp at the ceiling shines down.
inline void add_room(SceneMaker& m, float albedo) {
    m.add(floor_quad(0, 5), diffuse(albedo));
    m.add(floor_quad(3.5f, -5), diffuse(albedo));
    m.add(quad({-2.5f, 0, 1.75f}, {0, 5, 0}, {0, 0, 3.5f}), diffuse(Float3{albedo, 0.3f * albedo, 0.3f * albedo}));
    m.add(quad({2.5f, 0, 1.75f}, {0, -5, 0}, {0, 0, 3.5f}), diffuse(Float3{0.3f * albedo, albedo, 0.3f * albedo}));
    m.add(quad({0, 2.5f, 1.75f}, {5, 0, 0}, {0, 0, 3.5f}), diffuse(albedo));
    m.area_lamp({0, 0, 3.4f}, {0, 0, 0}, 2, 2, 4);
}

inline CausticCase glass_and_chrome() {
    SceneMaker m;
    add_room(m, 0.7f);
    m.add(sphere({-0.7f, 0.2f, 0.8f}, 0.6f, 4, true), glass(1, 1.5f));
    m.add(sphere({0.75f, 0.3f, 0.7f}, 0.6f, 4, true), glossy(0.9f, 0));
    m.perspective({0, -2.4f, 2.2f}, {0, 0.2f, 0.3f}, 0.4f);
    CausticCase c = caustic_case("glass and chrome spheres", m);
    c.finer = 0.5f;  // the balls show the room's corners
    return c;
}

/// The wall's caustic, made by the glass sphere and by the floor's mirror half, is seen in the floor.
inline CausticCase half_mirror_floor() {
    SceneMaker m;
    m.add(floor_quad(0, 8), combined("ShaderNodeMixShader", diffuse(Float3{0.7f, 0.6f, 0.4f}), glossy(0.9f, 0), 0.5f));
    m.add(quad({0, 2, 2}, {8, 0, 0}, {0, 0, 8}), diffuse(Float3{0.6f, 0.7f, 0.8f}));
    m.add(sphere({0, 0.7f, 0.9f}, 0.6f, 4, true), glass(1, 1.5f));
    m.area_lamp({0, -2, 2.5f}, {0, 1, 0.9f}, 2, 2, 5);
    m.perspective({0.3f, -2.5f, 1.6f}, {0, 0.8f, -0.1f}, 0.3f);
    CausticCase c = caustic_case("half mirror floor", m);
    c.photon_samples *= 2;  // half of them do not gather
    return c;
}

/// The lamp's way down leads through a pane; the ceiling that is seen has only what the floor throws back.
inline CausticCase bouncing_caustic() {
    SceneMaker m;
    m.add(floor_quad(0, 8), diffuse(Float3{0.8f, 0.7f, 0.6f}));
    m.add(floor_quad(2.4f, -3), glass(1, 1.5f));
    m.add(floor_quad(2.5f, 3), glass(1, 1.5f));
    m.add(floor_quad(3.2f, -10), diffuse(0.6f));
    m.area_lamp({0, 0, 2.7f}, {0, 0, 0}, 1.6f, 1.6f, 6);
    m.perspective({2.8f, -3.2f, 0.8f}, {2.4f, 0.4f, 3.2f}, 0.3f);
    CausticCase c = caustic_case("caustic that bounces on", m);
    c.path_samples *= 4;
    c.photons *= 2;
    c.block_bound = 0.2;
    return c;
}

/// All light passes the shell of glass around the glowing sphere.
inline CausticCase glass_bulb() {
    SceneMaker m;
    m.add(floor_quad(0, 8), diffuse(Float3{0.7f, 0.5f, 0.3f}));
    m.add(quad({0, 1.5f, 2}, {8, 0, 0}, {0, 0, 8}), diffuse(0.5f));
    m.add(sphere({0, 0, 1}, 0.3f, 3, false), emission(3));
    m.add(sphere({0, 0, 1}, 0.6f, 4, true), glass(1, 1.5f));
    m.add(sphere({0, 0, 1}, -0.5f, 4, true), glass(1, 1.5f));  // inside out: the glass is between the two
    m.perspective({0.4f, -3, 2.5f}, {0.6f, -0.6f, 0.1f}, 0.3f);
    return caustic_case("lamp in a glass bulb", m);
}

inline CausticCase pool(bool physical) {
    SceneMaker m;
    m.add(floor_quad(0, 10), diffuse(Float3{0.4f, 0.6f, 0.7f}));
    m.add(floor_quad(0.8f, 10), glass(1, 1.33f));
    m.area_lamp({0.5f, 0.5f, 3}, {0, 0, 0}, 3, 3, 5);
    m.perspective({0, -3.5f, 2.4f}, {0, 0.2f, 0}, 0.3f);
    m.scene.settings.physical_refraction = physical;
    return caustic_case(physical ? "under water, physical" : "under water", m);
}

/// Few flat faces that pretend to be round: shading and geometric normals differ by up to 20 degrees.
inline CausticCase coarse_ball(bool of_glass) {
    SceneMaker m;
    m.add(floor_quad(0, 8), diffuse(0.6f));
    const float height = of_glass ? 1.2f : 0.8f;
    m.add(sphere({-0.5f, 0, height}, 0.7f, 2, true), of_glass ? glass(1, 1.5f) : glossy(0.9f, 0));
    if (of_glass)
        m.area_lamp({-1, 0, 3.2f}, {-0.5f, 0, 0}, 2, 2, 5);
    else
        m.area_lamp({1.5f, -0.3f, 1.3f}, {-0.5f, 0, 0.8f}, 1, 1, 8);
    m.perspective({0, -3, 2.5f}, {of_glass ? -0.3f : 0.3f, 0, 0.1f}, 0.3f);
    return caustic_case(of_glass ? "coarse glass ball" : "coarse mirror ball", m);
}

/// A smooth-shaded coarse ball of chalk under a pane.
inline CausticCase coarse_receiver() {
    SceneMaker m;
    m.add(sphere({0, 0, 0}, 0.8f, 1, true), diffuse(0.7f));
    m.add(floor_quad(1.3f, -6), glass(1, 1.5f));
    m.add(floor_quad(1.4f, 6), glass(1, 1.5f));
    m.area_lamp({-1, -1, 2.6f}, {0, 0, 0}, 2, 2, 5);
    m.perspective({0, -3, 1}, {0, 0, 0.1f}, 0.3f);
    m.scene.settings.transparent_film = true;
    CausticCase c = caustic_case("coarse chalk ball", m);
    c.finer = 0.5f;
    c.photons *= 4;
    // Light that grazes a face and shines on its pretended roundness: rare bright photons.
    c.bound = 0.025;
    c.block_bound = 0.3;
    return c;
}

inline CausticCase through_a_mirror() {
    SceneMaker m;
    m.add(floor_quad(0, 8), diffuse(Float3{0.7f, 0.6f, 0.5f}));
    m.add(sphere({0, 0, 0.9f}, 0.7f, 4, true), tinted_glass({0.6f, 0.9f, 1.0f}, 1.5f));
    m.add(quad({0, 1.8f, 1.5f}, {6, 0, 0}, {0, 0, 3}), glossy(0.9f, 0));
    m.area_lamp({0.5f, -0.5f, 3.4f}, {0, 0, 0}, 2, 2, 5);
    m.perspective({0, 0.2f, 2.6f}, {0, 1.8f, 1.3f}, 0.25f);
    return caustic_case("in a mirror", m);
}

/// Metal that is class S and no delta: light samples and hits of the lamp both count at it.
inline CausticCase rough_metal() {
    SceneMaker m;
    m.add(floor_quad(0, 8), diffuse(0.6f));
    m.add(quad({0, 1, 1}, {5, 0, 0}, {0, 0, 2}),
          combined("ShaderNodeMixShader", diffuse(Float3{0.2f, 0.3f, 0.6f}), glossy(0.9f, 0.25f), 0.6f));
    m.add(sphere({0.6f, 0, 0.5f}, 0.4f, 4, true), glossy(0.8f, 0.2f));
    m.area_lamp({0, -2, 2.5f}, {0, 0.7f, 0.5f}, 1.5f, 1.5f, 5);
    m.perspective({-0.3f, -2.5f, 2}, {0.1f, 0.4f, 0.4f}, 0.3f);
    CausticCase c = caustic_case("rough metal", m);
    c.scene.settings.caustic_roughness = 0.3f;
    c.rough = true;
    return c;
}

}  // namespace cardioid::test
