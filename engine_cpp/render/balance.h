// SPDX-License-Identifier: GPL-3.0-or-later
// Balance of the two halves (spec 2): how many photons a camera path is worth, and whether any, from the errors and the rays of the
// training passes. Counts, never clocks, so the same scene gives the same number anywhere.
#pragma once

#include "film/film.h"
#include "render/passes.h"

#include <cstdint>
#include <vector>

namespace cardioid::render {

/// Luminance of one camera path, apart by who estimates it.
struct Halves {
    float camera = 0, photons = 0;
    float hits = 0;  ///< what camera paths alone would have brought instead of `photons`
};

class BalanceMeter {
public:
    explicit BalanceMeter(const film::Region& region);

    /// One camera path of training pass `pass`; a pixel belongs to one task at a time.
    void add(int pass, int x, int y, const Halves& path);
    /// By how much to multiply the number of photons so that the error falls fastest: sqrt(V_p C_c / (V_c C_p)), within [1/4, 8].
    /// 0: camera paths alone do better, and they find all that photons bring.
    /// Costs: work of the training passes, in rays; `gather_cost`: what camera paths pay where there are photons at all.
    double factor(double camera_cost, double gather_cost, double photon_cost) const;

private:
    struct Variances {
        double camera = 0, photons = 0, hits = 0;
    };
    /// Sums of squared relative differences of passes `first` and `first` + 1.
    Variances differences(int first, double level_floor) const;
    /// Mean of a member over pixels and passes.
    double mean(float Halves::*part) const;
    bool hits_find_everything() const;

    film::Region region_;
    std::vector<Halves> sums_[k_training_passes];
};

}  // namespace cardioid::render
