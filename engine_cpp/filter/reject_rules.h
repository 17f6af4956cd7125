// SPDX-License-Identifier: GPL-3.0-or-later
// Readings of thesis Algorithm 4, apart so that they can be measured against each other (docs/filter.md).
#pragma once

#include "filter/reject.h"

namespace cardioid::filter {

struct RejectionRules {
    /// The density runs on down a layer's clusters, as printed: a rejected cluster's evidence counts for the next one. Otherwise
    /// each cluster is counted by itself.
    bool accumulate = false;
    /// A neighbour's cluster that overlaps at all counts whole, as printed. Otherwise by the samples that surely or likely
    /// overlap: its ends, and of the rest the share of eq. 6.8.
    bool whole = false;
    /// Clusters are ranked and compared by the light that arrives, as printed. Otherwise by the light that they add to the
    /// pixel (reject_measure.h).
    bool incident = false;
};

constexpr RejectionRules rejection_rules(scene::FilterMethod method) {
    const bool thesis = method == scene::FilterMethod::thesis;
    return {thesis, thesis, thesis};
}

/// reject() by given rules instead of those of settings.filter_method.
Rejection reject_by(const RejectionRules& rules, const film::Film& film, const scene::FilterSettings& settings,
                    const ForEach& for_each, RejectionStats* stats = nullptr);

}  // namespace cardioid::filter
