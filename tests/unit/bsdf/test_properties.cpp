// SPDX-License-Identifier: GPL-3.0-or-later
// Properties that every lobe has: sample and eval agree, f > 0 exactly where pdf > 0, reciprocity, finite at grazing
// angles, nothing through the geometric normal's wrong side; deltas; classes.
#include "cases.h"

#include <gtest/gtest.h>

namespace cardioid::test {
namespace {

using bsdf::Fresnel;
using bsdf::LobeKind;

const Vec3 k_up = {0.0f, 0.0f, 1.0f};

bool finite_and_positive(Float x) { return all(is_finite(x) & (x >= Float(0.0f))); }
bool finite_and_positive(Spectrum s) {
    return finite_and_positive(s.r) && finite_and_positive(s.g) && finite_and_positive(s.b);
}

/// Uniform on the sphere.
Vec3 random_direction(Uniform& u) {
    float x[3][W];
    for (int k = 0; k < W; ++k) {
        const float z = 2 * u.next() - 1, phi = 6.2831853f * u.next(), r = std::sqrt(std::max(0.0f, 1 - z * z));
        x[0][k] = r * std::cos(phi);
        x[1][k] = r * std::sin(phi);
        x[2][k] = z;
    }
    return {load(x[0]), load(x[1]), load(x[2])};
}

struct Agreement {
    int draws = 0, disagree = 0;
};
/// Draws whose density or value differs between sample and eval by more than `tolerance` of it.
Agreement agreement(const Model& m, Vec3 wo, float tolerance) {
    Uniform u(3);
    Agreement a;
    for (int k = 0; k < 2048; k += W) {
        const LobeSample s = m.sample(wo, u.lanes3());
        const LobeEval e = m.eval(wo, s.wi);
        const Float df = abs(average(e.f_cos) - average(s.f_cos)), dp = abs(e.pdf - s.pdf);
        const Mask bad = s.valid & ((dp > tolerance * s.pdf) | (df > tolerance * average(s.f_cos)));
        a.draws += count(s.valid);
        a.disagree += count(bad);
    }
    return a;
}

TEST(Properties, SampleAndEvalAgree) {
    for (const Case& c : all_cases()) {
        const Agreement a = agreement(c.model, c.wo, 2e-3f);
        const bool may_reflect_all = c.name.starts_with("refraction") && c.name.find("inside") != std::string::npos;
        EXPECT_TRUE(a.draws > 0 || may_reflect_all) << c.name;
        // Rounding moves directions next to the horizon, where density changes fastest.
        EXPECT_LE(a.disagree, a.draws / 200) << c.name;
    }
}

TEST(Properties, SampleAndEvalAgreeNextToTheDelta) {
    for (const auto kind : {LobeKind::ggx_reflection, LobeKind::ggx_refraction, LobeKind::ggx_glass})
        for (const float alpha : {2e-4f, 1e-3f}) {
            const Model m = model_of("smooth", lobe_of(kind, std::sqrt(alpha), Fresnel::dielectric));
            const Agreement a = agreement(m, direction(0.7f, 0.4f), 0.05f);
            EXPECT_GT(a.draws, 1000);
            EXPECT_LE(a.disagree, a.draws / 100) << "alpha " << alpha;
        }
}

int lanes_with_one_of_two(const Model& m) {
    Uniform u(4);
    int found = 0;
    for (int k = 0; k < 4096; k += W) {
        Vec3 wo = random_direction(u);
        wo.z = abs(wo.z);
        const LobeEval e = m.eval(wo, random_direction(u));
        found += count((average(e.f_cos) > Float(0.0f)) ^ (e.pdf > Float(0.0f)));
    }
    return found;
}

TEST(Properties, PositiveTogether) {
    for (const Model& m : all_models()) EXPECT_EQ(lanes_with_one_of_two(m), 0) << m.name;
}

TEST(Properties, PositiveTogetherRejectsAPdfBelowTheHorizon) {
    Model m = model_of("lambert", lobe_of(LobeKind::diffuse, 0));
    m.eval = [eval = m.eval](Vec3 wo, Vec3 wi) {
        LobeEval e = eval(wo, wi);
        e.pdf = abs(wi.z) * k_inv_pi;
        return e;
    };
    EXPECT_GT(lanes_with_one_of_two(m), 0);
}

/// Largest difference between f(wo, wi) and factor·f(wi, wo), relative above values of 1e-3; `there` is the lobe as
/// seen from wi's side.
float reciprocity_error(const Model& here, const Model& there, bool across, float factor) {
    Uniform u(5);
    float worst = 0;
    for (int k = 0; k < 2048; k += W) {
        Vec3 a = random_direction(u), b = random_direction(u);
        a.z = max(abs(a.z), 0.05f);
        b.z = max(abs(b.z), 0.05f);
        a = normalize(a);
        b = normalize(b);
        const Vec3 below = {b.x, b.y, -b.z}, mirrored_a = {a.x, a.y, -a.z};
        // Seen from the other side the frame is turned over: z changes sign for both directions.
        const LobeEval forth = here.eval(a, across ? below : b), back = there.eval(b, across ? mirrored_a : a);
        const Float f = average(forth.f_cos) / b.z, g = factor * average(back.f_cos) / a.z;
        const Float error = abs(f - g) / max(max(f, g), 1e-3f);
        for (int l = 0; l < W; ++l) worst = std::max(worst, error[l]);
    }
    return worst;
}

TEST(Properties, ReciprocalReflection) {
    for (const float r : {0.0f, 0.7f, 1.0f}) {
        bsdf::Lobe diffuse = lobe_of(LobeKind::diffuse, r), preserving = diffuse;
        preserving.preserve_energy = true;
        for (const bsdf::Lobe& l :
             {diffuse, preserving, lobe_of(LobeKind::burley, r), lobe_of(LobeKind::velvet, r),
              lobe_of(LobeKind::sheen_v1, r), lobe_of(LobeKind::ggx_reflection, std::max(r, 0.3f), Fresnel::schlick)}) {
            const Model m = model_of("reflection", l);
            EXPECT_LT(reciprocity_error(m, m, false, 1), 2e-3f) << static_cast<int>(l.kind) << " " << r;
        }
    }
}

TEST(Properties, ReciprocalAcrossAnInterface) {
    for (const float r : {0.3f, 0.8f}) {
        const Model outside = model_of("out", lobe_of(LobeKind::ggx_glass, r, Fresnel::dielectric, 1.5f));
        const Model inside = model_of("in", lobe_of(LobeKind::ggx_glass, r, Fresnel::dielectric, 1 / 1.5f));
        EXPECT_LT(reciprocity_error(outside, inside, true, 2.25f), 5e-3f) << r;
        EXPECT_LT(reciprocity_error(inside, outside, true, 1 / 2.25f), 5e-3f) << r;
        // Mutants: the factor left out, and a value without the Fresnel term's symmetry.
        EXPECT_GT(reciprocity_error(outside, inside, true, 1), 0.1f);
        EXPECT_GT(reciprocity_error(outside, outside, true, 2.25f), 0.1f);
    }
}

TEST(Properties, ReciprocityRejectsACosineOfTheWrongSide) {
    Model m = model_of("lambert", lobe_of(LobeKind::diffuse, 0));
    m.eval = [eval = m.eval](Vec3 wo, Vec3 wi) {
        LobeEval e = eval(wo, wi);
        e.f_cos = e.f_cos * wo.z;
        return e;
    };
    EXPECT_GT(reciprocity_error(m, m, false, 1), 0.1f);
}

TEST(Properties, FiniteAtGrazingAngles) {
    std::vector<Model> models = all_models();
    for (const auto kind : {LobeKind::ggx_reflection, LobeKind::ggx_refraction, LobeKind::ggx_glass})
        for (const float eta : {1.0f, 1.001f, 0.2f, 3.0f})
            for (const float roughness : {0.0f, 0.012f, 0.05f, 1.0f})
                models.push_back(model_of("extreme", lobe_of(kind, roughness, Fresnel::dielectric, eta)));
    Uniform u(6);
    for (const Model& m : models)
        for (const float c : {0.0f, 1e-7f, 1e-4f, 1e-2f, 1.0f}) {
            const Vec3 wo = direction(c, 0.3f);
            for (const float d : {0.0f, 1e-7f, -1e-7f, 1e-3f, -1e-3f, 1.0f, -1.0f})
                for (const float phi : {0.3f, 1.0f, 3.4415927f}) {
                    const LobeEval e = m.eval(wo, direction(d, phi));
                    EXPECT_TRUE(finite_and_positive(e.f_cos) && finite_and_positive(e.pdf))
                        << m.name << " " << c << " " << d;
                }
            for (const Vec3& w : {Vec3{0.0f, 0.0f, 0.0f}, Vec3{0.99999994f, 0.99999994f, 0.99999994f}, u.lanes3()}) {
                const LobeSample s = m.sample(wo, w);
                EXPECT_TRUE(finite_and_positive(s.f_cos) && finite_and_positive(s.pdf)) << m.name << " " << c;
                const Float off = select(s.valid, abs(length(s.wi) - 1.0f), Float(0.0f));
                EXPECT_TRUE(all(off < Float(1e-3f))) << m.name << " " << c;
                EXPECT_TRUE(none(s.valid & (s.pdf <= Float(0.0f)))) << m.name << " " << c;
            }
        }
}

TEST(Properties, InactiveLanesAreInvalid) {
    for (const auto kind :
         {LobeKind::diffuse, LobeKind::translucent, LobeKind::ggx_reflection, LobeKind::ggx_glass, LobeKind::sheen}) {
        const bsdf::Lobe l = lobe_of(kind, 0.5f);
        EXPECT_TRUE(none(sample_lobe(l, 0, direction(0.8f, 0), k_up, {0.3f, 0.4f, 0.5f}, mask_of(false)).valid));
    }
}

TEST(Properties, NothingOnTheWrongSideOfTheSurface) {
    // The shading normal leans so far that its hemisphere dips under the surface.
    const Vec3 ng = direction(0.5f, 0.0f), wo = direction(0.8f, 0.0f);
    Uniform u(7);
    for (const Model& plain : all_models()) {
        for (const auto kind :
             {LobeKind::diffuse, LobeKind::translucent, LobeKind::ggx_reflection, LobeKind::ggx_refraction,
              LobeKind::ggx_glass, LobeKind::sheen, LobeKind::burley, LobeKind::velvet}) {
            const Model m = model_of(plain.name, lobe_of(kind, 0.7f, Fresnel::dielectric), ng);
            const Vec3 wi = random_direction(u);
            const Mask crosses = (dot(ng, wi) > Float(0.0f)) ^ (wi.z > Float(0.0f));
            EXPECT_TRUE(none(crosses & (m.eval(wo, wi).pdf > Float(0.0f))));
            const LobeSample s = m.sample(wo, u.lanes3());
            const Mask under = (dot(ng, s.wi) > Float(0.0f)) ^ ~s.transmitted;
            EXPECT_TRUE(none(s.valid & under));
        }
    }
}

// Deltas --------------------------------------------------------------------------------------------------

TEST(Delta, MirrorReflects) {
    bsdf::Lobe l = lobe_of(LobeKind::ggx_reflection, 0);
    fill3(l.weight, 0.5f, 0.25f, 1);
    const Vec3 wo = direction(0.6f, 0.3f);
    const LobeSample s = sample_lobe(l, 0, wo, k_up, {0.2f, 0.7f, 0.4f}, mask_of(true));
    EXPECT_TRUE(all(s.valid & s.delta & ~s.transmitted));
    EXPECT_NEAR(s.wi.x[0], -wo.x[0], 1e-6f);
    EXPECT_NEAR(s.wi.z[0], wo.z[0], 1e-6f);
    EXPECT_FLOAT_EQ(s.f_cos.g[0] / s.pdf[0], 0.25f);
    EXPECT_EQ(eval_lobe(l, 0, wo, s.wi, k_up).pdf[0], 0);
    EXPECT_EQ(eval_lobe(l, 0, wo, s.wi, k_up).f_cos.r[0], 0);
}

TEST(Delta, WindowFollowsSnellAndSplitsByFresnel) {
    for (const float eta : {1.5f, 1 / 1.5f}) {
        const bsdf::Lobe l = lobe_of(LobeKind::ggx_glass, 0, Fresnel::dielectric, eta);
        const Vec3 wo = direction(0.8f, 0.0f);
        const float sin_t = 0.6f / eta, cos_t = std::sqrt(1 - sin_t * sin_t);
        const float r_s = (0.8f - eta * cos_t) / (0.8f + eta * cos_t),
                    r_p = (eta * 0.8f - cos_t) / (eta * 0.8f + cos_t);
        const float f = 0.5f * (r_s * r_s + r_p * r_p);
        const LobeSample t = sample_lobe(l, 0, wo, k_up, {0.2f, 0.7f, 0.99f}, mask_of(true));
        EXPECT_TRUE(all(t.valid & t.delta & t.transmitted));
        EXPECT_NEAR(t.wi.x[0], -sin_t, 1e-6f);
        EXPECT_NEAR(t.wi.z[0], -cos_t, 1e-6f);
        EXPECT_NEAR(t.pdf[0], 1 - f, 1e-6f);
        EXPECT_NEAR(t.f_cos.r[0], 1 - f, 1e-6f);
        EXPECT_FLOAT_EQ(t.eta[0], eta);
        const LobeSample r = sample_lobe(l, 0, wo, k_up, {0.2f, 0.7f, 0.001f}, mask_of(true));
        EXPECT_TRUE(all(r.valid & r.delta & ~r.transmitted));
        EXPECT_NEAR(r.pdf[0], f, 1e-6f);
        EXPECT_FLOAT_EQ(r.eta[0], 1);
    }
}

TEST(Delta, TotalReflection) {
    const Vec3 wo = direction(0.3f, 0.0f);
    const bsdf::Lobe glass = lobe_of(LobeKind::ggx_glass, 0, Fresnel::dielectric, 1 / 1.5f);
    const LobeSample s = sample_lobe(glass, 0, wo, k_up, {0.2f, 0.7f, 0.999999f}, mask_of(true));
    EXPECT_TRUE(all(s.valid & ~s.transmitted));
    EXPECT_FLOAT_EQ(s.f_cos.r[0], 1);
    EXPECT_FLOAT_EQ(s.pdf[0], 1);
    const bsdf::Lobe window = lobe_of(LobeKind::ggx_refraction, 0, Fresnel::none, 1 / 1.5f);
    EXPECT_TRUE(none(sample_lobe(window, 0, wo, k_up, {0.2f, 0.7f, 0.5f}, mask_of(true)).valid));
}

TEST(Delta, IndexOfOnePassesStraightThrough) {
    const bsdf::Lobe l = lobe_of(LobeKind::ggx_refraction, 0.5f, Fresnel::none, 1);
    const Vec3 wo = direction(0.3f, 0.4f);
    const LobeSample s = sample_lobe(l, 0, wo, k_up, {0.2f, 0.7f, 0.5f}, mask_of(true));
    EXPECT_TRUE(all(s.valid & s.delta & s.transmitted & is_delta(l, 0)));
    EXPECT_NEAR(s.wi.x[0], -wo.x[0], 1e-6f);
    EXPECT_NEAR(s.wi.z[0], -wo.z[0], 1e-6f);
}

TEST(Classes, SpecularByRoughnessOfTheLargerAxis) {
    bsdf::Lobe l = lobe_of(LobeKind::ggx_reflection, 0.2f);
    EXPECT_TRUE(none(is_delta(l, 0)));
    EXPECT_TRUE(all(is_specular(l, 0, 0.21f)));
    EXPECT_TRUE(none(is_specular(l, 0, 0.19f)));
    fill(l.alpha_y, 0.3f * 0.3f);
    EXPECT_TRUE(none(is_specular(l, 0, 0.29f)));
    EXPECT_TRUE(all(is_specular(l, 0, 0.31f)));
    EXPECT_TRUE(all(is_specular(lobe_of(LobeKind::ggx_glass, 0), 0, 0.0f)));
    EXPECT_TRUE(none(is_specular(lobe_of(LobeKind::diffuse, 0), 0, 1.0f)));
    EXPECT_TRUE(none(is_specular(lobe_of(LobeKind::sheen, 0), 0, 1.0f)));
}

}  // namespace
}  // namespace cardioid::test
