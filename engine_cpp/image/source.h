// SPDX-License-Identifier: GPL-3.0-or-later
// Where texels come from: a file, the bytes of a file, or an array of floats. Hides OpenImageIO.
#pragma once

#include "image/texture.h"
#include "scene/scene_desc.h"

#include <functional>
#include <memory>
#include <string>

namespace cardioid::image {

struct SourceInfo {
    int width = 0, height = 0;
    int channels = 0;  ///< in the file; readers deliver at most the first four
    Storage storage = Storage::byte;
    bool tiled = false;           ///< parts can be read without reading what is before them
    bool straight_alpha = false;  ///< the file's colours are not multiplied by its alpha
    int delivered() const { return channels < 4 ? channels : 4; }
};

/// The reader's own cache of file tiles, shared by the images of a store.
class FileCache {
public:
    explicit FileCache(int megabytes);
    ~FileCache();
    FileCache(const FileCache&) = delete;
    FileCache& operator=(const FileCache&) = delete;
    std::int64_t memory_bytes() const;

private:
    friend class FileSource;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Receives rows [y, y + rows) counted from the top, interleaved.
using RowReceiver = std::function<void(int y, int rows, const std::byte* texels)>;

class Source {
public:
    virtual ~Source() = default;
    const SourceInfo& info() const { return info_; }
    /// The whole picture from the top, in bands: the first of `first` rows, the others of k_tile. Throws SceneError.
    virtual void read_all(int first, const RowReceiver& receive) = 0;
    /// A rectangle inside the picture, y from the top. Throws SceneError. From any thread.
    virtual void read_part(int x, int y, int width, int height, std::byte* texels) = 0;
    /// False: what was read once cannot be read again, because the source keeps nothing.
    virtual bool repeatable() const { return true; }

protected:
    SourceInfo info_;
};

/// Beyond this a size in a header is taken for damage.
inline constexpr int k_largest_side = 1 << 17;

/// A file by name, or the bytes of one.
std::unique_ptr<Source> open_file(const scene::ImageDesc& image, FileCache& cache);

/// Any source. Throws SceneError saying why it cannot be opened.
std::unique_ptr<Source> open_source(const scene::ImageDesc& image, FileCache& cache);

}  // namespace cardioid::image
