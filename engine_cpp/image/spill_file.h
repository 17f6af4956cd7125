// SPDX-License-Identifier: GPL-3.0-or-later
// A nameless temporary file for decoded tiles of images that do not fit the cache: reading a tile back takes
// microseconds, decoding the image again would take a large part of a second. Nothing is written while all images fit.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>

namespace cardioid::image {

class SpillFile {
public:
    SpillFile() = default;
    ~SpillFile();
    SpillFile(const SpillFile&) = delete;
    SpillFile& operator=(const SpillFile&) = delete;

    /// A range for `bytes`; the file is made at the first call.
    std::int64_t allocate(std::int64_t bytes);
    /// False when there is no file or the disk is full. From any thread.
    bool write(std::int64_t at, std::span<const std::byte> bytes);
    bool read(std::int64_t at, std::span<std::byte> bytes) const;

private:
    std::once_flag opened_;
    int descriptor_ = -1;
    std::atomic<std::int64_t> end_{0};
};

}  // namespace cardioid::image
