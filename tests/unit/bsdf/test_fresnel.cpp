// SPDX-License-Identifier: GPL-3.0-or-later
// Fresnel terms against closed forms and published values; bending of the normal.
#include "bsdf/bend_normal.h"
#include "bsdf/fresnel.h"
#include "model.h"

#include <gtest/gtest.h>

#include <complex>

namespace cardioid::test {
namespace {

using bsdf::Fresnel;
using bsdf::LobeKind;

double textbook(double c, std::complex<double> n) {
    const std::complex<double> t = std::sqrt(1.0 - (1 - c * c) / (n * n));
    const std::complex<double> s = (c - n * t) / (c + n * t), p = (n * c - t) / (n * c + t);
    return 0.5 * (std::norm(s) + std::norm(p));
}

TEST(FresnelTerm, Dielectric) {
    EXPECT_NEAR(fresnel_dielectric(1.0f, 1.5f).reflect[0], 0.04f, 1e-6f);
    for (const float eta : {1.1f, 1.5f, 3.0f, 0.9f, 1 / 1.5f})
        for (const float c : {0.05f, 0.3f, 0.7f, 0.8f, 1.0f}) {
            const DielectricTerm d = fresnel_dielectric(c, eta);
            EXPECT_NEAR(d.reflect[0], textbook(c, eta), 2e-5) << eta << " " << c;
            const float sin2 = (1 - c * c) / (eta * eta);
            EXPECT_NEAR(d.cos_t[0], std::sqrt(std::max(0.0f, 1 - sin2)), 1e-5f);
        }
    // Stokes: the same reflectance along the refracted ray from the other side.
    const DielectricTerm out = fresnel_dielectric(0.6f, 1.5f);
    EXPECT_NEAR(fresnel_dielectric(out.cos_t, 1 / 1.5f).reflect[0], out.reflect[0], 1e-6f);
}

TEST(FresnelTerm, Conductor) {
    for (const auto& nk : {std::complex<double>(0.18, 3.0), {1.5, 1.9}, {2.5, 0.1}})
        for (const float c : {0.02f, 0.3f, 0.7f, 1.0f}) {
            const Float f = fresnel_conductor(c, static_cast<float>(nk.real()), static_cast<float>(nk.imag()));
            EXPECT_NEAR(f[0], textbook(c, {nk.real(), -nk.imag()}), 3e-5) << nk << " " << c;
        }
}

TEST(FresnelTerm, F82IsTheTintTimesSchlickAt82Degrees) {
    bsdf::Lobe l = lobe_of(LobeKind::ggx_reflection, 0.3f, Fresnel::f82);
    fill3(l.f0, 0.8f, 0.5f, 0.2f);
    fill3(l.f90, 0.7f, 1.0f, 0.9f);
    const float s = std::pow(6.0f / 7, 5.0f);
    EXPECT_NEAR(reflectance(l, 0, 1.0f / 7).r[0], 0.7f * (0.8f + 0.2f * s), 1e-5f);
    EXPECT_NEAR(reflectance(l, 0, 1.0f / 7).g[0], 0.5f + 0.5f * s, 1e-5f);
    EXPECT_NEAR(reflectance(l, 0, 1.0f).b[0], 0.2f, 1e-6f);
    EXPECT_NEAR(reflectance(l, 0, 0.0f).b[0], 1, 1e-6f);
}

TEST(FresnelTerm, SchlickRunsFromF0ToF90AlongTheExactCurve) {
    bsdf::Lobe l = lobe_of(LobeKind::ggx_reflection, 0.3f, Fresnel::schlick, 1.5f);
    fill3(l.f0, 0.04f, 0.08f, 0.4f);
    fill3(l.f90, 1, 1, 0.5f);
    EXPECT_NEAR(reflectance(l, 0, 1.0f).b[0], 0.4f, 1e-6f);
    EXPECT_NEAR(reflectance(l, 0, 0.0f).b[0], 0.5f, 1e-5f);
    EXPECT_NEAR(reflectance(l, 0, 0.4f).r[0], textbook(0.4, 1.5), 1e-5);
}

TEST(BendNormal, LeavesValidNormalsAlone) {
    const Vec3 ng = {0.0f, 0.0f, 1.0f}, n = direction(0.95f, 1), wo = direction(0.8f, 2);
    EXPECT_EQ(bend_normal(ng, wo, n).x[0], n.x[0]);
    EXPECT_EQ(bend_normal(ng, wo, n).z[0], n.z[0]);
}

TEST(BendNormal, LiftsTheReflectionJustAboveTheSurface) {
    const Vec3 ng = {0.0f, 0.0f, 1.0f};
    int bent = 0;
    for (const float cos_o : {0.02f, 0.1f, 0.3f, 0.6f})
        for (const float cos_n : {0.3f, 0.5f, 0.8f})
            for (float phi = 0; phi < 6; phi += 0.4f) {
                const Vec3 wo = direction(cos_o, 0), n = direction(cos_n, phi);
                const float clear = 2 * dot(n, wo)[0] * n.z[0] - wo.z[0], least = std::min(0.9f * cos_o, 0.01f);
                const Vec3 b = bend_normal(ng, wo, n);
                EXPECT_NEAR(length(b)[0], 1, 1e-5f);
                const float now = 2 * dot(b, wo)[0] * b.z[0] - wo.z[0];
                EXPECT_GE(now, least - 1e-4f) << cos_o << " " << cos_n << " " << phi;
                if (clear >= least) continue;
                ++bent;
                EXPECT_NEAR(now, least, 1e-4f);
                // Turned toward ng in their plane.
                EXPECT_NEAR(dot(cross(b, n), ng)[0], 0, 1e-5f);
                EXPECT_GT(b.z[0], n.z[0]);
            }
    EXPECT_GT(bent, 30);
}

// Films ---------------------------------------------------------------------------------------------------

bsdf::Lobe film_lobe(bsdf::Fresnel fresnel, float thickness, float film_ior, float eta) {
    bsdf::Lobe l = lobe_of(bsdf::LobeKind::ggx_reflection, 0.3f, fresnel, eta);
    l.thin_film = true;
    fill(l.roughness, thickness);
    fill(l.film_ior, film_ior);
    return l;
}

/// Airy's formula integrated over the spectrum that the table was made from, in the mean over wavelengths of equal energy: the
/// sum of reflectances without interference is what thick films come to.
TEST(Film, ThickFilmsLoseTheirColour) {
    for (const float c : {1.0f, 0.6f}) {
        const Spectrum f = reflectance(film_lobe(bsdf::Fresnel::dielectric, 9000, 1.33f, 1.8f), 0, Float(c));
        const DielectricTerm top = fresnel_dielectric(Float(c), Float(1.33f));
        const Float a = top.reflect, b = fresnel_dielectric(top.cos_t, Float(1.8f / 1.33f)).reflect;
        const float incoherent = (a + (1.0f - a) * (1.0f - a) * b / (1.0f - a * b))[0];
        for (const Float x : {f.r, f.g, f.b}) EXPECT_NEAR(x[0], incoherent, 0.004f) << c;
    }
}

TEST(Film, OfTheSubstratesIndexIsNone) {
    for (const float c : {1.0f, 0.5f, 0.1f}) {
        const Spectrum f = reflectance(film_lobe(bsdf::Fresnel::dielectric, 400, 1.5f, 1.5f), 0, Float(c));
        const float bare = fresnel_dielectric(Float(c), Float(1.5f)).reflect[0];
        for (const Float x : {f.r, f.g, f.b}) EXPECT_NEAR(x[0], bare, 1e-4f) << c;
    }
}

TEST(Film, AQuarterWaveDarkensGreenGlass) {
    // 550 nm / (4 · 1.25) on glass of 1.5625: no reflection at 550 nm.
    const Spectrum f = reflectance(film_lobe(bsdf::Fresnel::dielectric, 110, 1.25f, 1.5625f), 0, Float(1.0f));
    EXPECT_LT(f.g[0], 0.003f);
    EXPECT_GT(f.b[0], f.g[0]);
    EXPECT_LT(f.g[0], 0.1f * fresnel_dielectric(Float(1.0f), Float(1.5625f)).reflect[0]);
}

TEST(Film, ThinnerThanItsLimitIsNone) {
    const Spectrum f = reflectance(film_lobe(bsdf::Fresnel::dielectric, 0.05f, 2.0f, 1.5f), 0, Float(0.7f));
    EXPECT_EQ(f.r[0], fresnel_dielectric(Float(0.7f), Float(1.5f)).reflect[0]);
}

}  // namespace
}  // namespace cardioid::test
