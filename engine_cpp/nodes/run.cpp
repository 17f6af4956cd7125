// SPDX-License-Identifier: GPL-3.0-or-later
#include "nodes/run.h"

#include "nodes/kernel.h"

namespace cardioid::CD_ISA_NS {

namespace {

using OpFunction = void (*)(const Machine&, const nodes::Instruction&);

constexpr OpFunction k_functions[] = {
#define CARDIOID_OP(name, args, results, kind) op_##name,
#include "nodes/ops.def"
#undef CARDIOID_OP
};

/// Whole steps of W that cover the chunk.
int lanes(const nodes::ShadingChunk& chunk) { return (chunk.n + W - 1) / W * W; }

void clear(float* row, int end) {
    for (int i = 0; i < end; i += W) store(row + i, Float(0.0f));
}

void clear_medium(nodes::VolumeOutput& medium, int end) {
    medium.phases = 0;
    for (int c = 0; c < 3; ++c) {
        clear(medium.absorption[c], end);
        clear(medium.emission[c], end);
    }
}

}  // namespace

void run_code(const nodes::ProgramView& view, const nodes::ShadingChunk& chunk, nodes::SurfaceOutput& out,
              float* registers) {
    const Machine m{view, chunk, out, registers, lanes(chunk)};
    for (int k = 0; k < view.instructions; ++k) {
        const nodes::Instruction& in = view.code[k];
        k_functions[static_cast<int>(in.op)](m, in);
    }
}

void run_program(const nodes::Program& program, const nodes::ShadingChunk& chunk, nodes::SurfaceOutput& out,
                 nodes::Scratch& scratch) {
    const int end = lanes(chunk);
    out.lobes = 0;
    for (int c = 0; c < 3; ++c) {
        clear(out.emission[c], end);
        clear(out.transparency[c], end);
    }
    clear(out.holdout, end);
    if (out.volume != nullptr) clear_medium(*out.volume, end);
    run_code(program.view, chunk, out, scratch.registers[0]);
}

}  // namespace cardioid::CD_ISA_NS
