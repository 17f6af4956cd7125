// SPDX-License-Identifier: GPL-3.0-or-later
// Integrals of a lobe over cells of the sphere (rows in cos θ, columns in φ), with an adaptive 8×8 Gauss–Legendre rule.
#pragma once

#include "model.h"

#include <vector>

namespace cardioid::test {

/// Rows are even in number, so that no cell straddles the horizon.
struct SphereGrid {
    int rows = 24, columns = 32;
    int cells() const { return rows * columns; }
    int cell(float x, float y, float z) const {
        const int r = std::clamp(static_cast<int>((z + 1) * 0.5f * static_cast<float>(rows)), 0, rows - 1);
        const float turn = std::atan2(y, x) / 6.2831853f;
        const int c = static_cast<int>((turn < 0 ? turn + 1 : turn) * static_cast<float>(columns));
        return r * columns + std::clamp(c, 0, columns - 1);
    }
};

/// Integrals of pdf and of the mean of f·cos.
struct Integrals {
    double pdf = 0, f = 0;
    Integrals& operator+=(Integrals o) {
        pdf += o.pdf;
        f += o.f;
        return *this;
    }
};

class CellIntegrator {
public:
    /// Cells are divided until halving them changes both integrals by at most `tolerance` + `relative`·value.
    CellIntegrator(Eval eval, Vec3 wo, double tolerance, double relative)
        : eval_(std::move(eval)), wo_(wo), tolerance_(tolerance), relative_(relative) {}

    Integrals cell(const SphereGrid& g, int index) const {
        const double dz = 2.0 / g.rows, dphi = 2 * 3.14159265358979323846 / g.columns;
        const double z = -1 + index / g.columns * dz, phi = index % g.columns * dphi;
        return refine(z, z + dz, phi, phi + dphi, gauss(z, z + dz, phi, phi + dphi), 0);
    }
    Integrals sphere(const SphereGrid& g) const {
        Integrals all;
        for (int k = 0; k < g.cells(); ++k) all += cell(g, k);
        return all;
    }

private:
    Integrals gauss(double z0, double z1, double p0, double p1) const;
    Integrals refine(double z0, double z1, double p0, double p1, Integrals coarse, int depth) const;

    Eval eval_;
    Vec3 wo_;
    double tolerance_, relative_;
};

inline Integrals CellIntegrator::gauss(double z0, double z1, double p0, double p1) const {
    constexpr double x[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    constexpr double w[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    const auto node = [&](int k) { return k < 4 ? -x[3 - k] : x[k - 4]; };
    const auto weight = [&](int k) { return k < 4 ? w[3 - k] : w[k - 4]; };
    float rows[3][64];
    for (int k = 0; k < 64; ++k) {
        const double z = 0.5 * (z0 + z1 + (z1 - z0) * node(k / 8)), phi = 0.5 * (p0 + p1 + (p1 - p0) * node(k % 8));
        const double s = std::sqrt(std::max(0.0, 1 - z * z));
        rows[0][k] = static_cast<float>(s * std::cos(phi));
        rows[1][k] = static_cast<float>(s * std::sin(phi));
        rows[2][k] = static_cast<float>(z);
    }
    Integrals sum;
    for (int k = 0; k < 64; k += W) {
        const LobeEval e = eval_(wo_, load3(rows, k));
        const Float f = average(e.f_cos);
        for (int l = 0; l < W; ++l) {
            const double a = weight((k + l) / 8) * weight((k + l) % 8);
            sum.pdf += a * static_cast<double>(e.pdf[l]);
            sum.f += a * static_cast<double>(f[l]);
        }
    }
    const double area = 0.25 * (z1 - z0) * (p1 - p0);
    return {sum.pdf * area, sum.f * area};
}

inline Integrals CellIntegrator::refine(double z0, double z1, double p0, double p1, Integrals coarse, int depth) const {
    const double zm = 0.5 * (z0 + z1), pm = 0.5 * (p0 + p1);
    const double z[3] = {z0, zm, z1}, p[3] = {p0, pm, p1};
    Integrals part[4], sum;
    for (int k = 0; k < 4; ++k) sum += part[k] = gauss(z[k / 2], z[k / 2 + 1], p[k % 2], p[k % 2 + 1]);
    const auto close = [&](double a, double b) { return std::abs(a - b) <= tolerance_ + relative_ * std::abs(b); };
    if (depth >= 9 || (close(coarse.pdf, sum.pdf) && close(coarse.f, sum.f))) return sum;
    Integrals fine;
    for (int k = 0; k < 4; ++k) fine += refine(z[k / 2], z[k / 2 + 1], p[k % 2], p[k % 2 + 1], part[k], depth + 1);
    return fine;
}

}  // namespace cardioid::test
