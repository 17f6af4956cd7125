// SPDX-License-Identifier: GPL-3.0-or-later
// Volume nodes. Cycles adds extinction and scattering apart from each other; here absorption is their difference.
#include "nodes/node_helpers.h"

namespace cardioid::nodes {

namespace {

Ref density_of(NodeContext& c, Ref weight) {
    return c.b.multiply(weight, c.b.maximum(c.number("Density", 1), c.b.constant(0)));
}

/// Phase function of the node and its parameters.
struct PhaseChoice {
    PhaseKind kind = PhaseKind::henyey_greenstein;
    Ref3 parameter;
};

PhaseChoice phase_of(NodeContext& c) {
    const Ref zero = c.b.constant(0);
    const std::string name = c.text("phase", "HENYEY_GREENSTEIN");
    if (name == "RAYLEIGH") return {PhaseKind::rayleigh, {zero, zero, zero}};
    if (name == "FOURNIER_FORAND")
        return {PhaseKind::fournier_forand, {c.number("Backscatter", 0.1f), c.number("IOR", 1.33f), zero}};
    const Ref anisotropy = c.number("Anisotropy", 0);
    if (name == "DRAINE") return {PhaseKind::draine, {anisotropy, c.number("Alpha", 0.5f), zero}};
    if (name == "MIE") return {PhaseKind::mie, {c.number("Diameter", 20), zero, zero}};
    return {PhaseKind::henyey_greenstein, {anisotropy, zero, zero}};
}

void absorption(NodeContext& c, Ref weight) {
    const Ref3 lost = Builder::each(c.color("Color", {0.8f, 0.8f, 0.8f}), [&](Ref x) { return c.b.one_minus(x); });
    c.absorption(c.b.multiply(lost, density_of(c, weight)));
}

void scatter(NodeContext& c, Ref weight) {
    const PhaseChoice phase = phase_of(c);
    const Ref3 color = c.color("Color", {0.8f, 0.8f, 0.8f});
    c.scattering(phase.kind, c.b.multiply(color, density_of(c, weight)), phase.parameter);
}

void coefficients(NodeContext& c, Ref weight) {
    const PhaseChoice phase = phase_of(c);
    c.scattering(phase.kind, c.b.multiply(c.vector("Scatter Coefficients", {1, 1, 1}), weight), phase.parameter);
    c.absorption(c.b.multiply(c.vector("Absorption Coefficients", {1, 1, 1}), weight));
    c.emission(c.b.multiply(c.vector("Emission Coefficients"), weight));
}

/// Stefan–Boltzmann's law in Blender's units, mixed with 1 by the intensity, times the colour of a black body.
void glow(NodeContext& c, Ref weight) {
    Builder& b = c.b;
    const Ref zero = b.constant(0), one = b.constant(1);
    const Ref intensity = c.number("Blackbody Intensity", 0);
    if (b.is(intensity, 0)) return;
    const Ref t = b.maximum(c.number("Temperature", 1000), zero), t2 = b.multiply(t, t);
    const Ref power = b.multiply(b.mix(one, b.multiply(t2, t2), intensity), b.constant(5.670373e-14f / 3.14159265f));
    const Ref on = b.multiply(weight, b.emit(Op::greater_than, {intensity, zero}));
    const Ref3 tint = c.color("Blackbody Tint", {1, 1, 1});
    c.emission(b.multiply(b.multiply(tint, blackbody_color(c, t)), b.multiply(power, on)));
}

void principled(NodeContext& c, Ref weight) {
    Builder& b = c.b;
    const Ref zero = b.constant(0);
    const Ref density = density_of(c, weight);
    const Ref3 color = c.color("Color", {0.5f, 0.5f, 0.5f});
    c.scattering(PhaseKind::henyey_greenstein, b.multiply(color, density), {c.number("Anisotropy", 0), zero, zero});
    const auto lost = [&](Ref x) { return b.maximum(b.one_minus(x), zero); };
    const Ref3 absorbed = Builder::each(c.color("Absorption Color"),
                                        [&](Ref x) { return lost(b.emit(Op::square_root, {b.maximum(x, zero)})); });
    c.absorption(b.multiply(b.multiply(Builder::each(color, lost), absorbed), density));
    const Ref strength = b.maximum(c.number("Emission Strength", 0), zero);
    c.emission(b.multiply(b.multiply(c.color("Emission Color", {1, 1, 1}), strength), weight));
    glow(c, weight);
}

constexpr NodeType k_nodes[] = {
    {"ShaderNodeVolumeAbsorption", nullptr, absorption, Support::same, ""},
    {"ShaderNodeVolumeScatter", nullptr, scatter, Support::same, ""},
    {"ShaderNodeVolumeCoefficients", nullptr, coefficients, Support::same, ""},
    {"ShaderNodeVolumePrincipled", nullptr, principled, Support::approximated,
     "inside meshes and worlds; grids of density, colour and temperature are not read"},
};

}  // namespace

std::span<const NodeType> volume_nodes() { return k_nodes; }

}  // namespace cardioid::nodes
