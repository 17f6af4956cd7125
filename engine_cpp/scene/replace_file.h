// SPDX-License-Identifier: GPL-3.0-or-later
// Files that appear whole or not at all: written under a temporary name beside the target, then renamed over it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace cardioid::scene {

/// The open temporary file. Errors (a full disk) throw SceneError.
class FileWriter {
public:
    FileWriter(const std::filesystem::path& path, int descriptor) : path_(path), descriptor_(descriptor) {}
    void write(std::span<const std::byte> bytes);

private:
    const std::filesystem::path& path_;
    int descriptor_;
};

/// `write` fills the file. If it throws, or writing fails, the temporary file is removed and an older `path` is
/// untouched. Throws SceneError naming `path`.
void replace_file(const std::filesystem::path& path, const std::function<void(FileWriter&)>& write);

/// The same for writers that open files by name: `write` gets the temporary name (same extension as `path`).
void replace_file_by_name(const std::filesystem::path& path, const std::function<void(const std::string&)>& write);

}  // namespace cardioid::scene
