// SPDX-License-Identifier: GPL-3.0-or-later
// A finished picture: named float passes over the cropped frame, bottom row first.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace cardioid::film {

struct Pass {
    std::string name;  ///< Combined, Depth, Normal, D1, D2, D3, C1, C2
    int channels = 0;
    std::vector<float> data;  ///< height × width × channels
};

struct Frame {
    int width = 0, height = 0;
    int samples = 0;  ///< most samples that a pixel has
    std::vector<Pass> passes;
    const Pass* find(const std::string& name) const {
        for (const Pass& p : passes) {
            if (p.name == name) return &p;
        }
        return nullptr;
    }
    Pass* find(const std::string& name) { return const_cast<Pass*>(std::as_const(*this).find(name)); }
};

}  // namespace cardioid::film
