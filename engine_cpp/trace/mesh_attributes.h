// SPDX-License-Identifier: GPL-3.0-or-later
// Values that nodes read of a mesh and that follow from its shape, as Blender's exporter computes them for Cycles.
#pragma once

#include "math/types.h"
#include "scene/scene_desc.h"

#include <vector>

namespace cardioid::trace {

/// MeshDesc::edges, or the sides of the triangles where it is empty: two vertices each, some twice.
std::vector<std::uint32_t> edges_of(const scene::MeshDesc& mesh);

/// Unit normals of the vertices: face normals weighted by the angle of the corner, as Blender has them. Zero for vertices
/// without a face. Polygons that are not flat count by their triangles.
std::vector<Float3> vertex_normals(const scene::MeshDesc& mesh);

/// Geometry ▸ Random Per Island: a number in [0, 1] for each triangle, the same all over a connected part. It is a hash of
/// the part's representative vertex, which depends on the order of the edges.
std::vector<float> random_per_island(const scene::MeshDesc& mesh);

/// Attribute that a host whose faces are polygons may give: unit normals of the vertices, three channels per point.
inline constexpr const char* k_vertex_normal = "#vertex_normal";

/// Geometry ▸ Pointiness for each vertex: over 0.5 where the surface is convex, under it where it is concave. The mean of the
/// angle between the normal (the host's, or else vertex_normals) and the edges, blurred once with the neighbours; vertices at
/// one place count as one.
std::vector<float> pointiness(const scene::MeshDesc& mesh);

}  // namespace cardioid::trace
