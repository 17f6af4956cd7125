// SPDX-License-Identifier: GPL-3.0-or-later
// Closures: what a program leaves in the SurfaceOutput.
#include "bsdf/bend_normal.h"
#include "bsdf/kernels.h"
#include "nodes/kernel.h"

namespace cardioid::CD_ISA_NS {

using bsdf::Distribution;
using bsdf::Fresnel;
using bsdf::Lobe;
using bsdf::LobeKind;
using nodes::Instruction;

namespace {

void copy_row(const Source& s, float* row, int end) {
    for (int i = 0; i < end; i += W) store(row + i, s.at(i));
}
void copy_rows(const Machine& m, const Instruction& in, int k, Row* rows) {
    for (int c = 0; c < 3; ++c) copy_row(m.arg(in, k + c), rows[c], m.end);
}
void add_rows(const Machine& m, const Instruction& in, Row* rows) {
    for (int c = 0; c < 3; ++c) {
        const Source s = m.arg(in, c);
        for (int i = 0; i < m.end; i += W) store(rows[c] + i, load(rows[c] + i) + s.at(i));
    }
}

Lobe& begin_lobe(const Machine& m, const Instruction& in, Lobe& spare) {
    Lobe& lobe = (in.imm & nodes::lobe_keep) ? m.out.lobe[m.out.lobes++] : spare;
    lobe.kind = static_cast<LobeKind>(in.imm & nodes::lobe_kind_mask);
    lobe.fresnel = static_cast<Fresnel>(in.imm >> nodes::lobe_fresnel_shift & 0xf);
    lobe.preserve_energy = (in.imm & nodes::lobe_preserve_energy) != 0;
    lobe.distribution = static_cast<Distribution>(in.imm >> nodes::lobe_distribution_shift & 0x7);
    lobe.separable_masking = (in.imm & nodes::lobe_separable) != 0;
    lobe.thin_film = (in.imm & nodes::lobe_thin_film) != 0;
    copy_rows(m, in, 0, lobe.weight);
    copy_rows(m, in, 3, lobe.normal);
    return lobe;
}

/// What is left for the layers below: 1 - the largest channel of albedo relative to the layer's weight.
void store_layer(const Machine& m, const Instruction& in, const Lobe& lobe, int weight_arg) {
    const Source3 weight = m.arg3(in, weight_arg);
    for (int i = 0; i < m.end; i += W) {
        const Spectrum albedo = lobe_albedo(lobe, i, load3(m.chunk.wo, i)), w = weight.rgb(i);
        const auto share = [](Float a, Float b) { return select(b != Float(0.0f), a / b, Float(0.0f)); };
        const Float most = max(share(albedo.r, w.r), max(share(albedo.g, w.g), share(albedo.b, w.b)));
        store(m.dst(in) + i, saturate(1.0f - most));
    }
}

}  // namespace

void op_emission(const Machine& m, const Instruction& in) { add_rows(m, in, m.out.emission); }
void op_transparent(const Machine& m, const Instruction& in) { add_rows(m, in, m.out.transparency); }
void op_holdout(const Machine& m, const Instruction& in) {
    const Source s = m.arg(in, 0);
    for (int i = 0; i < m.end; i += W) store(m.out.holdout + i, load(m.out.holdout + i) + s.at(i));
}

void op_lobe_simple(const Machine& m, const Instruction& in) {
    Lobe& lobe = begin_lobe(m, in, m.out.lobe[m.out.lobes]);
    copy_row(m.arg(in, 6), lobe.roughness, m.end);
    if (lobe.preserve_energy) copy_rows(m, in, 7, lobe.f0);
}

void op_lobe_sheen(const Machine& m, const Instruction& in) {
    Lobe spare;
    Lobe& lobe = begin_lobe(m, in, spare);
    copy_row(m.arg(in, 6), lobe.roughness, m.end);
    if (in.imm & nodes::lobe_layer) store_layer(m, in, lobe, 7);
}

void op_lobe_ggx(const Machine& m, const Instruction& in) {
    Lobe spare;
    Lobe& lobe = begin_lobe(m, in, spare);
    copy_rows(m, in, 6, lobe.tangent);
    copy_row(m.arg(in, 9), lobe.alpha_x, m.end);
    copy_row(m.arg(in, 10), lobe.alpha_y, m.end);
    if (lobe.kind != LobeKind::ggx_reflection || lobe.fresnel != Fresnel::none || lobe.preserve_energy) {
        copy_row(m.arg(in, 11), lobe.eta, m.end);
        copy_rows(m, in, 12, lobe.f0);
        copy_rows(m, in, 15, lobe.f90);
        copy_rows(m, in, 18, lobe.tint_transmission);
    }
    if (in.imm & nodes::lobe_layer) store_layer(m, in, lobe, 21);
}

void op_bend_normal(const Machine& m, const Instruction& in) {
    const Source3 n = m.arg3(in, 0);
    for (int i = 0; i < m.end; i += W) {
        const Vec3 bent = bend_normal(load3(m.chunk.normal_geometric, i), load3(m.chunk.wo, i), n.at(i));
        store_vec(m, in, 0, i, bent);
    }
}

}  // namespace cardioid::CD_ISA_NS
