// SPDX-License-Identifier: GPL-3.0-or-later
// One file for a whole scene: magic, version, a JSON header with the field names of scene_desc.h, raw little-endian
// arrays and a checksum over everything. See scene/README.md for the layout.
#pragma once

#include "scene/error.h"
#include "scene/scene_desc.h"

#include <filesystem>

namespace cardioid::scene {

/// Writes a temporary file beside `path`, then renames it: on any failure (SceneError) an older file stays as it was.
void save_scene(const SceneDesc& scene, const std::filesystem::path& path);

/// Throws SceneError, naming the file, when it is missing, foreign, from a newer version, truncated or damaged.
SceneDesc load_scene(const std::filesystem::path& path);

}  // namespace cardioid::scene
