// SPDX-License-Identifier: GPL-3.0-or-later
// All images of a scene behind one door: OpenImageIO reads them, OpenColorIO names the colour spaces, tiles of texels
// are kept in a cache of bounded size.
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

/// How colour is given where alpha is below 1. Blender's Image Texture gives `straight` when its Alpha output is
/// linked and `associated` (multiplied by alpha) when it is not; the Environment Texture always gives `associated`.
enum class AlphaUse : std::uint8_t { straight, associated };

/// Lookups are safe from any number of threads.
class ImageStore {
public:
    /// Opens every image (in parallel) and reads ahead what fits. Keeps no reference to `images`. Never throws for a
    /// bad image: a missing one is magenta (1, 0, 1, 1) as in Blender, and is named in warnings().
    ImageStore(const std::vector<scene::ImageDesc>& images, const std::string& ocio_config, int cache_mb);
    ~ImageStore();
    ImageStore(const ImageStore&) = delete;
    ImageStore& operator=(const ImageStore&) = delete;

    /// Colours at u[i], v[i] (v up) for i < n ≤ 64: scene-linear RGB, alpha as Blender's Image Texture gives them. An
    /// index that is not an image gives magenta.
    void lookup(int image, Interpolation interpolation, Extension extension, int n, const float* u, const float* v,
                Row rgba[4], AlphaUse alpha = AlphaUse::straight) const;

    /// Pixels; 1 for a missing image.
    int width(int image) const;
    int height(int image) const;
    bool has_alpha(int image) const;
    /// Mean of the associated colour over the image (for light picking). Reads the whole image the first time.
    Float3 mean_color(int image) const;
    int size() const;

    /// Texels held now, the reader's own cache included.
    std::int64_t memory_bytes() const;
    /// Each problem once. Grows while rendering if an image turns out to be damaged where it was not read before.
    std::vector<std::string> warnings() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace cardioid::image
