// SPDX-License-Identifier: GPL-3.0-or-later
// Embree's packet calls over W lanes: the one place where kernels touch rtc*. Width 1 uses single rays.
#pragma once

#include "simd/vec.h"
#include "trace/scene_view.h"

#include <embree3/rtcore.h>

namespace cardioid::CD_ISA_NS {

#if CARDIOID_WIDTH == 16
using EmbreeRayHit = RTCRayHit16;
using EmbreeRay = RTCRay16;
#elif CARDIOID_WIDTH == 8
using EmbreeRayHit = RTCRayHit8;
using EmbreeRay = RTCRay8;
#else
using EmbreeRayHit = RTCRayHit;
using EmbreeRay = RTCRay;
#endif

struct RayLanes {
    Vec3 o, d;
    Float t_min, t_max, time;
    Int mask;
};

struct HitLanes {
    Mask hit;
    Float t, u, v;
    Vec3 ng;  ///< not of unit length; in the mesh's space for instances that are not baked
    Int triangle, instance;
};

template <class T>
inline float* float_lanes(T& field) {
    return reinterpret_cast<float*>(&field);
}
template <class T>
inline std::int32_t* int_lanes(T& field) {
    return reinterpret_cast<std::int32_t*>(&field);
}

inline void fill_ray(EmbreeRay& to, const RayLanes& ray) {
    store(float_lanes(to.org_x), ray.o.x);
    store(float_lanes(to.org_y), ray.o.y);
    store(float_lanes(to.org_z), ray.o.z);
    store(float_lanes(to.tnear), ray.t_min);
    store(float_lanes(to.dir_x), ray.d.x);
    store(float_lanes(to.dir_y), ray.d.y);
    store(float_lanes(to.dir_z), ray.d.z);
    store(float_lanes(to.time), ray.time);
    store(float_lanes(to.tfar), ray.t_max);
    store(int_lanes(to.mask), ray.mask);
    store(int_lanes(to.id), Int(0));
    store(int_lanes(to.flags), Int(0));
}

inline RTCIntersectContext make_context(bool coherent) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
}

/// Closest hits. `coherent` only for camera rays: on others it halves the speed.
inline HitLanes intersect(RTCSceneTy* scene, const RayLanes& ray, Mask active, bool coherent) {
    RTCIntersectContext context = make_context(coherent);
    alignas(64) EmbreeRayHit rh;
    fill_ray(rh.ray, ray);
    store(int_lanes(rh.hit.geomID), Int(-1));
    store(int_lanes(rh.hit.instID[0]), Int(-1));
    store(int_lanes(rh.hit.primID), Int(0));
#if CARDIOID_WIDTH == 1
    if (any(active)) rtcIntersect1(scene, &context, &rh);
#else
    alignas(64) std::int32_t valid[W];
    store(valid, Int(active.v));
#if CARDIOID_WIDTH == 8
    rtcIntersect8(valid, scene, &context, &rh);
#else
    rtcIntersect16(valid, scene, &context, &rh);
#endif
#endif
    HitLanes h;
    const Int geometry = load(int_lanes(rh.hit.geomID));
    const Int instance = load(int_lanes(rh.hit.instID[0]));
    h.hit = active & (geometry != Int(-1));
    h.t = load(float_lanes(rh.ray.tfar));
    h.u = load(float_lanes(rh.hit.u));
    h.v = load(float_lanes(rh.hit.v));
    h.ng = {load(float_lanes(rh.hit.Ng_x)), load(float_lanes(rh.hit.Ng_y)), load(float_lanes(rh.hit.Ng_z))};
    h.triangle = load(int_lanes(rh.hit.primID));
    h.instance = select(instance == Int(-1), geometry, instance);
    return h;
}

/// Lanes whose segment meets anything that the ray's mask sees.
inline Mask occluded(RTCSceneTy* scene, const RayLanes& ray, Mask active) {
    RTCIntersectContext context = make_context(false);
    alignas(64) EmbreeRay r;
    fill_ray(r, ray);
#if CARDIOID_WIDTH == 1
    if (any(active)) rtcOccluded1(scene, &context, &r);
#else
    alignas(64) std::int32_t valid[W];
    store(valid, Int(active.v));
#if CARDIOID_WIDTH == 8
    rtcOccluded8(valid, scene, &context, &r);
#else
    rtcOccluded16(valid, scene, &context, &r);
#endif
#endif
    return active & (load(float_lanes(r.tfar)) < Float(0.0f));
}

}  // namespace cardioid::CD_ISA_NS
