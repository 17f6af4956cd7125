// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter/tile.h"

#include <algorithm>
#include <cmath>

namespace cardioid::filter {

namespace {

constexpr int k_padding = 16;

/// Of the mean of n samples with these sums. One sample says nothing of its variance: it may be all wrong.
float variance_of_mean(float sum, float squares, float n) {
    const float mean = sum / n;
    if (n < 1.5f) return mean * mean;
    return std::max(0.0f, squares / n - mean * mean) / (n - 1.0f);
}

/// ΣR² of a cluster's samples in one channel: its samples are taken to be of one colour, the cluster's.
float channel_squares(const film::Cluster& c, int channel) {
    const float y = film::luminance(c.radiance);
    if (y <= 0) return 0;
    const float share = c.radiance[channel] / y;
    return share * share * c.radiance_squared;
}

}  // namespace

Tile::Tile(const film::Film& film, const Rejection& rejection, const film::Region& region, int around,
           const Picture* filtered)
    : area(region), reach(around), stride(region.width + 2 * around + k_padding) {
    std::vector<float**> planes{&taken, &normal_variance, &depth, &depth_variance, &gradient[0], &gradient[1]};
    for (int c = 0; c < 3; ++c) {
        planes.push_back(&detail[c]);
        planes.push_back(&normal[c]);
        for (auto& layer : radiance) planes.push_back(&layer[c]);
        for (Signal& s : signal) planes.insert(planes.end(), {&s.mean[c], &s.variance[c], &s.weight[c]});
    }
    const std::size_t size = static_cast<std::size_t>(stride) * static_cast<std::size_t>(area.height + 2 * reach + 1);
    memory_.assign(planes.size() * size, 0.0f);
    for (std::size_t i = 0; i < planes.size(); ++i) *planes[i] = memory_.data() + i * size;

    const film::Region frame = film.region();
    for (int y = -reach; y < area.height + reach; ++y) {
        for (int x = -reach; x < area.width + reach; ++x) {
            const int px = area.x + x, py = area.y + y;
            if (px < 0 || py < 0 || px >= frame.width || py >= frame.height) continue;
            if (film.samples(px, py) == 0) continue;
            const int i = at(x, y);
            const film::PixelFeatures features = film.features(px, py);
            taken[i] = static_cast<float>(film.samples(px, py));
            load_features(features, i);
            if (!filtered) {
                load_noisy_detail(features, i);
                for (int l = 0; l < film::k_layers; ++l)
                    load_layer(film.clusters().view(px, py, l), rejection.withheld(px, py, l), l, i);
                continue;
            }
            load_filtered(*filtered, static_cast<std::size_t>(py) * frame.width + static_cast<std::size_t>(px),
                          at(x, y));
        }
    }
    find_gradients();
}

void Tile::load_features(const film::PixelFeatures& f, int i) {
    float length = 0;
    for (int c = 0; c < 3; ++c) {
        detail[c][i] = f.detail[c];
        normal[c][i] = f.normal[c];
        length += f.normal[c] * f.normal[c];
    }
    normal_variance[i] = length > 0 ? std::max(0.0f, 1.0f - length) : 0.0f;
    depth[i] = f.depth;
    depth_variance[i] = f.depth_variance;
}

void Tile::load_noisy_detail(const film::PixelFeatures& f, int i) {
    Signal& d = signal[k_detail_signal];
    has_noisy_detail |= f.detail_variance > 0;
    const float brightness = film::luminance(f.mirrored_detail);
    for (int c = 0; c < 3; ++c) {
        const float share = brightness > 0 ? f.mirrored_detail[c] / brightness : 0.0f;
        d.mean[c][i] = f.mirrored_detail[c];
        d.variance[c][i] = f.detail_variance * share * share;
        d.weight[c][i] = taken[i];
    }
}

void Tile::load_filtered(const Picture& filtered, std::size_t from, int i) {
    for (int c = 0; c < 3; ++c) detail[c][i] = filtered.detail[c][from];
    for (int l = 0; l < film::k_layers; ++l) {
        const auto &light = filtered.layer[l], &variance = filtered.variance[l];
        set_layer(l, i, {light[0][from], light[1][from], light[2][from]},
                  {variance[0][from], variance[1][from], variance[2][from]});
    }
}

void Tile::load_layer(std::span<const film::Cluster> clusters, unsigned withheld, int layer, int i) {
    float sum[3] = {}, squares[3] = {}, mean[3], variance[3];
    for (std::size_t k = 0; k < clusters.size(); ++k) {
        if ((withheld >> k & 1) != 0) continue;
        for (int c = 0; c < 3; ++c) {
            sum[c] += clusters[k].radiance[c];
            squares[c] += channel_squares(clusters[k], c);
        }
    }
    for (int c = 0; c < 3; ++c) {
        mean[c] = sum[c] / taken[i];
        variance[c] = variance_of_mean(sum[c], squares[c], taken[i]);
    }
    set_layer(layer, i, mean, variance);
}

void Tile::set_layer(int layer, int i, const float (&mean)[3], const float (&variance)[3]) {
    Signal& s = signal[layer];
    for (int c = 0; c < 3; ++c) {
        radiance[layer][c][i] = mean[c];
        const float d = detail[c][i];
        const bool bright = d > k_darkest_detail;
        s.mean[c][i] = bright ? mean[c] / d : 0.0f;
        s.variance[c][i] = bright ? variance[c] / (d * d) : 0.0f;
        s.weight[c][i] = bright ? taken[i] : 0.0f;
    }
}

void Tile::find_gradients() {
    // The smaller of the two one-sided differences: an edge has the slope of its surface on one side.
    const auto slope = [&](int i, int step) {
        float least = -1;
        for (const int other : {i - step, i + step}) {
            if (taken[other] == 0) continue;
            const float difference = std::abs(depth[other] - depth[i]);
            if (least < 0 || difference < least) least = difference;
        }
        return std::max(least, 0.0f);
    };
    for (int y = 1 - reach; y < area.height + reach - 1; ++y) {
        for (int x = 1 - reach; x < area.width + reach - 1; ++x) {
            const int i = at(x, y);
            if (taken[i] == 0) continue;
            gradient[0][i] = slope(i, 1);
            gradient[1][i] = slope(i, stride);
        }
    }
}

}  // namespace cardioid::filter
