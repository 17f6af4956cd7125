// SPDX-License-Identifier: GPL-3.0-or-later
#include "film/cluster_store.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace cardioid::film {
namespace {

/// Luminances beyond this count as this in ΣY(R)², which would overflow; sums of 2^24 such squares stay finite.
constexpr float k_largest_squared = 1e15f;

void join(Cluster& sums, const float (&radiance)[3], float y) {
    for (int k = 0; k < 3; ++k) sums.radiance[k] += radiance[k];
    sums.incident += y;
    const float bounded = std::min(std::abs(luminance(radiance)), k_largest_squared);
    sums.radiance_squared += bounded * bounded;
    ++sums.samples;
}

void join(Cluster& sums, const Cluster& other) {
    for (int k = 0; k < 3; ++k) sums.radiance[k] += other.radiance[k];
    sums.incident += other.incident;
    sums.radiance_squared += other.radiance_squared;
    sums.samples += other.samples;
}

/// Moves k_max_clusters elements; a size that the compiler knows makes it a few instructions.
template <class T>
void move_list(T* from, T* to) {
    std::memmove(to, from, sizeof(T) * k_max_clusters);
}

}  // namespace

void ClusterEditor::open(ClusterStore& store, int x, int y) {
    const int block = y / k_block * store.columns_ + x / k_block;
    if (store_ == &store && block_ == block) return;
    close();
    store_ = &store;
    block_ = block;
}

void ClusterEditor::unpack(std::size_t index) {
    const ClusterStore::Block& from = store_->blocks_[static_cast<std::size_t>(block_)];
    List& list = lists_[index];
    unpacked_[index] = true;
    std::fill(std::begin(list.high), std::end(list.high), k_infinite);
    std::fill(std::begin(list.low), std::end(list.low), k_infinite);
    list.high[0] = -k_infinite;
    list.count = list.unused = static_cast<std::uint8_t>(from.begin[index + 1] - from.begin[index]);
    for (std::uint8_t i = 0; i < list.count; ++i) {
        const Cluster& c = from.clusters[from.begin[index] + i];
        list.sums[i] = c;
        list.low[i] = c.min;
        list.high[i + 1] = c.max;
        list.place[i] = i;
    }
}

void ClusterEditor::close() {
    if (store_ == nullptr) return;
    ClusterStore::Block& block = store_->blocks_[static_cast<std::size_t>(block_)];
    std::uint16_t begin[k_block_lists + 1] = {};
    for (std::size_t i = 0; i < k_block_lists; ++i) {
        const int count = unpacked_[i] ? lists_[i].count : block.begin[i + 1] - block.begin[i];
        begin[i + 1] = static_cast<std::uint16_t>(begin[i] + count);
    }
    auto packed = std::make_unique_for_overwrite<Cluster[]>(begin[k_block_lists]);
    for (std::size_t i = 0; i < k_block_lists; ++i) {
        Cluster* to = packed.get() + begin[i];
        if (!unpacked_[i]) {
            std::copy(block.clusters.get() + block.begin[i], block.clusters.get() + block.begin[i + 1], to);
            continue;
        }
        const List& list = lists_[i];
        for (int c = 0; c < list.count; ++c) {
            to[c] = list.sums[list.place[c]];
            to[c].min = list.low[c];
            to[c].max = list.high[c + 1];
        }
        unpacked_[i] = false;
    }
    block.clusters = std::move(packed);
    std::copy(std::begin(begin), std::end(begin), block.begin);
    store_ = nullptr;
    block_ = -1;
}

void ClusterEditor::add(std::size_t index, const float (&radiance)[3], float y, std::uint32_t taken) {
    if (!unpacked_[index]) unpack(index);
    List& list = lists_[index];
    int at = 0;
    for (int i = 1; i <= k_max_clusters; ++i) at += list.high[i] < y;
    // Inside a cluster `above` is not above 0.
    const float below = y - list.high[at], above = list.low[at] - y;
    const float reach = taken < k_first_batch ? 0.0f : k_join * y;
    if (std::min(below, above) <= reach) {
        const int i = below <= above ? at - 1 : at;
        list.low[i] = std::min(list.low[i], y);
        list.high[i + 1] = std::max(list.high[i + 1], y);
        join(list.sums[list.place[i]], radiance, y);
        return;
    }
    insert(list, at, y);
    join(list.sums[list.place[at]], radiance, y);
    if (list.count > k_max_clusters) merge(list);
}

void ClusterEditor::insert(List& list, int at, float y) {
    move_list(list.low + at, list.low + at + 1);
    move_list(list.high + at + 1, list.high + at + 2);
    move_list(list.place + at, list.place + at + 1);
    list.low[at] = list.high[at + 1] = y;
    list.place[at] = list.unused;
    list.sums[list.unused] = {};
    list.unused = ++list.count;
}

/// Makes one of the two neighbours that are most alike (thesis 6.7 as spec 4 reads it; its factor 1/max_n changes no order).
void ClusterEditor::merge(List& list) {
    float gradient[k_max_clusters + 1];
    for (int i = 0; i <= k_max_clusters; ++i) {
        const auto steps = static_cast<float>(list.sums[list.place[i]].samples - 1);
        gradient[i] = (list.high[i + 1] - list.low[i]) / std::max(steps, 1.0f);
    }
    int best = 0;
    float least = k_infinite;
    for (int i = 0; i < k_max_clusters; ++i) {
        const float m =
            k_gradient_weight * std::abs(gradient[i] - gradient[i + 1]) + (list.low[i + 1] - list.high[i + 1]);
        if (m < least) least = m, best = i;
    }
    list.unused = list.place[best + 1];
    join(list.sums[list.place[best]], list.sums[list.unused]);
    move_list(list.low + best + 2, list.low + best + 1);
    move_list(list.high + best + 2, list.high + best + 1);
    move_list(list.place + best + 2, list.place + best + 1);
    --list.count;
}

}  // namespace cardioid::film
