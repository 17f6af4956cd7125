// SPDX-License-Identifier: GPL-3.0-or-later
// One image of a store: its source, how its texels are converted, and the loading of its tiles.
#pragma once

#include "image/convert.h"
#include "image/source.h"
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
    Picture(const scene::ImageDesc& image, std::unique_ptr<Source> source, ColorSpace space);

    const Texture& texture() const { return texture_; }
    Texture& texture() { return texture_; }
    bool has_alpha() const { return has_alpha_; }
    const std::string& name() const { return name_; }
    /// Can be loaded again, so that tiles may be dropped.
    bool repeatable() const { return source_ && source_->repeatable(); }

    /// Decided once the sizes of all images are known: read at once, or tile by tile.
    void read_by_parts(bool parts) { by_parts_ = parts; }
    bool can_read_parts() const { return source_ && can_read_parts_; }
    bool in_parts() const { return by_parts_; }
    /// The file is made of tiles.
    bool tiled() const { return conversion_.source.tiled; }

    /// Makes the tile readable, and others with it when the file is read whole. What cannot be read becomes magenta; the
    /// return value then says why (once). The caller must not be reading tiles.
    std::string load(int tile, TileCache& cache);
    /// Drops what a constructor-time read is no longer needed for.
    void forget_source() { source_.reset(); }
    std::size_t non_finite() const { return non_finite_; }

private:
    void load_whole(TileCache& cache);
    void load_part(int tile, TileCache& cache);
    void load_magenta(int tile, TileCache& cache);
    void publish(int tile, TileMemory memory, TileCache& cache);

    std::string name_;
    std::unique_ptr<Source> source_;
    Conversion conversion_;
    Texture texture_;
    bool has_alpha_ = false, by_parts_ = false, can_read_parts_ = false, failed_ = false;
    std::size_t non_finite_ = 0;
    std::mutex loading_;
};

}  // namespace cardioid::image
