// SPDX-License-Identifier: GPL-3.0-or-later
// A lobe as the statistical tests see it: evaluate, sample. Mutants wrap these two functions.
#pragma once

#include "bsdf/kernels.h"

#include <functional>
#include <random>
#include <string>

namespace cardioid::test {

using namespace cardioid::CD_ISA_NS;

using Eval = std::function<LobeEval(Vec3 wo, Vec3 wi)>;
using Sample = std::function<LobeSample(Vec3 wo, Vec3 u)>;

struct Model {
    std::string name;
    Eval eval;
    Sample sample;
};

inline void fill(Row& row, float x) {
    for (float& v : row) v = x;
}
inline void fill3(Row (&rows)[3], float x, float y, float z) {
    fill(rows[0], x);
    fill(rows[1], y);
    fill(rows[2], z);
}

/// A lobe with the same parameters in all lanes: weight 1, normal z, isotropic.
inline bsdf::Lobe lobe_of(bsdf::LobeKind kind, float roughness, bsdf::Fresnel fresnel = bsdf::Fresnel::none,
                          float eta = 1.5f) {
    bsdf::Lobe l;
    l.kind = kind;
    l.fresnel = fresnel;
    fill3(l.weight, 1, 1, 1);
    fill3(l.normal, 0, 0, 1);
    fill3(l.tangent, 1, 0, 0);
    fill(l.roughness, roughness);
    fill(l.alpha_x, roughness * roughness);
    fill(l.alpha_y, roughness * roughness);
    fill(l.eta, eta);
    fill3(l.f0, 1, 1, 1);
    fill3(l.f90, 1, 1, 1);
    fill3(l.tint_transmission, 1, 1, 1);
    return l;
}

/// The functions of kernels.h for a lobe whose lanes are all alike.
inline Model model_of(std::string name, const bsdf::Lobe& lobe, Vec3 ng = {0.0f, 0.0f, 1.0f}) {
    return {std::move(name), [lobe, ng](Vec3 wo, Vec3 wi) { return eval_lobe(lobe, 0, wo, wi, ng); },
            [lobe, ng](Vec3 wo, Vec3 u) { return sample_lobe(lobe, 0, wo, ng, u, mask_of(true)); }};
}

inline Vec3 direction(float cos_theta, float phi) {
    const float s = std::sqrt(std::max(0.0f, 1 - cos_theta * cos_theta));
    return {Float(s * std::cos(phi)), Float(s * std::sin(phi)), Float(cos_theta)};
}

class Uniform {
public:
    explicit Uniform(std::uint32_t seed) : engine_(seed) {}
    float next() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }
    Float lanes() {
        float x[W];
        for (float& v : x) v = next();
        return load(x);
    }
    Vec3 lanes3() { return {lanes(), lanes(), lanes()}; }

private:
    std::mt19937 engine_;
};

inline float lane(Vec3 v, int axis, int k) { return axis == 0 ? v.x[k] : axis == 1 ? v.y[k] : v.z[k]; }

}  // namespace cardioid::test
