// SPDX-License-Identifier: GPL-3.0-or-later
// A SceneDesc made ready for rays: geometry in Embree, graphs compiled, images opened, lights in their table. Immutable.
#pragma once

#include "trace/scene_view.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace cardioid::trace {

/// What building cost, for statistics.
struct BuildStats {
    double images_seconds = 0, materials_seconds = 0, geometry_seconds = 0, bvh_seconds = 0, lights_seconds = 0;
    std::int64_t triangles = 0, unique_triangles = 0, instances = 0, emissive_triangles = 0;
    std::int64_t embree_bytes = 0, geometry_bytes = 0, image_bytes = 0, light_bytes = 0;
};

/// Says what is being done; true: stop. Called between stages on the building thread.
using BuildProgress = std::function<bool(const std::string& stage)>;

struct BuildCancelled {};

class TraceableScene {
public:
    /// `desc` must have passed scene::validate. Throws BuildCancelled when `progress` asks for it.
    TraceableScene(const scene::SceneDesc& desc, const BuildProgress& progress);
    ~TraceableScene();
    TraceableScene(const TraceableScene&) = delete;
    TraceableScene& operator=(const TraceableScene&) = delete;

    const SceneView& view() const;
    const BuildStats& stats() const;
    /// Unknown nodes, missing images: each said once.
    std::vector<std::string> warnings() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace cardioid::trace
