// SPDX-License-Identifier: GPL-3.0-or-later
// One lookup as a value.
#pragma once

#include "image/image_store.h"

#include <array>

namespace cardioid::image::test {

using Color = std::array<float, 4>;

inline Color look(const ImageStore& store, int image, float u, float v,
                  Interpolation interpolation = Interpolation::closest, Extension extension = Extension::repeat,
                  AlphaUse alpha = AlphaUse::straight) {
    Row rgba[4];
    store.lookup(image, interpolation, extension, 1, &u, &v, rgba, alpha);
    return {rgba[0][0], rgba[1][0], rgba[2][0], rgba[3][0]};
}

/// Texel (x, y) of an image, y from the bottom.
inline Color texel(const ImageStore& store, int image, int x, int y, AlphaUse alpha = AlphaUse::straight) {
    return look(store, image, (static_cast<float>(x) + 0.5f) / static_cast<float>(store.width(image)),
                (static_cast<float>(y) + 0.5f) / static_cast<float>(store.height(image)), Interpolation::closest,
                Extension::repeat, alpha);
}

}  // namespace cardioid::image::test
