// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter/reject.h"

#include "filter/reject_kernel.h"
#include "filter/reject_measure.h"
#include "filter/reject_rules.h"
#include "filter/tile.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace cardioid::filter {

namespace {
using film::Cluster;

constexpr int k_tile = 4 * film::k_block;

/// A cluster of the tested pixel.
struct Candidate {
    Measure measure;
    int index = 0;
    std::uint32_t samples = 0;
};

struct Candidates {
    Candidate list[film::k_max_clusters];
    int count = 0;
};

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
        float detail = 0;                      ///< luminance of D̂; 0: too dark, or not looked at
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
    Measure measure(const Cluster& c) const { return rules_.incident ? measure_incident(c) : measure_added(c); }
    /// Brightest first.
    Candidates candidates(int x, int y, int layer) const;
    /// Adds samples like the candidate's to `found` until they are enough.
    bool supported(int x, int y, int layer, const Candidates& own, int tested, std::int64_t needed,
                   std::int64_t& found) const;
    /// Samples of q that are like those in `like`, as they are or × `texture`: as they would be on p's texture.
    std::int64_t evidence(std::span<const Cluster> list, const Range& like, float texture) const;
    std::int64_t counted(const Measure& m, const Range& like) const {
        return rules_.whole ? m.evidence : part_in(m, like);
    }

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
    if (!rules_.incident) {
        const float detail = film::luminance(film_.features(x, y).detail);
        pixel.detail = detail > k_darkest_detail ? detail : 0;
    }
    for (int layer = 0; layer < film::k_layers; ++layer) {
        const std::span<const Cluster> list = clusters_.view(x, y, layer);
        stats.clusters += static_cast<std::int64_t>(list.size());
        for (const Cluster& c : list) {
            stats.singles += c.samples == 1;
            pixel.brightest[layer] = std::max(pixel.brightest[layer], measure(c).range.high);
        }
    }
}

Candidates Rejector::candidates(int x, int y, int layer) const {
    Candidates c;
    for (const Cluster& cluster : clusters_.view(x, y, layer)) {
        const Candidate next{measure(cluster), c.count, cluster.samples};
        int at = c.count++;
        for (; at > 0 && c.list[at - 1].measure.range.high <= next.measure.range.high; --at)
            c.list[at] = c.list[at - 1];
        c.list[at] = next;
    }
    return c;
}

std::int64_t Rejector::evidence(std::span<const Cluster> list, const Range& like, float texture) const {
    std::int64_t sum = 0;
    for (const Cluster& c : list) {
        const Measure m = measure(c);
        if (m.range.touches(like)) {
            sum += counted(m, like);
        } else if (const Measure same{m.range * texture, m.evidence}; same.range.touches(like)) {
            sum += counted(same, like);
        }
    }
    return sum;
}

bool Rejector::supported(int x, int y, int layer, const Candidates& own, int tested, std::int64_t needed,
                         std::int64_t& found) const {
    const Range& range = own.list[tested].measure.range;
    // Only the tested cluster is stretched: a neighbour's ends are samples.
    const Range like{range.low * (1 - sensitivity_), range.high * (1 + sensitivity_)};
    // As printed, the pixel's own brighter clusters are in `found` already.
    for (int i = 0; i < own.count && !rules_.accumulate; ++i) {
        if (i != tested && own.list[i].measure.range.touches(like)) found += counted(own.list[i].measure, like);
    }
    if (found >= needed) return true;
    const Pixel& p = pixels_[index(x, y)];
    const bool inside = kernel_.inside(x, y);
    for (const RejectionKernel::Step& step : kernel_.steps()) {
        const int qx = x + step.dx, qy = y + step.dy;
        if (!inside && (qx < 0 || qy < 0 || qx >= width_ || qy >= height_)) continue;
        const Pixel& q = pixels_[index(qx, qy)];
        const float texture = p.detail > 0 && q.detail > 0 ? p.detail / q.detail : 1.0f;
        if (q.brightest[layer] * std::max(texture, 1.0f) < like.low) continue;
        std::int64_t more = evidence(clusters_.view(qx, qy, layer), like, texture);
        // With as many samples as this pixel a neighbour with more would have fewer like ones; one with fewer has what it has.
        if (q.samples > p.samples) {
            more = static_cast<std::int64_t>(static_cast<double>(more) * p.samples / static_cast<double>(q.samples));
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
        const Candidates own = candidates(x, y, layer);
        std::uint8_t& bits = bits_[index(x, y) * film::k_layers + static_cast<std::size_t>(layer)];
        std::int64_t found = 0;
        for (int i = 0; i < own.count; ++i) {
            const Candidate& c = own.list[i];
            found = (rules_.accumulate ? found : 0) + c.measure.evidence;
            // Once a cluster is accepted, so are all that are no brighter: the rest of the list.
            if (c.measure.range.low <= accepted || found >= needed || supported(x, y, layer, own, i, needed, found)) {
                accepted = std::max(accepted, c.measure.range.high);
                break;
            }
            bits = static_cast<std::uint8_t>(bits | 1u << c.index);
            ++stats.rejected;
            stats.rejected_samples += c.samples;
        }
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
