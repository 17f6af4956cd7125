// SPDX-License-Identifier: GPL-3.0-or-later
// What every op kernel is written with: operands as rows, and loops over the chunk in steps of W.
#pragma once

#include "nodes/op_modes.h"
#include "nodes/run.h"
#include "simd/vec.h"

namespace cardioid::CD_ISA_NS {

/// A row of W-wide values; a constant's 16 copies are read again and again (mask 0).
struct Source {
    const float* p;
    int mask;
    Float at(int i) const { return load(p + (i & mask)); }
    float scalar(int i) const { return p[mask == 0 ? 0 : i]; }
};

struct Source3 {
    Source x, y, z;
    Vec3 at(int i) const { return {x.at(i), y.at(i), z.at(i)}; }
    Spectrum rgb(int i) const { return {x.at(i), y.at(i), z.at(i)}; }
};

/// One run of a program.
struct Machine {
    const nodes::ProgramView& view;
    const nodes::ShadingChunk& chunk;
    nodes::SurfaceOutput& out;
    float* registers;
    int end;  ///< lanes to compute: n rounded up to W

    Source arg(const nodes::Instruction& in, int k) const {
        const std::uint16_t code = view.args[in.args + static_cast<std::uint32_t>(k)];
        const int index = code & nodes::k_operand_index;
        if (code & nodes::operand_constant) return {view.constants + index * nodes::k_constant_stride, 0};
        const float* base = (code & nodes::operand_chunk) ? chunk.position[0] : registers;
        return {base + index * k_chunk, -1};
    }
    Source3 arg3(const nodes::Instruction& in, int k) const { return {arg(in, k), arg(in, k + 1), arg(in, k + 2)}; }
    float* dst(const nodes::Instruction& in, int k = 0) const { return registers + (in.dst + k) * k_chunk; }
};

template <class F>
inline void map1(const Machine& m, const nodes::Instruction& in, F f) {
    const Source a = m.arg(in, 0);
    float* d = m.dst(in);
    for (int i = 0; i < m.end; i += W) store(d + i, f(a.at(i)));
}
template <class F>
inline void map2(const Machine& m, const nodes::Instruction& in, F f) {
    const Source a = m.arg(in, 0), b = m.arg(in, 1);
    float* d = m.dst(in);
    for (int i = 0; i < m.end; i += W) store(d + i, f(a.at(i), b.at(i)));
}
template <class F>
inline void map3(const Machine& m, const nodes::Instruction& in, F f) {
    const Source a = m.arg(in, 0), b = m.arg(in, 1), c = m.arg(in, 2);
    float* d = m.dst(in);
    for (int i = 0; i < m.end; i += W) store(d + i, f(a.at(i), b.at(i), c.at(i)));
}
inline void store_vec(const Machine& m, const nodes::Instruction& in, int k, int i, Vec3 v) {
    store(m.dst(in, k) + i, v.x);
    store(m.dst(in, k + 1) + i, v.y);
    store(m.dst(in, k + 2) + i, v.z);
}

#define CARDIOID_OP(name, args, results, kind) void op_##name(const Machine& m, const nodes::Instruction& in);
#include "nodes/ops.def"
#undef CARDIOID_OP

}  // namespace cardioid::CD_ISA_NS
