// SPDX-License-Identifier: GPL-3.0-or-later
#include "film/cluster_store.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardioid::film {

ClusterStore::ClusterStore(int width, int height)
    : width_(width),
      height_(height),
      columns_((width + k_block - 1) / k_block),
      blocks_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>((height + k_block - 1) / k_block)) {}

std::span<const Cluster> ClusterStore::view(int x, int y, int layer) const {
    const Block& block = blocks_[static_cast<std::size_t>(y / k_block * columns_ + x / k_block)];
    const std::uint16_t* begin = block.begin + static_cast<std::size_t>(pixel_index(x, y) * k_layers + layer);
    return {block.clusters.get() + begin[0], static_cast<std::size_t>(begin[1] - begin[0])};
}

void ClusterStore::assign(int x, int y, int layer, std::span<const Cluster> clusters) {
    Block& block = blocks_[static_cast<std::size_t>(y / k_block * columns_ + x / k_block)];
    const std::size_t list = static_cast<std::size_t>(pixel_index(x, y) * k_layers + layer);
    const std::size_t before = block.begin[list], after = block.begin[list + 1], end = block.begin[k_block_lists];
    const int room = room_for(static_cast<int>(end - (after - before) + clusters.size()));
    auto packed = allocate(room);
    Cluster* to = std::copy_n(block.clusters.get(), before, packed.get());
    to = std::copy(clusters.begin(), clusters.end(), to);
    std::copy(block.clusters.get() + after, block.clusters.get() + end, to);
    block.clusters = std::move(packed);
    block.room = static_cast<std::uint16_t>(room);
    for (std::size_t i = list + 1; i <= k_block_lists; ++i)
        block.begin[i] = static_cast<std::uint16_t>(block.begin[i] - (after - before) + clusters.size());
}

std::unique_ptr<Cluster[]> ClusterStore::allocate(int room) {
    const auto n = static_cast<std::size_t>(room);
    auto clusters = std::make_unique_for_overwrite<Cluster[]>(n + k_copied - 1);
    std::fill_n(clusters.get() + n, k_copied - 1, Cluster{});
    return clusters;
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
    std::int64_t clusters = 0;
    for (const Block& b : blocks_) clusters += b.room + k_copied - 1;
    return clusters * static_cast<std::int64_t>(sizeof(Cluster)) +
           static_cast<std::int64_t>(blocks_.size() * sizeof(Block));
}

bool valid(std::span<const Cluster> list, std::uint32_t samples) {
    if (list.size() > k_max_clusters) return false;
    std::uint64_t taken = 0;
    float above = 0;
    for (const Cluster& c : list) {
        for (const float sum : c.radiance) {
            if (!std::isfinite(sum)) return false;
        }
        if (!(c.min > above) || !(c.max >= c.min) || !std::isfinite(c.max)) return false;
        if (!(c.incident >= 0 && c.radiance_squared >= 0)) return false;
        if (!std::isfinite(c.incident + c.radiance_squared) || c.samples == 0) return false;
        above = c.max;
        taken += c.samples;
    }
    return taken <= samples;
}

}  // namespace cardioid::film
