// SPDX-License-Identifier: GPL-3.0-or-later
// Shading normals of a mesh whose vertices move.
#pragma once

#include "math/types.h"
#include "scene/scene_desc.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace cardioid::trace {

/// One unit normal for each vertex, that it moves along: the corners' where they agree, else the vertex's own, which faces
/// give that are flat, too.
std::vector<Float3> smooth_normals(const scene::MeshDesc& mesh);

/// MeshDesc::corner_normals (not empty) of `mesh` with its vertices at `positions`; corners of triangles that are not
/// `reshaded` keep theirs. Smooth corners get the sum of the unit normals of the reshaded faces that they shared a normal with,
/// flat ones the face's. A flat face that lies in the smooth surface around it cannot be told from a smooth one.
std::vector<float> displaced_normals(const scene::MeshDesc& mesh, const std::vector<float>& positions,
                                     const std::function<bool(std::size_t triangle)>& reshaded);

}  // namespace cardioid::trace
