// SPDX-License-Identifier: GPL-3.0-or-later
// Rays that nodes send (nodes::RayService) through the traceable scene.
#pragma once

#include "nodes/shading.h"
#include "path/tracer.h"

namespace cardioid::CD_ISA_NS {

/// RayService::closest; `scene` is a trace::SceneView.
void node_closest(const void* scene, const nodes::NodeRays& rays, nodes::NodeHits& hits, int lanes);

/// ShadingChunk::random_seed of rays: another one for each vertex of each path.
Int node_seed(const Walk& walk, Int ray);

}  // namespace cardioid::CD_ISA_NS
