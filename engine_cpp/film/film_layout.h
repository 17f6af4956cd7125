// SPDX-License-Identifier: GPL-3.0-or-later
// What a film file begins with: a header of 32 bytes and a JSON object (docs/film-file.md). Errors are SceneErrors
// whose text follows the file's name.
#pragma once

#include "film/film.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace cardioid::film {

inline constexpr std::array<char, 8> k_film_magic{'C', 'A', 'R', 'D', 'F', 'L', 'M', '\n'};
inline constexpr std::uint32_t k_film_version = 1;

struct FilmHeader {
    std::array<char, 8> magic = k_film_magic;
    std::uint32_t version = k_film_version;
    std::uint32_t reserved = 0;
    std::uint64_t json_bytes = 0;
    std::uint64_t clusters = 0;
};
static_assert(sizeof(FilmHeader) == 32);

/// What stands in the JSON.
struct FilmContents {
    Region region;
    float exposure = 1;
    bool transparent = false, photons = false, clusters = false;
    int pixel_bytes = 0;  ///< of the sums of a pixel
    scene::FilterSettings filter;
};

/// `start`: the file's first bytes, 32 if it has as many. Throws for what is no film, newer or damaged.
FilmHeader read_film_header(std::span<const std::byte> start);

std::string write_contents(const FilmContents& contents);
/// Regions are sound and filter settings in their ranges.
FilmContents read_contents(const std::string& text);

/// Compares the length of the file with what its beginning promises, so that no array is larger than the file, and with
/// the machine's memory. `per_pixel`: bytes of all arrays of pixels together.
void check_film_size(const FilmContents& contents, const FilmHeader& header, std::uint64_t size,
                     std::uint64_t per_pixel);

}  // namespace cardioid::film
