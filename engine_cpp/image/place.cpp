// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/sampler.h"

namespace cardioid::image {
namespace {

/// Largest coordinate that is told apart from its neighbours; also what NaN becomes, with the sign changed.
constexpr float k_far = 1e6f;

float bounded(float u) {
    const float above = u > -k_far ? u : -k_far;
    return above < k_far ? above : k_far;
}

int floor_int(float x) {
    const int truncated = static_cast<int>(x);
    return truncated - (x < static_cast<float>(truncated) ? 1 : 0);
}

float fraction(float u) { return u - static_cast<float>(floor_int(u)); }

/// Texel coordinate of u before the taps are spread. Periods are taken out here, in floats, so that no division of
/// integers is needed later.
template <Extension E>
float scaled(float u, float size) {
    if constexpr (E == Extension::repeat) return fraction(bounded(u)) * size;
    if constexpr (E == Extension::mirror) return fraction(bounded(u) * 0.5f) * 2.0f * size;
    // Beyond the border everything is alike, and the product must fit an integer.
    const float near = u > -8.0f ? u : -8.0f;
    return (near < 8.0f ? near : 8.0f) * size;
}

/// Texel i, which is at most 3 outside its period.
template <Extension E>
int wrapped(int i, int size) {
    if constexpr (E == Extension::repeat) {
        i = i < 0 ? i + size : i;
        return i >= size ? i - size : i;
    } else if constexpr (E == Extension::extend) {
        i = i < 0 ? 0 : i;
        return i >= size ? size - 1 : i;
    } else if constexpr (E == Extension::clip) {
        return i < size ? i : -1;
    } else {
        i = i < 0 ? -1 - i : i;
        i = i >= 2 * size ? i - 2 * size : i;
        return i >= size ? 2 * size - 1 - i : i;
    }
}

/// For images of fewer texels than a footprint has taps.
int wrapped_small(Extension extension, int i, int size) {
    switch (extension) {
        case Extension::repeat: return (i % size + size) % size;
        case Extension::extend: return i < 0 ? 0 : i >= size ? size - 1 : i;
        case Extension::clip: return i >= 0 && i < size ? i : -1;
        case Extension::mirror: break;
    }
    const int period = (i % (2 * size) + 2 * size) % (2 * size);
    return period < size ? period : 2 * size - 1 - period;
}

/// B-spline weights of the four texels around a point at t between the middle two.
void cubic_weights(float t, float w[4]) {
    const float s = 1 - t;
    w[0] = s * s * s * (1.0f / 6);
    w[1] = (0.5f * t - 1) * t * t + 2.0f / 3;
    w[2] = (0.5f * s - 1) * s * s + 2.0f / 3;
    w[3] = t * t * t * (1.0f / 6);
}

template <Extension E, int taps>
void place_axis(AxisTaps& axis, int size, int n, const float* u) {
    const float extent = static_cast<float>(size);
    const bool small = size < 4;
    for (int i = 0; i < n; ++i) {
        const float x = scaled<E>(u[i], extent) - (taps == 1 ? 0.0f : 0.5f);
        const int whole = floor_int(x);
        const float t = x - static_cast<float>(whole);
        const int first = whole - (taps == 4 ? 1 : 0);
        for (int k = 0; k < taps; ++k) axis.texel[k][i] = wrapped<E>(first + k, size);
        if (small)
            for (int k = 0; k < taps; ++k) axis.texel[k][i] = wrapped_small(E, first + k, size);
        if constexpr (taps == 2) {
            axis.weight[0][i] = 1 - t;
            axis.weight[1][i] = t;
        } else if constexpr (taps == 4) {
            float w[4];
            cubic_weights(t, w);
            for (int k = 0; k < 4; ++k) axis.weight[k][i] = w[k];
        }
    }
}

template <int taps>
void place_taps(AxisTaps& axis, Extension extension, int size, int n, const float* u) {
    switch (extension) {
        case Extension::repeat: return place_axis<Extension::repeat, taps>(axis, size, n, u);
        case Extension::extend: return place_axis<Extension::extend, taps>(axis, size, n, u);
        case Extension::clip: return place_axis<Extension::clip, taps>(axis, size, n, u);
        case Extension::mirror: return place_axis<Extension::mirror, taps>(axis, size, n, u);
    }
}

}  // namespace

void place(Footprint& footprint, Interpolation interpolation, Extension extension, int width, int height, int n,
           const float* u, const float* v) {
    switch (interpolation) {
        case Interpolation::closest:
            footprint.taps = 1;
            place_taps<1>(footprint.x, extension, width, n, u);
            return place_taps<1>(footprint.y, extension, height, n, v);
        case Interpolation::linear:
            footprint.taps = 2;
            place_taps<2>(footprint.x, extension, width, n, u);
            return place_taps<2>(footprint.y, extension, height, n, v);
        case Interpolation::cubic:
            footprint.taps = 4;
            place_taps<4>(footprint.x, extension, width, n, u);
            return place_taps<4>(footprint.y, extension, height, n, v);
    }
}

}  // namespace cardioid::image
