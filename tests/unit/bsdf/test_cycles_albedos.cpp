// SPDX-License-Identifier: GPL-3.0-or-later
// Directional albedos that Cycles of Blender 3.4.1, 4.5 and 5.0 renders under a white world (record_cycles_albedos.py, 131072
// samples each) against ours: the same closure has the same brightness at every angle.
#include "model.h"

#include <gtest/gtest.h>

#include <vector>

namespace cardioid::test {
namespace {

using bsdf::Fresnel;
using bsdf::LobeKind;

struct Recorded {
    const char* name;
    bsdf::Lobe lobe;
    float albedo[3];  ///< green, at cosines 1, 0.6, 0.25
    float tolerance;
};

bsdf::Lobe grey(bsdf::Lobe l, float color) {
    fill3(l.weight, color, color, color);
    fill3(l.f0, color, color, color);
    return l;
}
bsdf::Lobe compensated(bsdf::Lobe l) {
    l.preserve_energy = true;
    return l;
}
bsdf::Lobe with_f0(bsdf::Lobe l, float f0, float f90 = 1) {
    fill3(l.f0, f0, f0, f0);
    fill3(l.f90, f90, f90, f90);
    return l;
}

/// Noise of both sides is about 0.001; larger tolerances say why.
std::vector<Recorded> recorded() {
    constexpr float k_noise = 0.003f;
    constexpr float k_glass = 0.006f;  // Cycles loses about 0.4 % of what it refracts, even straight on
    constexpr float k_sheen = 0.012f;  // rational fits instead of Cycles' table
    const auto ggx = [](float r, Fresnel f = Fresnel::none, float eta = 1.5f) {
        return lobe_of(LobeKind::ggx_reflection, r, f, eta);
    };
    const bsdf::Lobe glass = lobe_of(LobeKind::ggx_glass, 0.5f, Fresnel::dielectric, 1.5f);
    const bsdf::Lobe inside = lobe_of(LobeKind::ggx_glass, 0.5f, Fresnel::dielectric, 1 / 1.5f);
    const bsdf::Lobe rough = lobe_of(LobeKind::diffuse, 1);
    return {
        // 3.4.1
        {"diffuse 3.4", rough, {0.7765f, 0.8404f, 0.9334f}, k_noise},
        {"velvet", lobe_of(LobeKind::velvet, 0.5f), {0.0037f, 0.1834f, 0.6057f}, k_noise},
        {"burley 0.5", lobe_of(LobeKind::burley, 0.5f), {1.0060f, 1.0057f, 1.0225f}, k_noise},
        {"burley 1", lobe_of(LobeKind::burley, 1), {1.0357f, 1.0405f, 1.1934f}, k_noise},
        {"sheen v1", lobe_of(LobeKind::sheen_v1, 0.5f), {0.0003f, 0.0098f, 0.0407f}, k_noise},
        {"specular v1", with_f0(ggx(0.5f, Fresnel::principled_v1), 0.04f), {0.0370f, 0.0548f, 0.1159f}, k_noise},
        {"glossy 0.3, 3.4", ggx(0.3f), {0.9907f, 0.9816f, 0.9311f}, k_noise},
        // 4.5
        {"diffuse", compensated(rough), {1, 1, 1}, k_noise},
        {"diffuse grey", compensated(grey(rough, 0.5f)), {0.4136f, 0.4383f, 0.4743f}, k_noise},
        {"glossy 0.3", ggx(0.3f), {0.9907f, 0.9813f, 0.9317f}, k_noise},
        {"glossy 0.7", ggx(0.7f), {0.6978f, 0.6946f, 0.7685f}, k_noise},
        {"glossy multi grey", compensated(grey(ggx(0.7f), 0.5f)), {0.4115f, 0.4105f, 0.4322f}, k_noise},
        {"glass", glass, {0.9883f, 0.9692f, 0.9209f}, k_glass},
        {"glass inside", inside, {0.9256f, 0.8432f, 0.7938f}, k_glass},
        {"glass multi", compensated(glass), {0.9965f, 0.9982f, 0.9994f}, k_glass},
        {"refraction", lobe_of(LobeKind::ggx_refraction, 0.5f), {0.9956f, 0.9879f, 0.9702f}, k_glass},
        {"sheen 0.3", lobe_of(LobeKind::sheen, 0.3f), {0.0008f, 0.0097f, 0.1657f}, k_sheen},
        {"sheen 0.6", lobe_of(LobeKind::sheen, 0.6f), {0.0504f, 0.1778f, 0.4352f}, k_sheen},
        {"sheen 1", lobe_of(LobeKind::sheen, 1), {0.3419f, 0.4589f, 0.6196f}, k_sheen},
        {"specular v2", compensated(with_f0(ggx(0.5f, Fresnel::schlick), 0.04f)), {0.0373f, 0.0555f, 0.1206f}, k_noise},
        {"coat", compensated(ggx(0.3f, Fresnel::dielectric)), {0.0397f, 0.0647f, 0.2114f}, k_noise},
        {"metal", compensated(with_f0(ggx(0.5f, Fresnel::f82), 0.6f, 0.9f)), {0.5789f, 0.5684f, 0.5706f}, k_noise},
        {"conductor", with_f0(ggx(0.3f, Fresnel::conductor), 2.513f, 3.404f), {0.5744f, 0.5595f, 0.5256f}, 0.005f},
    };
}

bsdf::Lobe facets(bsdf::Lobe l, bsdf::Distribution distribution, bool separable = false) {
    l.distribution = distribution;
    l.separable_masking = separable;
    return l;
}
bsdf::Lobe toon(LobeKind kind, float size, float smooth) {
    bsdf::Lobe l = lobe_of(kind, size);
    fill(l.alpha_x, smooth);
    return l;
}
bsdf::Lobe film(bsdf::Lobe l) {
    l.thin_film = true;
    fill(l.roughness, 400);
    fill(l.film_ior, 1.8f);
    return l;
}
/// Principled Hair by absorption, on a surface whose tangent is in the plane of wo: h is 0.
bsdf::Lobe strand() {
    bsdf::Lobe l = lobe_of(LobeKind::hair_chiang, 1);
    fill(l.alpha_x, 0.3f);
    fill(l.alpha_y, 0.3f);
    fill3(l.f0, 0.245531f, 0.52f, 1.365f);
    fill3(l.f90, 0, 0.0349066f, 0);
    fill(l.eta, 1.55f);
    return l;
}

/// Distributions other than GGX, toon, hair and films; 5.0 where nothing else is said.
std::vector<Recorded> recorded_special() {
    using bsdf::Distribution;
    constexpr float k_noise = 0.003f;
    constexpr float k_film = 0.005f;  // colour matching by a fit
    const auto ggx = [](float r, Fresnel f = Fresnel::none) { return lobe_of(LobeKind::ggx_reflection, r, f); };
    const auto reflect = [&](float r, Distribution d, bool separable = false) { return facets(ggx(r), d, separable); };
    const bsdf::Lobe refraction = lobe_of(LobeKind::ggx_refraction, 0.5f);
    const bsdf::Lobe glass = lobe_of(LobeKind::ggx_glass, 0.5f, Fresnel::dielectric);
    const bsdf::Lobe smooth = lobe_of(LobeKind::ggx_glass, 0.2f, Fresnel::dielectric);
    return {
        {"glossy 0.7, 3.4", reflect(0.7f, Distribution::ggx, true), {0.6978f, 0.6874f, 0.7302f}, k_noise},
        {"refraction, 3.4", facets(refraction, Distribution::ggx, true), {0.9996f, 0.9902f, 0.9662f}, k_noise},
        // 3.4 and later have a fit of Beckmann's masking.
        {"beckmann 0.6, 3.4", reflect(0.6f, Distribution::beckmann, true), {0.9967f, 0.9201f, 0.9064f}, 0.006f},
        {"beckmann 1, 3.4", reflect(1, Distribution::beckmann, true), {0.4616f, 0.7109f, 0.8593f}, 0.006f},
        {"beckmann 0.3", reflect(0.3f, Distribution::beckmann), {1.0f, 1.0f, 0.981f}, k_noise},
        {"beckmann 0.6", reflect(0.6f, Distribution::beckmann), {0.9967f, 0.9175f, 0.9044f}, k_noise},
        {"beckmann 1", reflect(1, Distribution::beckmann), {0.4616f, 0.7136f, 0.8849f}, k_noise},
        {"ashikhmin 0.3", reflect(0.3f, Distribution::ashikhmin_shirley), {0.9839f, 0.9245f, 0.8012f}, k_noise},
        {"beckmann refraction", facets(refraction, Distribution::beckmann), {1, 1, 1}, k_noise},
        {"beckmann glass", facets(glass, Distribution::beckmann), {1, 0.9936f, 0.9515f}, k_noise},
        {"toon diffuse", toon(LobeKind::toon_diffuse, 0.4f, 0.3f), {0.653f, 0.653f, 0.653f}, k_noise},
        {"toon glossy", toon(LobeKind::toon_glossy, 0.4f, 0.3f), {0.653f, 0.5885f, 0.4366f}, k_noise},
        {"toon sharp", toon(LobeKind::toon_glossy, 0.6f, 0), {1, 0.8838f, 0.6565f}, k_noise},
        {"principled hair 0.3", strand(), {0.3732f, 0.3333f, 0.4233f}, k_noise},
        {"film specular", film(with_f0(ggx(0.2f, Fresnel::schlick), 0.04f)), {0.1068f, 0.1519f, 0.2969f}, k_film},
        {"film glass", film(smooth), {0.9998f, 0.9991f, 0.9923f}, k_film},
        {"film metal", film(with_f0(ggx(0.2f, Fresnel::f82), 0.577f, 0.726f)), {0.4391f, 0.2521f, 0.5169f}, k_film},
        {"film conductor",
         film(with_f0(ggx(0.2f, Fresnel::conductor), 2.513f, 3.404f)),
         {0.4789f, 0.2591f, 0.5049f},
         k_film},
    };
}

float albedo(const bsdf::Lobe& lobe, float cosine) {
    // A regular lattice (Kronecker sequence of the plastic number's cubic relatives) instead of random numbers.
    constexpr int k_draws = 1 << 17;
    const Vec3 wo = direction(cosine, 0);
    double sum = 0;
    for (int k = 0; k < k_draws; k += W) {
        float u[3][W];
        for (int l = 0; l < W; ++l) {
            const double n = k + l + 0.5, steps[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
            for (int d = 0; d < 3; ++d) u[d][l] = static_cast<float>(std::fmod(n * steps[d], 1.0)) * 0.9999999f;
        }
        const LobeSample s =
            sample_lobe(lobe, 0, wo, {0.0f, 0.0f, 1.0f}, {load(u[0]), load(u[1]), load(u[2])}, mask_of(true));
        sum += static_cast<double>(hsum(select(s.valid, s.f_cos.g / max(s.pdf, 1e-30f), Float(0.0f))));
    }
    return static_cast<float>(sum / k_draws);
}

TEST(CyclesAlbedos, AreOurs) {
    constexpr float k_cosines[3] = {1, 0.6f, 0.25f};
    std::vector<Recorded> all = recorded();
    for (const Recorded& r : recorded_special()) all.push_back(r);
    for (const Recorded& r : all)
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(albedo(r.lobe, k_cosines[k]), r.albedo[k], r.tolerance) << r.name << " " << k_cosines[k];
}

}  // namespace
}  // namespace cardioid::test
