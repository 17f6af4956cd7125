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

void op_rotate(const Machine& m, const Instruction& in) {
    const Source3 v = m.arg3(in, 0), axis = m.arg3(in, 3);
    const Source angle = m.arg(in, 6);
    for (int i = 0; i < m.end; i += W) {
        Float s, c;
        sincos(angle.at(i), s, c);
        const Vec3 p = v.at(i), a = axis.at(i);
        store_vec(m, in, 0, i, p * c + cross(a, p) * s + a * (dot(a, p) * (1.0f - c)));
    }
}

/// Cycles' formula: the surface gradient of the height, and a blend with the plain normal by strength.
void op_bump(const Machine& m, const Instruction& in) {
    const Source3 normal = m.arg3(in, 0), step_x = m.arg3(in, 3), step_y = m.arg3(in, 6);
    const Source height_x = m.arg(in, 9), height_y = m.arg(in, 10), strengths = m.arg(in, 11),
                 distances = m.arg(in, 12);
    for (int i = 0; i < m.end; i += W) {
        const Vec3 n = normal.at(i), px = step_x.at(i), py = step_y.at(i);
        const Vec3 rx = cross(py, n), ry = cross(n, px);
        const Float det = dot(px, rx), strength = max(strengths.at(i), 0.0f);
        const Vec3 gradient = rx * height_x.at(i) + ry * height_y.at(i);
        const Vec3 tilted = n * abs(det) - gradient * (distances.at(i) * copysign(1.0f, det));
        const Vec3 out = normalize(normalize(tilted) * strength + n * (1.0f - strength));
        store_vec(m, in, 0, i, select(length_squared(tilted) > Float(0.0f), out, n));
    }
}

void op_fresnel(const Machine& m, const Instruction& in) {
    map2(m, in, [](Float cosine, Float eta) {
        const Float c = abs(cosine), g2 = eta * eta - 1.0f + c * c;
        const Float g = safe_sqrt(g2);
        const Float a = (g - c) / (g + c), b = (c * (g + c) - 1.0f) / (c * (g - c) + 1.0f);
        return select(g2 > Float(0.0f), 0.5f * a * a * (1.0f + b * b), Float(1.0f));
    });
}

}  // namespace cardioid::CD_ISA_NS
