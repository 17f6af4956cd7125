// SPDX-License-Identifier: GPL-3.0-or-later
// Passes: ranges of sample numbers that are rendered together, with photons of their own. The table is the same for every render,
// so that a frame can be split by sample numbers and every part traces the photons that the whole would have.
#pragma once

#include <vector>

namespace cardioid::render {

struct Pass {
    int number = 0;
    int begin = 0, size = 0;     ///< sample numbers [begin, begin + size) belong to the pass
    int first = 0, samples = 0;  ///< those of them that this render has
    /// Sample that stands for the pass in the schedule of radii.
    int middle() const { return begin + size / 2; }
};

/// The first passes teach the photons where they are needed (spec 2); then nothing more is learned.
inline constexpr int k_training_passes = 4;

/// Passes that meet samples [first, first + samples): 1, 1, 2, 4, 8, 8, … samples, each at most `most`. Small at first, so that
/// a picture is there at once; then 8, which keeps the samples of a pixel next to each other in a batch.
std::vector<Pass> passes(int first, int samples, int most = 8);

}  // namespace cardioid::render
