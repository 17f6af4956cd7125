// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures to files. Each is written under a temporary name and renamed, so that a full disk keeps the old file; errors
// throw scene::SceneError naming the path.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

namespace cardioid::image {

enum class Depth : std::uint8_t { half, real };

/// `pixels`: width × height × channels.size(), interleaved, bottom row first. Channel names as in EXR files ("R",
/// "ViewLayer.Normal.X"); `metadata` becomes text attributes. Halves are clamped to ±65504.
void write_exr(const std::string& path, int width, int height, const std::vector<std::string>& channels,
               std::span<const float> pixels, const std::map<std::string, std::string>& metadata = {},
               Depth depth = Depth::real);

/// Scene-linear colour (3 channels, or 4 with associated alpha), bottom row first, as 8-bit sRGB: clipped, not
/// tone-mapped.
void write_png(const std::string& path, int width, int height, int channels, std::span<const float> pixels);

}  // namespace cardioid::image
