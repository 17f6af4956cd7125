// SPDX-License-Identifier: GPL-3.0-or-later
// Names of the interpreter's instructions; operands and results are listed in ops.def.
#pragma once

#include <cstdint>

namespace cardioid::nodes {

enum class Op : std::uint16_t {
#define CARDIOID_OP(name, args, results, kind) name,
#include "nodes/ops.def"
#undef CARDIOID_OP
    count
};

enum class OpKind : std::uint8_t {
    pure,    ///< a function of operands, imm and data: folded when the operands are constant, merged when equal
    reads,   ///< reads the chunk, the scene or images too: merged, never folded
    effect,  ///< writes the SurfaceOutput
};

struct OpInfo {
    const char* name;
    int args;     ///< rows read
    int results;  ///< rows written
    OpKind kind;
};
const OpInfo& op_info(Op op);

}  // namespace cardioid::nodes
