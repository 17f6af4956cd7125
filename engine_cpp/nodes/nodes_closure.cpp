// SPDX-License-Identifier: GPL-3.0-or-later
// BSDF, emission and mixing nodes.
#include "nodes/node_helpers.h"

namespace cardioid::nodes {

namespace {

using bsdf::Fresnel;
using bsdf::LobeKind;

/// Colour of a closure times its weight; negative colours are black.
Ref3 weighted(NodeContext& c, Ref weight) {
    return c.b.multiply(c.b.maximum(c.color("Color", {0.8f, 0.8f, 0.8f}), c.b.constant(0)), weight);
}

void mix_shader(NodeContext& c, Ref weight) {
    const Ref fac = c.b.saturate(c.number("Fac", 0.5f));
    c.shader("Shader", c.b.multiply(weight, c.b.one_minus(fac)));
    c.shader("Shader_001", c.b.multiply(weight, fac));
}

void add_shader(NodeContext& c, Ref weight) {
    c.shader("Shader", weight);
    c.shader("Shader_001", weight);
}

void emission(NodeContext& c, Ref weight) {
    c.emission(c.b.multiply(c.b.multiply(c.color("Color", {1, 1, 1}), c.number("Strength", 1)), weight));
}

void transparent(NodeContext& c, Ref weight) { c.transparent(weighted(c, weight)); }
void holdout(NodeContext& c, Ref weight) { c.holdout(weight); }

void diffuse(NodeContext& c, Ref weight) {
    const Ref roughness = c.number("Roughness", 0);
    const bool modern = c.property("version", 1) >= 2 && !c.b.is(roughness, 0);
    c.simple_lobe(LobeKind::diffuse, weighted(c, weight), c.closure_normal("Normal", false), roughness, modern,
                  c.b.saturate(c.color("Color", {0.8f, 0.8f, 0.8f})));
}

void translucent(NodeContext& c, Ref weight) {
    const Ref3 w = weighted(c, weight);
    c.simple_lobe(LobeKind::translucent, w, c.closure_normal("Normal", true), c.b.constant(0), false, w);
}

void subsurface(NodeContext& c, Ref weight) {
    // The boundary's roughness came with the methods' present names.
    const bool before_4 = !c.has("Roughness");
    SubsurfaceLobe l;
    l.albedo = c.b.maximum(c.color("Color", {0.8f, 0.8f, 0.8f}), c.b.constant(0));
    l.weight = c.b.multiply(l.albedo, weight);
    l.normal = c.closure_normal("Normal", true);
    l.radius = c.b.multiply(c.vector("Radius", {1, 0.2f, 0.1f}), c.number("Scale", before_4 ? 1 : 0.05f));
    l.index = c.number("IOR", 1.4f);
    l.anisotropy = c.number("Anisotropy", 0);
    l.alpha = c.number("Roughness", 1);
    c.subsurface_lobe(l, c.text("falloff", "RANDOM_WALK"), before_4);
}

void toon(NodeContext& c, Ref weight) {
    const bool glossy = c.text("component", "DIFFUSE") == "GLOSSY";
    const Ref smooth = c.number("Smooth", 0);
    c.simple_lobe(glossy ? LobeKind::toon_glossy : LobeKind::toon_diffuse, weighted(c, weight),
                  c.closure_normal("Normal", glossy), c.number("Size", 0.5f), false, c.b.broadcast(smooth));
}

void velvet(NodeContext& c, Ref weight) {
    const Ref3 w = weighted(c, weight);
    c.simple_lobe(LobeKind::velvet, w, c.closure_normal("Normal", false), c.b.saturate(c.number("Sigma", 1)), false, w);
}

void sheen(NodeContext& c, Ref weight) {
    const Ref3 w = weighted(c, weight);
    const Ref roughness = c.b.saturate(c.number("Roughness", 0.5f));
    const Ref3 n = c.closure_normal("Normal", false);
    if (c.text("distribution", "MICROFIBER") == "ASHIKHMIN")
        c.simple_lobe(LobeKind::velvet, w, n, roughness, false, w);
    else
        c.sheen_lobe(w, n, roughness, w);
}

/// Distribution, and masking as Blender before 3.5 had it.
void set_distribution(NodeContext& c, GgxLobe& l, double first_version) {
    const std::string name = c.text("distribution", "GGX");
    if (name == "BECKMANN") l.distribution = bsdf::Distribution::beckmann;
    if (name == "ASHIKHMIN_SHIRLEY") l.distribution = bsdf::Distribution::ashikhmin_shirley;
    const bool old = c.property("version", first_version) < 2;
    l.walks_facets = old && name == "MULTI_GGX";
    l.separable_masking = old && !l.walks_facets;
}

/// Blender's roughness, squared; 0 for the old "sharp" distribution.
Ref alpha_of(NodeContext& c, float fallback) {
    if (c.text("distribution") == "SHARP") return c.b.constant(0);
    const Ref r = c.b.saturate(c.number("Roughness", fallback));
    return c.b.multiply(r, r);
}

void glossy(NodeContext& c, Ref weight) {
    GgxLobe l = c.ggx();
    l.weight = weighted(c, weight);
    l.normal = c.closure_normal("Normal", true);
    l.alpha_x = l.alpha_y = alpha_of(c, 0.5f);
    set_distribution(c, l, 2);
    l.preserve_energy = c.text("distribution", "GGX") == "MULTI_GGX";
    if (l.preserve_energy) l.f0 = c.b.saturate(c.color("Color"));
    const Ref anisotropy = c.b.emit(Op::clamp, {c.number("Anisotropy", 0), c.b.constant(-0.99f), c.b.constant(0.99f)});
    if (!c.b.is(anisotropy, 0)) {
        // Positive stretches along the second axis, negative along the first.
        const Ref alpha = l.alpha_x, one = c.b.constant(1);
        const Ref plus = c.b.add(one, anisotropy), minus = c.b.subtract(one, anisotropy);
        l.alpha_x = c.b.select_positive(anisotropy, c.b.multiply(alpha, minus), c.b.divide(alpha, plus));
        l.alpha_y = c.b.select_positive(anisotropy, c.b.divide(alpha, minus), c.b.multiply(alpha, plus));
        l.tangent = rotated_tangent(c, l.normal, "Tangent", "Rotation");
    }
    c.ggx_lobe(l);
}

/// Before 4.0 rough glass is two lobes, weighted by the Fresnel term of the whole surface instead of each facet's.
void old_rough_glass(NodeContext& c, GgxLobe l) {
    const Ref3 weight = l.weight;
    const Ref f = fresnel(c, c.b.dot(l.normal, c.b.chunk3(ChunkRow::wo)), l.eta);
    l.kind = LobeKind::ggx_reflection;
    l.fresnel = Fresnel::none;
    l.weight = c.b.multiply(weight, f);
    c.ggx_lobe(l);
    l.kind = LobeKind::ggx_refraction;
    l.weight = c.b.multiply(weight, c.b.maximum(c.b.one_minus(f), c.b.constant(0.0001f)));
    c.ggx_lobe(l);
}

void glass(NodeContext& c, Ref weight) {
    GgxLobe l = c.ggx();
    l.kind = LobeKind::ggx_glass;
    l.fresnel = Fresnel::dielectric;
    l.weight = weighted(c, weight);
    l.normal = c.closure_normal("Normal", true);
    l.alpha_x = l.alpha_y = alpha_of(c, 0);
    l.f0 = c.b.saturate(c.color("Color"));
    l.eta = sided_eta(c, c.number("IOR", 1.45f));
    set_distribution(c, l, 1);
    set_film(c, l, true, c.b.maximum(c.number("IOR", 1.45f), c.b.constant(1e-5f)));
    const bool smooth = c.b.is_constant(l.alpha_x) && c.b.value(l.alpha_x) <= bsdf::k_delta_alpha;
    const bool multi = c.text("distribution", "GGX") == "MULTI_GGX";
    if (c.property("version", 1) < 2 && !smooth && !multi) {
        old_rough_glass(c, l);
        return;
    }
    l.preserve_energy = multi && !smooth;
    c.ggx_lobe(l);
}

void refraction(NodeContext& c, Ref weight) {
    GgxLobe l = c.ggx();
    l.kind = LobeKind::ggx_refraction;
    l.weight = weighted(c, weight);
    l.normal = c.closure_normal("Normal", true);
    l.alpha_x = l.alpha_y = alpha_of(c, 0);
    l.eta = sided_eta(c, c.number("IOR", 1.45f));
    set_distribution(c, l, 2);
    c.ggx_lobe(l);
}

void metallic(NodeContext& c, Ref weight) {
    GgxLobe l = c.ggx();
    const Ref zero = c.b.constant(0);
    l.weight = c.b.broadcast(weight);
    l.normal = c.closure_normal("Normal", true);
    l.preserve_energy = c.text("distribution", "MULTI_GGX") == "MULTI_GGX";
    set_distribution(c, l, 2);
    set_film(c, l);
    const Ref alpha = alpha_of(c, 0.5f);
    l.alpha_x = l.alpha_y = alpha;
    const Ref anisotropy = c.b.saturate(c.number("Anisotropy", 0));
    if (!c.b.is(anisotropy, 0)) {
        anisotropic_alpha(c, alpha, anisotropy, l);
        l.tangent = rotated_tangent(c, l.normal, "Tangent", "Rotation");
    }
    if (c.text("fresnel_type", "F82") == "PHYSICAL_CONDUCTOR") {
        l.fresnel = Fresnel::conductor;
        l.f0 = c.b.maximum(c.vector("IOR", {2.757f, 2.513f, 2.231f}), zero);
        l.f90 = c.b.maximum(c.vector("Extinction", {3.867f, 3.404f, 3.009f}), zero);
    } else {
        l.fresnel = Fresnel::f82;
        l.f0 = c.b.saturate(c.color("Base Color", {0.617f, 0.577f, 0.540f}));
        l.f90 = c.b.saturate(c.color("Edge Tint", {0.695f, 0.726f, 0.770f}));
    }
    c.ggx_lobe(l);
}

constexpr SupportByVersion k_multi_34 = {Support::approximated, Support::same, Support::same, Support::same};
constexpr const char* k_multi =
    "3.4's Multiscatter GGX is compensated by albedo as in 4.0 and later, not walked between facets";

constexpr const char* k_glossy =
    "GGX and Beckmann are the same; Ashikhmin-Shirley lacks light that Cycles adds at grazing angles; 3.4's "
    "Multiscatter GGX is "
    "compensated by albedo";

constexpr NodeType k_nodes[] = {
    {"ShaderNodeMixShader", nullptr, mix_shader, Support::same, ""},
    {"ShaderNodeAddShader", nullptr, add_shader, Support::same, ""},
    {"ShaderNodeEmission", nullptr, emission, Support::same, ""},
    {"ShaderNodeBackground", nullptr, emission, Support::same, ""},
    {"ShaderNodeBsdfTransparent", nullptr, transparent, Support::same, ""},
    {"ShaderNodeHoldout", nullptr, holdout, Support::same, ""},
    {"ShaderNodeBsdfDiffuse", nullptr, diffuse, Support::same, ""},
    {"ShaderNodeBsdfTranslucent", nullptr, translucent, Support::same, ""},
    {"ShaderNodeBsdfGlossy", nullptr, glossy, Support::approximated, k_glossy},
    {"ShaderNodeBsdfAnisotropic", nullptr, glossy, Support::approximated, k_glossy},
    {"ShaderNodeBsdfGlass", nullptr, glass, k_multi_34, k_multi},
    {"ShaderNodeBsdfRefraction", nullptr, refraction, Support::same, ""},
    {"ShaderNodeBsdfMetallic", nullptr, metallic, since_45(Support::same), ""},
    {"ShaderNodeBsdfVelvet", nullptr, velvet, only_34(Support::same), ""},
    {"ShaderNodeBsdfSheen", nullptr, sheen, since_45(Support::same), ""},
    {"ShaderNodeSubsurfaceScattering", nullptr, subsurface, Support::same, ""},
    {"ShaderNodeBsdfToon",
     nullptr,
     toon,
     {Support::approximated, Support::same, Support::same, Support::same},
     "3.4 fades Smooth by another angle for indirect light; ours is the same for all"},
};

}  // namespace

std::span<const NodeType> closure_nodes() { return k_nodes; }

}  // namespace cardioid::nodes
