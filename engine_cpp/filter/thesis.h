// SPDX-License-Identifier: GPL-3.0-or-later
// The filter as the thesis has it (6.3.2–6.3.3, Algorithms 5 and 6), where spec 6 makes it consistent.
#pragma once

#include "filter/kernels.h"

namespace cardioid::filter {

/// A band of luminance over the whole kernel (Algorithm 5).
struct Group {
    float min = 0, max = 0;
};

/// Groups of what was added so far: ascending, further apart than μ. The same whatever the order of adding.
class GroupList {
public:
    explicit GroupList(float mu) : stretch_(1 / (1 - mu)) {}
    void clear() { groups_.clear(); }
    void add(float min, float max);
    /// The group that holds a cluster which was added.
    std::size_t find(float min) const;
    const std::vector<Group>& groups() const { return groups_; }

private:
    float stretch_;  ///< groups whose bounds differ by less than this factor are one
    std::vector<Group> groups_;
};

/// ln of thesis 6.10 for k samples here and `expected` there, relative to its largest value: k! cancels when weights are normalised.
float poisson_weight(float k, float expected);

/// One tile. `weights`: select_geometry_weights of the request.
void filter_thesis(const KernelRequest& request, const film::Film& film, const Rejection& rejection, float mu,
                   const float* weights);

}  // namespace cardioid::filter
