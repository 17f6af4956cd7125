// SPDX-License-Identifier: GPL-3.0-or-later
// All images of a scene behind one door: OpenImageIO reads and caches the tiles, OpenColorIO names the colour spaces.
#pragma once

#include "math/types.h"
#include "scene/scene_desc.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cardioid::image {

enum class Interpolation : std::uint8_t { closest, linear, cubic };
enum class Extension : std::uint8_t { repeat, extend, clip, mirror };

/// Read-only after construction; lookups are safe from any number of threads.
class ImageStore {
public:
    /// Opens every image (in parallel), converts colour spaces. Never throws for a bad image: a missing one is magenta
    /// (1, 0, 1, 1) as in Blender, and is named in warnings().
    ImageStore(const std::vector<scene::ImageDesc>& images, const std::string& ocio_config, int cache_mb);
    ~ImageStore();
    ImageStore(const ImageStore&) = delete;
    ImageStore& operator=(const ImageStore&) = delete;

    /// Colours at u[i], v[i] (v up) for i < n ≤ 64: scene-linear RGB, alpha as Blender's Image Texture gives them.
    void lookup(int image, Interpolation interpolation, Extension extension, int n, const float* u, const float* v,
                Row rgba[4]) const;

    int width(int image) const;
    int height(int image) const;
    bool has_alpha(int image) const;
    /// Mean colour over the image (for light picking).
    Float3 mean_color(int image) const;
    int size() const;

    std::int64_t memory_bytes() const;
    const std::vector<std::string>& warnings() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace cardioid::image
