// SPDX-License-Identifier: GPL-3.0-or-later
#include "film/cluster_store.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardioid::film {
namespace {

/// Of a list in its block.
std::size_t list_index(int x, int y, int layer) {
    return static_cast<std::size_t>((y % k_block * k_block + x % k_block) * k_layers + layer);
}

/// Luminances beyond this count as this in ΣY(R)², which would overflow; sums of 2^24 such squares stay finite.
constexpr float k_largest_squared = 1e15f;

void join(Cluster& c, const LayerSample& s, float y) {
    for (int k = 0; k < 3; ++k) {
        c.radiance[k] += s.radiance[k];
        c.incident[k] += s.incident[k];
    }
    const float bounded = std::min(luminance(s.radiance), k_largest_squared);
    c.radiance_squared += bounded * bounded;
    c.min = std::min(c.min, y);
    c.max = std::max(c.max, y);
    ++c.samples;
}

/// `b` follows `a` in the list.
void merge(Cluster& a, const Cluster& b) {
    for (int k = 0; k < 3; ++k) {
        a.radiance[k] += b.radiance[k];
        a.incident[k] += b.incident[k];
    }
    a.radiance_squared += b.radiance_squared;
    a.max = b.max;
    a.samples += b.samples;
}

float gradient(const Cluster& c) { return c.samples > 1 ? (c.max - c.min) / static_cast<float>(c.samples - 1) : 0.0f; }

/// The i whose neighbour i + 1 is most like it (thesis 6.7 as spec 4 reads it; the common factor 1/max_n changes no order).
int most_alike(const Cluster* list, int count) {
    int best = 0;
    float least = std::numeric_limits<float>::infinity();
    float here = gradient(list[0]);
    for (int i = 0; i + 1 < count; ++i) {
        const float next = gradient(list[i + 1]);
        const float m = k_gradient_weight * std::abs(here - next) + (list[i + 1].min - list[i].max);
        if (m < least) least = m, best = i;
        here = next;
    }
    return best;
}

}  // namespace

ClusterStore::ClusterStore(int width, int height)
    : width_(width),
      height_(height),
      columns_((width + k_block - 1) / k_block),
      blocks_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>((height + k_block - 1) / k_block)) {}

std::span<const Cluster> ClusterStore::view(int x, int y, int layer) const {
    const Block& block = blocks_[static_cast<std::size_t>(y / k_block * columns_ + x / k_block)];
    const std::uint16_t* begin = block.begin + list_index(x, y, layer);
    return {block.clusters.get() + begin[0], static_cast<std::size_t>(begin[1] - begin[0])};
}

void ClusterStore::assign(int x, int y, int layer, std::span<const Cluster> clusters) {
    Block& block = blocks_[static_cast<std::size_t>(y / k_block * columns_ + x / k_block)];
    const std::size_t list = list_index(x, y, layer);
    const std::size_t before = block.begin[list], after = block.begin[list + 1], end = block.begin[k_block_lists];
    auto packed = std::make_unique_for_overwrite<Cluster[]>(end - (after - before) + clusters.size());
    Cluster* to = std::copy_n(block.clusters.get(), before, packed.get());
    to = std::copy(clusters.begin(), clusters.end(), to);
    std::copy(block.clusters.get() + after, block.clusters.get() + end, to);
    block.clusters = std::move(packed);
    for (std::size_t i = list + 1; i <= k_block_lists; ++i)
        block.begin[i] = static_cast<std::uint16_t>(block.begin[i] - (after - before) + clusters.size());
}

std::int64_t ClusterStore::cluster_count() const {
    std::int64_t sum = 0;
    for (const Block& b : blocks_) sum += b.begin[k_block_lists];
    return sum;
}

std::int64_t ClusterStore::single_count() const {
    std::int64_t sum = 0;
    for (const Block& b : blocks_) {
        for (int i = 0; i < b.begin[k_block_lists]; ++i) sum += b.clusters[static_cast<std::size_t>(i)].samples == 1;
    }
    return sum;
}

std::int64_t ClusterStore::memory_bytes() const {
    return cluster_count() * static_cast<std::int64_t>(sizeof(Cluster)) +
           static_cast<std::int64_t>(blocks_.size() * sizeof(Block));
}

bool valid(std::span<const Cluster> list, std::uint32_t samples) {
    if (list.size() > k_max_clusters) return false;
    std::uint64_t taken = 0;
    float above = 0;
    for (const Cluster& c : list) {
        for (int k = 0; k < 3; ++k) {
            if (!std::isfinite(c.radiance[k]) || !std::isfinite(c.incident[k])) return false;
        }
        if (!(c.min > above) || !(c.max >= c.min) || !std::isfinite(c.max)) return false;
        if (!(c.radiance_squared >= 0) || !std::isfinite(c.radiance_squared) || c.samples == 0) return false;
        above = c.max;
        taken += c.samples;
    }
    return taken <= samples;
}

void ClusterEditor::open(ClusterStore& store, int x, int y) {
    const int block = y / k_block * store.columns_ + x / k_block;
    if (store_ == &store && block_ == block) return;
    close();
    store_ = &store;
    block_ = block;
    const ClusterStore::Block& from = store.blocks_[static_cast<std::size_t>(block)];
    for (int list = 0; list < k_block_lists; ++list) {
        const int begin = from.begin[list], count = from.begin[list + 1] - begin;
        std::copy_n(from.clusters.get() + begin, count, clusters_[list / k_layers][list % k_layers]);
        count_[list / k_layers][list % k_layers] = static_cast<std::uint8_t>(count);
    }
}

void ClusterEditor::close() {
    if (store_ == nullptr) return;
    ClusterStore::Block& to = store_->blocks_[static_cast<std::size_t>(block_)];
    int total = 0;
    for (const auto& pixel : count_) {
        for (const int n : pixel) total += n;
    }
    if (total != to.begin[k_block_lists])
        to.clusters = std::make_unique_for_overwrite<Cluster[]>(static_cast<std::size_t>(total));
    std::uint16_t at = 0;
    for (int list = 0; list < k_block_lists; ++list) {
        const std::uint8_t count = count_[list / k_layers][list % k_layers];
        to.begin[list] = at;
        std::copy_n(clusters_[list / k_layers][list % k_layers], count, to.clusters.get() + at);
        at = static_cast<std::uint16_t>(at + count);
    }
    to.begin[k_block_lists] = at;
    store_ = nullptr;
    block_ = -1;
}

bool ClusterEditor::add(int x, int y, int layer, const LayerSample& sample, std::uint32_t taken) {
    const float luminous = luminance(sample.incident);
    if (!(luminous > 0) || !std::isfinite(luminous)) return false;
    const int pixel = y % k_block * k_block + x % k_block;
    Cluster* list = clusters_[pixel][layer];
    std::uint8_t& count = count_[pixel][layer];
    int at = 0;
    while (at < count && list[at].max < luminous) ++at;
    if (at < count && list[at].min <= luminous) {
        join(list[at], sample, luminous);
        return true;
    }
    if (taken >= k_first_batch) {
        const float infinite = std::numeric_limits<float>::infinity();
        const float below = at > 0 ? luminous - list[at - 1].max : infinite;
        const float above = at < count ? list[at].min - luminous : infinite;
        if (std::min(below, above) <= k_join * luminous) {
            join(list[below <= above ? at - 1 : at], sample, luminous);
            return true;
        }
    }
    std::copy_backward(list + at, list + count, list + count + 1);
    list[at] = {.min = luminous, .max = luminous};
    join(list[at], sample, luminous);
    ++count;
    if (count > k_max_clusters) {
        const int i = most_alike(list, count);
        merge(list[i], list[i + 1]);
        std::copy(list + i + 2, list + count, list + i + 1);
        --count;
    }
    return true;
}

}  // namespace cardioid::film
