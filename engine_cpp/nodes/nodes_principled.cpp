// SPDX-License-Identifier: GPL-3.0-or-later
// Principled BSDF as before Blender 4.0 (v1: a sum of Disney lobes) and since (v2: layers scaled by albedo).
#include "nodes/node_helpers.h"

namespace cardioid::nodes {

namespace {

using bsdf::Fresnel;
using bsdf::LobeKind;

// ---------------------------------------------------------------------------------------------------- version 1

/// Colours and weights that several lobes of version 1 share.
struct V1 {
    Ref3 base;  ///< base colour
    Ref3 tint;  ///< base colour at luminance 1
    Ref3 normal;
    Ref roughness, metallic, transmission, specular_tint;
    Ref diffuse_weight;  ///< share of neither metal nor glass
    bool multi_ggx = false;
};

/// Hue and saturation of a colour: divided by its luminance, white for black.
Ref3 hue_of(NodeContext& c, Ref3 color, Ref luminance) {
    const Ref one = c.b.constant(1);
    return c.b.each(color, [&](Ref x) { return c.b.select_positive(luminance, c.b.divide(x, luminance), one); });
}

/// Subsurface radii shrink with its weight; what goes in is a mix of both colours.
void v1_subsurface(NodeContext& c, const V1& p, Ref weight, Ref subsurface, Ref3 color) {
    SubsurfaceLobe l;
    l.albedo = color;
    l.weight = c.b.multiply(color, weight);
    l.normal = p.normal;
    l.radius = c.b.multiply(c.vector("Subsurface Radius", {1, 0.2f, 0.1f}), subsurface);
    l.index = c.number("Subsurface IOR", 1.4f);
    l.anisotropy = c.number("Subsurface Anisotropy", 0);
    l.alpha = c.b.constant(1);
    l.v1 = true;
    c.subsurface_lobe(l, c.text("subsurface_method", "RANDOM_WALK"), true);
}

void v1_diffuse(NodeContext& c, const V1& p, Ref weight) {
    const Ref subsurface = c.number("Subsurface", 0), zero = c.b.constant(0);
    const Ref w = c.b.multiply(weight, p.diffuse_weight);
    if (c.b.is(subsurface, 0)) {
        const Ref3 color = c.b.multiply(c.b.maximum(p.base, zero), w);
        c.simple_lobe(LobeKind::burley, color, p.normal, p.roughness, false, p.base);
    } else {
        // Points without subsurface have the whole diffuse lobe, the others its retro-reflection.
        const Ref3 color =
            c.b.maximum(c.b.mix(p.base, c.color("Subsurface Color", {0.8f, 0.8f, 0.8f}), subsurface), zero);
        const Ref on = c.b.emit(Op::greater_than, {subsurface, c.b.constant(1e-5f)}), off = c.b.one_minus(on);
        v1_subsurface(c, p, c.b.multiply(w, on), subsurface, color);
        c.simple_lobe(LobeKind::burley, c.b.multiply(color, c.b.multiply(w, on)), p.normal, p.roughness, true, color);
        c.simple_lobe(LobeKind::burley, c.b.multiply(p.base, c.b.multiply(w, off)), p.normal, p.roughness, false,
                      color);
    }
    const Ref sheen = c.b.maximum(c.number("Sheen", 0), c.b.constant(0));
    if (c.b.is(sheen, 0)) return;
    const Ref3 hue = hue_of(c, p.base, c.b.luminance(p.base));
    const Ref3 tint = c.b.mix(c.b.constant(Float3{1, 1, 1}), hue, c.number("Sheen Tint", 0.5f));
    c.simple_lobe(LobeKind::sheen_v1, c.b.multiply(tint, c.b.multiply(w, sheen)), p.normal, p.roughness, false, tint);
}

void v1_specular(NodeContext& c, const V1& p, Ref weight) {
    const Ref one = c.b.constant(1);
    const Ref specular = c.number("Specular", 0.5f);
    if (c.b.is(specular, 0) && c.b.is(p.metallic, 0)) return;
    GgxLobe l = c.ggx();
    l.fresnel = Fresnel::principled_v1;
    const Ref glass = c.b.multiply(p.transmission, c.b.one_minus(p.metallic));
    l.weight = c.b.broadcast(c.b.multiply(weight, c.b.one_minus(glass)));
    l.normal = p.normal;
    l.separable_masking = !p.multi_ggx;
    l.walks_facets = p.multi_ggx;
    const Ref reflectance = c.b.multiply(specular, c.b.constant(0.08f));
    const Ref root = c.b.emit(Op::square_root, {reflectance});
    l.eta = c.b.subtract(c.b.divide(c.b.constant(2), c.b.one_minus(root)), one);
    l.alpha_x = l.alpha_y = c.b.multiply(p.roughness, p.roughness);
    const Ref anisotropic = c.b.saturate(c.number("Anisotropic", 0));
    if (!c.b.is(anisotropic, 0)) {
        anisotropic_alpha(c, l.alpha_x, anisotropic, l);
        l.tangent = rotated_tangent(c, p.normal, "Tangent", "Anisotropic Rotation");
    }
    const Ref gray = c.b.dot(p.base, c.b.constant(Float3{0.3f, 0.6f, 0.1f}));
    const Ref3 tint = c.b.mix(c.b.constant(Float3{1, 1, 1}), hue_of(c, p.base, gray), p.specular_tint);
    l.f0 = c.b.add(c.b.multiply(c.b.multiply(tint, reflectance), c.b.one_minus(p.metallic)),
                   c.b.multiply(p.base, p.metallic));
    l.preserve_energy = p.multi_ggx && !(c.b.is_constant(p.roughness) && c.b.value(p.roughness) <= 0.075f);
    c.ggx_lobe(l);
}

void v1_transmission(NodeContext& c, const V1& p, Ref weight) {
    const Ref glass = c.b.multiply(p.transmission, c.b.one_minus(p.metallic));
    if (c.b.is(glass, 0)) return;
    const Ref3 w = c.b.broadcast(c.b.multiply(weight, glass));
    GgxLobe l = c.ggx();
    l.normal = p.normal;
    l.separable_masking = !p.multi_ggx;
    l.walks_facets = p.multi_ggx;
    l.eta = sided_eta(c, c.number("IOR", 1.45f));
    l.alpha_x = l.alpha_y = c.b.multiply(p.roughness, p.roughness);
    const Ref3 front = c.b.mix(c.b.constant(Float3{1, 1, 1}), p.base, p.specular_tint);
    const bool smooth = c.b.is_constant(p.roughness) && c.b.value(p.roughness) <= 0.05f &&
                        c.b.is(c.number("Transmission Roughness", 0), 0);
    if (c.b.is(front, 1) && (smooth || p.multi_ggx)) {
        l.kind = LobeKind::ggx_glass;
        l.fresnel = Fresnel::dielectric;
        l.preserve_energy = p.multi_ggx && !smooth;
        l.weight = w;
        l.tint = l.f0 = p.base;
        c.ggx_lobe(l);
        return;
    }
    // Reflection and refraction are two lobes, weighted by the Fresnel term of the whole surface.
    const Ref f = fresnel(c, c.b.dot(p.normal, c.b.chunk3(ChunkRow::wo)), l.eta);
    l.fresnel = Fresnel::principled_v1;
    l.weight = c.b.multiply(w, f);
    l.f0 = front;
    c.ggx_lobe(l);
    Ref rough = p.roughness;
    if (!p.multi_ggx)
        rough = c.b.one_minus(c.b.multiply(c.b.one_minus(rough), c.b.one_minus(c.number("Transmission Roughness", 0))));
    l.kind = LobeKind::ggx_refraction;
    l.fresnel = Fresnel::none;
    l.weight = c.b.multiply(c.b.multiply(w, p.base), c.b.maximum(c.b.one_minus(f), c.b.constant(0.0001f)));
    l.alpha_x = l.alpha_y = c.b.multiply(rough, rough);
    c.ggx_lobe(l);
}

void v1_clearcoat(NodeContext& c, Ref weight) {
    const Ref clearcoat = c.b.maximum(c.number("Clearcoat", 0), c.b.constant(0));
    if (c.b.is(clearcoat, 0)) return;
    GgxLobe l = c.ggx();
    l.fresnel = Fresnel::principled_v1;
    l.weight = c.b.broadcast(c.b.multiply(weight, c.b.multiply(clearcoat, c.b.constant(0.25f))));
    l.normal = c.closure_normal("Clearcoat Normal", true);
    l.distribution = bsdf::Distribution::gtr1;
    const Ref r = c.number("Clearcoat Roughness", 0.03f);
    l.alpha_x = l.alpha_y = c.b.multiply(r, r);
    l.eta = c.b.constant(1.5f);
    l.f0 = c.b.constant(Float3{0.04f, 0.04f, 0.04f});
    c.ggx_lobe(l);
}

void principled_v1(NodeContext& c, Ref weight) {
    const Ref alpha = c.b.saturate(c.number("Alpha", 1));
    c.transparent(c.b.broadcast(c.b.multiply(weight, c.b.one_minus(alpha))));
    weight = c.b.multiply(weight, alpha);
    c.emission(c.b.multiply(c.b.multiply(c.color("Emission"), c.number("Emission Strength", 1)), weight));
    if (c.b.optimise() && c.b.is(weight, 0)) return;
    V1 p;
    p.base = c.color("Base Color", {0.8f, 0.8f, 0.8f});
    p.normal = c.closure_normal("Normal", true);
    p.roughness = c.b.saturate(c.number("Roughness", 0.5f));
    p.metallic = c.b.saturate(c.number("Metallic", 0));
    p.transmission = c.b.saturate(c.number("Transmission", 0));
    p.specular_tint = c.number("Specular Tint", 0);
    p.diffuse_weight = c.b.multiply(c.b.one_minus(p.metallic), c.b.one_minus(p.transmission));
    p.multi_ggx = c.text("distribution", "GGX") == "MULTI_GGX";
    v1_diffuse(c, p, weight);
    v1_specular(c, p, weight);
    v1_transmission(c, p, weight);
    v1_clearcoat(c, weight);
}

// ---------------------------------------------------------------------------------------------------- version 2

struct V2 {
    Ref3 weight;  ///< what the layers above leave
    Ref3 base, clamped_base, specular_tint;
    Ref3 normal;
    Ref roughness, alpha_x, alpha_y;
    Ref3 tangent;
    Ref ior;
    Ref specular_eta;  ///< of the specular layer: the index as the specular level changes it
    bool multi_ggx = true;
};

void v2_sheen(NodeContext& c, V2& p, Ref coat_weight) {
    const Ref sheen = c.b.maximum(c.number("Sheen Weight", 0), c.b.constant(0));
    if (c.b.is(sheen, 0)) return;
    const Ref3 n = c.closure_normal("Normal", false);
    const Ref3 coat_normal = c.vector_or("Coat Normal", c.property("version", 2) >= 3 ? n : c.normal());
    const Ref3 mixed = c.b.normalize(c.b.mix(n, coat_normal, c.b.saturate(coat_weight)));
    const Ref3 tint = c.b.maximum(c.color("Sheen Tint", {1, 1, 1}), c.b.constant(0));
    const Ref3 w = c.b.multiply(c.b.multiply(p.weight, tint), sheen);
    p.weight =
        c.b.multiply(p.weight, c.sheen_lobe(w, mixed, c.b.saturate(c.number("Sheen Roughness", 0.5f)), p.weight));
}

void v2_coat(NodeContext& c, V2& p, Ref coat) {
    if (c.b.is(coat, 0)) return;
    const Ref one = c.b.constant(1);
    GgxLobe l = c.ggx();
    l.fresnel = Fresnel::dielectric;
    l.weight = c.b.multiply(p.weight, coat);
    l.layer_weight = p.weight;
    // Since 5.0 a coat without a normal of its own follows the node's.
    const bool follows = c.property("version", 2) >= 3 && !c.linked("Coat Normal");
    l.normal = c.closure_normal(follows ? "Normal" : "Coat Normal", true);
    l.eta = c.b.maximum(c.number("Coat IOR", 1.5f), one);
    const Ref r = c.b.saturate(c.number("Coat Roughness", 0.03f));
    l.alpha_x = l.alpha_y = c.b.multiply(r, r);
    p.weight = c.b.multiply(p.weight, c.ggx_lobe(l));
    const Ref3 tint = c.b.maximum(c.color("Coat Tint", {1, 1, 1}), c.b.constant(0));
    if (c.b.is(tint, 1)) return;
    // Absorption along the refracted ray through a coat of thickness 1.
    const Ref cosine = c.b.dot(c.b.chunk3(ChunkRow::wo), l.normal);
    const Ref inv = c.b.divide(one, l.eta);
    const Ref sine2 = c.b.multiply(c.b.multiply(inv, inv), c.b.one_minus(c.b.multiply(cosine, cosine)));
    const Ref depth = c.b.divide(one, c.b.emit(Op::square_root, {c.b.one_minus(sine2)}));
    const Ref3 through = c.b.each(tint, [&](Ref t) { return c.b.mix(one, c.b.emit(Op::power, {t, depth}), coat); });
    p.weight = c.b.multiply(p.weight, through);
}

void v2_metal(NodeContext& c, V2& p) {
    const Ref metallic = c.b.saturate(c.number("Metallic", 0));
    GgxLobe l = c.ggx();
    l.fresnel = Fresnel::f82;
    l.preserve_energy = p.multi_ggx;
    l.weight = c.b.multiply(p.weight, metallic);
    l.normal = p.normal;
    l.alpha_x = p.alpha_x;
    l.alpha_y = p.alpha_y;
    l.tangent = p.tangent;
    l.f0 = p.clamped_base;
    l.f90 = c.b.minimum(p.specular_tint, c.b.constant(1));
    if (c.property("version", 2) >= 3) set_film(c, l);
    c.ggx_lobe(l);
    p.weight = c.b.multiply(p.weight, c.b.one_minus(metallic));
}

/// ((ior - 1)/(ior + 1))²
Ref f0_of(NodeContext& c, Ref ior) {
    const Ref one = c.b.constant(1);
    const Ref q = c.b.divide(c.b.subtract(ior, one), c.b.add(ior, one));
    return c.b.multiply(q, q);
}

void v2_glass(NodeContext& c, V2& p) {
    const Ref transmission = c.b.saturate(c.number("Transmission Weight", 0));
    if (c.b.is(transmission, 0)) return;
    GgxLobe l = c.ggx();
    l.kind = LobeKind::ggx_glass;
    l.weight = c.b.multiply(p.weight, transmission);
    l.normal = p.normal;
    l.alpha_x = l.alpha_y = c.b.multiply(p.roughness, p.roughness);
    l.eta = sided_eta(c, p.ior);
    l.tint = c.b.each(p.clamped_base, [&](Ref x) { return c.b.emit(Op::square_root, {x}); });
    l.preserve_energy = p.multi_ggx && !c.b.is(p.roughness, 0);
    // A white tint makes the rescaled Schlick term the dielectric one.
    l.fresnel = c.b.is(p.specular_tint, 1) ? Fresnel::dielectric : Fresnel::schlick;
    set_film(c, l, true, p.ior);
    l.f0 = l.fresnel == Fresnel::dielectric ? l.f0 : c.b.multiply(p.specular_tint, f0_of(c, p.ior));
    c.ggx_lobe(l);
    p.weight = c.b.multiply(p.weight, c.b.one_minus(transmission));
}

void v2_specular(NodeContext& c, V2& p) {
    const Ref level = c.b.maximum(c.number("Specular IOR Level", 0.5f), c.b.constant(0));
    Ref eta = p.ior, f0 = f0_of(c, p.ior);
    if (!c.b.is(level, 0.5f)) {
        f0 = c.b.multiply(f0, c.b.multiply(level, c.b.constant(2)));
        const Ref one = c.b.constant(1);
        const Ref root = c.b.emit(Op::square_root, {c.b.minimum(f0, c.b.constant(0.99f))});
        const Ref dense = c.b.divide(c.b.add(one, root), c.b.one_minus(root));
        eta = c.b.select_positive(c.b.one_minus(p.ior), c.b.divide(one, dense), dense);
    }
    p.specular_eta = eta;
    GgxLobe l = c.ggx();
    set_film(c, l);
    if (c.b.is(eta, 1) && c.b.is(l.film_thickness, 0)) return;
    l.fresnel = Fresnel::schlick;
    l.preserve_energy = p.multi_ggx;
    l.weight = l.layer_weight = p.weight;
    l.normal = p.normal;
    l.eta = eta;
    l.alpha_x = p.alpha_x;
    l.alpha_y = p.alpha_y;
    l.tangent = p.tangent;
    l.f0 = c.b.multiply(p.specular_tint, f0);
    p.weight = c.b.multiply(p.weight, c.ggx_lobe(l));
}

void v2_subsurface(NodeContext& c, const V2& p, Ref subsurface) {
    if (c.b.is(subsurface, 0)) return;
    const std::string method = c.text("subsurface_method", "RANDOM_WALK");
    SubsurfaceLobe l;
    l.albedo = p.clamped_base;
    l.weight = c.b.multiply(c.b.multiply(p.clamped_base, p.weight), subsurface);
    l.normal = p.normal;
    l.radius = c.b.multiply(c.vector("Subsurface Radius", {1, 0.2f, 0.1f}), c.number("Subsurface Scale", 0.05f));
    l.index = method == "RANDOM_WALK_SKIN" ? c.number("Subsurface IOR", 1.4f) : p.specular_eta;
    l.anisotropy = c.number("Subsurface Anisotropy", 0);
    l.alpha = c.b.multiply(p.roughness, p.roughness);
    c.subsurface_lobe(l, method, false);
}

void principled_v2(NodeContext& c, Ref mix_weight) {
    const Ref zero = c.b.constant(0);
    const Ref alpha = c.b.saturate(c.number("Alpha", 1));
    c.transparent(c.b.broadcast(c.b.multiply(mix_weight, c.b.one_minus(alpha))));
    V2 p;
    p.weight = c.b.broadcast(c.b.multiply(mix_weight, alpha));
    if (c.b.optimise() && c.b.is(p.weight, 0)) return;
    const Ref coat = c.b.maximum(c.number("Coat Weight", 0), zero);
    v2_sheen(c, p, coat);
    v2_coat(c, p, coat);
    const Ref3 emitted = c.b.multiply(c.color("Emission Color", {1, 1, 1}), c.number("Emission Strength", 0));
    c.emission(c.b.multiply(emitted, p.weight));

    p.base = c.b.maximum(c.color("Base Color", {0.8f, 0.8f, 0.8f}), zero);
    p.clamped_base = c.b.minimum(p.base, c.b.constant(1));
    p.specular_tint = c.b.maximum(c.color("Specular Tint", {1, 1, 1}), zero);
    p.normal = c.closure_normal("Normal", true);
    p.roughness = c.b.saturate(c.number("Roughness", 0.5f));
    p.ior = c.b.maximum(c.number("IOR", 1.5f), c.b.constant(1e-5f));
    p.multi_ggx = c.text("distribution", "MULTI_GGX") == "MULTI_GGX";
    p.alpha_x = p.alpha_y = c.b.multiply(p.roughness, p.roughness);
    p.tangent = c.b.constant(Float3{0, 0, 0});
    const Ref anisotropic = c.b.saturate(c.number("Anisotropic", 0));
    if (!c.b.is(anisotropic, 0)) {
        GgxLobe stretched = c.ggx();
        anisotropic_alpha(c, p.alpha_x, anisotropic, stretched);
        p.alpha_x = stretched.alpha_x;
        p.alpha_y = stretched.alpha_y;
        p.tangent = rotated_tangent(c, p.normal, "Tangent", "Anisotropic Rotation");
    }
    v2_metal(c, p);
    v2_glass(c, p);
    v2_specular(c, p);
    const Ref subsurface = c.b.saturate(c.number("Subsurface Weight", 0));
    v2_subsurface(c, p, subsurface);
    const Ref roughness = c.b.saturate(c.number("Diffuse Roughness", 0));
    const Ref3 rest = c.b.multiply(p.weight, c.b.one_minus(subsurface));
    c.simple_lobe(LobeKind::diffuse, c.b.multiply(p.base, rest), c.closure_normal("Normal", false), roughness,
                  !c.b.is(roughness, 0), p.clamped_base);
}

void principled(NodeContext& c, Ref weight) {
    // Sockets decide when the exporter did not say: version 2 renamed most of them.
    const double guess = c.has("Specular IOR Level") || c.has("Transmission Weight") || c.has("Emission Color") ? 2 : 1;
    if (c.property("version", guess) >= 2) {
        principled_v2(c, weight);
    } else {
        principled_v1(c, weight);
    }
}

constexpr NodeType k_nodes[] = {
    {"ShaderNodeBsdfPrincipled",
     nullptr,
     principled,
     {Support::approximated, Support::approximated, Support::same, Support::same},
     "3.4: Multiscatter GGX is compensated by albedo, Clearcoat is sampled by its own density; 4.5: thin films have "
     "the "
     "colours of 5.0"},
};

}  // namespace

std::span<const NodeType> principled_nodes() { return k_nodes; }

}  // namespace cardioid::nodes
