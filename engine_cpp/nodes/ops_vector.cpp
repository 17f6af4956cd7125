// SPDX-License-Identifier: GPL-3.0-or-later
// Vector operations that mix components; all others are compiled to scalar ones.
#include "nodes/kernel.h"

namespace cardioid::CD_ISA_NS {

using nodes::Instruction;

void op_dot(const Machine& m, const Instruction& in) {
    const Source3 a = m.arg3(in, 0), b = m.arg3(in, 3);
    for (int i = 0; i < m.end; i += W) {
        const Vec3 x = a.at(i), y = b.at(i);
        store(m.dst(in) + i, x.x * y.x + x.y * y.y + x.z * y.z);
    }
}

void op_cross(const Machine& m, const Instruction& in) {
    const Source3 a = m.arg3(in, 0), b = m.arg3(in, 3);
    for (int i = 0; i < m.end; i += W) store_vec(m, in, 0, i, cross(a.at(i), b.at(i)));
}

void op_normalize(const Machine& m, const Instruction& in) {
    const Source3 a = m.arg3(in, 0);
    for (int i = 0; i < m.end; i += W) store_vec(m, in, 0, i, normalize(a.at(i)));
}

void op_normalize_or(const Machine& m, const Instruction& in) {
    const Source3 a = m.arg3(in, 0), b = m.arg3(in, 3);
    for (int i = 0; i < m.end; i += W) {
        const Vec3 v = a.at(i);
        store_vec(m, in, 0, i, select(length_squared(v) > Float(0.0f), normalize(v), b.at(i)));
    }
}

}  // namespace cardioid::CD_ISA_NS
