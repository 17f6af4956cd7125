// SPDX-License-Identifier: GPL-3.0-or-later
// Sums of samples per pixel, apart by path class. A pixel belongs to one task at a time, which adds its samples in order, so
// the bits do not depend on the number of threads or on how samples are grouped into passes.
#pragma once

#include "film/frame.h"
#include "scene/scene_desc.h"

#include <cstdint>
#include <vector>

namespace cardioid::film {

inline constexpr int k_classes = 5;  ///< D1, D2, D3, C1, C2

/// One camera path's result.
struct Sample {
    float radiance[k_classes][3];
    float alpha = 1;
    float depth = 1e10f;  ///< along the view axis; 1e10: nothing hit
    float normal[3] = {0, 0, 0};
};

/// A rectangle of the frame in pixels, from its bottom left.
struct Region {
    int x = 0, y = 0, width = 0, height = 0;
};

class Film {
public:
    explicit Film(const scene::Settings& settings);

    /// The rendered part of the frame.
    Region region() const { return region_; }
    /// x, y in the whole frame. `first`: this is sample 0, which gives the Depth pass its value (depth is not averaged).
    /// Returns false for a sample with a value that is not finite: it is dropped.
    bool add(int x, int y, const Sample& sample, bool first);

    /// An empty picture of the region's size.
    Frame make_frame() const;
    /// Writes the means of the pixels inside `part` (frame coordinates) into `frame`.
    void resolve(const Region& part, Frame& frame) const;

    std::int64_t memory_bytes() const { return static_cast<std::int64_t>(pixels_.size() * sizeof(Pixel)); }

private:
    struct Pixel {
        float radiance[k_classes][3] = {};
        float alpha = 0, depth = 1e10f;
        float normal[3] = {0, 0, 0};
        std::uint32_t samples = 0;
    };
    Region region_;
    float exposure_;
    bool transparent_;
    std::vector<Pixel> pixels_;
};

/// Adds rgb × scale to a pixel of the class's pass (0: D1, …) and to Combined.
void add_to_class(Frame& frame, std::size_t pixel, int path_class, const float (&rgb)[3], float scale);

/// The crop of the settings, or the whole frame; clipped to the frame.
Region crop_region(const scene::Settings& settings);

}  // namespace cardioid::film
