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
/// Anisotropy may have stretched it over 1.
void copy_alpha(const Source& s, float* row, int end) {
    for (int i = 0; i < end; i += W) store(row + i, min(s.at(i), 1.0f));
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
    lobe.walks_facets = (in.imm & nodes::lobe_walks_facets) != 0;
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
void op_displacement(const Machine& m, const Instruction& in) { copy_rows(m, in, 0, m.out.displacement); }
void op_set_normal(const Machine& m, const Instruction& in) { copy_rows(m, in, 0, m.out.normal); }
void op_transparent(const Machine& m, const Instruction& in) { add_rows(m, in, m.out.transparency); }
void op_holdout(const Machine& m, const Instruction& in) {
    const Source s = m.arg(in, 0);
    for (int i = 0; i < m.end; i += W) store(m.out.holdout + i, load(m.out.holdout + i) + s.at(i));
}

void op_lobe_simple(const Machine& m, const Instruction& in) {
    Lobe& lobe = begin_lobe(m, in, m.out.lobe[m.out.lobes]);
    copy_row(m.arg(in, 6), lobe.roughness, m.end);
    const bool toon = lobe.kind == LobeKind::toon_diffuse || lobe.kind == LobeKind::toon_glossy;
    if (toon) copy_row(m.arg(in, 7), lobe.alpha_x, m.end);
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
    copy_alpha(m.arg(in, 9), lobe.alpha_x, m.end);
    copy_alpha(m.arg(in, 10), lobe.alpha_y, m.end);
    if (lobe.thin_film) {
        copy_row(m.arg(in, 24), lobe.roughness, m.end);
        copy_row(m.arg(in, 25), lobe.film_ior, m.end);
    }
    if (lobe.kind != LobeKind::ggx_reflection || lobe.fresnel != Fresnel::none || lobe.preserve_energy) {
        copy_row(m.arg(in, 11), lobe.eta, m.end);
        copy_rows(m, in, 12, lobe.f0);
        copy_rows(m, in, 15, lobe.f90);
        copy_rows(m, in, 18, lobe.tint_transmission);
    }
    if (in.imm & nodes::lobe_layer) store_layer(m, in, lobe, 21);
}

namespace {

/// alpha' of the dipole whose diffuse reflectance is rd (Jensen & Buhler 2002), by bisection as Cycles does.
Float dipole_albedo(Float rd, Float four_thirds_a) {
    Float low = 0.0f, high = 1.0f, middle = 0.5f;
    for (int k = 0; k < 12; ++k) {
        middle = 0.5f * (low + high);
        const Float s = sqrt(3.0f * (1.0f - middle));
        const Mask under = 0.5f * middle * (1.0f + exp(-four_thirds_a * s)) * exp(-s) < rd;
        low = select(under, middle, low);
        high = select(under, high, middle);
    }
    return select(rd < Float(1e-4f), Float(0.0f), select(rd >= Float(0.995f), Float(0.999999f), middle));
}

/// Factor that turns the radius of Random Walk (Skin) into a mean free path.
Float skin_factor(Float albedo, Float eta) {
    const Float inv = 1.0f / eta;
    const Float f = inv * (0.710f - 1.440f * inv) + 0.668f + 0.0636f * eta;
    return sqrt(3.0f * (1.0f - dipole_albedo(albedo, (4.0f / 3.0f) * (1.0f + f) / (1.0f - f))));
}

}  // namespace

void op_lobe_subsurface(const Machine& m, const Instruction& in) {
    Lobe& lobe = begin_lobe(m, in, m.out.lobe[m.out.lobes]);
    const bool of_v1 = (in.imm & nodes::lobe_v1_exit) != 0, skin = (in.imm & nodes::lobe_skin_radius) != 0;
    copy_rows(m, in, 6, lobe.f0);
    const Source index = m.arg(in, 12), anisotropy = m.arg(in, 13), alpha = m.arg(in, 14);
    for (int i = 0; i < m.end; i += W) {
        const Float eta = clamp(index.at(i), 1.01f, 3.8f);
        store(lobe.eta + i, eta);
        store(lobe.roughness + i, clamp(anisotropy.at(i), 0.0f, 0.9f));
        store(lobe.alpha_x + i, saturate(alpha.at(i)));
        store(lobe.alpha_y + i, Float(of_v1 ? 1.0f : 0.0f));
        for (int c = 0; c < 3; ++c) {
            const Float radius = max(m.arg(in, 9 + c).at(i), 0.0f);
            const Float factor = skin ? skin_factor(load(lobe.f0[c] + i), eta) : Float(0.25f * k_inv_pi);
            store(lobe.f90[c] + i, radius * factor);
        }
    }
}

void op_lobe_hair(const Machine& m, const Instruction& in) {
    Lobe& lobe = begin_lobe(m, in, m.out.lobe[m.out.lobes]);
    copy_rows(m, in, 6, lobe.tangent);
    copy_row(m.arg(in, 9), lobe.alpha_x, m.end);
    copy_row(m.arg(in, 10), lobe.alpha_y, m.end);
    copy_row(m.arg(in, 11), lobe.roughness, m.end);
    copy_row(m.arg(in, 12), lobe.eta, m.end);
    copy_rows(m, in, 13, lobe.f0);
    copy_rows(m, in, 16, lobe.f90);
    copy_rows(m, in, 19, lobe.tint_transmission);
}

void op_bend_normal(const Machine& m, const Instruction& in) {
    const Source3 n = m.arg3(in, 0);
    for (int i = 0; i < m.end; i += W) {
        const Vec3 bent = bend_normal(load3(m.chunk.normal_geometric, i), load3(m.chunk.wo, i), n.at(i));
        store_vec(m, in, 0, i, bent);
    }
}

}  // namespace cardioid::CD_ISA_NS
