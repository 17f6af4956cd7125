// SPDX-License-Identifier: GPL-3.0-or-later
// A tile of the film as planes of floats, with the pixels around it that its kernels reach: what vector kernels load.
#pragma once

#include "film/film.h"
#include "filter/picture.h"
#include "filter/reject.h"

#include <vector>

namespace cardioid::filter {

/// Something that is averaged over pixels alike: a layer's light, or the texture detail.
struct Signal {
    float* mean[3] = {};      ///< R / D̂, or D̂, by channel; 0 where D̂ is too dark
    float* variance[3] = {};  ///< of that mean
    float* weight[3] = {};    ///< samples taken that stand behind it; 0 where D̂ is too dark
};

inline constexpr int k_detail_signal = film::k_layers;  ///< after the layers: the part of D̂ seen in mirrors and glass
inline constexpr int k_signals = film::k_layers + 1;
/// Channels of D̂ at or under this are not divided by.
inline constexpr float k_darkest_detail = 1e-4f;

/// Planes of (2 · reach + width) × (2 · reach + height) pixels. What lies outside the film is zero.
class Tile {
public:
    /// x, y, width, height in the film's region. `filtered`: what a pass before has made of layers and detail; null: the film's.
    Tile(const film::Film& film, const Rejection& rejection, const film::Region& area, int reach,
         const Picture* filtered = nullptr);

    film::Region area;
    int reach, stride;                   ///< floats from row to row; rows can be loaded 16 floats past their end
    float* taken = nullptr;              ///< samples; 0: outside
    float* detail[3] = {};               ///< D̂
    float* normal[3] = {};               ///< mean of unit vectors at x_d
    float* normal_variance = nullptr;    ///< 1 − |normal|²
    float* depth = nullptr;              ///< at x_d
    float* depth_variance = nullptr;     ///< of the samples
    float* gradient[2] = {};             ///< |∂depth/∂x|, |∂depth/∂y| in units per pixel
    float* radiance[film::k_layers][3];  ///< R that is kept: sum over kept clusters / samples
    Signal signal[k_signals];
    bool has_noisy_detail = false;  ///< some pixel's D̂ has variance

    /// Index of pixel (x, y) of the tile; -reach … width + reach.
    int at(int x, int y) const { return (y + reach) * stride + x + reach; }

private:
    void load_features(const film::PixelFeatures& f, int i);
    void load_noisy_detail(const film::PixelFeatures& f, int i);
    void load_layer(std::span<const film::Cluster> clusters, unsigned withheld, int layer, int i);
    void load_filtered(const Picture& filtered, std::size_t from, int i);
    /// Kept light of a layer and its variance.
    void set_layer(int layer, int i, const float (&mean)[3], const float (&variance)[3]);
    void find_gradients();
    std::vector<float> memory_;
};

}  // namespace cardioid::filter
