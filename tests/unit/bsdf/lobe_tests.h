// SPDX-License-Identifier: GPL-3.0-or-later
// The two statistical tests of a lobe: sample() against pdf, and sampled weights against the integral of f·cos.
#pragma once

#include "sphere_grid.h"
#include "statistics/chi2.h"
#include "statistics/ttest.h"

namespace cardioid::test {

/// Draws `n` directions; lost draws (invalid) are a cell of their own, expected 1 − ∫pdf.
inline statistics::Chi2Result chi2_of(const Model& m, Vec3 wo, int n, std::uint32_t seed) {
    const SphereGrid grid;
    std::vector<double> observed(static_cast<std::size_t>(grid.cells()) + 1, 0.0), expected(observed.size(), 0.0);
    Uniform uniform(seed);
    for (int k = 0; k < n; k += W) {
        const LobeSample s = m.sample(wo, uniform.lanes3());
        const std::uint32_t valid = bits(s.valid);
        for (int l = 0; l < W; ++l) {
            const bool ok = (valid >> l & 1) != 0;
            const int cell = ok ? grid.cell(s.wi.x[l], s.wi.y[l], s.wi.z[l]) : grid.cells();
            observed[static_cast<std::size_t>(cell)] += 1;
        }
    }
    const double drawn = (n + W - 1) / W * W;
    const CellIntegrator integrate(m.eval, wo, 2e-7, 1e-4);
    double total = 0;
    for (int k = 0; k < grid.cells(); ++k)
        total += expected[static_cast<std::size_t>(k)] = drawn * integrate.cell(grid, k).pdf;
    // Edges of the domain are integrated to about 1e-4: a difference inside that is none. A density that integrates
    // to more than 1 leaves a negative count here, which chi2_test rejects.
    const double lost = drawn - total, error = 2e-4 * drawn;
    expected.back() = lost + std::clamp(observed.back() - lost, -error, error);
    return statistics::chi2_test(observed, expected);
}

/// Sampled mean of f·cos/pdf, deltas included: the albedo under uniform light.
inline statistics::Moments furnace(const Model& m, Vec3 wo, int n, std::uint32_t seed) {
    Uniform uniform(seed);
    statistics::Moments moments;
    for (int k = 0; k < n; k += W) {
        const LobeSample s = m.sample(wo, uniform.lanes3());
        const Float f = average(s.f_cos) / max(s.pdf, 1e-30f);
        const std::uint32_t valid = bits(s.valid);
        for (int l = 0; l < W; ++l) moments.add((valid >> l & 1) != 0 ? static_cast<double>(f[l]) : 0.0);
    }
    return moments;
}

/// furnace() against the integral of f·cos over the sphere (lobes without deltas).
inline statistics::TResult weights_of(const Model& m, Vec3 wo, int n, std::uint32_t seed) {
    const double reference = CellIntegrator(m.eval, wo, 2e-7, 1e-4).sphere(SphereGrid{}).f;
    return statistics::t_test(furnace(m, wo, n, seed), reference, 1e-4);
}

}  // namespace cardioid::test
