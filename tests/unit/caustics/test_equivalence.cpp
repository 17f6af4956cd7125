// SPDX-License-Identifier: GPL-3.0-or-later
// Path tracing, the hybrid and photon mapping are one picture in expectation, class by class
// where classes mean the same.
#include "caustics/compare.h"

#include <map>

namespace cardioid::test {
namespace {

using scene::IntegratorKind;

/// Renders of path tracing, made once for all tests of a scene.
const Pictures& judge_of(const CausticCase& c) {
    static std::map<std::string, Pictures> made;
    const auto [at, fresh] = made.try_emplace(c.name);
    if (fresh) at->second = pictures(path_traced(c), 1000);
    return at->second;
}

void expect_agreement(const std::string& what, const Agreement& a) {
    std::printf("%-40s %s\n", what.c_str(), a.report.c_str());
    EXPECT_TRUE(a.agree) << what << ": " << a.report;
}

/// Bounds of a single class; a class with little light is bounded relative to the picture.
void expect_classes(const CausticCase& c, const Pictures& judge, const Pictures& tested,
                    std::initializer_list<std::size_t> classes, const std::string& what) {
    const double picture = moments_of(judge, [](const auto& m) { return m[0].whole; }).mean;
    for (const std::size_t k : classes) {
        const double own = moments_of(judge, [k](const auto& m) { return m[k].whole; }).mean;
        const double scale = std::max(own, 0.1 * picture);
        expect_agreement(c.name + ", " + what, compare_pass(judge, tested, k, 0.06, 0, scale));
    }
}

constexpr std::initializer_list<std::size_t> k_all_classes = {1, 2, 3, 4, 5};

void expect_hybrid(const CausticCase& c) {
    const Pictures& judge = judge_of(c);
    const Pictures hybrid = photon_pictures(c, with_photons(c, IntegratorKind::hybrid), 2000);
    expect_agreement(c.name + ", hybrid", compare_pass(judge, hybrid, 0, c.bound, c.block_bound));
    // Path tracing takes every rough lobe for class D.
    if (!c.rough) expect_classes(c, judge, hybrid, k_all_classes, "hybrid");
}

void expect_photon_mapping(const CausticCase& c) {
    const Pictures& judge = judge_of(c);
    const Pictures photons = photon_pictures(c, with_photons(c, IntegratorKind::photon_mapping), 3000);
    // Direct light is noisier by photons than by connections.
    expect_agreement(c.name + ", photons", compare_pass(judge, photons, 0, c.bound, 2 * c.block_bound));
    if (!c.rough) expect_classes(c, judge, photons, {1, 2, 3}, "photons");
}

TEST(Equivalence, GlassAndChromeHybrid) { expect_hybrid(glass_and_chrome()); }
TEST(Equivalence, GlassAndChromePhotons) { expect_photon_mapping(glass_and_chrome()); }
TEST(Equivalence, HalfMirrorFloorHybrid) { expect_hybrid(half_mirror_floor()); }
TEST(Equivalence, HalfMirrorFloorPhotons) { expect_photon_mapping(half_mirror_floor()); }
TEST(Equivalence, BouncingCausticHybrid) { expect_hybrid(bouncing_caustic()); }
TEST(Equivalence, BouncingCausticPhotons) { expect_photon_mapping(bouncing_caustic()); }
TEST(Equivalence, GlassBulbHybrid) { expect_hybrid(glass_bulb()); }
TEST(Equivalence, GlassBulbPhotons) { expect_photon_mapping(glass_bulb()); }
TEST(Equivalence, UnderWaterHybrid) { expect_hybrid(pool(false)); }
TEST(Equivalence, UnderWaterPhotons) { expect_photon_mapping(pool(false)); }
TEST(Equivalence, UnderWaterPhysicalHybrid) { expect_hybrid(pool(true)); }
TEST(Equivalence, UnderWaterPhysicalPhotons) { expect_photon_mapping(pool(true)); }
TEST(Equivalence, CoarseMirrorBallHybrid) { expect_hybrid(coarse_ball(false)); }
TEST(Equivalence, CoarseMirrorBallPhotons) { expect_photon_mapping(coarse_ball(false)); }
TEST(Equivalence, CoarseGlassBallHybrid) { expect_hybrid(coarse_ball(true)); }
TEST(Equivalence, CoarseGlassBallPhotons) { expect_photon_mapping(coarse_ball(true)); }
TEST(Equivalence, CoarseReceiverHybrid) { expect_hybrid(coarse_receiver()); }
TEST(Equivalence, CoarseReceiverPhotons) { expect_photon_mapping(coarse_receiver()); }
TEST(Equivalence, ThroughAMirrorHybrid) { expect_hybrid(through_a_mirror()); }
TEST(Equivalence, ThroughAMirrorPhotons) { expect_photon_mapping(through_a_mirror()); }
TEST(Equivalence, RoughMetalHybrid) { expect_hybrid(rough_metal()); }
TEST(Equivalence, RoughMetalPhotons) { expect_photon_mapping(rough_metal()); }

void expect_variant(const CausticCase& c, const scene::SceneDesc& scene, const std::string& what, bool rough = false) {
    const Pictures tested = photon_pictures(c, scene, 4000);
    expect_agreement(c.name + ", " + what, compare_pass(judge_of(c), tested, 0, c.bound, c.block_bound));
    if (!rough) expect_classes(c, judge_of(c), tested, {4, 5}, what);
}

TEST(Variants, GuideAndBlendedHits) {
    for (const bool guided : {false, true}) {
        for (const bool blended : {false, true}) {
            if (guided && blended) continue;  // all tests above
            const CausticCase c = glass_and_chrome();
            scene::SceneDesc scene = with_photons(c, IntegratorKind::hybrid);
            scene.settings.guided_emission = guided;
            scene.settings.blend_caustic_hits = blended;
            expect_variant(c, scene, std::string(guided ? "guided" : "not guided") + (blended ? ", blended" : ""));
        }
    }
}

TEST(Variants, PhotonMappingWithoutGuide) {
    const CausticCase c = half_mirror_floor();
    scene::SceneDesc scene = with_photons(c, IntegratorKind::photon_mapping);
    scene.settings.guided_emission = false;
    scene.settings.photons *= 2;
    expect_variant(c, scene, "photons, not guided", true);
}

TEST(Variants, ShrinkingRadii) {
    for (const auto schedule : {scene::RadiusSchedule::memoryless, scene::RadiusSchedule::per_pixel}) {
        for (const float shrink : {2.0f / 3, 1.0f}) {
            const bool memoryless = schedule == scene::RadiusSchedule::memoryless;
            if (memoryless && shrink == 1) continue;  // all tests above
            const CausticCase c = glass_and_chrome();
            scene::SceneDesc scene = with_photons(c, IntegratorKind::hybrid);
            scene.settings.radius_schedule = schedule;
            scene.settings.radius_shrink = shrink;
            if (!memoryless) scene.settings.photons *= 6;  // one hit point a pass
            expect_variant(c, scene, memoryless ? "memoryless" : shrink == 1 ? "per pixel, fixed" : "per pixel");
        }
    }
}

TEST(Variants, IndirectCausticsByPathTracing) {
    const CausticCase c = glass_and_chrome();
    scene::SceneDesc scene = with_photons(c, IntegratorKind::hybrid);
    scene.settings.indirect_caustics = scene::IndirectCaustics::path_tracing;
    expect_variant(c, scene, "C2 path traced");
}

TEST(Variants, IndirectCausticsOff) {
    const CausticCase c = glass_and_chrome();
    scene::SceneDesc scene = with_photons(c, IntegratorKind::hybrid);
    scene.settings.indirect_caustics = scene::IndirectCaustics::off;
    const Pictures tested = photon_pictures(c, scene, 5000);
    for (const auto& p : tested) EXPECT_EQ(p[5].whole, 0);
    // The judge without its C2.
    Pictures judge = judge_of(c);
    for (auto& p : judge) {
        p[0].whole -= p[5].whole;
        for (std::size_t b = 0; b < k_blocks; ++b) p[0].block[b] -= p[5].block[b];
        p[5] = Means{};
    }
    expect_agreement(c.name + ", C2 off", compare_pass(judge, tested, 0, c.bound, c.block_bound));
    expect_classes(c, judge, tested, {1, 2, 3, 4}, "C2 off");
}

/// Bounces are counted over both halves of a path together, in all and by kind.
void expect_same_limits(const std::string& name, scene::SceneDesc scene) {
    CausticCase c = glass_and_chrome();
    c.name = name;
    c.scene = std::move(scene);
    expect_hybrid(c);
    expect_photon_mapping(c);
}

TEST(BounceLimits, InAll) {
    for (const int limit : {2, 3, 4}) {
        if (limit != 3 && !heavy()) continue;
        scene::SceneDesc scene = glass_and_chrome().scene;
        scene.settings.max_bounces = limit;
        expect_same_limits("limit " + std::to_string(limit), scene);
    }
}

TEST(BounceLimits, ByKind) {
    // Two on the lamp's side and two on the camera's: together one too many.
    scene::SceneDesc transmission = glass_and_chrome().scene;
    transmission.settings.max_transmission_bounces = 3;
    expect_same_limits("three transmissions", transmission);
    scene::SceneDesc diffuse = glass_and_chrome().scene;
    diffuse.settings.max_diffuse_bounces = 1;
    expect_same_limits("one diffuse bounce", diffuse);
    if (!heavy()) return;
    scene::SceneDesc glossy = glass_and_chrome().scene;
    glossy.settings.max_glossy_bounces = 0;
    expect_same_limits("no glossy bounce", glossy);
}

}  // namespace
}  // namespace cardioid::test
