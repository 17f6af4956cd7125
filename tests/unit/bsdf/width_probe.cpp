// SPDX-License-Identifier: GPL-3.0-or-later
#include "bsdf/width_probe.h"
#include "bsdf/kernels.h"

namespace cardioid::test {

namespace CD_ISA_NS {

using namespace cardioid::CD_ISA_NS;

/// A deterministic number in [0, 1) for every use.
inline float number(int lobe, int lane, int use) {
    std::uint32_t h =
        static_cast<std::uint32_t>(lobe * 64 + lane) * 0x9e3779b9u + static_cast<std::uint32_t>(use) * 0x85ebca6bu;
    h ^= h >> 16;
    h *= 0x7feb352du;
    h ^= h >> 15;
    h *= 0x846ca68bu;
    h ^= h >> 16;
    return static_cast<float>(h >> 8) * 0x1p-24f;
}

inline void unit(float* x, float* y, float* z, float u, float v) {
    const float c = 2 * u - 1, s = __builtin_sqrtf(1 - c * c), a = 6.2831853f * v;
    *x = s * __builtin_cosf(a);
    *y = s * __builtin_sinf(a);
    *z = c;
}

struct Inputs {
    bsdf::Lobe lobe;
    Row wo[3], wi[3], ng[3], u[3];
};

void fill(Inputs& in, int k) {
    bsdf::Lobe& l = in.lobe;
    l.kind = static_cast<bsdf::LobeKind>(k % 15);
    l.fresnel = static_cast<bsdf::Fresnel>(k / 15 % 6);
    l.preserve_energy = k % 2 == 1;
    l.distribution = static_cast<bsdf::Distribution>(bsdf::refracts(l.kind) ? k / 15 % 2 : k / 15 % 4);
    l.separable_masking = k / 15 % 2 == 1;
    l.thin_film =
        bsdf::is_microfacet(l.kind) && l.fresnel != bsdf::Fresnel::none && l.fresnel != bsdf::Fresnel::principled_v1;
    for (int n = 0; n < k_chunk; ++n) {
        const auto r = [&](int use) { return number(k, n, use); };
        for (int c = 0; c < 3; ++c) {
            l.weight[c][n] = r(c);
            l.f0[c][n] = 0.9f * r(3 + c);
            l.f90[c][n] = r(6 + c);
            l.tint_transmission[c][n] = r(9 + c);
            in.ng[c][n] = c == 2 ? 1.0f : 0.0f;
            l.normal[c][n] = in.ng[c][n];
            in.u[c][n] = r(12 + c);
        }
        l.roughness[n] = 0.1f + 0.9f * r(15);
        l.alpha_x[n] = 0.05f + 0.95f * r(16);
        l.alpha_y[n] = n % 2 == 0 ? l.alpha_x[n] : 0.05f + 0.95f * r(17);
        if (bsdf::is_hair(l.kind)) {
            // Narrow strands are steeper than rounding allows to compare.
            l.roughness[n] = l.kind == bsdf::LobeKind::hair_chiang ? 0.5f + 0.5f * r(15) : 0.1f * r(15);
            l.alpha_x[n] = 0.4f + 0.6f * r(16);
            l.alpha_y[n] = 0.4f + 0.6f * r(17);
        }
        if (l.thin_film) {
            l.roughness[n] = n % 3 == 0 ? 0.0f : 800.0f * r(15);
            l.film_ior[n] = 1.1f + r(25);
        }
        l.eta[n] = n % 4 < 2 ? 1.1f + r(18) : 1 / (1.1f + r(18));
        unit(&l.tangent[0][n], &l.tangent[1][n], &l.tangent[2][n], r(19), r(20));
        unit(&in.wo[0][n], &in.wo[1][n], &in.wo[2][n], 0.51f + 0.49f * r(21), r(22));
        unit(&in.wi[0][n], &in.wi[1][n], &in.wi[2][n], r(23), r(24));
    }
}

void probe(float* out) {
    static Inputs in;
    for (int k = 0; k < k_probe_lobes; ++k) {
        fill(in, k);
        for (int i = 0; i < k_chunk; i += W) {
            const Vec3 wo = load3(in.wo, i), ng = load3(in.ng, i);
            const LobeEval e = eval_lobe(in.lobe, i, wo, load3(in.wi, i), ng);
            const LobeSample s = sample_lobe(in.lobe, i, wo, ng, load3(in.u, i), mask_of(true));
            const Float values[k_probe_values] = {
                e.f_cos.r, e.f_cos.g, e.f_cos.b, e.pdf,     s.wi.x, s.wi.y,
                s.wi.z,    s.f_cos.r, s.f_cos.g, s.f_cos.b, s.pdf,  select(s.valid, Float(1.0f), Float(0.0f))};
            for (int v = 0; v < k_probe_values; ++v)
                for (int n = 0; n < W; ++n) out[((k * k_chunk) + i + n) * k_probe_values + v] = values[v][n];
        }
    }
}

}  // namespace CD_ISA_NS

#if CARDIOID_WIDTH == 1
void probe_w1(float* out) { CD_ISA_NS::probe(out); }
#elif CARDIOID_WIDTH == 8
void probe_w8(float* out) { CD_ISA_NS::probe(out); }
#else
void probe_w16(float* out) { CD_ISA_NS::probe(out); }
#endif

}  // namespace cardioid::test
