// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/image_store.h"
#include "nodes/kernel.h"

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

}  // namespace cardioid::CD_ISA_NS
