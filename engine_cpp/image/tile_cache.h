// SPDX-License-Identifier: GPL-3.0-or-later
// Owns the tiles of all textures and keeps their sum under a bound by dropping those that were not used lately.
#pragma once

#include "image/reader_lock.h"
#include "image/texture.h"

#include <cstdint>
#include <vector>

namespace cardioid::image {

/// Uninitialised memory for a tile; freed unless it is published.
struct TileDelete {
    void operator()(std::byte* tile) const;
};
using TileMemory = std::unique_ptr<std::byte[], TileDelete>;
TileMemory new_tile(const Texture& texture);

class TileCache {
public:
    explicit TileCache(std::int64_t budget) : budget_(budget) {}
    ~TileCache();
    TileCache(const TileCache&) = delete;
    TileCache& operator=(const TileCache&) = delete;

    /// Before any lookup; textures stay where they are.
    void add(Texture& texture) { textures_.push_back(&texture); }

    /// Whoever reads tiles holds a ReaderLock::Reading of this.
    ReaderLock& lock() { return lock_; }

    /// Counts `bytes` as taken, dropping tiles if the budget is exceeded. The caller must not be reading.
    void reserve(std::int64_t bytes);
    void release(std::int64_t bytes) { bytes_ -= bytes; }
    /// Makes a loaded tile visible; its bytes were reserved. Returns false if another thread was first.
    bool publish(Texture& texture, int tile, TileMemory memory);

    std::int64_t bytes() const { return bytes_.load(); }
    std::int64_t budget() const { return budget_; }

private:
    void evict(std::int64_t target);
    bool evict_from(Texture& texture, std::int64_t target);

    const std::int64_t budget_;
    std::atomic<std::int64_t> bytes_{0};
    std::vector<Texture*> textures_;
    std::size_t hand_ = 0;  ///< where the last eviction stopped
    ReaderLock lock_;
};

}  // namespace cardioid::image
