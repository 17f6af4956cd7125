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
    float* squares[filter::k_signals][3];  // of weights, × variance
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
                for (float** const plane : {&numerator[s][c], &denominator[s][c], &squares[s][c]}) {
                    *plane = take();
                    clear(*plane);
                }
            }
        }
    }
    void clear(float* plane) const {
        for (int i = 0; i < stride * rows; ++i) plane[i] = 0.0f;
    }
    int at(int x, int y) const { return (y + k_patch) * stride + x + k_patch; }
};

/// What noise explains of a squared difference. All of it, vp + vq, would take bright outliers into every neighbour; the smaller one
/// twice would let light leave them that nobody takes (4 % of the energy of sparse light).
Float explained_by_noise(Float vp, Float vq) { return 0.5f * (vp + vq) + min(vp, vq); }

/// Squared difference of the means of pixels p and q, less what their noise explains, in units of that noise: twice the mean of the
/// channels, because lamps of different colours cast shadows of equal luminance. 0 outside the film.
Float mean_distance(const Signal& s, int p, int q) {
    Float sum = 0.0f, channels = 0.0f;
    for (int c = 0; c < 3; ++c) {
        const Float mp = load(s.mean[c] + p), mq = load(s.mean[c] + q);
        const Float vp = load(s.variance[c] + p), vq = load(s.variance[c] + q);
        const Float d = mp - mq;
        const Float scale = (k_mean_width * k_mean_width) * (vp + vq) + k_alike_squared * (mp * mp + mq * mq) + 1e-30f;
        const Mask seen = (load(s.weight[c] + p) > Float(0.0f)) & (load(s.weight[c] + q) > Float(0.0f));
        sum = sum + select(seen, (d * d - explained_by_noise(vp, vq)) / scale, Float(0.0f));
        channels = channels + select(seen, Float(1.0f), Float(0.0f));
    }
    return 2.0f * sum / max(channels, 1.0f);
}

void find_distances(const Tile& t, const Signal& s, Scratch& m, int shift) {
    for (int y = -k_patch; y < t.area.height + k_patch; ++y) {
        for (int x = -k_patch; x < t.area.width + k_patch; x += W) {
            const int p = t.at(x, y);
            store(m.distance + m.at(x, y), mean_distance(s, p, p + shift));
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
                float *const numerator = m.numerator[signal][c] + i, *const denominator = m.denominator[signal][c] + i,
                             *const squares = m.squares[signal][c] + i;
                const Float share = w * load(s.weight[c] + q);
                store(numerator, fma(share, load(s.mean[c] + q), load(numerator)));
                store(denominator, load(denominator) + share);
                store(squares, fma(share * share, load(s.variance[c] + q), load(squares)));
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

/// D̂: what the first surface adds is exact, what the choice between mirror and glass made noisy is averaged.
void write_detail(const KernelRequest& r, const Scratch& m) {
    const Tile& t = *r.tile;
    const Signal& s = t.signal[filter::k_detail_signal];
    for (int y = 0; y < t.area.height; ++y) {
        for (int x = 0; x < t.area.width; x += W) {
            const int i = m.at(x, y), p = t.at(x, y);
            for (int c = 0; c < 3; ++c) {
                Float detail = load(t.detail[c] + p);
                if (t.has_noisy_detail) {
                    const Float weight = load(m.denominator[filter::k_detail_signal][c] + i);
                    const Float change =
                        load(m.numerator[filter::k_detail_signal][c] + i) / max(weight, 1e-30f) - load(s.mean[c] + p);
                    const Mask noisy = (load(s.variance[c] + p) > Float(0.0f)) & (weight > Float(0.0f));
                    detail = select(noisy, max(detail + change, 0.0f), detail);
                }
                store_row(r.detail[c] + y * r.stride + x, detail, t.area.width - x);
            }
        }
    }
}

void write_layer(const KernelRequest& r, const Scratch& m, int layer) {
    const Tile& t = *r.tile;
    for (int y = 0; y < t.area.height; ++y) {
        for (int x = 0; x < t.area.width; x += W) {
            const int i = m.at(x, y), p = t.at(x, y), left = t.area.width - x;
            for (int c = 0; c < 3; ++c) {
                Float detail;
                for (int k = 0; k < W; ++k) detail.v[k] = k < left ? r.detail[c][y * r.stride + x + k] : 0.0f;
                const Float weight = load(m.denominator[layer][c] + i);
                const Float light = load(m.numerator[layer][c] + i) / max(weight, 1e-30f);
                const Mask bright = (load(t.detail[c] + p) > Float(filter::k_darkest_detail)) & (weight > Float(0.0f));
                const Float value = select(bright, light * detail, load(t.radiance[layer][c] + p));
                store_row(r.result[layer][c] + y * r.stride + x, value, left);
                const Float scale = detail / max(weight, 1e-30f);
                store_row(r.variance[layer][c] + y * r.stride + x, load(m.squares[layer][c] + i) * (scale * scale),
                          left);
            }
        }
    }
}

}  // namespace

void filter_similar(const KernelRequest& r) {
    const Tile& t = *r.tile;
    Scratch m(r);
    const bool wanted[] = {r.layers[0], r.layers[1], r.layers[2], t.has_noisy_detail};
    for (int j = -r.radius; j <= r.radius; ++j) {
        for (int i = -r.radius; i <= r.radius; ++i) {
            const int dx = i * r.step, dy = j * r.step, shift = dy * t.stride + dx;
            const float spatial = exp(Float(-static_cast<float>(i * i + j * j) * r.inverse_two_spread_squared))[0];
            find_geometry(t, m, dx, dy, shift);
            for (int s = 0; s < filter::k_signals; ++s) {
                if (!wanted[s]) continue;
                find_distances(t, t.signal[s], m, shift);
                accumulate(t, s, m, shift, spatial);
            }
        }
    }
    write_detail(r, m);
    for (int l = 0; l < film::k_layers; ++l) {
        if (r.layers[l]) write_layer(r, m, l);
    }
}

}  // namespace cardioid::CD_ISA_NS
