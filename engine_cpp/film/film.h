// SPDX-License-Identifier: GPL-3.0-or-later
// Sums of samples per pixel: apart by path class, and as clusters of incident light in layers, from which the picture
// can be filtered after the render. A pixel belongs to one task at a time, which adds its samples in order, so the bits
// do not depend on the number of threads or on how samples are grouped into passes.
#pragma once

#include "film/cluster_store.h"
#include "film/frame.h"
#include "scene/scene_desc.h"

#include <cstdint>
#include <vector>

namespace cardioid::film {

inline constexpr int k_classes = 5;  ///< D1, D2, D3, C1, C2

/// One camera path's result.
struct Sample {
    float radiance[k_classes][3] = {};
    float unfiltered[3] = {};       ///< the part of it that is in no layer: D1 and photons
    LayerSample layers[k_layers];   ///< the rest
    float detail[3] = {};           ///< albedo of the D lobes at x_d × throughput before it; 0 where there is none
    float mirrored_detail[3] = {};  ///< the part of `detail` that lies behind specular lobes: noisy by their choice
    /// Normal and depth along the view axis at x_d, and depth²; each × luminance(detail).
    float feature_normal[3] = {}, feature_depth = 0, feature_depth_squared = 0;
    float alpha = 1;
    float depth = 1e10f;  ///< of the first surface, along the view axis; 1e10: nothing hit
    float normal[3] = {0, 0, 0};
};

/// A rectangle of the frame in pixels, from its bottom left.
struct Region {
    int x = 0, y = 0, width = 0, height = 0;
};

/// Means over a pixel's samples, misses included.
struct PixelFeatures {
    float detail[3] = {};
    float normal[3] = {};  ///< mean of unit vectors: shorter where they differ; zero: nothing with a D lobe was seen
    float depth = 0;       ///< mean; 0 where nothing was seen
    float depth_variance = 0;       ///< of the samples, not of their mean
    float mirrored_detail[3] = {};  ///< the part of `detail` that lies behind specular lobes
    float detail_variance = 0;      ///< of luminance(mirrored_detail)
};

class FilmWriter;

class Film {
public:
    explicit Film(const scene::Settings& settings);

    /// The rendered part of the frame.
    Region region() const { return region_; }
    float exposure() const { return exposure_; }
    bool has_clusters() const { return clusters_.width() > 0; }
    const ClusterStore& clusters() const { return clusters_; }
    ClusterStore& clusters() { return clusters_; }
    const scene::FilterSettings& filter_settings() const { return filter_; }

    /// Samples taken, misses and empty ones included. x, y here and below count from the region's corner.
    std::uint32_t samples(int x, int y) const { return pixel(x, y).samples; }
    PixelFeatures features(int x, int y) const;
    /// Mean radiance (without exposure) that is in no layer, photons of the per-pixel schedule included.
    void unfiltered(int x, int y, float (&rgb)[3]) const;
    /// The per-pixel schedule's photons, as means of the classes D2…C2; they replace what was told before.
    void set_photons(int x, int y, const float (&classes)[k_classes - 1][3]);

    /// An empty picture of the region's size: Combined, Depth, Normal, D1 … C2; with clusters also Raw, Filtered,
    /// Withheld.
    Frame make_frame() const;
    /// Raw light of a pixel with exposure, as resolve() writes it.
    void raw(int x, int y, float (&rgb)[3]) const;
    /// Writes the raw means of the pixels inside `part` (frame coordinates) into `frame`: Combined (unless
    /// `keep_combined`), Raw and the classes.
    void resolve(const Region& part, Frame& frame, bool keep_combined = false) const;

    std::int64_t memory_bytes() const;

private:
    friend class FilmWriter;
    friend class FilmFile;
    struct Pixel {
        float radiance[k_classes][3] = {};
        float unfiltered[3] = {};
        float detail[3] = {}, mirrored_detail[3] = {}, mirrored_detail_squared = 0;  ///< squared: of luminance
        float feature_normal[3] = {}, feature_depth = 0, feature_depth_squared = 0;
        float alpha = 0, depth = 1e10f;
        float normal[3] = {0, 0, 0};
        std::uint32_t samples = 0;
    };
    struct PhotonMeans {
        float classes[k_classes - 1][3] = {};
    };
    const Pixel& pixel(int x, int y) const {
        return pixels_[static_cast<std::size_t>(y) * region_.width + static_cast<std::size_t>(x)];
    }
    /// With exposure; channel of a pixel that has samples.
    float class_mean(std::size_t pixel, int path_class, int channel) const;
    Region region_;
    float exposure_;
    bool transparent_;
    scene::FilterSettings filter_;
    std::vector<Pixel> pixels_;
    std::vector<PhotonMeans> photons_;  ///< empty but for the per-pixel schedule
    ClusterStore clusters_;             ///< empty when settings.record_clusters is off
};

/// Adds samples; one per thread. A pixel's samples come in order, from one thread at a time; blocks of 8 × 8 pixels
/// (from the region's corner) belong to one thread at a time.
class FilmWriter {
public:
    void open(Film& film) { film_ = &film; }
    /// x, y in the whole frame. `first`: this is the pixel's first sample, which gives the Depth pass its value (depth
    /// is not averaged). Returns false for a sample with a value that is not finite or beyond 1e30: it is dropped.
    bool add(int x, int y, const Sample& sample, bool first);
    /// Before another thread may read or write the pixels.
    void close();

private:
    Film* film_ = nullptr;
    ClusterEditor editor_;
};

/// The crop of the settings, or the whole frame; clipped to the frame.
Region crop_region(const scene::Settings& settings);

}  // namespace cardioid::film
