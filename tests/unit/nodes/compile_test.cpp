// SPDX-License-Identifier: GPL-3.0-or-later
#include "nodes/compile.h"

#include "nodes/graphs.h"

#include <gtest/gtest.h>

namespace cardioid {
namespace {

using nodes::CompiledGraph;
using nodes::Purpose;
using test::GraphMaker;

CompiledGraph compile(const scene::GraphDesc& graph, nodes::Warnings& warnings,
                      nodes::GraphKind kind = nodes::GraphKind::material) {
    nodes::CompileContext context;
    context.name = "M";
    context.kind = kind;
    return nodes::compile(graph, context, warnings);
}
CompiledGraph compile(const scene::GraphDesc& graph) {
    nodes::Warnings warnings;
    return compile(graph, warnings);
}

TEST(Compile, ConstantDiffuseIsOneInstruction) {
    const auto g =
        compile(GraphMaker().node("ShaderNodeBsdfDiffuse").value("Color", {0.5f, 0.4f, 0.3f, 1}).surface("BSDF"));
    EXPECT_EQ(g.of(Purpose::surface).code.size(), 1u);
    EXPECT_TRUE(g.of(Purpose::emission).code.empty());
    EXPECT_TRUE(g.of(Purpose::transparency).code.empty());
    EXPECT_EQ(g.info.lobes, 1);
    EXPECT_FALSE(g.info.has_emission);
    EXPECT_FALSE(g.info.has_transparency);
    EXPECT_FALSE(g.info.needs_triangle_frame);
}

TEST(Compile, EmptyGraphIsTheFallbackColour) {
    nodes::CompileContext context;
    context.kind = nodes::GraphKind::world;
    context.fallback_color = {0.1f, 0.2f, 0.3f};
    nodes::Warnings warnings;
    const auto g = nodes::compile({}, context, warnings);
    EXPECT_TRUE(g.info.constant_emission);
    EXPECT_EQ(g.info.emission_value, (Float3{0.1f, 0.2f, 0.3f}));
}

TEST(Compile, EachPurposeKeepsOnlyWhatItNeeds) {
    GraphMaker m;
    m.node("ShaderNodeBsdfTransparent").value("Color", {1, 1, 1, 1});
    m.node("ShaderNodeEmission").value("Color", {1, 0.5f, 0, 1}).value("Strength", {4});
    m.node("ShaderNodeMixShader").value("Fac", {0.25f}).link("Shader", 0, "BSDF").link("Shader_001", 1, "Emission");
    const auto g = compile(m.surface("Shader"));
    EXPECT_TRUE(g.info.constant_emission);
    EXPECT_EQ(g.info.emission_value, (Float3{1, 0.5f, 0}));
    EXPECT_TRUE(g.info.constant_transparency);
    EXPECT_EQ(g.info.transparency_value, (Float3{0.75f, 0.75f, 0.75f}));
    EXPECT_EQ(g.of(Purpose::emission).code.size(), 1u);
    EXPECT_EQ(g.of(Purpose::transparency).code.size(), 1u);
    EXPECT_EQ(g.of(Purpose::surface).code.size(), 2u);
}

TEST(Compile, SharedClosureIsEmittedOnceWithItsWholeWeight) {
    GraphMaker m;
    m.node("ShaderNodeBsdfDiffuse").value("Color", {1, 1, 1, 1});
    for (int k = 0; k < 40; ++k) m.node("ShaderNodeAddShader").link("Shader", k, "BSDF").link("Shader_001", k, "BSDF");
    const auto g = compile(m.surface("Shader"));
    EXPECT_EQ(g.info.lobes, 1);
    const auto& p = g.of(Purpose::surface);
    EXPECT_EQ(p.constants[static_cast<std::size_t>(p.args[0] & nodes::k_operand_index) * nodes::k_constant_stride],
              1099511627776.0f);
}

TEST(Compile, LoopsAreCutAndNamed) {
    GraphMaker m;
    m.node("ShaderNodeMixShader", "A").link("Shader", 1, "Shader").link("Shader_001", 2, "BSDF");
    m.node("ShaderNodeAddShader", "B").link("Shader", 0, "Shader").link("Shader_001", 2, "BSDF");
    m.node("ShaderNodeBsdfDiffuse", "C").value("Color", {1, 1, 1, 1});
    m.graph.surface = {0, "Shader"};
    nodes::Warnings warnings;
    const auto g = compile(m.graph, warnings);
    ASSERT_EQ(warnings.messages().size(), 1u);
    EXPECT_NE(warnings.messages()[0].find("loop"), std::string::npos);
    EXPECT_EQ(g.info.lobes, 1);
}

TEST(Compile, UnknownNodeIsNamedOnceAndTheRestRenders) {
    GraphMaker m;
    m.node("ShaderNodeFoo", "X");
    m.node("ShaderNodeBsdfDiffuse").link("Color", 0, "Color").value("Roughness", {0.5f});
    nodes::Warnings warnings;
    for (int k = 0; k < 3; ++k) EXPECT_EQ(compile(m.surface("BSDF"), warnings).info.lobes, 1);
    ASSERT_EQ(warnings.messages().size(), 1u);
    EXPECT_EQ(warnings.messages()[0], "Node 'X' (ShaderNodeFoo) in material 'M' is not supported; it uses its default");
}

TEST(Compile, UnknownShaderIsADefaultDiffuse) {
    GraphMaker m;
    m.node("ShaderNodeBsdfOfTheFuture", "X");
    nodes::Warnings warnings;
    EXPECT_EQ(compile(m.surface("BSDF"), warnings).info.lobes, 1);
    EXPECT_EQ(warnings.messages().size(), 1u);
}

TEST(Compile, ColourAsSurfaceIsEmission) {
    GraphMaker m;
    m.node("ShaderNodeRGB").param("value", std::vector<double>{0.5, 0.25, 1, 1});
    const auto g = compile(m.surface("Color"));
    EXPECT_EQ(g.info.emission_value, (Float3{0.5f, 0.25f, 1}));
    EXPECT_FALSE(g.info.has_lobes);
}

}  // namespace
}  // namespace cardioid
