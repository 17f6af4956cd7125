// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace/embree_scene.h"

#include <embree3/rtcore.h>

#include <atomic>
#include <stdexcept>

namespace cardioid::trace {

namespace {
bool count_memory(void* user, ssize_t bytes, bool /*post*/) {
    __atomic_fetch_add(static_cast<std::int64_t*>(user), bytes, __ATOMIC_RELAXED);
    return true;
}

bool continue_build(void* user, double /*fraction*/) { return (*static_cast<std::function<bool()>*>(user))(); }
}  // namespace

EmbreeScene::EmbreeScene(const GeometryPool& pool, bool robust, const std::function<bool(int)>& has_transparency,
                         const std::function<bool()>& keep_going)
    : keep_going_(keep_going) {
    device_ = rtcNewDevice(nullptr);
    if (!device_) throw std::runtime_error("Embree could not start on this machine");
    rtcSetDeviceMemoryMonitorFunction(device_, count_memory, &bytes_);
    top_ = new_scene(robust);
    meshes_.assign(pool.meshes().size(), nullptr);
    const auto& placed = pool.placed();
    for (std::size_t i = 0; i < placed.size() && !cancelled_; ++i) {
        const int mesh = placed[i].mesh;
        std::uint32_t mask = placed[i].visibility & ~static_cast<std::uint32_t>(scene::visible_shadow);
        if (placed[i].visibility & scene::visible_shadow) {
            mask |= has_transparency(static_cast<int>(i)) ? mask_shadow_transparent : mask_shadow_opaque;
        }
        if (pool.meshes()[mesh].baked) {
            attach_triangles(top_, pool, mesh, static_cast<unsigned>(i), mask);
            continue;
        }
        if (!meshes_[mesh]) {
            meshes_[mesh] = new_scene(robust);
            attach_triangles(meshes_[mesh], pool, mesh, 0, ~0u);
            commit(meshes_[mesh]);
        }
        RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(instance, meshes_[mesh]);
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, placed[i].transform.m.data());
        rtcSetGeometryMask(instance, mask);
        rtcCommitGeometry(instance);
        rtcAttachGeometryByID(top_, instance, static_cast<unsigned>(i));
        rtcReleaseGeometry(instance);
    }
    if (!cancelled_) commit(top_);
}

EmbreeScene::~EmbreeScene() {
    if (top_) rtcReleaseScene(top_);
    for (RTCScene s : meshes_) {
        if (s) rtcReleaseScene(s);
    }
    if (device_) {
        rtcSetDeviceMemoryMonitorFunction(device_, nullptr, nullptr);
        rtcReleaseDevice(device_);
    }
}

RTCScene EmbreeScene::new_scene(bool robust) {
    RTCScene scene = rtcNewScene(device_);
    rtcSetSceneFlags(scene, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    rtcSetSceneProgressMonitorFunction(scene, continue_build, &keep_going_);
    return scene;
}

void EmbreeScene::commit(RTCScene scene) {
    if (!keep_going_()) {
        cancelled_ = true;
        return;
    }
    rtcCommitScene(scene);
    const RTCError error = rtcGetDeviceError(device_);
    if (error == RTC_ERROR_CANCELLED) {
        cancelled_ = true;
    } else if (error == RTC_ERROR_OUT_OF_MEMORY) {
        throw std::runtime_error("Not enough memory for the geometry: simplify meshes or use instances");
    } else if (error != RTC_ERROR_NONE) {
        throw std::runtime_error("Embree failed to build the scene (error " + std::to_string(static_cast<int>(error)) +
                                 ")");
    }
}

void EmbreeScene::attach_triangles(RTCScene scene, const GeometryPool& pool, int mesh, unsigned id,
                                   std::uint32_t mask) {
    const GeometryPool::MeshRange& r = pool.meshes()[mesh];
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, pool.positions(mesh), 0, 12,
                               r.vertices);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, pool.triangles(mesh), 0, 12,
                               r.triangles);
    rtcSetGeometryMask(geometry, mask);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
}

const char* embree_version() { return RTC_VERSION_STRING; }

}  // namespace cardioid::trace
