// SPDX-License-Identifier: GPL-3.0-or-later
// The interpreter: one instruction at a time over all lanes of a chunk.
#pragma once

#include "nodes/instructions.h"
#include "nodes/shading.h"
#include "simd/isa.h"

namespace cardioid::nodes {

/// Working memory of one thread.
struct alignas(64) Scratch {
    Row registers[k_max_registers];
};

}  // namespace cardioid::nodes

namespace cardioid::CD_ISA_NS {

/// Writes every lane up to chunk.n rounded up to W: `lobes` and their rows, emission, transparency and holdout. The
/// emission and transparency programs write their own rows; the others are zero.
void run_program(const nodes::Program& program, const nodes::ShadingChunk& chunk, nodes::SurfaceOutput& out,
                 nodes::Scratch& scratch);

/// The instructions alone, without clearing the output (constant folding).
void run_code(const nodes::ProgramView& view, const nodes::ShadingChunk& chunk, nodes::SurfaceOutput& out,
              float* registers);

}  // namespace cardioid::CD_ISA_NS
