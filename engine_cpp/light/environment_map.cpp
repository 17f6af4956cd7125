// SPDX-License-Identifier: GPL-3.0-or-later
#include "light/environment_map.h"

#include <algorithm>
#include <numbers>

namespace cardioid::light {
namespace {

constexpr double k_pi = std::numbers::pi;
/// Every cell keeps this share of the mean brightness: what the samples of a cell missed must stay possible.
constexpr double k_floor = 0.01;
/// Cells this many times brighter than the mean, and their neighbours, are looked at more closely.
constexpr float k_bright = 4;
constexpr int k_fine = 4;

struct Grid {
    int width, height;
    std::vector<float> value;
    float& at(int x, int y) {
        return value[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
    float at(int x, int y) const {
        return value[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

/// z is uniform within a row and the azimuth within a column, so that cells are uniform in solid angle.
double border_z(const Grid& g, int row) { return std::cos(k_pi * row / g.height); }

Float3 direction_in(const Grid& g, int x, int y, double u, double v) {
    const double z = border_z(g, y) + (border_z(g, y + 1) - border_z(g, y)) * v;
    const double r = std::sqrt(std::max(0.0, 1 - z * z));
    const double phi = 2 * k_pi * ((x + u) / g.width) - k_pi;
    return {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)), static_cast<float>(z)};
}

float brightness(Float3 c) {
    const float b = (std::fabs(c.x) + std::fabs(c.y) + std::fabs(c.z)) / 3;
    return std::isfinite(b) ? b : 0;
}

/// Collects directions and hands them to the world shader in full chunks.
class Evaluator {
public:
    explicit Evaluator(const EnvironmentEval& eval) : eval_(eval) {}
    void add(Float3 direction, float weight, float& sum) {
        directions_[count_] = direction;
        weights_[count_] = weight;
        sums_[count_] = &sum;
        if (++count_ == k_chunk) flush();
    }
    void flush() {
        if (count_ == 0) return;
        eval_(count_, directions_, radiance_);
        for (int i = 0; i < count_; ++i) *sums_[i] += weights_[i] * brightness(radiance_[i]);
        count_ = 0;
    }

private:
    const EnvironmentEval& eval_;
    int count_ = 0;
    Float3 directions_[k_chunk], radiance_[k_chunk];
    float weights_[k_chunk];
    float* sums_[k_chunk];
};

double mean_over_sphere(const Grid& g) {
    double sum = 0;
    for (int y = 0; y < g.height; ++y) {
        double row = 0;
        for (int x = 0; x < g.width; ++x) row += g.at(x, y);
        sum += row / g.width * (border_z(g, y) - border_z(g, y + 1)) / 2;
    }
    return sum;
}

void refine_bright_cells(Grid& g, Evaluator& eval, float mean) {
    std::vector<unsigned char> chosen(g.value.size(), 0);
    for (int y = 0; y < g.height; ++y) {
        for (int x = 0; x < g.width; ++x) {
            if (g.at(x, y) <= k_bright * mean) continue;
            for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, g.height - 1); ++ny) {
                for (int dx = -1; dx <= 1; ++dx) {
                    const int nx = (x + dx + g.width) % g.width;
                    chosen[static_cast<std::size_t>(ny) * static_cast<std::size_t>(g.width) +
                           static_cast<std::size_t>(nx)] = 1;
                }
            }
        }
    }
    for (int y = 0; y < g.height; ++y) {
        for (int x = 0; x < g.width; ++x) {
            if (chosen[static_cast<std::size_t>(y) * static_cast<std::size_t>(g.width) + static_cast<std::size_t>(x)] ==
                0)
                continue;
            float& sum = g.at(x, y);
            sum = 0;
            for (int i = 0; i < k_fine * k_fine; ++i) {
                eval.add(direction_in(g, x, y, (i % k_fine + 0.5) / k_fine, (i / k_fine + 0.5) / k_fine),
                         1.0f / (k_fine * k_fine), sum);
            }
        }
    }
    eval.flush();
}

/// Writes 0, running sums, 1 into `cdf` (n + 1 values); returns the sum.
double write_cdf(const double* weight, int n, float* cdf) {
    double total = 0;
    for (int i = 0; i < n; ++i) total += weight[i];
    double sum = 0;
    cdf[0] = 0;
    for (int i = 0; i < n; ++i) {
        sum += weight[i];
        cdf[i + 1] = static_cast<float>(total > 0 ? std::min(sum / total, 1.0) : (i + 1.0) / n);
    }
    cdf[n] = 1;
    return total;
}

/// Weights are what the brightness has over `even`, and `floor` everywhere.
DirectionCdf make_cdf(const Grid& g, double floor, double even) {
    DirectionCdf out;
    const auto columns = static_cast<std::size_t>(g.width), rows = static_cast<std::size_t>(g.height);
    out.conditional.resize((columns + 1) * rows);
    out.marginal.resize(rows + 1);
    std::vector<double> row(columns), row_weight(rows);
    for (int y = 0; y < g.height; ++y) {
        for (int x = 0; x < g.width; ++x) row[static_cast<std::size_t>(x)] = std::max(g.at(x, y) - even, 0.0) + floor;
        const auto i = static_cast<std::size_t>(y);
        row_weight[i] = write_cdf(row.data(), g.width, out.conditional.data() + i * (columns + 1)) *
                        (border_z(g, y) - border_z(g, y + 1));
    }
    write_cdf(row_weight.data(), g.height, out.marginal.data());
    return out;
}

}  // namespace

EnvironmentMap make_environment_map(const EnvironmentEval& eval, int resolution, bool compensate) {
    Grid g{resolution, std::max(resolution / 2, 1), {}};
    g.value.assign(static_cast<std::size_t>(g.width) * static_cast<std::size_t>(g.height), 0.0f);
    Evaluator evaluator(eval);
    for (int y = 0; y < g.height; ++y) {
        for (int x = 0; x < g.width; ++x) evaluator.add(direction_in(g, x, y, 0.5, 0.5), 1.0f, g.at(x, y));
    }
    evaluator.flush();
    refine_bright_cells(g, evaluator, static_cast<float>(mean_over_sphere(g)));
    const double mean = mean_over_sphere(g);
    EnvironmentMap map;
    if (!(mean > 0) || !std::isfinite(mean)) return map;

    map.width = g.width;
    map.height = g.height;
    map.irradiance = static_cast<float>(k_pi * mean);
    map.row_z.resize(static_cast<std::size_t>(g.height) + 1);
    for (int y = 0; y < g.height; ++y) map.row_z[static_cast<std::size_t>(y)] = static_cast<float>(border_z(g, y));
    map.row_z.back() = -1;
    map.sent = make_cdf(g, k_floor * mean, 0);
    // No floor where there are partners: cells far under the sun's share would be narrower than a float can tell.
    map.seen = compensate ? make_cdf(g, 0, mean) : make_cdf(g, k_floor * mean, 0);
    return map;
}

int environment_resolution(const WorldInput& world) {
    const bool automatic = world.sampling == scene::WorldSampling::automatic;
    const int asked = automatic && world.map_resolution <= 0 ? 1024 : world.map_resolution;
    return std::clamp(asked, 8, automatic ? 4096 : 8192);
}

}  // namespace cardioid::light
