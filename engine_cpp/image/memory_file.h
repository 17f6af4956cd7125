// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes under a file name, without a disk. Every format can be read from it, while readers from memory exist in
// OpenImageIO for some formats only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cardioid::image {

class MemoryFile {
public:
    /// Throws scene::SceneError if the system refuses.
    explicit MemoryFile(const std::vector<std::uint8_t>& bytes);
    ~MemoryFile();
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    std::string path() const;

private:
    int descriptor_;
};

}  // namespace cardioid::image
