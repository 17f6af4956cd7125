// SPDX-License-Identifier: GPL-3.0-or-later
// Owns Embree's device and scenes. The geometry id at the top level is the instance number.
#pragma once

#include "trace/geometry_pool.h"

#include <cstdint>
#include <functional>
#include <vector>

struct RTCDeviceTy;

namespace cardioid::trace {

class EmbreeScene {
public:
    /// `has_transparency(instance)`: some material of the instance lets shadow rays through.
    /// `keep_going` is asked while the tree is built; false stops the build (and `cancelled()` is true).
    EmbreeScene(const GeometryPool& pool, bool robust, const std::function<bool(int)>& has_transparency,
                const std::function<bool()>& keep_going);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    RTCSceneTy* top() const { return top_; }
    std::int64_t memory_bytes() const { return bytes_; }
    bool cancelled() const { return cancelled_; }

private:
    RTCSceneTy* new_scene(bool robust);
    void commit(RTCSceneTy* scene);
    void attach_triangles(RTCSceneTy* scene, const GeometryPool& pool, int mesh, unsigned id, std::uint32_t mask);

    RTCDeviceTy* device_ = nullptr;
    RTCSceneTy* top_ = nullptr;
    std::vector<RTCSceneTy*> meshes_;
    std::int64_t bytes_ = 0;
    std::function<bool()> keep_going_;
    bool cancelled_ = false;
};

/// Version of the Embree library in use, e.g. "3.13.5".
const char* embree_version();

}  // namespace cardioid::trace
