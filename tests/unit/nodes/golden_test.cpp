// SPDX-License-Identifier: GPL-3.0-or-later
// Node by node against Cycles: emission of each node's output at the points where Cycles sampled it.
#include "nodes/chunks.h"
#include "nodes/compile.h"
#include "nodes/golden_tile.h"

#include <gtest/gtest.h>

namespace cardioid {
namespace {

using test::GoldenCase;

class Golden : public testing::TestWithParam<GoldenCase> {};

TEST_P(Golden, IsWhatCyclesGives) {
    const GoldenCase& c = GetParam();
    nodes::Warnings warnings;
    nodes::CompileContext context;
    std::vector<std::string> names;
    context.attribute_names = &names;
    const auto g = nodes::compile(c.graph, context, warnings);
    for (const auto& message : warnings.messages()) ADD_FAILURE() << message;
    const int points = static_cast<int>(c.points.size() / 3);
    const auto m = std::make_unique<test::Machine>(points);
    const auto tile = std::make_unique<test::GoldenTile>(c, names);
    tile->fill(m->chunk);
    CD_ISA_NS::run_program(g.of(nodes::Purpose::emission), m->chunk, m->out, m->scratch);
    for (int i = 0; i < points; ++i) {
        // On the diagonal Cycles may have taken either triangle, each with its own parameters.
        if (c.name == "geometry Parametric" && tile->on_diagonal(i)) continue;
        for (int k = 0; k < 3; ++k) {
            const float want = c.values[static_cast<std::size_t>(i * 3 + k)], got = m->out.emission[k][i];
            EXPECT_NEAR(got, want, c.tolerance * std::max(std::abs(want), 0.05f)) << "point " << i << " channel " << k;
        }
    }
}

std::string name_of(const testing::TestParamInfo<GoldenCase>& info) {
    std::string name;
    for (const char c : info.param.name) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(Blender34, Golden, testing::ValuesIn(test::read_golden(CARDIOID_GOLDEN "/blender_3_4.json")),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Blender45, Golden, testing::ValuesIn(test::read_golden(CARDIOID_GOLDEN "/blender_4_5.json")),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Blender50, Golden, testing::ValuesIn(test::read_golden(CARDIOID_GOLDEN "/blender_5_0.json")),
                         name_of);

}  // namespace
}  // namespace cardioid
