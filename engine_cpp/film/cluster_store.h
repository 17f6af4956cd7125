// SPDX-License-Identifier: GPL-3.0-or-later
// Cluster lists of all pixels behind a narrow interface. They are kept packed by blocks of 8 × 8 pixels, exactly as
// long as they are; a block is packed anew after samples were added to it (dense storage would take 1.6 GB at 1080p).
#pragma once

#include "film/cluster.h"

#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace cardioid::film {

/// Clusters are copied by so many at once: arrays that are read from have room for it.
inline constexpr int k_copied = 4;
inline constexpr int k_block = 8;
inline constexpr int k_block_lists = k_block * k_block * k_layers;
/// The luminance of a sample may lie this share of itself from a cluster's bound and still join it (μ of thesis 6.2.1).
inline constexpr float k_join = 0.5f;
/// Weight of the change of gradient when neighbours are merged (φ, thesis 6.7 as spec 4 reads it).
inline constexpr float k_gradient_weight = 0.75f;
/// The first samples of a pixel are clusters of their own.
inline constexpr std::uint32_t k_first_batch = 4;

/// Place of a pixel in its block: in Morton order, as pixels are rendered.
constexpr int pixel_index(int x, int y) {
    constexpr int k_spread[k_block] = {0, 1, 4, 5, 16, 17, 20, 21};
    return k_spread[x % k_block] + 2 * k_spread[y % k_block];
}

class ClusterStore {
public:
    ClusterStore() = default;
    ClusterStore(int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }
    /// Ascending in luminance, disjoint, at most k_max_clusters. x, y in [0, width) × [0, height). Not while an editor
    /// has the pixel's block open.
    std::span<const Cluster> view(int x, int y, int layer) const;
    /// Replaces a pixel's list (tests, files, merging of films). Invariants are the caller's.
    void assign(int x, int y, int layer, std::span<const Cluster> clusters);
    std::int64_t memory_bytes() const;
    std::int64_t cluster_count() const;
    /// Clusters of one sample.
    std::int64_t single_count() const;

private:
    friend class ClusterEditor;
    friend class FilmFile;
    struct Block {
        std::unique_ptr<Cluster[]> clusters;  ///< room for `room` and k_copied - 1 more
        std::uint16_t room = 0;
        std::uint16_t begin[k_block_lists + 1] = {};  ///< of each list; the last one is the end
    };
    /// Room for n, rounded up: blocks that grow by a few clusters stay where they are.
    static int room_for(int n) { return (n + 31) / 32 * 32; }
    static std::unique_ptr<Cluster[]> allocate(int room);
    int width_ = 0, height_ = 0, columns_ = 0;
    std::vector<Block> blocks_;
};

/// Whether a list is one that an editor could have made of at most `samples` samples.
bool valid(std::span<const Cluster> list, std::uint32_t samples);

/// A thread's working memory: a block, and the lists of one of its pixels spread out. Blocks are owned by one thread at
/// a time. Quick where the samples of a pixel follow each other, quickest where pixels come in Morton order.
class ClusterEditor {
public:
    /// Packs the block that was open, if another one.
    void open(ClusterStore& store, int x, int y) {
        const int block = y / k_block * store.columns_ + x / k_block;
        if (store_ == &store && block_ == block) return;
        close();
        store_ = &store;
        block_ = block;
    }
    /// Adds to a pixel of the open block. `taken`: samples that the pixel had before. Returns false for a sample that
    /// belongs to no cluster: luminance of I not above 0. Sums of lists are those of the samples, whatever their order.
    bool add(int x, int y, int layer, const LayerSample& sample, std::uint32_t taken) {
        const float incident = luminance(sample.incident);
        if (!(incident > 0 && incident <= std::numeric_limits<float>::max())) return false;
        const int pixel = pixel_index(x, y);
        if (pixel != pixel_) turn_to(pixel);
        add(lists_[layer], sample.radiance, incident, taken);
        return true;
    }
    /// Packs what is open.
    void close();

private:
    static constexpr int k_pixels = k_block * k_block;
    static constexpr int k_pixel_clusters = k_layers * k_max_clusters;
    struct List {
        int count = 0;
        bool collapsed = false;                    ///< known to have no neighbours within reach of each other
        Cluster clusters[2 * k_max_clusters + 1];  ///< one more than is kept, and room to move k_max_clusters at once
    };
    /// Where the clusters of a pixel are.
    struct Place {
        const Cluster* begin = nullptr;
        std::uint8_t count[k_layers] = {};
        int total() const { return count[0] + count[1] + count[2]; }
    };
    Place place(int pixel) const;
    void turn_to(int pixel);
    void put_back();
    static void add(List& list, const float (&radiance)[3], float incident, std::uint32_t taken);
    static void collapse(List& list);
    static void merge(List& list);

    ClusterStore* store_ = nullptr;
    int block_ = -1, pixel_ = -1;
    List lists_[k_layers];     ///< of the pixel
    Place changed_[k_pixels];  ///< of pixels that got samples, in `packed_`; begin is null for the others
    int packed_size_ = 0;
    Cluster packed_[k_pixels * k_pixel_clusters + k_copied];
};

}  // namespace cardioid::film
