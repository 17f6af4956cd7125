// SPDX-License-Identifier: GPL-3.0-or-later
#include "film/cluster_store.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace cardioid::film {
namespace {

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

/// Moves k_max_clusters of them; a size that the compiler knows makes it a few instructions.
void move(const Cluster* from, Cluster* to) { std::memmove(to, from, sizeof(Cluster) * k_max_clusters); }

/// Copies n and up to k_copied - 1 more; returns the end of the n.
Cluster* copy(const Cluster* from, int n, Cluster* to) {
    for (int i = 0; i < n; i += k_copied) std::memcpy(to + i, from + i, sizeof(Cluster) * k_copied);
    return to + n;
}

/// Whether a sample at the bound of the brighter one could join the darker one.
bool within_reach(const Cluster& darker, const Cluster& brighter) {
    return brighter.min - darker.max <= k_join * brighter.min;
}

float gradient(const Cluster& c) { return (c.max - c.min) / std::max(static_cast<float>(c.samples - 1), 1.0f); }

}  // namespace

ClusterEditor::Place ClusterEditor::place(int pixel) const {
    if (changed_[pixel].begin != nullptr) return changed_[pixel];
    const ClusterStore::Block& block = store_->blocks_[static_cast<std::size_t>(block_)];
    const std::uint16_t* begin = block.begin + pixel * k_layers;
    Place p{.begin = block.clusters.get() + begin[0]};
    for (int l = 0; l < k_layers; ++l) p.count[l] = static_cast<std::uint8_t>(begin[l + 1] - begin[l]);
    return p;
}

void ClusterEditor::turn_to(int pixel) {
    put_back();
    // Pixels that are met again and again take up new room each time.
    if (packed_size_ > (k_pixels - 1) * k_pixel_clusters) {
        ClusterStore& store = *store_;
        const int block = block_;
        close();
        store_ = &store;
        block_ = block;
    }
    const Place p = place(pixel);
    const Cluster* from = p.begin;
    for (int l = 0; l < k_layers; ++l) {
        lists_[l].count = p.count[l];
        lists_[l].collapsed = false;
        copy(from, p.count[l], lists_[l].clusters);
        from += p.count[l];
    }
    pixel_ = pixel;
}

void ClusterEditor::put_back() {
    if (pixel_ < 0) return;
    Place& p = changed_[pixel_];
    Cluster* to = packed_ + packed_size_;
    p.begin = to;
    for (int l = 0; l < k_layers; ++l) {
        p.count[l] = static_cast<std::uint8_t>(lists_[l].count);
        to = copy(lists_[l].clusters, lists_[l].count, to);
    }
    packed_size_ = static_cast<int>(to - packed_);
    pixel_ = -1;
}

void ClusterEditor::close() {
    if (store_ == nullptr) return;
    put_back();
    ClusterStore::Block& block = store_->blocks_[static_cast<std::size_t>(block_)];
    int total = 0;
    bool all_changed = true;
    for (int pixel = 0; pixel < k_pixels; ++pixel) {
        const int count = place(pixel).total();
        total += count;
        all_changed = all_changed && (count == 0 || changed_[pixel].begin != nullptr);
    }
    const int room = ClusterStore::room_for(total);
    // What is not changed would be written over before it is read.
    const bool stays = all_changed && room == block.room;
    auto packed = stays ? std::move(block.clusters) : ClusterStore::allocate(room);
    std::uint16_t begin[k_block_lists + 1] = {};
    Cluster* to = packed.get();
    for (int pixel = 0; pixel < k_pixels; ++pixel) {
        const Place p = place(pixel);
        to = copy(p.begin, p.total(), to);
        std::uint16_t* at = begin + pixel * k_layers;
        for (int l = 0; l < k_layers; ++l) at[l + 1] = static_cast<std::uint16_t>(at[l] + p.count[l]);
        changed_[pixel].begin = nullptr;
    }
    block.clusters = std::move(packed);
    block.room = static_cast<std::uint16_t>(room);
    std::copy(std::begin(begin), std::end(begin), block.begin);
    store_ = nullptr;
    block_ = -1;
    packed_size_ = 0;
}

void ClusterEditor::add(List& list, const float (&radiance)[3], float incident, std::uint32_t taken) {
    Cluster* const clusters = list.clusters;
    int at = 0;
    for (int i = 0; i < k_max_clusters; ++i)
        at += static_cast<int>(clusters[i].max < incident) & static_cast<int>(i < list.count);
    const float infinite = std::numeric_limits<float>::infinity();
    // Inside a cluster `above` is not above 0.
    const float below = at > 0 ? incident - clusters[at - 1].max : infinite;
    const float above = at < list.count ? clusters[at].min - incident : infinite;
    const float reach = taken < k_first_batch ? 0.0f : k_join * incident;
    const bool joins = std::min(below, above) <= reach;
    const int i = joins && below <= above ? at - 1 : at;
    if (!joins) {
        move(clusters + at, clusters + at + 1);
        clusters[at] = {.min = incident, .max = incident};
        ++list.count;
    }
    Cluster& c = clusters[i];
    c.min = std::min(c.min, incident);
    c.max = std::max(c.max, incident);
    join(c, radiance, incident);
    if (taken >= k_first_batch) {
        // Where nothing was within reach before, only this cluster and its neighbours can be.
        const bool apart = list.collapsed && !(i > 0 && within_reach(clusters[i - 1], c)) &&
                           !(i + 1 < list.count && within_reach(c, clusters[i + 1]));
        if (!apart) collapse(list);
        list.collapsed = true;
    }
    if (list.count > k_max_clusters) merge(list);
}

/// Neighbours that a sample could not tell apart are one: what the first batch kept apart where nothing was known yet.
void ClusterEditor::collapse(List& list) {
    Cluster* const clusters = list.clusters;
    int kept = 0;
    for (int i = 1; i < list.count; ++i) {
        if (within_reach(clusters[kept], clusters[i])) {
            clusters[kept].max = clusters[i].max;
            join(clusters[kept], clusters[i]);
        } else if (++kept != i) {
            clusters[kept] = clusters[i];
        }
    }
    list.count = std::min(list.count, kept + 1);
}

/// Makes one of the two neighbours that are most alike (thesis 6.7 as spec 4 reads it; the factor 1/max_n changes no
/// order).
void ClusterEditor::merge(List& list) {
    Cluster* const clusters = list.clusters;
    int best = 0;
    float least = std::numeric_limits<float>::infinity(), here = gradient(clusters[0]);
    for (int i = 0; i < k_max_clusters; ++i) {
        const float next = gradient(clusters[i + 1]);
        const float m = k_gradient_weight * std::abs(here - next) + (clusters[i + 1].min - clusters[i].max);
        if (m < least) least = m, best = i;
        here = next;
    }
    Cluster& a = clusters[best];
    a.max = clusters[best + 1].max;
    join(a, clusters[best + 1]);
    move(clusters + best + 2, clusters + best + 1);
    --list.count;
}

}  // namespace cardioid::film
