// SPDX-License-Identifier: GPL-3.0-or-later
// What closure nodes leave for media, subsurface, distributions and hair.
#include "chunks.h"
#include "graphs.h"
#include "nodes/compile.h"
#include "nodes/run.h"

#include <gtest/gtest.h>

#include <memory>

namespace cardioid::test {
namespace {

using namespace nodes;

struct Ran {
    CompiledGraph graph;
    Warnings warnings;
    std::unique_ptr<bsdf::Lobe[]> lobes = std::make_unique<bsdf::Lobe[]>(bsdf::k_max_lobes);
    std::unique_ptr<VolumeOutput> medium = std::make_unique<VolumeOutput>();
    std::unique_ptr<SurfaceOutput> out = std::make_unique<SurfaceOutput>();
};

std::unique_ptr<Ran> run(const scene::GraphDesc& graph, Purpose purpose) {
    auto r = std::make_unique<Ran>();
    std::vector<std::string> names;
    CompileContext context;
    context.name = "test";
    context.attribute_names = &names;
    r->graph = compile(graph, context, r->warnings);
    r->out->lobe = r->lobes.get();
    r->out->volume = r->medium.get();
    auto chunk = std::make_unique<ShadingChunk>();
    chunk->n = 1;
    for (int i = 0; i < k_chunk; ++i) {
        chunk->normal[2][i] = chunk->normal_geometric[2][i] = chunk->wo[2][i] = 1;
        chunk->dp_du[0][i] = chunk->dp_dv[1][i] = 1;
        chunk->instance[i] = -1;
    }
    auto scratch = std::make_unique<Scratch>();
    isa_w1::run_program(r->graph.of(purpose), *chunk, *r->out, *scratch);
    return r;
}

scene::GraphDesc as_volume(GraphMaker& m) {
    m.graph.volume = {m.index(), "Volume"};
    return m.graph;
}

TEST(Media, AbsorptionAndScatteringAreApart) {
    GraphMaker m;
    m.node("ShaderNodeVolumeScatter")
        .value("Color", {0.5f, 0.25f, 1})
        .value("Density", {2})
        .value("Anisotropy", {0.3f});
    m.node("ShaderNodeVolumeAbsorption").value("Color", {0.8f, 1, 0}).value("Density", {3});
    m.node("ShaderNodeAddShader").link("Shader", 0, "Volume").link("Shader_001", 1, "Volume");
    const auto r = run(as_volume(m), Purpose::volume);
    EXPECT_TRUE(r->graph.info.has_volume);
    EXPECT_TRUE(r->graph.info.constant_volume);
    ASSERT_EQ(r->medium->phases, 1);
    EXPECT_EQ(r->medium->phase[0].kind, PhaseKind::henyey_greenstein);
    EXPECT_FLOAT_EQ(r->medium->phase[0].parameter[0][0], 0.3f);
    const float scatter[3] = {1, 0.5f, 2}, absorbed[3] = {0.6f, 0, 3};
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(r->medium->phase[0].scatter[c][0], scatter[c], 1e-6f);
        EXPECT_NEAR(r->medium->absorption[c][0], absorbed[c], 1e-6f);
    }
}

TEST(Media, EqualPhasesAreOne) {
    GraphMaker m;
    for (const float density : {1.0f, 2.0f, 4.0f})
        m.node("ShaderNodeVolumeScatter")
            .value("Color", {1, 1, 1})
            .value("Density", {density})
            .value("Anisotropy", {0.5f});
    m.node("ShaderNodeAddShader").link("Shader", 0, "Volume").link("Shader_001", 1, "Volume");
    m.node("ShaderNodeAddShader").link("Shader", 3, "Shader").link("Shader_001", 2, "Volume");
    const auto r = run(as_volume(m), Purpose::volume);
    ASSERT_EQ(r->medium->phases, 1);
    EXPECT_FLOAT_EQ(r->medium->phase[0].scatter[0][0], 7);
}

TEST(Media, PrincipledVolumeAbsorbsWhatItDoesNotScatter) {
    GraphMaker m;
    m.node("ShaderNodeVolumePrincipled").value("Color", {0.5f, 0.5f, 0.5f}).value("Density", {2});
    m.value("Absorption Color", {0.25f, 0, 1}).value("Emission Strength", {3}).value("Emission Color", {1, 0.5f, 0});
    const auto r = run(as_volume(m), Purpose::volume);
    ASSERT_EQ(r->medium->phases, 1);
    EXPECT_FLOAT_EQ(r->medium->phase[0].scatter[1][0], 1);
    const float absorbed[3] = {0.5f, 1, 0}, emitted[3] = {3, 1.5f, 0};
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(r->medium->absorption[c][0], absorbed[c], 1e-6f);
        EXPECT_NEAR(r->medium->emission[c][0], emitted[c], 1e-6f);
    }
}

TEST(Media, SurfacesAndVolumesShareNodesWithoutMixing) {
    GraphMaker m;
    m.node("ShaderNodeEmission").value("Color", {1, 1, 1}).value("Strength", {5});
    m.graph.surface = {0, "Emission"};
    m.graph.volume = {0, "Emission"};
    const auto medium = run(m.graph, Purpose::volume), surface = run(m.graph, Purpose::surface);
    EXPECT_FLOAT_EQ(medium->medium->emission[0][0], 5);
    EXPECT_FLOAT_EQ(medium->out->emission[0][0], 0);
    EXPECT_FLOAT_EQ(surface->out->emission[0][0], 5);
    EXPECT_FLOAT_EQ(surface->medium->emission[0][0], 0);
}

TEST(Subsurface, MethodsOfBothNamings) {
    const auto lobe = [](const char* method, bool modern) {
        GraphMaker m;
        m.node("ShaderNodeSubsurfaceScattering").value("Color", {0.8f, 0.4f, 0.2f}).value("Radius", {1, 0.5f, 0.25f});
        m.value("Scale", {0.1f}).param("falloff", std::string(method));
        if (modern) m.value("Roughness", {0.5f});
        auto r = run(m.surface("BSSRDF"), Purpose::surface);
        EXPECT_TRUE(r->graph.info.has_subsurface);
        EXPECT_EQ(r->graph.info.lobes, 1);
        EXPECT_EQ(r->lobes[0].kind, bsdf::LobeKind::subsurface);
        return r;
    };
    constexpr float k_compatible = 0.25f / 3.14159265f;
    EXPECT_NEAR(lobe("BURLEY", true)->lobes[0].f90[0][0], 0.1f * k_compatible, 1e-6f);
    EXPECT_TRUE(lobe("BURLEY", true)->lobes[0].preserve_energy);
    EXPECT_NEAR(lobe("RANDOM_WALK", true)->lobes[0].f90[1][0], 0.05f * k_compatible, 1e-6f);
    EXPECT_EQ(lobe("RANDOM_WALK", true)->lobes[0].fresnel, bsdf::Fresnel::dielectric);
    EXPECT_FLOAT_EQ(lobe("RANDOM_WALK", true)->lobes[0].alpha_x[0], 0.5f);
    EXPECT_NEAR(lobe("RANDOM_WALK_FIXED_RADIUS", false)->lobes[0].f90[0][0], 0.1f * k_compatible, 1e-6f);
    const auto skin = lobe("RANDOM_WALK_SKIN", true), old = lobe("RANDOM_WALK", false);
    EXPECT_EQ(skin->lobes[0].fresnel, bsdf::Fresnel::schlick);
    EXPECT_EQ(old->lobes[0].fresnel, bsdf::Fresnel::none);
    // By the dipole's formula, computed in double: albedo 0.8, 0.4, 0.2 and index 1.4.
    const float skin_radius[3] = {0.0071603f, 0.0182050f, 0.0187133f};
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(skin->lobes[0].f90[c][0], skin_radius[c], 2e-6f);
    EXPECT_FLOAT_EQ(skin->lobes[0].f90[2][0], old->lobes[0].f90[2][0]);
}

TEST(Distributions, ReachTheirLobes) {
    const auto lobe = [](const char* distribution, double version) {
        GraphMaker m;
        m.node("ShaderNodeBsdfAnisotropic").value("Color", {1, 1, 1}).value("Roughness", {0.5f});
        m.param("distribution", std::string(distribution)).param("version", version);
        return run(m.surface("BSDF"), Purpose::surface);
    };
    EXPECT_EQ(lobe("BECKMANN", 2)->lobes[0].distribution, bsdf::Distribution::beckmann);
    EXPECT_EQ(lobe("ASHIKHMIN_SHIRLEY", 2)->lobes[0].distribution, bsdf::Distribution::ashikhmin_shirley);
    EXPECT_FALSE(lobe("GGX", 2)->lobes[0].separable_masking);
    EXPECT_TRUE(lobe("GGX", 1)->lobes[0].separable_masking);
}

}  // namespace
}  // namespace cardioid::test
