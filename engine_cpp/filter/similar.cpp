// SPDX-License-Identifier: GPL-3.0-or-later
// The default filter: light that arrives alike is averaged. Two pixels are alike when the means of a patch around each agree within
// their variance (after Rousselle et al. 2012), so that weights tighten as noise falls and the picture converges; with
// geometry's weights. docs/filter.md has the measurements behind each choice.
#include "filter/geometry.h"

namespace cardioid::CD_ISA_NS {

namespace {

using filter::k_patch;
using filter::KernelRequest;
using filter::Signal;
using filter::Tile;

/// How far means may differ, in standard deviations.
constexpr float k_mean_width = 0.7f;
/// Means that differ by this share of themselves are alike without any noise, too.
constexpr float k_alike_squared = 1e-7f;

/// The tile's scratch: distances with a border of k_patch, sums over rows, and numerators and denominators by signal.
struct Scratch {
    int stride, rows;  // of planes with the border
    float *distance, *row_sums, *geometry;
    float *numerator[filter::k_signals][3], *denominator[filter::k_signals][3];
    explicit Scratch(const KernelRequest& r)
        : stride(r.tile->area.width + 2 * k_patch + 16), rows(r.tile->area.height + 2 * k_patch) {
        float* next = r.scratch;
        const auto take = [&] {
            float* const plane = next;
            next += stride * rows;
            return plane;
        };
        distance = take();
        row_sums = take();
        geometry = take();
        for (int s = 0; s < filter::k_signals; ++s) {
            for (int c = 0; c < 3; ++c) {
                numerator[s][c] = take();
                denominator[s][c] = take();
            }
        }
    }
    int at(int x, int y) const { return (y + k_patch) * stride + x + k_patch; }
};

void clear(float* plane, int n) {
    for (int i = 0; i < n; ++i) plane[i] = 0.0f;
}

/// Squared difference of the means of pixels p and q, less what their noise explains, in units of that noise; 0 outside the film.
Float mean_distance(const Tile& t, const Signal& s, int p, int q) {
    const Float mp = load(s.mean + p), mq = load(s.mean + q), vp = load(s.variance + p), vq = load(s.variance + q);
    const Float d = mp - mq, explained = vp + min(vp, vq);
    const Float scale = (k_mean_width * k_mean_width) * (vp + vq) + k_alike_squared * (mp * mp + mq * mq) + 1e-30f;
    const Mask inside = (load(t.taken + p) > Float(0.0f)) & (load(t.taken + q) > Float(0.0f));
    return select(inside, (d * d - explained) / scale, Float(0.0f));
}

void find_distances(const Tile& t, const Signal& s, Scratch& m, int shift) {
    for (int y = -k_patch; y < t.area.height + k_patch; ++y) {
        for (int x = -k_patch; x < t.area.width + k_patch; x += W) {
            const int p = t.at(x, y);
            store(m.distance + m.at(x, y), mean_distance(t, s, p, p + shift));
        }
        for (int x = 0; x < t.area.width; x += W) {
            const float* d = m.distance + m.at(x, y);
            Float sum = load(d - k_patch);
            for (int i = 1 - k_patch; i <= k_patch; ++i) sum = sum + load(d + i);
            store(m.row_sums + m.at(x, y), sum);
        }
    }
}

void accumulate(const Tile& t, int signal, Scratch& m, int shift, float spatial) {
    const Signal& s = t.signal[signal];
    constexpr float inverse_patch = 1.0f / ((2 * k_patch + 1) * (2 * k_patch + 1));
    for (int y = 0; y < t.area.height; ++y) {
        for (int x = 0; x < t.area.width; x += W) {
            const int i = m.at(x, y), q = t.at(x, y) + shift;
            Float sum = load(m.row_sums + i - k_patch * m.stride);
            for (int k = 1 - k_patch; k <= k_patch; ++k) sum = sum + load(m.row_sums + i + k * m.stride);
            const Float exponent = max(sum * inverse_patch, 0.0f) + load(m.geometry + i);
            const Float w = exp(-min(exponent, 60.0f)) * spatial;
            for (int c = 0; c < 3; ++c) {
                float* const numerator = m.numerator[signal][c] + i;
                float* const denominator = m.denominator[signal][c] + i;
                store(numerator, fma(w, load(s.sum[c] + q), load(numerator)));
                store(denominator, fma(w, load(s.weight[c] + q), load(denominator)));
            }
        }
    }
}

void find_geometry(const Tile& t, Scratch& m, int dx, int dy, int shift) {
    for (int y = 0; y < t.area.height; ++y) {
        for (int x = 0; x < t.area.width; x += W) {
            const int p = t.at(x, y);
            store(m.geometry + m.at(x, y), geometry_distance(t, p, p + shift, dx, dy));
        }
    }
}

/// D̂ of W pixels: as it is, or averaged where the choice between mirror and glass made it noisy.
Float detail_of(const Tile& t, const Scratch& m, int c, int p, int i) {
    const Float raw = load(t.detail[c] + p);
    if (!t.has_blurred_detail) return raw;
    const Float sum = load(m.numerator[filter::k_detail_signal][c] + i);
    const Float weight = load(m.denominator[filter::k_detail_signal][c] + i);
    const Mask noisy = (load(t.signal[filter::k_detail_signal].variance + p) > Float(0.0f)) & (weight > Float(0.0f));
    return select(noisy, sum / max(weight, 1e-30f), raw);
}

void write_layer(const KernelRequest& r, const Scratch& m, int layer) {
    const Tile& t = *r.tile;
    for (int y = 0; y < t.area.height; ++y) {
        for (int x = 0; x < t.area.width; x += W) {
            const int i = m.at(x, y), p = t.at(x, y);
            for (int c = 0; c < 3; ++c) {
                const Float weight = load(m.denominator[layer][c] + i);
                const Float light = load(m.numerator[layer][c] + i) / max(weight, 1e-30f);
                const Mask bright = (load(t.detail[c] + p) > Float(filter::k_darkest_detail)) & (weight > Float(0.0f));
                const Float value = select(bright, light * detail_of(t, m, c, p, i), load(t.radiance[layer][c] + p));
                // Rows of the result have no padding.
                const int left = t.area.width - x;
                for (int k = 0; k < W && k < left; ++k) r.result[layer][c][y * t.area.width + x + k] = value[k];
            }
        }
    }
}

}  // namespace

void filter_similar(const KernelRequest& r) {
    const Tile& t = *r.tile;
    Scratch m(r);
    const bool wanted[] = {r.layers[0], r.layers[1], r.layers[2], t.has_blurred_detail};
    for (int s = 0; s < filter::k_signals; ++s) {
        for (int c = 0; c < 3; ++c) {
            clear(m.numerator[s][c], m.stride * m.rows);
            clear(m.denominator[s][c], m.stride * m.rows);
        }
    }
    for (int dy = -r.radius; dy <= r.radius; ++dy) {
        for (int dx = -r.radius; dx <= r.radius; ++dx) {
            const int shift = dy * t.stride + dx;
            const float spatial = exp(Float(-static_cast<float>(dx * dx + dy * dy) * r.inverse_two_spread_squared))[0];
            find_geometry(t, m, dx, dy, shift);
            for (int s = 0; s < filter::k_signals; ++s) {
                if (!wanted[s]) continue;
                find_distances(t, t.signal[s], m, shift);
                accumulate(t, s, m, shift, spatial);
            }
        }
    }
    for (int l = 0; l < film::k_layers; ++l) {
        if (r.layers[l]) write_layer(r, m, l);
    }
}

}  // namespace cardioid::CD_ISA_NS
