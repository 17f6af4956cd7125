// SPDX-License-Identifier: GPL-3.0-or-later
// Regular patterns: checker, brick, magic.
#include "nodes/kernel.h"
#include "nodes/kernel_math.h"

namespace cardioid::CD_ISA_NS {

using nodes::Instruction;

namespace {

/// Cycles moves whole coordinates off the border between two cells.
Float off_border(Float x) { return (x + 0.000001f) * 0.999999f; }

Int parity(Float x) { return to_int(floor(off_border(x))) & Int(1); }

/// Integer noise in [0, 1).
Float brick_noise(Int n) {
    n = (n + Int(1013)) & Int(0x7fffffff);
    n = (n >> 13) ^ n;
    const Int nn = (n * (n * n * Int(60493) + Int(19990303)) + Int(1376312589)) & Int(0x7fffffff);
    return 0.5f * (to_float(nn) * (1.0f / 1073741824.0f));
}

Mask multiple_of(Float row, float k) {
    const Float q = row * (1.0f / k);
    return floor(q + 0.5f) * k == row;
}

}  // namespace

void op_checker(const Machine& m, const Instruction& in) {
    const Source3 p = m.arg3(in, 0);
    for (int i = 0; i < m.end; i += W) {
        const Vec3 q = p.at(i);
        const Mask odd = (parity(q.x) ^ parity(q.y) ^ parity(q.z)) != Int(0);
        store(m.dst(in) + i, select(odd, Float(1.0f), Float(0.0f)));
    }
}

/// Data: offset amount, offset frequency, squash amount, squash frequency. Results: tint, mortar.
void op_brick(const Machine& m, const Instruction& in) {
    const Source3 point = m.arg3(in, 0);
    const Source size = m.arg(in, 3), smooth = m.arg(in, 4), bias = m.arg(in, 5), width = m.arg(in, 6),
                 height = m.arg(in, 7);
    const float* data = m.view.data + in.data;
    for (int i = 0; i < m.end; i += W) {
        const Vec3 p = point.at(i);
        const Float row_height = height.at(i), mortar_size = size.at(i), softness = smooth.at(i);
        Float brick_width = width.at(i), offset = 0.0f;
        const Float row = floor(safe_divide(p.y, row_height));
        if (data[1] != 0 && data[3] != 0) {
            brick_width = select(multiple_of(row, data[3]), brick_width * data[2], brick_width);
            offset = select(multiple_of(row, data[1]), brick_width * data[0], Float(0.0f));
        }
        const Float brick = floor(safe_divide(p.x + offset, brick_width));
        const Float x = (p.x + offset) - brick_width * brick, y = p.y - row_height * row;
        const Int id = (to_int(row) << 16) + (to_int(brick) & Int(0xffff));
        store(m.dst(in, 0) + i, saturate(brick_noise(id) + bias.at(i)));
        const Float edge = min(min(x, y), min(brick_width - x, row_height - y));
        const Float depth = 1.0f - safe_divide(edge, mortar_size);
        const Float t = saturate(safe_divide(depth, softness));
        const Float soft = select(depth < softness, t * t * (3.0f - 2.0f * t), Float(1.0f));
        store(m.dst(in, 1) + i,
              select(edge >= mortar_size, Float(0.0f), select(softness == Float(0.0f), Float(1.0f), soft)));
    }
}

/// imm: depth.
void op_magic(const Machine& m, const Instruction& in) {
    const Source3 point = m.arg3(in, 0);
    const Source scales = m.arg(in, 3), distortions = m.arg(in, 4);
    const int depth = static_cast<int>(in.imm);
    for (int i = 0; i < m.end; i += W) {
        const Vec3 p = point.at(i);
        const Float scale = scales.at(i) * 5.0f, d = distortions.at(i);
        const Float px = safe_modulo(p.x, k_two_pi), py = safe_modulo(p.y, k_two_pi), pz = safe_modulo(p.z, k_two_pi);
        Float x = sin((px + py + pz) * scale), y = cos((py - px - pz) * scale), z = -cos((pz - px - py) * scale);
        if (depth > 0) {
            x *= d;
            y *= d;
            z *= d;
            y = -cos(x - y + z) * d;
        }
        if (depth > 1) x = cos(x - y - z) * d;
        if (depth > 2) z = sin(-x - y - z) * d;
        if (depth > 3) x = -cos(-x + y - z) * d;
        if (depth > 4) y = -sin(-x + y + z) * d;
        if (depth > 5) y = -cos(-x + y + z) * d;
        if (depth > 6) x = cos(x + y + z) * d;
        if (depth > 7) z = sin(x + y - z) * d;
        if (depth > 8) x = -cos(-x - y + z) * d;
        if (depth > 9) y = -sin(x - y + z) * d;
        const Float inv = select(d != Float(0.0f), 0.5f / d, Float(1.0f));
        store_vec(m, in, 0, i, {0.5f - x * inv, 0.5f - y * inv, 0.5f - z * inv});
    }
}

}  // namespace cardioid::CD_ISA_NS
