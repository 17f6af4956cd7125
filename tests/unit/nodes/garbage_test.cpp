// SPDX-License-Identifier: GPL-3.0-or-later
// Graphs that make no sense compile and run without a crash: loops, links to nowhere, wrong sockets, wild values.
#include "nodes/chunks.h"
#include "nodes/compile.h"
#include "nodes/golden_file.h"
#include "nodes/graphs.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace cardioid {
namespace {

using nodes::Purpose;
using test::GraphMaker;

/// Types, sockets and properties of real graphs, to be put together wrongly.
struct Pool {
    std::vector<std::string> types{"ShaderNodeBsdfPrincipled", "ShaderNodeMixShader",      "ShaderNodeAddShader",
                                   "ShaderNodeBsdfGlass",      "ShaderNodeBump",           "ShaderNodeFromNowhere",
                                   "ShaderNodeTexImage",       "ShaderNodeTexEnvironment", "ShaderNodeDisplacement"};
    std::vector<std::string> inputs{"Shader",    "Shader_001", "Fac",    "Base Color",
                                    "Roughness", "Height",     "Normal", "nonsense"};
    std::vector<std::string> outputs{"Shader", "BSDF", "Color",        "Value",  "Vector",
                                     "Normal", "Fac",  "Displacement", "Result", "nonsense"};
    std::vector<std::pair<std::string, scene::ParamValue>> params{{"image", 3.0},
                                                                  {"version", 2.0},
                                                                  {"ramp", std::vector<double>{0.5}},
                                                                  {"operation", std::string("NONSENSE")},
                                                                  {"value", std::vector<double>{1e30}}};

    Pool() {
        for (const auto& c : test::read_golden(CARDIOID_GOLDEN "/blender_3_4.json")) {
            for (const auto& n : c.graph.nodes) {
                if (n.type == "ShaderNodeTexSky") continue;  // a sky takes a good part of a second
                types.push_back(n.type);
                for (const auto& [id, input] : n.inputs) {
                    inputs.push_back(id);
                    if (input.linked()) outputs.push_back(input.socket);
                }
                for (const auto& p : n.params) params.push_back(p);
            }
        }
    }
};

class Garbage {
public:
    explicit Garbage(unsigned seed) : random_(seed) {}

    scene::GraphDesc graph(const Pool& pool) {
        GraphMaker m;
        const int count = 1 + pick(25);
        for (int k = 0; k < count; ++k) {
            m.node(any(pool.types));
            for (int i = pick(12); i > 0; --i) {
                const float v = wild();
                if (pick(3) > 0)
                    m.link(any(pool.inputs), pick(count + 3) - 1, any(pool.outputs));
                else
                    m.value(any(pool.inputs), {v, wild(), wild(), wild()});
            }
            for (int i = pick(5); i > 0; --i) {
                const auto& [name, value] =
                    pool.params[static_cast<std::size_t>(pick(static_cast<int>(pool.params.size())))];
                m.param(name, value);
            }
        }
        m.graph.surface = {pick(count + 2) - 1, any(pool.outputs)};
        m.graph.displacement = {pick(count + 2) - 1, any(pool.outputs)};
        return m.graph;
    }

private:
    int pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
    const std::string& any(const std::vector<std::string>& from) {
        return from[static_cast<std::size_t>(pick(static_cast<int>(from.size())))];
    }
    float wild() {
        constexpr float inf = std::numeric_limits<float>::infinity();
        const float values[] = {0, 1, 0.5f, -3, 1e-30f, 1e30f, -1e30f, inf, -inf, std::nanf(""), 3e9f, -0.0f};
        return values[pick(12)];
    }
    std::mt19937 random_;
};

TEST(Garbage, CompilesAndRuns) {
    const Pool pool;
    const auto m = std::make_unique<test::Machine>(19);
    for (const auto kind : {nodes::GraphKind::material, nodes::GraphKind::world, nodes::GraphKind::light}) {
        for (unsigned seed = 0; seed < 1500; ++seed) {
            nodes::Warnings warnings;
            std::vector<std::string> names;
            nodes::CompileContext context;
            context.kind = kind;
            context.attribute_names = &names;
            context.optimise = seed % 3 != 0;
            const auto g = nodes::compile(Garbage(seed).graph(pool), context, warnings);
            EXPECT_LE(g.info.lobes, bsdf::k_max_lobes);
            for (int p = 0; p < nodes::k_purposes; ++p)
                CD_ISA_NS::run_program(g.program[p], m->chunk, m->out, m->scratch);
            CD_ISA_NS::run_program(g.of(Purpose::surface), m->chunk, m->out, m->scratch);
            EXPECT_EQ(m->out.lobes, g.info.lobes);
        }
    }
}

TEST(Garbage, AVeryDeepShaderTreeIsFine) {
    GraphMaker m;
    m.node("ShaderNodeBsdfDiffuse").value("Color", {1, 1, 1, 1});
    for (int k = 0; k < 20000; ++k)
        m.node("ShaderNodeMixShader").value("Fac", {0.5f}).link("Shader", k, "Shader").link("Shader_001", k, "Shader");
    nodes::Warnings warnings;
    nodes::CompileContext context;
    EXPECT_EQ(nodes::compile(m.surface("Shader"), context, warnings).info.lobes, 1);
    EXPECT_TRUE(warnings.messages().empty());
}

TEST(Garbage, TenThousandValueNodesGiveTheirSum) {
    GraphMaker m;
    m.node("ShaderNodeNewGeometry");
    for (int k = 0; k < 10000; ++k)
        m.node("ShaderNodeMath").link("Value", k, k == 0 ? "Backfacing" : "Value").value("Value_001", {1});
    m.node("ShaderNodeEmission").link("Strength", 10000, "Value").value("Color", {1, 1, 1, 1});
    nodes::Warnings warnings;
    nodes::CompileContext context;
    const auto g = nodes::compile(m.surface("Emission"), context, warnings);
    EXPECT_TRUE(warnings.messages().empty());
    const auto machine = std::make_unique<test::Machine>(3);
    CD_ISA_NS::run_program(g.of(Purpose::emission), machine->chunk, machine->out, machine->scratch);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(machine->out.emission[0][i], 10000 + machine->chunk.backfacing[i]);
}

/// What a ramp or curve with these parameters makes of a half.
float through(const char* type, const char* input, const char* output,
              const std::vector<std::pair<std::string, scene::ParamValue>>& params) {
    GraphMaker m;
    m.node(type).value(input, {0.5f, 0.5f, 0.5f, 1});
    for (const auto& [name, value] : params) m.param(name, value);
    m.node("ShaderNodeEmission").link("Color", 0, output).value("Strength", {1});
    nodes::Warnings warnings;
    nodes::CompileContext context;
    return nodes::compile(m.surface("Emission"), context, warnings).info.emission_value.x;
}

TEST(Garbage, RampsWithOneStopOrNoneAndFlatCurves) {
    using List = std::vector<double>;
    EXPECT_NEAR(through("ShaderNodeValToRGB", "Fac", "Color", {{"ramp", List{}}}), 0.5f, 0.01f);
    EXPECT_NEAR(through("ShaderNodeValToRGB", "Fac", "Color", {{"ramp", List{0.9, 0.3, 0, 0, 1}}}), 0.3f, 1e-6f);
    // Both points of the curve at one place: its range is nothing.
    const float flat = through("ShaderNodeFloatCurve", "Value", "Value",
                               {{"curve_table_v", List(256, 0.7)}, {"curve_min", 0.4}, {"curve_max", 0.4}});
    EXPECT_TRUE(std::isfinite(flat));
}

TEST(Garbage, TooManyLobesAreNamed) {
    GraphMaker m;
    m.node("ShaderNodeNewGeometry");
    m.node("ShaderNodeBsdfDiffuse").value("Color", {1, 1, 1, 1});
    for (int k = 0; k < 30; ++k) {
        const int below = m.index();
        m.node("ShaderNodeBsdfDiffuse").value("Color", {1, 1, 1, 1});
        m.node("ShaderNodeAddShader").link("Shader", below, "Shader").link("Shader_001", below + 1, "BSDF");
    }
    nodes::Warnings warnings;
    nodes::CompileContext context;
    EXPECT_EQ(nodes::compile(m.surface("Shader"), context, warnings).info.lobes, bsdf::k_max_lobes);
    EXPECT_EQ(warnings.messages().size(), 1u);
}

TEST(Garbage, AProgramThatNeedsTooManyRegistersBecomesPlain) {
    // Every sine stays alive until the last sum.
    GraphMaker m;
    m.node("ShaderNodeNewGeometry");
    const int count = 1500;
    for (int k = 0; k < count; ++k)
        m.node("ShaderNodeMath")
            .param("operation", std::string("MULTIPLY"))
            .link("Value", 0, "Backfacing")
            .value("Value_001", {2.0f + static_cast<float>(k)});
    for (const char* round : {"ADD", "MULTIPLY"})
        for (int k = 0; k < count; ++k)
            m.node("ShaderNodeMath")
                .param("operation", std::string(round))
                .link("Value", 1 + k, "Value")
                .link("Value_001", m.index() - 1, "Value");
    m.node("ShaderNodeEmission").link("Strength", m.index() - 1, "Value").value("Color", {1, 1, 1, 1});
    nodes::Warnings warnings;
    nodes::CompileContext context;
    const auto g = nodes::compile(m.surface("Emission"), context, warnings);
    EXPECT_LE(g.of(Purpose::emission).registers, nodes::k_max_registers);
    ASSERT_EQ(warnings.messages().size(), 1u);
    EXPECT_NE(warnings.messages()[0].find("too large"), std::string::npos);
}

}  // namespace
}  // namespace cardioid
