// SPDX-License-Identifier: GPL-3.0-or-later
// Displacement by Blender's three methods: bump alone, moved vertices alone, both; and what versions do with bumped normals.
#include "nodes/compile.h"

#include "nodes/chunks.h"
#include "nodes/graphs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace cardioid {
namespace {

using nodes::Op;
using nodes::Purpose;
using scene::DisplacementMethod;

scene::GraphDesc displaced_diffuse() {
    test::GraphMaker m;
    m.node("ShaderNodeTexNoise").value("Scale", {3});
    m.node("ShaderNodeDisplacement").link("Height", 0, "Fac").value("Midlevel", {0.5f}).value("Scale", {2});
    m.node("ShaderNodeBsdfDiffuse").value("Color", {1, 1, 1, 1});
    auto g = m.surface("BSDF");
    g.displacement = {1, "Displacement"};
    return g;
}

nodes::CompiledGraph compile(DisplacementMethod method, std::vector<std::string>& names) {
    nodes::CompileContext context;
    context.displacement_method = method;
    context.attribute_names = &names;
    nodes::Warnings warnings;
    auto g = nodes::compile(displaced_diffuse(), context, warnings);
    EXPECT_TRUE(warnings.messages().empty());
    return g;
}

bool knows(const std::vector<std::string>& names, const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

TEST(Displacement, MethodsTellBumpFromMovedVertices) {
    for (const auto method : {DisplacementMethod::bump, DisplacementMethod::displacement, DisplacementMethod::both}) {
        std::vector<std::string> names;
        const auto g = compile(method, names);
        EXPECT_EQ(g.info.has_displacement, method != DisplacementMethod::bump);
        EXPECT_EQ(g.of(Purpose::displacement).code.empty(), method == DisplacementMethod::bump);
        EXPECT_EQ(g.info.has_bump, method != DisplacementMethod::displacement);
        EXPECT_EQ(knows(names, nodes::k_undisplaced), method == DisplacementMethod::both);
        EXPECT_EQ(g.info.lobes, 1);
    }
}

/// The bumped normal of a displacement so strong that some of the surface turns away from the viewer.
std::unique_ptr<test::Machine> bumped(double version) {
    scene::GraphDesc graph = displaced_diffuse();
    graph.nodes[1].params["version"] = version;
    nodes::CompileContext context;
    nodes::Warnings warnings;
    const auto g = nodes::compile(graph, context, warnings);
    auto m = std::make_unique<test::Machine>();
    isa_w1::run_program(g.of(Purpose::surface), m->chunk, m->out, m->scratch);
    return m;
}

/// Least cosine, against the geometric normal, of views mirrored about `normal`.
float lowest_reflection(const test::Machine& m, const Row* normal) {
    float lowest = 1;
    for (int i = 0; i < k_chunk; ++i) {
        const Float3 n{normal[0][i], normal[1][i], normal[2][i]};
        const Float3 o{m.chunk.wo[0][i], m.chunk.wo[1][i], m.chunk.wo[2][i]};
        lowest = std::min(lowest, 2 * dot(n, o) * n.z - o.z);
    }
    return lowest;
}

TEST(Displacement, AsBumpKeepsReflectionsAboveTheSurfaceBefore36) {
    const auto lowest = [](double version) {
        const auto m = bumped(version);
        return lowest_reflection(*m, m->out.normal);
    };
    EXPECT_GT(lowest(1), 0.0f);
    EXPECT_LT(lowest(2), -0.3f);
    EXPECT_LT(lowest(3), -0.3f);
}

TEST(Bump, DiffuseNormalsStayAboveTheSurfaceBefore36AndAreShadowedByFacetsSince45) {
    for (const double version : {1.0, 2.0, 3.0}) {
        test::GraphMaker maker;
        maker.node("ShaderNodeTexNoise").value("Scale", {3});
        maker.node("ShaderNodeBump").link("Height", 0, "Fac").value("Distance", {2}).param("version", version);
        maker.node("ShaderNodeBsdfDiffuse").link("Normal", 1, "Normal");
        maker.node("ShaderNodeBsdfGlossy").link("Normal", 1, "Normal");
        maker.node("ShaderNodeAddShader").link("Shader", 2, "BSDF").link("Shader_001", 3, "BSDF");
        nodes::CompileContext context;
        nodes::Warnings warnings;
        const auto g = nodes::compile(maker.surface("Shader"), context, warnings);
        EXPECT_TRUE(g.info.own_normals);
        EXPECT_EQ(g.info.ggx_bump_shadow, version == 3);
        const auto m = std::make_unique<test::Machine>();
        isa_w1::run_program(g.of(Purpose::surface), m->chunk, m->out, m->scratch);
        ASSERT_EQ(m->out.lobes, 2);
        for (int k = 0; k < 2; ++k) {
            const bool diffuse = m->lobes[k].kind == bsdf::LobeKind::diffuse;
            const float lowest = lowest_reflection(*m, m->lobes[k].normal);
            if (diffuse && version >= 2)
                EXPECT_LT(lowest, -0.3f);
            else
                EXPECT_GT(lowest, 0.0f);
        }
    }
}

TEST(Displacement, IsTheHeightAlongTheNormal) {
    scene::GraphDesc graph = displaced_diffuse();
    graph.nodes[1].inputs["Height"] = {};
    graph.nodes[1].inputs["Height"].value = {0.75f, 0, 0, 0};
    nodes::CompileContext context;
    context.displacement_method = DisplacementMethod::displacement;
    nodes::Warnings warnings;
    const auto g = nodes::compile(graph, context, warnings);
    const auto m = std::make_unique<test::Machine>(5);
    isa_w1::run_program(g.of(Purpose::displacement), m->chunk, m->out, m->scratch);
    for (int i = 0; i < 5; ++i)
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(m->out.displacement[k][i], 0.5f * m->chunk.normal[k][i], 1e-6f);
}

}  // namespace
}  // namespace cardioid
