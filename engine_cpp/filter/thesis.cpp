// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter/thesis.h"

#include <algorithm>
#include <cmath>

namespace cardioid::filter {

void GroupList::add(float min, float max) {
    // The groups that the new one reaches, or that reach it, become one with it: [first, last).
    auto first = groups_.begin();
    while (first != groups_.end() && first->max * stretch_ < min) ++first;
    auto last = first;
    while (last != groups_.end() && last->min <= max * stretch_) {
        min = std::min(min, last->min);
        max = std::max(max, last->max);
        ++last;
    }
    if (first == last) {
        groups_.insert(first, {min, max});
        return;
    }
    *first = {min, max};
    groups_.erase(first + 1, last);
}

std::size_t GroupList::find(float min) const {
    std::size_t g = 0;
    while (g + 1 < groups_.size() && groups_[g].max < min) ++g;
    return g;
}

float poisson_weight(float k, float expected) {
    if (k <= 0) return std::exp(-expected);
    if (expected <= 0) return 0;
    return std::exp(k * std::log(expected / k) - (expected - k));
}

namespace {

/// What a kernel group knows of one pixel, and the sums over the kernel.
struct GroupSums {
    float here = 0, count = 0;  ///< samples of p and of q
    float radiance[3] = {};     ///< ΣR of q
    double numerator[3] = {}, denominator[3] = {};
};

class PixelFilter {
public:
    PixelFilter(const KernelRequest& r, const film::Film& film, const Rejection& rejection, float mu,
                const float* weights)
        : r_(r), film_(film), rejection_(rejection), weights_(weights), groups_(mu) {}

    void filter(int x, int y, int layer) {
        find_groups(x, y, layer);
        sums_.assign(groups_.groups().size(), {});
        each_cluster(x, y, layer,
                     [&](const film::Cluster& c) { sums_[groups_.find(c.min)].here += static_cast<float>(c.samples); });
        int plane = 0;
        for (int dy = -r_.radius; dy <= r_.radius; ++dy) {
            for (int dx = -r_.radius; dx <= r_.radius; ++dx, ++plane) add(x, y, dx, dy, layer, plane);
        }
        write(x, y, layer);
    }

private:
    template <class Body>
    void each_cluster(int x, int y, int layer, Body&& body) const {
        const auto clusters = film_.clusters().view(r_.tile->area.x + x, r_.tile->area.y + y, layer);
        const unsigned withheld = rejection_.withheld(r_.tile->area.x + x, r_.tile->area.y + y, layer);
        for (std::size_t i = 0; i < clusters.size(); ++i) {
            if ((withheld >> i & 1) == 0) body(clusters[i]);
        }
    }

    void find_groups(int x, int y, int layer) {
        groups_.clear();
        for (int dy = -r_.radius; dy <= r_.radius; ++dy) {
            for (int dx = -r_.radius; dx <= r_.radius; ++dx) {
                if (r_.tile->taken[r_.tile->at(x + dx, y + dy)] == 0) continue;
                each_cluster(x + dx, y + dy, layer, [&](const film::Cluster& c) { groups_.add(c.min, c.max); });
            }
        }
    }

    void add(int x, int y, int dx, int dy, int layer, int plane) {
        const Tile& t = *r_.tile;
        const float weight = weights_[(plane * t.area.height + y) * t.area.width + x];
        const int p = t.at(x, y), q = t.at(x + dx, y + dy);
        if (weight <= 0) return;
        for (GroupSums& g : sums_) {
            g.count = 0;
            std::fill_n(g.radiance, 3, 0.0f);
        }
        each_cluster(x + dx, y + dy, layer, [&](const film::Cluster& c) {
            GroupSums& g = sums_[groups_.find(c.min)];
            g.count += static_cast<float>(c.samples);
            for (int k = 0; k < 3; ++k) g.radiance[k] += c.radiance[k];
        });
        const float per_sample = t.taken[p] / t.taken[q];
        for (GroupSums& g : sums_) {
            const float w = weight * poisson_weight(g.here, g.count * per_sample);
            for (int k = 0; k < 3; ++k) {
                const float ratio = p == q ? 1.0f : t.detail[k][p] / t.detail[k][q];
                if (p != q && t.detail[k][q] <= k_darkest_detail) continue;
                g.numerator[k] += static_cast<double>(w * g.radiance[k] * ratio);
                g.denominator[k] += static_cast<double>(w * t.taken[q]);
            }
        }
    }

    void write(int x, int y, int layer) const {
        const Tile& t = *r_.tile;
        const int p = t.at(x, y);
        for (int k = 0; k < 3; ++k) {
            float* const out = &r_.result[layer][k][y * r_.stride + x];
            *out = t.radiance[layer][k][p];
            if (t.detail[k][p] <= k_darkest_detail) continue;
            double sum = 0;
            for (const GroupSums& g : sums_) {
                if (g.denominator[k] > 0) sum += g.numerator[k] / g.denominator[k];
            }
            *out = static_cast<float>(sum);
        }
    }

    const KernelRequest& r_;
    const film::Film& film_;
    const Rejection& rejection_;
    const float* weights_;
    GroupList groups_;
    std::vector<GroupSums> sums_;
};

}  // namespace

void filter_thesis(const KernelRequest& request, const film::Film& film, const Rejection& rejection, float mu,
                   const float* weights) {
    PixelFilter filter(request, film, rejection, mu, weights);
    const film::Region& area = request.tile->area;
    for (int layer = 0; layer < film::k_layers; ++layer) {
        if (!request.layers[layer]) continue;
        for (int y = 0; y < area.height; ++y) {
            for (int x = 0; x < area.width; ++x) {
                if (request.tile->taken[request.tile->at(x, y)] > 0) filter.filter(x, y, layer);
            }
        }
    }
}

}  // namespace cardioid::filter
