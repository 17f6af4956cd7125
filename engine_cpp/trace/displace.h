// SPDX-License-Identifier: GPL-3.0-or-later
// True displacement: meshes whose materials move vertices are copied, moved and shaded anew before anything is built of them.
#pragma once

#include "trace/geometry_pool.h"
#include "trace/scene_view.h"

#include <functional>
#include <vector>

namespace cardioid::trace {

/// As Cycles does it, in object space: every vertex moves once, by the material of the first triangle that uses it and that
/// displaces, along the smooth normal and seen from the first instance with those materials. A mesh that is placed with
/// different displacing materials becomes a variant for each set (in Cycles: one for all). Normals follow the moved surface where
/// the method is `displacement` (faces count alike; flat faces stay flat), and stay where it is `both`, since bump mapping turns
/// them. Vertices at sharp edges move as one, as in Blender 5.1 (before, Cycles let the surface break open there).
/// Attributes that follow from the shape and that programs name ("#pointiness", "#random_island") are those of the
/// undisplaced mesh; "#undisplaced" is added. `view` holds the camera; `materials` the programs by id. `checkpoint` may throw.
MeshVariants displaced_meshes(const scene::SceneDesc& desc, const PoolNames& names, const SceneView& view,
                              const std::vector<MaterialView>& materials, int default_material,
                              const std::function<void()>& checkpoint);

}  // namespace cardioid::trace
