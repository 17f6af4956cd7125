// SPDX-License-Identifier: GPL-3.0-or-later
// Interpolated colours of a texture at up to 64 points; Cycles' conventions (texel centres at half-integers).
#pragma once

#include "image/image_store.h"
#include "image/srgb.h"
#include "image/texture.h"

namespace cardioid::image {

/// Four floats that the compiler keeps in one register.
typedef float Quad __attribute__((vector_size(16)));

/// Texels and weights along one axis for every point: taps 0…count-1 of each, -1 for outside (clip).
struct AxisTaps {
    int texel[4][k_chunk];
    float weight[4][k_chunk];
};

struct Footprint {
    int taps = 1;  ///< along each axis: 1, 2 or 4
    AxisTaps x, y;
};

void place(Footprint& footprint, Interpolation interpolation, Extension extension, int width, int height, int n,
           const float* u, const float* v);

/// Stored colour (encoded, alpha associated) of points first…n-1. Stops at a tile that is not loaded and returns the
/// point (the tile's index in `missing`), or returns n.
int fetch(const Texture& texture, const Footprint& footprint, int first, int n, Quad* colors, int& missing);

/// Alpha and transfer function of the fetched colours.
void finish(const Texture& texture, const SrgbTable& srgb, AlphaUse alpha, int n, const Quad* colors, Row rgba[4]);

}  // namespace cardioid::image
