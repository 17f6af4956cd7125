// SPDX-License-Identifier: GPL-3.0-or-later
// Balance of the two halves (spec 2): how many photons a camera path is worth, from the errors and the rays of the training
// passes. Counts, never clocks, so the same scene gives the same number anywhere.
#pragma once

#include "film/film.h"
#include "render/passes.h"

#include <cstdint>
#include <vector>

namespace cardioid::render {

class BalanceMeter {
public:
    explicit BalanceMeter(const film::Region& region);

    /// One camera path's luminance by who estimates it, in training pass `pass`; a pixel belongs to one task at a time.
    void add(int pass, int x, int y, float camera, float photons);
    /// By how much to multiply the number of photons so that the error falls fastest: sqrt(V_p C_c / (V_c C_p)), within [1/4, 8].
    /// Costs: work of the training passes, in rays.
    double factor(double camera_cost, double photon_cost) const;

private:
    struct Sums {
        float camera = 0, photons = 0;
    };
    /// Mean squared relative difference of two passes, camera and photons.
    void differences(int first, double level_floor, double& camera, double& photons) const;

    film::Region region_;
    std::vector<Sums> sums_[k_training_passes];
};

}  // namespace cardioid::render
