// SPDX-License-Identifier: GPL-3.0-or-later
// Balance of the two halves (spec 2): how many photons a camera path is worth, from the errors and the rays of the last two
// training passes. Counts, never clocks, so the same scene gives the same number anywhere.
#pragma once

#include "film/film.h"

#include <cstdint>
#include <vector>

namespace cardioid::render {

class BalanceMeter {
public:
    explicit BalanceMeter(const film::Region& region);

    /// One camera path's luminance by who estimates it. `half` 0 or 1: which of the two passes; a pixel belongs to one task at a time.
    void add(int half, int x, int y, float camera, float photons);
    /// By how much to multiply the number of photons so that the error falls fastest: sqrt(V_p C_c / (V_c C_p)), within [1/8, 8].
    /// `samples`: of the two passes, per pixel. Costs: work of both passes together, in rays.
    double factor(const int (&samples)[2], double camera_cost, double photon_cost) const;

private:
    struct Sums {
        float camera = 0, photons = 0;
    };
    film::Region region_;
    std::vector<Sums> sums_[2];
};

}  // namespace cardioid::render
