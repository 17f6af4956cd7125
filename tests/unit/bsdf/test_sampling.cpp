// SPDX-License-Identifier: GPL-3.0-or-later
// sample() draws from pdf (chi²), and f·cos/pdf averages to the integral of f·cos (t-test), for every kind of lobe; and
// both tests reject lobes that were made wrong on purpose.
#include "cases.h"
#include "lobe_tests.h"

#include <gtest/gtest.h>

namespace cardioid::test {
namespace {

constexpr int k_draws = 150000;
constexpr double k_alpha = 0.01;

TEST(Sampling, DirectionsFollowThePdf) {
    const std::vector<Case> cases = all_cases();
    const double level = statistics::sidak(k_alpha, static_cast<int>(cases.size()));
    std::uint32_t seed = 1;
    for (const Case& c : cases) {
        const statistics::Chi2Result r = chi2_of(c.model, c.wo, k_draws, seed++);
        EXPECT_FALSE(r.rejected(level)) << c.name << ": chi² " << r.statistic << " for " << r.degrees << ", p " << r.p
                                        << (r.impossible ? ", impossible" : "");
    }
}

TEST(Sampling, WeightsAverageToTheIntegral) {
    const std::vector<Case> cases = all_cases();
    const double level = statistics::sidak(k_alpha, static_cast<int>(cases.size()));
    std::uint32_t seed = 1001;
    for (const Case& c : cases) {
        const statistics::TResult r = weights_of(c.model, c.wo, k_draws, seed++);
        EXPECT_FALSE(r.rejected(level)) << c.name << ": off by " << r.difference << " ± " << r.error << ", p " << r.p;
    }
}

// Mutants -------------------------------------------------------------------------------------------------

const Vec3 k_wo = direction(0.5f, 0.7f);

Model glass(float eta) {
    return model_of("glass", lobe_of(bsdf::LobeKind::ggx_glass, 0.6f, bsdf::Fresnel::dielectric, eta));
}
Model lambert() { return model_of("lambert", lobe_of(bsdf::LobeKind::diffuse, 0)); }

/// Applies `change` to what eval returns.
template <class Change>
Model with_eval(Model m, Change change) {
    m.eval = [eval = m.eval, change](Vec3 wo, Vec3 wi) {
        LobeEval e = eval(wo, wi);
        change(e, wo, wi);
        return e;
    };
    return m;
}
/// Applies `change` to the value and density that sample and eval return.
template <class Change>
Model with_both(Model m, Change change) {
    m = with_eval(std::move(m), change);
    m.sample = [sample = m.sample, change](Vec3 wo, Vec3 u) {
        LobeSample s = sample(wo, u);
        LobeEval e{s.f_cos, s.pdf};
        change(e, wo, s.wi);
        s.f_cos = e.f_cos;
        s.pdf = e.pdf;
        return s;
    };
    return m;
}

bool chi2_rejects(const Model& m) { return chi2_of(m, k_wo, k_draws, 5).rejected(1e-4); }
bool weights_reject(const Model& m) { return weights_of(m, k_wo, k_draws, 5).rejected(1e-4); }

TEST(SamplingMutants, UnchangedModelsPass) {
    for (const Model& m : {lambert(), glass(1.5f), glass(1 / 1.5f)}) {
        EXPECT_FALSE(chi2_rejects(m)) << m.name;
        EXPECT_FALSE(weights_reject(m)) << m.name;
    }
}

TEST(SamplingMutants, PdfFivePercentTooLarge) {
    const auto change = [](LobeEval& e, Vec3, Vec3) { e.pdf *= 1.05f; };
    EXPECT_TRUE(chi2_rejects(with_both(lambert(), change)));
    EXPECT_TRUE(chi2_rejects(with_both(glass(1.5f), change)));
    EXPECT_TRUE(weights_reject(with_both(lambert(), change)));
}

TEST(SamplingMutants, PdfFivePercentTooSmall) {
    const auto change = [](LobeEval& e, Vec3, Vec3) { e.pdf *= 0.95f; };
    EXPECT_TRUE(chi2_rejects(with_both(lambert(), change)));
    EXPECT_TRUE(chi2_rejects(with_both(glass(1.5f), change)));
}

TEST(SamplingMutants, PdfForgetsTheCosine) {
    const auto uniform = [](LobeEval& e, Vec3, Vec3) {
        e.pdf = select(e.pdf > Float(0.0f), Float(0.5f * k_inv_pi), Float(0.0f));
    };
    EXPECT_TRUE(chi2_rejects(with_both(lambert(), uniform)));
}

TEST(SamplingMutants, EvalForgetsTheCosine) {
    const auto no_cosine = [](LobeEval& e, Vec3, Vec3 wi) { e.f_cos = e.f_cos * (1.0f / max(abs(wi.z), 1e-3f)); };
    EXPECT_TRUE(weights_reject(with_eval(lambert(), no_cosine)));
    EXPECT_TRUE(weights_reject(with_eval(glass(1.5f), no_cosine)));
}

TEST(SamplingMutants, EvalDropsOneOverPi) {
    EXPECT_TRUE(weights_reject(with_eval(lambert(), [](LobeEval& e, Vec3, Vec3) { e.f_cos = e.f_cos * k_pi; })));
}

TEST(SamplingMutants, RefractionJacobianWithoutEta) {
    for (const float eta : {1.5f, 1 / 1.5f}) {
        const auto change = [eta](LobeEval& e, Vec3, Vec3 wi) {
            e.pdf *= select(wi.z < Float(0.0f), Float(1 / (eta * eta)), Float(1.0f));
        };
        EXPECT_TRUE(chi2_rejects(with_both(glass(eta), change)));
        const auto value = [eta](LobeEval& e, Vec3, Vec3 wi) {
            e.f_cos = e.f_cos * select(wi.z < Float(0.0f), Float(1 / (eta * eta)), Float(1.0f));
        };
        EXPECT_TRUE(weights_reject(with_eval(glass(eta), value)));
    }
}

TEST(SamplingMutants, RefractionHalfVectorOfTheOtherSide) {
    // pdf evaluated with 1/eta: what a program that mixes up the sides does.
    Model m = glass(1.5f);
    m.eval = glass(1 / 1.5f).eval;
    EXPECT_TRUE(chi2_rejects(m));
    EXPECT_TRUE(weights_reject(m));
}

TEST(SamplingMutants, AnisotropyAlongTheWrongAxis) {
    bsdf::Lobe l = lobe_of(bsdf::LobeKind::ggx_reflection, 0.5f);
    fill(l.alpha_x, 0.4f);
    fill(l.alpha_y, 0.1f);
    Model m = model_of("anisotropic", l);
    EXPECT_FALSE(chi2_rejects(m));
    fill3(l.tangent, 0, 1, 0);
    m.eval = model_of("turned", l).eval;
    EXPECT_TRUE(chi2_rejects(m));
}

TEST(SamplingMutants, NormalsNotWeightedByVisibility) {
    // Claims the density D·cos of facet normals while the samples follow the visible ones.
    const bsdf::Lobe l = lobe_of(bsdf::LobeKind::ggx_reflection, 0.6f);
    const auto change = [](LobeEval& e, Vec3 wo, Vec3 wi) {
        const Vec3 h = normalize(wo + wi);
        const Float stretch = sqrt(wo.z * wo.z + 0.1296f * (1.0f - wo.z * wo.z));
        e.pdf *= 0.5f * (wo.z + stretch) * h.z / max(dot(wo, h), 1e-6f);
    };
    EXPECT_TRUE(chi2_rejects(with_both(model_of("plain normals", l), change)));
}

}  // namespace
}  // namespace cardioid::test
