// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/image_store.h"
#include "nodes/kernel.h"
#include "nodes/kernel_math.h"

namespace cardioid::CD_ISA_NS {

using nodes::Instruction;

namespace {

/// A row of the operand, copied only when it is a constant.
const float* whole_row(const Source& s, float* buffer, int end) {
    if (s.mask != 0) return s.p;
    for (int i = 0; i < end; i += W) store(buffer + i, s.at(i));
    return buffer;
}

}  // namespace

void op_image(const Machine& m, const Instruction& in) {
    alignas(64) Row u, v;
    const int image = static_cast<int>(in.imm & 0xffffff);
    const auto interpolation = static_cast<image::Interpolation>(in.imm >> 24 & 0x7);
    const auto extension = static_cast<image::Extension>(in.imm >> 28);
    const auto alpha = static_cast<image::AlphaUse>(in.imm >> 27 & 1);
    auto* rgba = reinterpret_cast<Row*>(m.dst(in));
    const float* at_u = whole_row(m.arg(in, 0), u, m.end);
    m.view.images->lookup(image, interpolation, extension, m.end, at_u, whole_row(m.arg(in, 1), v, m.end), rgba, alpha);
}

/// Tile 1001 + 10 v + u of the whole parts; where there is none, Cycles' magenta.
void op_image_tiles(const Machine& m, const Instruction& in) {
    const auto interpolation = static_cast<image::Interpolation>(in.imm >> 24 & 0x7);
    const auto extension = static_cast<image::Extension>(in.imm >> 28);
    const auto alpha = static_cast<image::AlphaUse>(in.imm >> 27 & 1);
    const Source u = m.arg(in, 0), v = m.arg(in, 1);
    alignas(64) Row inside[2], rgba[4];
    alignas(64) std::int32_t tile[k_chunk];
    constexpr float k_missing[] = {1, 0, 1, 1};
    for (int i = 0; i < m.end; i += W) {
        const Float x = truncate(u.at(i)), y = truncate(v.at(i));
        const Mask on = (x >= Float(0.0f)) & (y >= Float(0.0f)) & (x < Float(10.0f)) & (y < Float(1000.0f));
        store(inside[0] + i, u.at(i) - x);
        store(inside[1] + i, v.at(i) - y);
        store(tile + i, select(on, to_int(select(on, y * 10.0f + x, Float(0.0f))) + Int(1001), Int(0)));
        for (int c = 0; c < 4; ++c) store(m.dst(in, c) + i, Float(k_missing[c]));
    }
    const float* list = m.view.data + in.data;
    for (int k = 0; k < static_cast<int>(list[0]); ++k) {
        const Int number(static_cast<std::int32_t>(list[1 + 2 * k]));
        bool used = false;
        for (int i = 0; i < m.end; i += W) used = used || any(load(tile + i) == number);
        if (!used) continue;
        m.view.images->lookup(static_cast<int>(list[2 + 2 * k]), interpolation, extension, m.end, inside[0], inside[1],
                              rgba, alpha);
        for (int i = 0; i < m.end; i += W) {
            const Mask here = load(tile + i) == number;
            for (int c = 0; c < 4; ++c) {
                float* to = m.dst(in, c) + i;
                store(to, select(here, load(rgba[c] + i), load(to)));
            }
        }
    }
}

}  // namespace cardioid::CD_ISA_NS
