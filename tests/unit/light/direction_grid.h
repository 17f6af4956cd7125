// SPDX-License-Identifier: GPL-3.0-or-later
// Cells of equal solid angle in a cap around an axis, expected counts by quadrature of a density, and the chi² test.
#pragma once

#include "light_tests.h"
#include "statistics/chi2.h"

#include <functional>

namespace cardioid::light_tests {

class DirectionGrid {
public:
    /// The cap of directions within `angle` (radians) of the unit axis.
    DirectionGrid(Float3 axis, double angle) : axis_(axis), height_(1 - std::cos(angle)) {
        const Float3 other = std::fabs(axis.x) < 0.7f ? Float3{1, 0, 0} : Float3{0, 1, 0};
        s_ = normalize(cross(axis, other));
        t_ = cross(axis, s_);
    }

    static constexpr int k_rings = 24, k_sectors = 24;
    static constexpr std::size_t k_cells = k_rings * k_sectors + 1;  ///< the last one: outside of the cap, or no sample

    std::size_t cell_of(Float3 d) const {
        // |d - axis|² / 2 = 1 - cos without cancellation.
        const Float3 off = d - axis_;
        const double down = 0.5 * static_cast<double>(dot(off, off)) / height_;
        double turn = std::atan2(static_cast<double>(dot(d, t_)), static_cast<double>(dot(d, s_))) / (2 * k_pi_d);
        if (turn < 0) turn += 1;
        if (down >= 1) return k_cells - 1;
        return static_cast<std::size_t>(down * k_rings) * k_sectors +
               std::min(static_cast<std::size_t>(turn * k_sectors), static_cast<std::size_t>(k_sectors - 1));
    }

    using Density = std::function<Float(Vec3)>;
    /// Probability of each cell, by sub × sub midpoints a cell; the rest of 1 goes to the last one.
    std::vector<double> probabilities(const Density& density, int sub) const {
        std::vector<double> p(k_cells, 0.0);
        const int across = k_sectors * sub, along = k_rings * sub;
        const double weight = 2 * k_pi_d * height_ / (static_cast<double>(across) * along);
        double sum = 0;
        for (int y = 0; y < along; ++y) {
            for (int x = 0; x < across; x += W) {
                Vec3 d{0.0f, 0.0f, 1.0f};
                for (int i = 0; i < W; ++i) set_lane(d, i, direction((x + i + 0.5) / across, (y + 0.5) / along));
                const Float value = density(d);
                for (int i = 0; i < W && x + i < across; ++i) {
                    const double v = static_cast<double>(value[i]) * weight;
                    p[static_cast<std::size_t>(y / sub * k_sectors + (x + i) / sub)] += v;
                    sum += v;
                }
            }
        }
        p[k_cells - 1] = std::max(0.0, 1 - sum);
        integral_ = sum;
        return p;
    }
    double integral() const { return integral_; }

    Float3 direction(double u, double v) const {
        const double rise = v * height_, sine = std::sqrt(std::max(0.0, rise * (2 - rise))), phi = 2 * k_pi_d * u;
        const double a = sine * std::cos(phi), b = sine * std::sin(phi), c = 1 - rise;
        const auto mix = [&](float s, float t, float n) {
            return static_cast<float>(a * static_cast<double>(s) + b * static_cast<double>(t) +
                                      c * static_cast<double>(n));
        };
        return {mix(s_.x, t_.x, axis_.x), mix(s_.y, t_.y, axis_.y), mix(s_.z, t_.z, axis_.z)};
    }

private:
    Float3 axis_, s_, t_;
    double height_;
    mutable double integral_ = 0;
};

}  // namespace cardioid::light_tests
