// SPDX-License-Identifier: GPL-3.0-or-later
// The pixels around a pixel in which samples are looked for, and how many must be found there.
#pragma once

#include "filter/reject_measure.h"
#include "scene/filter_settings.h"

#include <cstdint>
#include <vector>

namespace cardioid::filter {

class RejectionKernel {
public:
    struct Step {
        int dx, dy;
    };
    RejectionKernel(const scene::FilterSettings& settings, int width, int height);

    /// Without the pixel itself, nearest first: like samples are most likely there.
    const std::vector<Step>& steps() const { return steps_; }
    /// All of the kernel lies in the picture.
    bool inside(int x, int y) const;
    /// n × k_evidence. d = n/(σ²μ) is a density, so n shrinks with the part of the kernel that lies in the picture.
    std::int64_t needed(int x, int y) const;

private:
    int width_, height_, half_;
    double density_;  ///< samples per pixel of the kernel
    std::vector<Step> steps_;
};

}  // namespace cardioid::filter
