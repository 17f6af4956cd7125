// SPDX-License-Identifier: GPL-3.0-or-later
// The optimiser changes no value: programs with and without it agree, on the graphs of the golden files and on random ones.
#include "nodes/chunks.h"
#include "nodes/compile.h"
#include "nodes/emit_program.h"
#include "nodes/golden_tile.h"
#include "nodes/graphs.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>

namespace cardioid {
namespace {

using nodes::Purpose;
using test::GraphMaker;

nodes::CompiledGraph compile(const scene::GraphDesc& graph, bool optimise, std::vector<std::string>& names) {
    nodes::Warnings warnings;
    nodes::CompileContext context;
    context.optimise = optimise;
    context.attribute_names = &names;
    return nodes::compile(graph, context, warnings);
}

void run(const nodes::CompiledGraph& g, test::Machine& m) {
    isa_w1::run_program(g.of(Purpose::emission), m.chunk, m.out, m.scratch);
}

void expect_same(const test::Machine& a, const test::Machine& b, const std::string& what) {
    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < a.chunk.n; ++i) {
            const float x = a.out.emission[k][i], y = b.out.emission[k][i];
            if (std::isnan(x) && std::isnan(y)) continue;
            ASSERT_NEAR(x, y, 1e-4f * (1 + std::abs(x))) << what << ", point " << i << " channel " << k;
        }
}

TEST(Optimise, GoldenGraphsKeepTheirValues) {
    for (const auto& c : test::read_golden(CARDIOID_GOLDEN "/blender_3_4.json")) {
        std::vector<std::string> names;
        const auto plain = compile(c.graph, false, names), lean = compile(c.graph, true, names);
        EXPECT_LE(lean.of(Purpose::emission).code.size(), plain.of(Purpose::emission).code.size()) << c.name;
        const auto a = std::make_unique<test::Machine>(16), b = std::make_unique<test::Machine>(16);
        const test::GoldenTile tile(c, names);
        tile.fill(a->chunk);
        tile.fill(b->chunk);
        run(plain, *a);
        run(lean, *b);
        expect_same(*a, *b, c.name);
    }
}

/// A graph of continuous nodes with constants that invite folding (0, 1, equal ones) and shared results.
scene::GraphDesc random_graph(std::mt19937& random) {
    const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    const auto constant = [&] {
        return std::array<float, 6>{0, 1, 0.5f, -0.7f, 2, 1}[static_cast<std::size_t>(pick(6))];
    };
    GraphMaker m;
    m.node("ShaderNodeNewGeometry");
    const auto feed = [&](const char* id) {
        const int from = pick(m.index() * 2);
        if (from >= m.index()) {
            m.value(id, {constant(), constant(), constant(), 1});
            return;
        }
        const auto& type = m.graph.nodes[static_cast<std::size_t>(from)].type;
        const char* out = type == "ShaderNodeNewGeometry"  ? "Position"
                          : type == "ShaderNodeMath"       ? "Value"
                          : type == "ShaderNodeVectorMath" ? "Vector"
                          : type == "ShaderNodeMix"        ? "Result_Color"
                                                           : "Color";
        m.link(id, from, out);
    };
    const char* math[] = {"ADD", "SUBTRACT", "MULTIPLY", "MULTIPLY_ADD", "MINIMUM", "SINE", "ABSOLUTE", "SMOOTH_MIN"};
    const char* blend[] = {"MIX", "ADD", "MULTIPLY", "SCREEN", "SOFT_LIGHT", "DARKEN", "SUBTRACT", "DIFFERENCE"};
    const int count = 4 + pick(20);
    for (int k = 0; k < count; ++k) {
        switch (pick(4)) {
            case 0:
                m.node("ShaderNodeMath").param("operation", std::string(math[pick(8)]));
                for (const char* id : {"Value", "Value_001", "Value_002"}) feed(id);
                break;
            case 1:
                m.node("ShaderNodeVectorMath").param("operation", std::string(math[pick(6)]));
                for (const char* id : {"Vector", "Vector_001", "Vector_002"}) feed(id);
                break;
            case 2:
                m.node("ShaderNodeMix")
                    .param("data_type", std::string("RGBA"))
                    .param("blend_type", std::string(blend[pick(8)]));
                for (const char* id : {"Factor_Float", "A_Color", "B_Color"}) feed(id);
                break;
            default:
                m.node("ShaderNodeInvert");
                for (const char* id : {"Fac", "Color"}) feed(id);
                break;
        }
    }
    m.node("ShaderNodeEmission");
    feed("Color");
    feed("Strength");
    return m.surface("Emission");
}

TEST(Optimise, RandomGraphsKeepTheirValues) {
    std::mt19937 random(7);
    int smaller = 0;
    for (int k = 0; k < 500; ++k) {
        const auto graph = random_graph(random);
        std::vector<std::string> names;
        const auto plain = compile(graph, false, names), lean = compile(graph, true, names);
        const auto a = std::make_unique<test::Machine>(32), b = std::make_unique<test::Machine>(32);
        run(plain, *a);
        run(lean, *b);
        bool finite = true;
        for (int c = 0; c < 3; ++c)
            for (int i = 0; i < 32; ++i) finite &= std::abs(a->out.emission[c][i]) < 1e4f;
        if (finite) expect_same(*a, *b, "graph " + std::to_string(k));
        smaller += lean.of(Purpose::emission).code.size() < plain.of(Purpose::emission).code.size();
    }
    EXPECT_GT(smaller, 450);
}

TEST(Optimise, ConstantsFoldToNothing) {
    GraphMaker m;
    m.node("ShaderNodeMath").param("operation", std::string("POWER")).value("Value", {2}).value("Value_001", {3});
    m.node("ShaderNodeTexNoise").value("Scale", {2}).link("Vector", 0, "Value");
    m.node("ShaderNodeEmission").link("Color", 1, "Fac").link("Strength", 0, "Value");
    std::vector<std::string> names;
    const auto g = compile(m.surface("Emission"), true, names);
    EXPECT_TRUE(g.info.constant_emission);
    EXPECT_EQ(g.of(Purpose::emission).code.size(), 1u);
}

TEST(Optimise, EqualInstructionsAreMerged) {
    nodes::Builder b(true);
    const nodes::Ref x = b.chunk(nodes::ChunkRow::position);
    EXPECT_EQ(b.emit(nodes::Op::sine, {x}), b.emit(nodes::Op::sine, {x}));
    EXPECT_NE(b.emit(nodes::Op::cosine, {x}), b.emit(nodes::Op::sine, {x}));
    EXPECT_EQ(b.code().size(), 2u);
}

TEST(Optimise, NeutralArithmeticVanishes) {
    nodes::Builder b(true);
    const nodes::Ref x = b.chunk(nodes::ChunkRow::position), zero = b.constant(0), one = b.constant(1);
    EXPECT_EQ(b.add(x, zero), x);
    EXPECT_EQ(b.multiply(one, x), x);
    EXPECT_EQ(b.multiply(x, zero), zero);
    EXPECT_EQ(b.mix(x, one, zero), x);
    EXPECT_EQ(b.mix(x, one, one), one);
    EXPECT_TRUE(b.code().empty());
}

TEST(Optimise, RegistersAreReused) {
    GraphMaker m;
    m.node("ShaderNodeNewGeometry");
    for (int k = 0; k < 20000; ++k)
        m.node("ShaderNodeVectorMath")
            .param("operation", std::string(k % 2 == 0 ? "SINE" : "COSINE"))
            .link("Vector", k, k == 0 ? "Position" : "Vector");
    m.node("ShaderNodeEmission").link("Color", 20000, "Vector");
    std::vector<std::string> names;
    const auto g = compile(m.surface("Emission"), true, names);
    EXPECT_EQ(g.of(Purpose::emission).code.size(), 60001u);
    EXPECT_LE(g.of(Purpose::emission).registers, 8);
}

TEST(Optimise, AThousandMaterialsCompileInUnderASecond) {
    const auto start = std::chrono::steady_clock::now();
    std::vector<std::string> names;
    for (int k = 0; k < 1000; ++k) {
        GraphMaker m;
        m.node("ShaderNodeTexNoise").value("Scale", {5});
        m.node("ShaderNodeValToRGB")
            .link("Fac", 0, "Fac")
            .param("ramp", std::vector<double>{0, 0, 0, 0, 1, 1, 1, k * 0.001, 1, 1});
        m.node("ShaderNodeBsdfPrincipled")
            .param("version", 2.0)
            .link("Base Color", 1, "Color")
            .link("Roughness", 0, "Fac");
        compile(m.surface("BSDF"), true, names);
    }
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 1.0);
}

}  // namespace
}  // namespace cardioid
