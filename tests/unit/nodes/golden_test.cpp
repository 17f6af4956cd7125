// SPDX-License-Identifier: GPL-3.0-or-later
// Node by node against Cycles: emission of each node's output at the points where Cycles sampled it.
#include "nodes/chunks.h"
#include "nodes/compile.h"
#include "nodes/golden_file.h"

#include <gtest/gtest.h>

namespace cardioid {
namespace {

using test::GoldenCase;

class Golden : public testing::TestWithParam<GoldenCase> {};

/// The tile of make_golden.py: tilted, seen from above.
void place(test::Machine& m, const GoldenCase& c) {
    const Float3 normal = normalize(Float3{-0.3f, -0.2f, 1});
    for (int i = 0; i < k_chunk; ++i) {
        const auto p = static_cast<std::size_t>(std::min(i, m.chunk.n - 1)) * 3;
        for (std::size_t k = 0; k < 3; ++k) m.chunk.position[k][i] = c.points[p + k];
        const float n[] = {normal.x, normal.y, normal.z}, up[] = {0, 0, 1};
        for (std::size_t k = 0; k < 3; ++k) {
            m.chunk.normal[k][i] = m.chunk.normal_geometric[k][i] = n[k];
            m.chunk.wo[k][i] = up[k];
        }
        m.chunk.backfacing[i] = 0;
        m.chunk.ray_flags[i] = nodes::ray_camera;
    }
}

TEST_P(Golden, IsWhatCyclesGives) {
    const GoldenCase& c = GetParam();
    nodes::Warnings warnings;
    nodes::CompileContext context;
    const auto g = nodes::compile(c.graph, context, warnings);
    for (const auto& message : warnings.messages()) ADD_FAILURE() << message;
    const int points = static_cast<int>(c.points.size() / 3);
    const auto m = std::make_unique<test::Machine>(points);
    place(*m, c);
    CD_ISA_NS::run_program(g.of(nodes::Purpose::emission), m->chunk, m->out, m->scratch);
    for (int i = 0; i < points; ++i) {
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

INSTANTIATE_TEST_SUITE_P(Blender34, Golden, testing::ValuesIn(test::read_golden(CARDIOID_GOLDEN "/blender_3_4.json")), name_of);
INSTANTIATE_TEST_SUITE_P(Blender45, Golden, testing::ValuesIn(test::read_golden(CARDIOID_GOLDEN "/blender_4_5.json")), name_of);
INSTANTIATE_TEST_SUITE_P(Blender50, Golden, testing::ValuesIn(test::read_golden(CARDIOID_GOLDEN "/blender_5_0.json")), name_of);

}  // namespace
}  // namespace cardioid
