// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter/reject.h"

#include "filter/reject_kernel.h"
#include "filter/reject_rules.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace cardioid::filter {

namespace {
using film::Cluster;

constexpr int k_tile = 4 * film::k_block;

struct Range {
    float low, high;
};

/// The tested cluster's luminances and those that are like them.
Range stretched(const Cluster& c, float sensitivity) { return {c.min * (1 - sensitivity), c.max * (1 + sensitivity)}; }

std::int64_t whole(const Cluster& c) { return static_cast<std::int64_t>(c.samples) * k_evidence; }

/// How many of a cluster's samples lie in a range that it touches. Both its ends are samples; the rest is between them.
std::int64_t part_in(const Cluster& c, const Range& range) {
    const bool low = c.min >= range.low, high = c.max <= range.high;
    if (low && high) return whole(c);
    const float share = (std::min(c.max, range.high) - std::max(c.min, range.low)) / (c.max - c.min);
    const float between = share * static_cast<float>(k_evidence);
    return (low || high ? k_evidence : 0) +
           (static_cast<std::int64_t>(c.samples) - 2) * static_cast<std::int64_t>(between);
}

class Rejector {
public:
    Rejector(const RejectionRules& rules, const film::Film& film, const scene::FilterSettings& settings)
        : rules_(rules),
          clusters_(film.clusters()),
          width_(film.clusters().width()),
          height_(film.clusters().height()),
          columns_((width_ + k_tile - 1) / k_tile),
          sensitivity_(settings.luminance_sensitivity),
          kernel_(settings, width_, height_),
          film_(film),
          pixels_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)),
          bits_(pixels_.size() * film::k_layers),
          stats_(static_cast<std::size_t>(tiles())) {}

    int tiles() const { return columns_ * ((height_ + k_tile - 1) / k_tile); }
    /// First for all tiles: what the others look up.
    void survey(int tile) {
        for_pixels(tile, [this](int x, int y, RejectionStats& stats) { survey_pixel(x, y, stats); });
    }
    void reject(int tile) {
        for_pixels(tile, [this](int x, int y, RejectionStats& stats) { reject_pixel(x, y, stats); });
    }
    std::vector<std::uint8_t> take_bits() { return std::move(bits_); }
    RejectionStats stats() const;

private:
    /// What decides about most neighbours without a look at their clusters.
    struct Pixel {
        float brightest[film::k_layers] = {};  ///< 0: no clusters
        std::uint32_t samples = 0;
    };

    template <typename Body>
    void for_pixels(int tile, const Body& body) {
        RejectionStats stats = stats_[static_cast<std::size_t>(tile)];
        const int x0 = tile % columns_ * k_tile, y0 = tile / columns_ * k_tile;
        for (int y = y0; y < std::min(y0 + k_tile, height_); ++y) {
            for (int x = x0; x < std::min(x0 + k_tile, width_); ++x) body(x, y, stats);
        }
        stats_[static_cast<std::size_t>(tile)] = stats;
    }
    std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x); }
    void survey_pixel(int x, int y, RejectionStats& stats);
    void reject_pixel(int x, int y, RejectionStats& stats);
    /// Adds samples like c's to `found` until they are enough.
    bool supported(int x, int y, int layer, const Cluster& c, std::int64_t needed, std::int64_t& found) const;
    std::int64_t evidence(std::span<const Cluster> list, const Range& like, const Cluster* without) const;

    RejectionRules rules_;
    const film::ClusterStore& clusters_;
    int width_, height_, columns_;
    float sensitivity_;
    RejectionKernel kernel_;
    const film::Film& film_;
    std::vector<Pixel> pixels_;
    std::vector<std::uint8_t> bits_;
    std::vector<RejectionStats> stats_;  ///< of the tiles
};

void Rejector::survey_pixel(int x, int y, RejectionStats& stats) {
    Pixel& pixel = pixels_[index(x, y)];
    pixel.samples = film_.samples(x, y);
    for (int layer = 0; layer < film::k_layers; ++layer) {
        const std::span<const Cluster> list = clusters_.view(x, y, layer);
        if (list.empty()) continue;
        pixel.brightest[layer] = list.back().max;
        stats.clusters += static_cast<std::int64_t>(list.size());
        for (const Cluster& c : list) stats.singles += c.samples == 1;
    }
}

std::int64_t Rejector::evidence(std::span<const Cluster> list, const Range& like, const Cluster* without) const {
    std::int64_t sum = 0;
    for (const Cluster& c : list) {
        if (c.max < like.low || c.min > like.high || &c == without) continue;
        sum += rules_.whole ? whole(c) : part_in(c, like);
    }
    return sum;
}

bool Rejector::supported(int x, int y, int layer, const Cluster& c, std::int64_t needed, std::int64_t& found) const {
    const Range like = stretched(c, sensitivity_);
    // As printed, the pixel's own brighter clusters are in `found` already.
    if (!rules_.accumulate) found += evidence(clusters_.view(x, y, layer), like, &c);
    if (found >= needed) return true;
    const std::uint32_t own_samples = pixels_[index(x, y)].samples;
    const bool inside = kernel_.inside(x, y);
    for (const RejectionKernel::Step& step : kernel_.steps()) {
        const int qx = x + step.dx, qy = y + step.dy;
        if (!inside && (qx < 0 || qy < 0 || qx >= width_ || qy >= height_)) continue;
        const Pixel& q = pixels_[index(qx, qy)];
        if (q.brightest[layer] < like.low) continue;
        std::int64_t more = evidence(clusters_.view(qx, qy, layer), like, nullptr);
        // A neighbour with more samples would have fewer like ones had it as many as this pixel. One with fewer has what it has.
        if (q.samples > own_samples) {
            more = static_cast<std::int64_t>(static_cast<double>(more) * own_samples / static_cast<double>(q.samples));
        }
        found += more;
        if (found >= needed) return true;
    }
    return false;
}

void Rejector::reject_pixel(int x, int y, RejectionStats& stats) {
    const std::int64_t needed = kernel_.needed(x, y);
    float accepted = 0;
    for (int layer = 0; layer < film::k_layers; ++layer) {
        const std::span<const Cluster> list = clusters_.view(x, y, layer);
        std::int64_t found = 0;
        int i = static_cast<int>(list.size()) - 1;
        for (; i >= 0; --i) {
            const Cluster& c = list[static_cast<std::size_t>(i)];
            if (c.min <= accepted) break;
            found = (rules_.accumulate ? found : 0) + whole(c);
            if (found >= needed || supported(x, y, layer, c, needed, found)) break;
            stats.rejected_samples += c.samples;
        }
        // Lists ascend: all below an accepted cluster are accepted.
        if (i >= 0) accepted = std::max(accepted, list[static_cast<std::size_t>(i)].max);
        const int kept = i + 1, count = static_cast<int>(list.size());
        stats.rejected += count - kept;
        bits_[index(x, y) * film::k_layers + static_cast<std::size_t>(layer)] =
            static_cast<std::uint8_t>((1u << count) - (1u << kept));
    }
}

RejectionStats Rejector::stats() const {
    RejectionStats sum;
    for (const RejectionStats& s : stats_) {
        sum.clusters += s.clusters;
        sum.singles += s.singles;
        sum.rejected += s.rejected;
        sum.rejected_samples += s.rejected_samples;
    }
    return sum;
}

}  // namespace

Rejection reject_by(const RejectionRules& rules, const film::Film& film, const scene::FilterSettings& settings,
                    const ForEach& for_each, RejectionStats* stats) {
    const film::Region region = film.region();
    Rejection result{region.width, region.height, {}};
    if (!film.has_clusters() || !(settings.firefly_density > 0)) return result;
    Rejector rejector(rules, film, settings);
    if (!for_each(rejector.tiles(), [&](int tile) { rejector.survey(tile); })) return result;
    if (!for_each(rejector.tiles(), [&](int tile) { rejector.reject(tile); })) return result;
    result.bits = rejector.take_bits();
    if (stats) *stats = rejector.stats();
    return result;
}

Rejection reject(const film::Film& film, const scene::FilterSettings& settings, const ForEach& for_each,
                 RejectionStats* stats) {
    return reject_by(rejection_rules(settings.filter_method), film, settings, for_each, stats);
}

}  // namespace cardioid::filter
