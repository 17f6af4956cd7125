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

}  // namespace

Tile::Tile(const film::Film& film, const Rejection& rejection, const film::Region& region, int around)
    : area(region), reach(around), stride(region.width + 2 * around + k_padding) {
    std::vector<float**> planes{&taken, &normal_variance, &depth, &depth_variance, &gradient[0], &gradient[1]};
    for (int c = 0; c < 3; ++c) {
        planes.push_back(&detail[c]);
        planes.push_back(&normal[c]);
        for (auto& layer : radiance) planes.push_back(&layer[c]);
        for (Signal& s : signal) planes.push_back(&s.sum[c]);
        for (Signal& s : signal) planes.push_back(&s.weight[c]);
    }
    for (Signal& s : signal) planes.insert(planes.end(), {&s.mean, &s.variance});
    const std::size_t size = static_cast<std::size_t>(stride) * static_cast<std::size_t>(area.height + 2 * reach + 1);
    memory_.assign(planes.size() * size, 0.0f);
    for (std::size_t i = 0; i < planes.size(); ++i) *planes[i] = memory_.data() + i * size;

    const film::Region frame = film.region();
    for (int y = -reach; y < area.height + reach; ++y) {
        for (int x = -reach; x < area.width + reach; ++x) {
            const int px = area.x + x, py = area.y + y;
            if (px < 0 || py < 0 || px >= frame.width || py >= frame.height) continue;
            if (film.samples(px, py) > 0) load_pixel(film, rejection, px, py, at(x, y));
        }
    }
    find_gradients();
}

void Tile::load_pixel(const film::Film& film, const Rejection& rejection, int x, int y, int i) {
    taken[i] = static_cast<float>(film.samples(x, y));
    const film::PixelFeatures f = film.features(x, y);
    float length = 0;
    for (int c = 0; c < 3; ++c) {
        detail[c][i] = f.detail[c];
        normal[c][i] = f.normal[c];
        length += f.normal[c] * f.normal[c];
    }
    normal_variance[i] = length > 0 ? std::max(0.0f, 1.0f - length) : 0.0f;
    depth[i] = f.depth;
    depth_variance[i] = f.depth_variance;
    for (int l = 0; l < film::k_layers; ++l)
        load_layer(film.clusters().view(x, y, l), rejection.withheld(x, y, l), l, i);
    Signal& d = signal[k_detail_signal];
    d.mean[i] = film::luminance(f.detail);
    d.variance[i] = f.detail_variance;
    has_blurred_detail |= f.detail_variance > 0;
    for (int c = 0; c < 3; ++c) {
        d.sum[c][i] = f.detail[c] * taken[i];
        d.weight[c][i] = taken[i];
    }
}

void Tile::load_layer(std::span<const film::Cluster> clusters, unsigned withheld, int layer, int i) {
    float sum[3] = {}, squares = 0;
    for (std::size_t k = 0; k < clusters.size(); ++k) {
        if ((withheld >> k & 1) != 0) continue;
        for (int c = 0; c < 3; ++c) sum[c] += clusters[k].radiance[c];
        squares += clusters[k].radiance_squared;
    }
    Signal& s = signal[layer];
    const float d[3] = {detail[0][i], detail[1][i], detail[2][i]};
    for (int c = 0; c < 3; ++c) {
        radiance[layer][c][i] = sum[c] / taken[i];
        if (d[c] <= k_darkest_detail) continue;
        s.sum[c][i] = sum[c] / d[c];
        s.weight[c][i] = taken[i];
    }
    const float brightness = film::luminance(d);
    if (brightness <= k_darkest_detail) return;
    s.mean[i] = film::luminance(sum) / (taken[i] * brightness);
    s.variance[i] = variance_of_mean(film::luminance(sum), squares, taken[i]) / (brightness * brightness);
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
