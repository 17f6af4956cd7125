// SPDX-License-Identifier: GPL-3.0-or-later
// The lobes that the statistical tests go through.
#pragma once

#include "model.h"

#include <vector>

namespace cardioid::test {

struct Case {
    Model model;
    Vec3 wo;
    std::string name;
};

/// Other distributions than GGX, masking by independent factors, and films.
inline void add_facets(std::vector<Model>& out) {
    using bsdf::Distribution;
    using bsdf::Fresnel;
    using bsdf::LobeKind;
    for (const float r : {0.15f, 0.5f, 1.0f}) {
        const std::string name = std::to_string(r);
        bsdf::Lobe l = lobe_of(LobeKind::ggx_reflection, r);
        l.distribution = Distribution::beckmann;
        out.push_back(model_of("beckmann " + name, l));
        l.separable_masking = true;
        out.push_back(model_of("beckmann separable " + name, l));
        l.distribution = Distribution::ggx;
        out.push_back(model_of("ggx separable " + name, l));
        l.distribution = Distribution::ashikhmin_shirley;
        out.push_back(model_of("ashikhmin-shirley " + name, l));
        l.distribution = Distribution::gtr1;
        out.push_back(model_of("gtr1 " + name, l));
        bsdf::Lobe glass = lobe_of(LobeKind::ggx_glass, r, Fresnel::dielectric, 1.5f);
        glass.distribution = Distribution::beckmann;
        out.push_back(model_of("beckmann glass " + name, glass));
        glass = lobe_of(LobeKind::ggx_refraction, r, Fresnel::none, 1.5f);
        glass.distribution = Distribution::beckmann;
        glass.separable_masking = true;
        out.push_back(model_of("beckmann refraction separable " + name, glass));
    }
    for (const auto d : {Distribution::beckmann, Distribution::ashikhmin_shirley}) {
        bsdf::Lobe l = lobe_of(LobeKind::ggx_reflection, 0.5f);
        l.distribution = d;
        fill(l.alpha_x, 0.6f);
        fill(l.alpha_y, 0.15f);
        fill3(l.tangent, 0.6f, 0.8f, 0.3f);
        out.push_back(model_of("anisotropic " + std::to_string(static_cast<int>(d)), l));
    }
}

inline void add_films(std::vector<Model>& out) {
    using bsdf::Fresnel;
    using bsdf::LobeKind;
    const auto add = [&](const std::string& name, bsdf::Lobe l, float thickness) {
        l.thin_film = true;
        fill(l.roughness, thickness);
        fill(l.film_ior, 1.33f);
        out.push_back(model_of("film " + name, l));
    };
    add("dielectric", lobe_of(LobeKind::ggx_reflection, 0.4f, Fresnel::dielectric, 1.5f), 400);
    add("glass", lobe_of(LobeKind::ggx_glass, 0.4f, Fresnel::dielectric, 1.5f), 700);
    add("glass inside", lobe_of(LobeKind::ggx_glass, 0.4f, Fresnel::dielectric, 1 / 1.5f), 300);
    bsdf::Lobe metal = lobe_of(LobeKind::ggx_reflection, 0.4f, Fresnel::f82);
    fill3(metal.f0, 0.9f, 0.6f, 0.3f);
    fill3(metal.f90, 0.8f, 0.9f, 0.5f);
    add("f82", metal, 500);
    metal.fresnel = Fresnel::conductor;
    fill3(metal.f0, 0.2f, 0.5f, 1.1f);
    fill3(metal.f90, 3.9f, 2.4f, 2.3f);
    add("conductor", metal, 350);
}

inline bsdf::Lobe chiang_lobe(float rough, float across, float h) {
    bsdf::Lobe l = lobe_of(bsdf::LobeKind::hair_chiang, 1.0f);
    fill(l.alpha_x, rough);
    fill(l.alpha_y, across);
    fill3(l.f0, 0.2f, 0.4f, 0.8f);
    fill3(l.f90, h, 0.035f, 0.0f);
    fill(l.eta, 1.55f);
    return l;
}

inline void add_toon_and_hair(std::vector<Model>& out) {
    using bsdf::LobeKind;
    for (const float smooth : {0.0f, 0.3f})
        for (const auto kind : {LobeKind::toon_diffuse, LobeKind::toon_glossy}) {
            bsdf::Lobe l = lobe_of(kind, 0.4f);
            fill(l.alpha_x, smooth);
            out.push_back(model_of("toon " + std::to_string(static_cast<int>(kind)) + " " + std::to_string(smooth), l));
        }
    for (const auto kind : {LobeKind::hair_reflection, LobeKind::hair_transmission}) {
        bsdf::Lobe l = lobe_of(kind, 0.1f);
        fill(l.alpha_x, 0.25f);
        fill(l.alpha_y, 0.7f);
        out.push_back(model_of("hair " + std::to_string(static_cast<int>(kind)), l));
    }
    for (const float h : {-0.7f, 0.1f}) out.push_back(model_of("chiang 0.3", chiang_lobe(0.3f, 0.3f, h)));
    out.push_back(model_of("chiang 0.8", chiang_lobe(0.8f, 0.6f, 0.5f)));
    bsdf::Lobe retro = lobe_of(LobeKind::burley, 0.7f);
    retro.preserve_energy = true;
    out.push_back(model_of("burley retro", retro));
}

inline std::vector<Model> all_models() {
    using bsdf::Fresnel;
    using bsdf::LobeKind;
    std::vector<Model> out;
    const auto add = [&](const std::string& name, const bsdf::Lobe& l) { out.push_back(model_of(name, l)); };
    for (const float r : {0.0f, 0.5f, 1.0f}) add("diffuse " + std::to_string(r), lobe_of(LobeKind::diffuse, r));
    add("translucent", lobe_of(LobeKind::translucent, 0));
    for (const float r : {0.1f, 1.0f}) add("burley " + std::to_string(r), lobe_of(LobeKind::burley, r));
    for (const float r : {0.3f, 1.0f}) add("velvet " + std::to_string(r), lobe_of(LobeKind::velvet, r));
    for (const float r : {0.15f, 0.5f, 1.0f}) add("sheen " + std::to_string(r), lobe_of(LobeKind::sheen, r));
    add("sheen_v1", lobe_of(LobeKind::sheen_v1, 0));
    for (const float r : {0.1f, 0.3f, 0.6f, 1.0f}) {
        const std::string name = std::to_string(r);
        add("reflection " + name, lobe_of(LobeKind::ggx_reflection, r));
        for (const float eta : {1.5f, 1 / 1.5f}) {
            const std::string side = name + (eta > 1 ? " outside" : " inside");
            add("refraction " + side, lobe_of(LobeKind::ggx_refraction, r, Fresnel::none, eta));
            add("glass " + side, lobe_of(LobeKind::ggx_glass, r, Fresnel::dielectric, eta));
        }
    }
    add_facets(out);
    add_toon_and_hair(out);
    add_films(out);
    bsdf::Lobe anisotropic = lobe_of(LobeKind::ggx_reflection, 0.5f);
    fill(anisotropic.alpha_x, 0.5f);
    fill(anisotropic.alpha_y, 0.1f);
    fill3(anisotropic.tangent, 0.6f, 0.8f, 0.3f);
    add("reflection anisotropic", anisotropic);
    bsdf::Lobe metal = lobe_of(LobeKind::ggx_reflection, 0.5f, Fresnel::f82);
    fill3(metal.f0, 0.9f, 0.6f, 0.3f);
    fill3(metal.f90, 0.8f, 0.9f, 0.5f);
    metal.preserve_energy = true;
    add("reflection f82 compensated", metal);
    bsdf::Lobe coat = lobe_of(LobeKind::ggx_reflection, 0.4f, Fresnel::schlick, 1.45f);
    fill3(coat.f0, 0.04f, 0.03f, 0.02f);
    coat.preserve_energy = true;
    add("reflection schlick compensated", coat);
    bsdf::Lobe tinted = lobe_of(LobeKind::ggx_glass, 0.5f, Fresnel::schlick, 1.33f);
    fill3(tinted.f0, 0.02f, 0.05f, 0.1f);
    fill3(tinted.tint_transmission, 0.9f, 0.5f, 0.2f);
    tinted.preserve_energy = true;
    add("glass tinted compensated", tinted);
    return out;
}

/// Every model at three angles, each with an azimuth of its own.
inline std::vector<Case> all_cases() {
    std::vector<Case> out;
    for (const Model& m : all_models())
        for (const float c : {0.95f, 0.5f, 0.12f})
            out.push_back({m, direction(c, 1 + 4 * c), m.name + ", cos " + std::to_string(c)});
    // The geometric normal cuts off part of the hemisphere.
    for (const auto kind : {bsdf::LobeKind::diffuse, bsdf::LobeKind::ggx_reflection, bsdf::LobeKind::ggx_glass}) {
        const Vec3 wo = direction(0.5f, 0.3f);
        out.push_back({model_of("bent", lobe_of(kind, 0.6f), direction(0.9f, 2.0f)), wo,
                       "bent " + std::to_string(static_cast<int>(kind))});
    }
    return out;
}

}  // namespace cardioid::test
