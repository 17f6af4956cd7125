// SPDX-License-Identifier: GPL-3.0-or-later
// One image of a store: its source, how its texels are converted, and the loading of its tiles.
#pragma once

#include "image/convert.h"
#include "image/source.h"
#include "image/spill_file.h"
#include "image/tile_cache.h"

#include <memory>
#include <mutex>
#include <string>

namespace cardioid::image {

class Picture {
public:
    /// Magenta.
    Picture();
    /// Throws SceneError if the source's picture cannot be used.
    Picture(const scene::ImageDesc& image, std::string label, std::unique_ptr<Source> source, ColorSpace space);

    const Texture& texture() const { return texture_; }
    Texture& texture() { return texture_; }
    bool has_alpha() const { return has_alpha_; }
    /// `image "Name"`, for messages.
    const std::string& label() const { return label_; }
    /// Can be loaded again, so that tiles may be dropped.
    bool repeatable() const { return source_ && source_->repeatable(); }

    /// The file is made of tiles, so that one can be read without the others.
    bool tiled() const { return source_ && source_->info().tiled; }
    bool in_parts() const { return tiled() && texture_.evictable; }
    /// Decided once the sizes of all images are known: tiles may be dropped. Files of tiles are then read tile by tile;
    /// other images are decoded once, into `spill`.
    void make_evictable(SpillFile& spill);

    /// Makes the tile readable, and others with it when the file is read whole. What cannot be read becomes magenta;
    /// the return value then says why (once). The caller must not be reading tiles.
    std::string load(int tile, TileCache& cache);
    /// Drops what a constructor-time read is no longer needed for.
    void forget_source() { source_.reset(); }
    std::size_t non_finite() const { return non_finite_; }

private:
    void load_whole(TileCache& cache);
    void load_part(int tile, TileCache& cache);
    bool load_spilled(int tile, TileCache& cache);
    std::int64_t spill_place(int tile) const {
        return spill_begin_ + static_cast<std::int64_t>(texture_.tile_bytes()) * tile;
    }
    void load_magenta(int tile, TileCache& cache);
    void publish(int tile, TileMemory memory, TileCache& cache);

    std::string label_;
    std::unique_ptr<Source> source_;
    Conversion conversion_;
    Texture texture_;
    bool has_alpha_ = false, failed_ = false;
    SpillFile* spill_ = nullptr;
    std::int64_t spill_begin_ = 0;
    std::atomic<bool> spilled_{false};  ///< the spill file has every tile
    std::size_t non_finite_ = 0;
    std::mutex loading_;
};

}  // namespace cardioid::image
