// SPDX-License-Identifier: GPL-3.0-or-later
#include "nodes/run.h"

#include "nodes/chunks.h"
#include "nodes/compile.h"
#include "nodes/graphs.h"

#include "simd/lanes.h"

#include <gtest/gtest.h>

namespace cardioid {
namespace {

using nodes::Purpose;
using test::GraphMaker;

std::unique_ptr<test::Machine> run(const scene::GraphDesc& graph, Purpose purpose = Purpose::surface, int n = k_chunk) {
    nodes::Warnings warnings;
    nodes::CompileContext context;
    const auto g = nodes::compile(graph, context, warnings);
    auto m = std::make_unique<test::Machine>(n);
    CD_ISA_NS::run_program(g.of(purpose), m->chunk, m->out, m->scratch);
    return m;
}

TEST(Run, DiffuseGivesOneLobe) {
    const auto m =
        run(GraphMaker().node("ShaderNodeBsdfDiffuse").value("Color", {0.5f, 0.4f, 0.3f, 1}).surface("BSDF"));
    ASSERT_EQ(m->out.lobes, 1);
    const bsdf::Lobe& lobe = m->lobes[0];
    EXPECT_EQ(lobe.kind, bsdf::LobeKind::diffuse);
    for (int i = 0; i < k_chunk; ++i) {
        EXPECT_EQ(lobe.weight[0][i], 0.5f);
        EXPECT_EQ(lobe.weight[2][i], 0.3f);
        EXPECT_EQ(lobe.normal[0][i], m->chunk.normal[0][i]);
        EXPECT_EQ(m->out.emission[0][i], 0);
        EXPECT_EQ(m->out.transparency[1][i], 0);
    }
}

TEST(Run, PartialChunkFillsItsLastStep) {
    const auto m = run(
        GraphMaker().node("ShaderNodeEmission").value("Color", {1, 2, 3, 1}).value("Strength", {2}).surface("Emission"),
        Purpose::emission, 5);
    for (int i = 0; i < (5 + CD_ISA_NS::W - 1) / CD_ISA_NS::W * CD_ISA_NS::W; ++i) EXPECT_EQ(m->out.emission[2][i], 6);
}

TEST(Run, GlassTurnsItsIndexOverInside) {
    const auto m =
        run(GraphMaker().node("ShaderNodeBsdfGlass").value("Color", {1, 1, 1, 1}).value("IOR", {1.5f}).surface("BSDF"));
    ASSERT_EQ(m->out.lobes, 1);
    for (int i = 0; i < k_chunk; ++i) EXPECT_FLOAT_EQ(m->lobes[0].eta[i], m->chunk.backfacing[i] > 0 ? 1 / 1.5f : 1.5f);
}

scene::GraphDesc principled(int version, std::initializer_list<std::pair<const char*, float>> values) {
    GraphMaker m;
    m.node("ShaderNodeBsdfPrincipled")
        .param("version", static_cast<double>(version))
        .value("Base Color", {0.8f, 0.6f, 0.4f, 1});
    for (const auto& [id, v] : values) m.value(id, {v, v, v, 1});
    return m.surface("BSDF");
}

TEST(Run, PrincipledOneMetalHasNoDiffuse) {
    const auto m = run(principled(1, {{"Metallic", 1}, {"Specular", 0.5f}, {"Roughness", 0.3f}}));
    ASSERT_EQ(m->out.lobes, 1);
    EXPECT_EQ(m->lobes[0].kind, bsdf::LobeKind::ggx_reflection);
    EXPECT_FLOAT_EQ(m->lobes[0].f0[1][7], 0.6f);
    EXPECT_FLOAT_EQ(m->lobes[0].alpha_x[7], 0.09f);
}

TEST(Run, PrincipledTwoDiffuseGetsWhatSpecularLeaves) {
    const auto m = run(principled(2, {{"IOR", 1.5f}, {"Specular IOR Level", 0.5f}, {"Roughness", 0.5f}}));
    ASSERT_EQ(m->out.lobes, 2);
    EXPECT_EQ(m->lobes[1].kind, bsdf::LobeKind::diffuse);
    for (int i = 0; i < k_chunk; ++i) {
        EXPECT_LT(m->lobes[1].weight[0][i], 0.8f * 0.97f);
        EXPECT_GT(m->lobes[1].weight[0][i], 0.1f);
        EXPECT_NEAR(m->lobes[1].weight[1][i] / m->lobes[1].weight[0][i], 0.75f, 1e-5f);
    }
}

TEST(Run, EmissionUnderACoatNeedsNoLobe) {
    const auto graph =
        principled(2, {{"Coat Weight", 1}, {"Emission Color", 1}, {"Emission Strength", 2}, {"Coat IOR", 1.5f}});
    const auto all = run(graph), emission = run(graph, Purpose::emission);
    EXPECT_EQ(emission->out.lobes, 0);
    for (int i = 0; i < k_chunk; ++i) {
        EXPECT_EQ(all->out.emission[0][i], emission->out.emission[0][i]);
        EXPECT_LT(all->out.emission[0][i], 1.95f);
        EXPECT_GT(all->out.emission[0][i], 0.2f);
    }
}

TEST(Run, AlphaIsTransparency) {
    for (const int version : {1, 2}) {
        const auto m = run(principled(version, {{"Alpha", 0.25f}}), Purpose::transparency);
        EXPECT_FLOAT_EQ(m->out.transparency[0][3], 0.75f);
        EXPECT_EQ(m->out.lobes, 0);
    }
}

}  // namespace
}  // namespace cardioid
