// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter/geometry.h"

namespace cardioid::CD_ISA_NS {

void geometry_weights(const filter::KernelRequest& r, float* weights) {
    const filter::Tile& t = *r.tile;
    float* out = weights;
    for (int dy = -r.radius; dy <= r.radius; ++dy) {
        for (int dx = -r.radius; dx <= r.radius; ++dx) {
            const float spatial = static_cast<float>(dx * dx + dy * dy) * r.inverse_two_spread_squared;
            for (int y = 0; y < t.area.height; ++y, out += t.area.width) {
                for (int x = 0; x < t.area.width; x += W) {
                    const int p = t.at(x, y), q = p + dy * t.stride + dx;
                    const Float w = exp(-min(geometry_distance(t, p, q, dx, dy) + spatial, 60.0f));
                    const Float inside = select(load(t.taken + q) > Float(0.0f), w, Float(0.0f));
                    const int left = t.area.width - x;
                    for (int k = 0; k < W && k < left; ++k) out[x + k] = inside[k];
                }
            }
        }
    }
}

}  // namespace cardioid::CD_ISA_NS
