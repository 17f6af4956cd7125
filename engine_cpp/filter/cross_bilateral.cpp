// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter/geometry.h"

namespace cardioid::CD_ISA_NS {

namespace {

using filter::KernelRequest;
using filter::Tile;

/// Σ W R of the layers' channels and Σ W.
struct Sums {
    Float radiance[film::k_layers][3], weight;
};

/// Squared distance of the texture detail.
Float texture_distance(const Tile& t, int p, int q) {
    Float sum = 0.0f;
    for (const float* d : {t.detail[0], t.detail[1], t.detail[2]}) {
        const Float difference = load(d + p) - load(d + q);
        sum = fma(difference, difference, sum);
    }
    return sum;
}

Sums average(const KernelRequest& r, int p) {
    const Tile& t = *r.tile;
    Sums sums;
    sums.weight = 0.0f;
    for (auto& layer : sums.radiance) {
        for (Float& channel : layer) channel = 0.0f;
    }
    for (int dy = -r.radius; dy <= r.radius; ++dy) {
        for (int dx = -r.radius; dx <= r.radius; ++dx) {
            const int q = p + dy * t.stride + dx;
            const Float exponent = static_cast<float>(dx * dx + dy * dy) * r.inverse_two_spread_squared +
                                   texture_distance(t, p, q) * (0.5f * r.inverse_texture_width_squared) +
                                   geometry_distance(t, p, q, dx, dy);
            const Mask inside = load(t.taken + q) > Float(0.0f);
            const Float w = select(inside, exp(-min(exponent, 60.0f)), Float(0.0f));
            sums.weight += w;
            for (int l = 0; l < film::k_layers; ++l) {
                if (!r.layers[l]) continue;
                for (int c = 0; c < 3; ++c)
                    sums.radiance[l][c] = fma(w, load(t.radiance[l][c] + q), sums.radiance[l][c]);
            }
        }
    }
    return sums;
}

}  // namespace

void filter_cross_bilateral(const KernelRequest& r) {
    const Tile& t = *r.tile;
    for (int y = 0; y < t.area.height; ++y) {
        for (int x = 0; x < t.area.width; x += W) {
            const int p = t.at(x, y), left = t.area.width - x;
            const Sums sums = average(r, p);
            const Mask inside = load(t.taken + p) > Float(0.0f);
            const Float inverse = select(inside, Float(1.0f) / max(sums.weight, 1e-30f), Float(0.0f));
            for (int l = 0; l < film::k_layers; ++l) {
                if (!r.layers[l]) continue;
                for (int c = 0; c < 3; ++c)
                    store_row(r.result[l][c] + y * r.stride + x, sums.radiance[l][c] * inverse, left);
            }
        }
    }
}

}  // namespace cardioid::CD_ISA_NS
