// SPDX-License-Identifier: GPL-3.0-or-later
// The point on an emitter where its program runs, as Cycles sees it: lamps are instances of their own (SceneView::
// first_lamp_instance) with parametric coordinates by kind, triangles have the normals of their mesh and a back.
#pragma once

#include "path/tracer.h"

namespace cardioid::CD_ISA_NS {

/// Cycles counts one bounce more where it asks for emission at the end of a ray.
inline Int one_bounce_further(Int depth) { return depth + select(byte_of(depth, 0) < Int(255), Int(1), Int(0)); }

/// Adds to `at` (position, normals and wo of lamps `id` are there) what nodes read of lamps. Emission knows no kind of ray.
void place_on_lamp(const trace::SceneView& scene, Int id, ShadedPoint& at, Mask lamps);

/// Adds to `at` (position, wo, instance, triangle, u and v are there) the normals of emissive triangles.
void place_on_triangle(const trace::SceneView& scene, ShadedPoint& at, Mask triangles);

}  // namespace cardioid::CD_ISA_NS
