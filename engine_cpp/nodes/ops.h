// SPDX-License-Identifier: GPL-3.0-or-later
// Names of the interpreter's instructions; operands and results are listed in ops.def.
#pragma once

#include <cstdint>

namespace cardioid::nodes {

enum class Op : std::uint16_t {
#define CARDIOID_OP(name, args, results) name,
#include "nodes/ops.def"
#undef CARDIOID_OP
    count
};

struct OpInfo {
    const char* name;
    int args;      ///< rows read
    int results;   ///< rows written
};
const OpInfo& op_info(Op op);

}  // namespace cardioid::nodes
