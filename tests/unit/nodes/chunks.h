// SPDX-License-Identifier: GPL-3.0-or-later
// Shading chunks for the tests: n points of a curved surface with everything filled in.
#pragma once

#include "nodes/run.h"

#include <cmath>
#include <memory>

namespace cardioid::test {

struct Machine {
    nodes::ShadingChunk chunk{};
    nodes::SurfaceOutput out{};
    bsdf::Lobe lobes[bsdf::k_max_lobes];
    nodes::Scratch scratch;

    explicit Machine(int n = k_chunk) {
        chunk.n = n;
        out.lobe = lobes;
        for (int i = 0; i < k_chunk; ++i) fill(i, std::min(i, n - 1));
    }

private:
    void set(Row* rows, int i, Float3 v) {
        rows[0][i] = v.x;
        rows[1][i] = v.y;
        rows[2][i] = v.z;
    }
    void fill(int i, int point) {
        const float t = static_cast<float>(point) / k_chunk;
        set(chunk.position, i, {std::cos(7 * t), std::sin(9 * t), 2 * t - 1});
        set(chunk.normal_geometric, i, {0, 0, 1});
        set(chunk.normal, i, normalize({0.3f * std::sin(20 * t), 0.2f, 1}));
        set(chunk.wo, i, normalize({std::cos(5 * t), 0.4f, 0.2f + t}));
        set(chunk.dp_du, i, {1, 0, 0});
        set(chunk.dp_dv, i, {0, 1, 0});
        chunk.barycentric_u[i] = 0.2f + 0.3f * t;
        chunk.barycentric_v[i] = 0.4f - 0.3f * t;
        chunk.footprint[i] = 0.01f;
        chunk.ray_length[i] = 3 + t;
        chunk.backfacing[i] = static_cast<float>(point % 3 == 0);
        chunk.instance[i] = -1;
        chunk.ray_flags[i] = point % 2 == 0 ? nodes::ray_camera : nodes::ray_diffuse | nodes::ray_reflection;
        chunk.ray_depth[i] = static_cast<float>(point % 4);
    }
};

}  // namespace cardioid::test
