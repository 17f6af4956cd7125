// SPDX-License-Identifier: GPL-3.0-or-later
// frame.cardioid: a film in one file, to be filtered again without rendering (docs/film-file.md).
#pragma once

#include "film/film.h"

#include <array>
#include <filesystem>
#include <span>

namespace cardioid::film {

class FilmFile {
public:
    /// Written under a temporary name, then renamed: on any failure (SceneError: a full disk) an older file stays as it
    /// was.
    static void save(const Film& film, const std::filesystem::path& path);
    /// Throws SceneError naming the file when it is missing, foreign (also: a scene file), from a newer version,
    /// truncated, damaged, or larger than memory. What it returns is sound: the filter need not check it.
    static Film load(const std::filesystem::path& path);

private:
    class Reader;
    static Film read(const std::filesystem::path& path);
    static std::array<std::uint8_t, k_block_lists> counts_of(const ClusterStore::Block& block);
    static void set_counts(ClusterStore::Block& block, std::span<const std::uint8_t, k_block_lists> counts);
    static void read_clusters(ClusterStore& store, std::uint64_t total, Reader& in);
    static void check(const Film& film);
};

}  // namespace cardioid::film
