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
                    const Mask inside = load(t.taken + q) > Float(0.0f);
                    store_row(out + x, select(inside, w, Float(0.0f)), t.area.width - x);
                }
            }
        }
    }
}

}  // namespace cardioid::CD_ISA_NS
