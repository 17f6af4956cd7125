// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/tile_cache.h"

#include <malloc.h>
#include <new>

namespace cardioid::image {
namespace {

constexpr std::align_val_t k_alignment{64};

/// Tiles that another thread allocated are free in that thread's arena, where this one cannot use them: without this a cache of
/// 1 GB was seen to hold 1.3.
void return_memory() {
#ifdef __GLIBC__
    ::malloc_trim(0);
#endif
}

}  // namespace

void TileDelete::operator()(std::byte* tile) const { ::operator delete[](tile, k_alignment); }

TileMemory new_tile(const Texture& texture) {
    return TileMemory(static_cast<std::byte*>(::operator new[](texture.tile_bytes(), k_alignment)));
}

TileCache::~TileCache() {
    for (Texture* texture : textures_)
        for (int i = 0; i < texture->tile_count(); ++i) TileDelete()(const_cast<std::byte*>(texture->tiles[i].load()));
}

void TileCache::reserve(std::int64_t bytes) {
    if (bytes_.fetch_add(bytes) + bytes <= budget_) return;
    // More than is needed at once, because stopping all readers costs the same for one tile as for a thousand.
    lock_.write([&] { evict(budget_ - budget_ / 8); });
    return_memory();
}

bool TileCache::publish(Texture& texture, int tile, TileMemory memory) {
    const std::byte* expected = nullptr;
    texture.used[tile].store(true, std::memory_order_relaxed);
    if (!texture.tiles[tile].compare_exchange_strong(expected, memory.get(), std::memory_order_release)) return false;
    memory.release();
    return true;
}

void TileCache::evict(std::int64_t target) {
    // The first round clears the marks of what was used since the last time, the second can take everything.
    for (std::size_t step = 0; step < 2 * textures_.size() && bytes_ > target; ++step) {
        if (!evict_from(*textures_[hand_], target)) return;
        hand_ = (hand_ + 1) % textures_.size();
    }
}

/// False once the target is met.
bool TileCache::evict_from(Texture& texture, std::int64_t target) {
    if (!texture.evictable) return true;
    for (int i = 0; i < texture.tile_count(); ++i) {
        const std::byte* tile = texture.tiles[i].load(std::memory_order_acquire);
        if (!tile || texture.used[i].exchange(false, std::memory_order_relaxed)) continue;
        texture.tiles[i].store(nullptr, std::memory_order_relaxed);
        TileDelete()(const_cast<std::byte*>(tile));
        bytes_ -= static_cast<std::int64_t>(texture.tile_bytes());
        if (bytes_ <= target) return false;
    }
    return true;
}

}  // namespace cardioid::image
