// SPDX-License-Identifier: GPL-3.0-or-later
// Outlier rejection (thesis 6.3.1, Algorithm 4; spec 5): which clusters are withheld because their neighbourhood has too few samples
// like theirs. A pure function of film and settings.
#pragma once

#include "film/film.h"
#include "filter/executor.h"
#include "scene/filter_settings.h"

#include <cstdint>
#include <vector>

namespace cardioid::filter {

/// Per pixel and layer one bit for each cluster, bit i for cluster i: set where it is withheld.
struct Rejection {
    int width = 0, height = 0;
    std::vector<std::uint8_t> bits;  ///< (y · width + x) · k_layers + layer; empty: nothing is withheld
    std::uint8_t withheld(int x, int y, int layer) const {
        return bits.empty() ? 0 : bits[(static_cast<std::size_t>(y) * width + x) * film::k_layers + layer];
    }
};

/// Counts of a run.
struct RejectionStats {
    std::int64_t clusters = 0, singles = 0;  ///< of the film; with one sample
    std::int64_t rejected = 0, rejected_samples = 0;
};

/// Empty when `for_each` was stopped or firefly_density is 0 or the film has no clusters.
Rejection reject(const film::Film& film, const scene::FilterSettings& settings, const ForEach& for_each,
                 RejectionStats* stats = nullptr);

}  // namespace cardioid::filter
