// SPDX-License-Identifier: GPL-3.0-or-later
// Cluster lists of all pixels behind a narrow interface. They are kept packed by blocks of 8 × 8 pixels, exactly as long as they
// are; a block is unpacked to add samples to it and packed again (dense storage would take 1.8 GB at 1080p).
#pragma once

#include "film/cluster.h"

#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace cardioid::film {

inline constexpr int k_block = 8;
inline constexpr int k_block_lists = k_block * k_block * k_layers;
/// The luminance of a sample may lie this share of itself from a cluster's bound and still join it (μ of thesis 6.2.1).
inline constexpr float k_join = 0.5f;
/// Weight of the change of gradient when neighbours are merged (φ, thesis 6.7 as spec 4 reads it).
inline constexpr float k_gradient_weight = 0.75f;
/// The first samples of a pixel are clusters of their own.
inline constexpr std::uint32_t k_first_batch = 4;

/// Of a list in its block.
constexpr std::size_t list_index(int x, int y, int layer) {
    return static_cast<std::size_t>((y % k_block * k_block + x % k_block) * k_layers + layer);
}

class ClusterStore {
public:
    ClusterStore() = default;
    ClusterStore(int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }
    /// Ascending in luminance, disjoint, at most k_max_clusters. x, y in [0, width) × [0, height). Not while an editor has the
    /// pixel's block open.
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
        std::unique_ptr<Cluster[]> clusters;
        std::uint16_t begin[k_block_lists + 1] = {};  ///< of each list; the last one is the end
    };
    int width_ = 0, height_ = 0, columns_ = 0;
    std::vector<Block> blocks_;
};

/// Whether a list is one that an editor could have made of at most `samples` samples.
bool valid(std::span<const Cluster> list, std::uint32_t samples);

/// A thread's working memory: one block, of which the lists that get samples are unpacked. Blocks are owned by one thread at a
/// time.
class ClusterEditor {
public:
    /// Packs the block that was open, if another one.
    void open(ClusterStore& store, int x, int y);
    /// Adds to a pixel of the open block. `taken`: samples that the pixel had before. Returns false for a sample that belongs to
    /// no cluster: luminance of I not above 0. Sums of lists are those of the samples, whatever their order.
    bool add(int x, int y, int layer, const LayerSample& sample, std::uint32_t taken) {
        const float y_of_i = luminance(sample.incident);
        if (!(y_of_i > 0 && y_of_i <= k_largest)) return false;
        add(list_index(x, y, layer), sample.radiance, y_of_i, taken);
        return true;
    }
    /// Packs what is open.
    void close();

private:
    static constexpr float k_infinite = std::numeric_limits<float>::infinity();
    static constexpr float k_largest = std::numeric_limits<float>::max();
    static constexpr int k_room = 2 * (k_max_clusters + 1);  ///< so that moves of k_max_clusters stay inside

    /// Bounds lie apart from sums, which stay where they are when a cluster is put between others. Behind the last cluster bounds
    /// are infinite.
    struct List {
        float high[k_room];  ///< [i + 1] of cluster i; [0] is -infinite
        float low[k_room];
        std::uint8_t place[k_room];  ///< of cluster i in sums
        std::uint8_t count, unused;  ///< `unused`: a free place in sums
        Cluster sums[k_max_clusters + 1];
    };
    void add(std::size_t list, const float (&radiance)[3], float y, std::uint32_t taken);
    void unpack(std::size_t list);
    static void insert(List& list, int at, float y);
    static void merge(List& list);

    ClusterStore* store_ = nullptr;
    int block_ = -1;
    bool unpacked_[k_block_lists] = {};
    List lists_[k_block_lists];
};

}  // namespace cardioid::film
