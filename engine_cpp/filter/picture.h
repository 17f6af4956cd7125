// SPDX-License-Identifier: GPL-3.0-or-later
// The layers between two passes of the filter.
#pragma once

#include "film/cluster.h"

#include <cstddef>
#include <vector>

namespace cardioid::filter {

/// Planes of width × height.
struct Picture {
    int width = 0, height = 0;
    std::vector<float> layer[film::k_layers][3];     ///< radiance
    std::vector<float> variance[film::k_layers][3];  ///< of radiance
    std::vector<float> detail[3];                    ///< D̂, without the noise of mirrors and glass

    Picture() = default;
    Picture(int w, int h) : width(w), height(h) {
        const auto size = static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
        for (auto& l : layer) {
            for (auto& c : l) c.resize(size);
        }
        for (auto& l : variance) {
            for (auto& c : l) c.resize(size);
        }
        for (auto& d : detail) d.resize(size);
    }
};

}  // namespace cardioid::filter
