// SPDX-License-Identifier: GPL-3.0-or-later
#include "nodes/ops.h"

namespace cardioid::nodes {

const OpInfo& op_info(Op op) {
    static constexpr OpInfo k_table[] = {
#define CARDIOID_OP(name, args, results, kind) {#name, args, results, OpKind::kind},
#include "nodes/ops.def"
#undef CARDIOID_OP
    };
    return k_table[static_cast<int>(op)];
}

}  // namespace cardioid::nodes
