// SPDX-License-Identifier: GPL-3.0-or-later
#include "nodes/estimate.h"

#include "image/image_store.h"
#include "nodes/run.h"

#include <algorithm>
#include <memory>

namespace cardioid::nodes {

namespace {

struct Workspace {
    ShadingChunk chunk{};
    SurfaceOutput out{};
    Scratch scratch;
    bsdf::Lobe lobes[1];
};

/// Van der Corput numbers in the given base.
float radical_inverse(int i, int base) {
    float f = 1, r = 0;
    for (; i > 0; i /= base) {
        f /= static_cast<float>(base);
        r += f * static_cast<float>(i % base);
    }
    return r;
}

void fill_chunk(ShadingChunk& c) {
    c.n = k_chunk;
    for (int i = 0; i < k_chunk; ++i) {
        constexpr int k_bases[] = {2, 3, 5};
        for (int k = 0; k < 3; ++k) c.position[k][i] = radical_inverse(i + 1, k_bases[k]);
        for (auto* rows : {c.normal_geometric, c.normal, c.wo}) rows[2][i] = 1;
        c.dp_du[0][i] = c.dp_dv[1][i] = 1;
        c.barycentric_u[i] = c.barycentric_v[i] = 1.0f / 3;
        c.footprint[i] = 0.001f;
        c.ray_length[i] = 1;
        c.instance[i] = -1;
        c.ray_flags[i] = ray_diffuse | ray_reflection;
        c.ray_depth[i] = c.diffuse_depth[i] = 1;
    }
}

void set_rows(float* row, float value) { std::fill_n(row, k_chunk, value); }

void run_one(const Program& p, const Instruction& in, Workspace& w) {
    float* dst = w.scratch.registers[in.dst];
    if (in.op == Op::image) {
        const Float3 mean = p.view.images->mean_color(static_cast<int>(in.imm & 0xffffff));
        const float values[] = {mean.x, mean.y, mean.z, 1};
        for (int k = 0; k < 4; ++k) set_rows(dst + k * k_chunk, values[k]);
    } else if (in.op == Op::image_tiles) {
        const float* tiles = p.view.data + in.data;
        Float3 sum;
        for (int k = 0; k < static_cast<int>(tiles[0]); ++k)
            sum = sum + p.view.images->mean_color(static_cast<int>(tiles[2 + 2 * k])) * (1 / tiles[0]);
        const float values[] = {sum.x, sum.y, sum.z, 1};
        for (int k = 0; k < 4; ++k) set_rows(dst + k * k_chunk, values[k]);
    } else if (in.op == Op::attribute) {
        for (int k = 0; k < 3; ++k) std::copy_n(w.chunk.position[k], k_chunk, dst + k * k_chunk);
        set_rows(dst + 3 * k_chunk, 1);
    } else {
        ProgramView one = p.view;
        one.code = &in;
        one.instructions = 1;
        isa_w1::run_code(one, w.chunk, w.out, w.scratch.registers[0]);
    }
}

}  // namespace

Float3 estimate_emission(const Program& program) {
    const auto w = std::make_unique<Workspace>();
    w->out.lobe = w->lobes;
    fill_chunk(w->chunk);
    for (const Instruction& in : program.code) run_one(program, in, *w);
    float mean[3] = {};
    for (int c = 0; c < 3; ++c) {
        for (const float e : w->out.emission[c]) mean[c] += std::isfinite(e) ? e / k_chunk : 0;
    }
    return {mean[0], mean[1], mean[2]};
}

}  // namespace cardioid::nodes
