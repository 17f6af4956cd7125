// SPDX-License-Identifier: GPL-3.0-or-later
// Reading the scene's tables over lanes: instance values and matrices.
#pragma once

#include "nodes/kernel.h"

namespace cardioid::CD_ISA_NS {

/// The plain floats of a matrix (no library call in a kernel).
inline const float* floats_of(const Affine& a) { return reinterpret_cast<const float*>(&a); }

inline constexpr int k_instance_stride = static_cast<int>(sizeof(nodes::InstanceInfo) / sizeof(float));

/// Float `member` of the lanes' instances; `fallback` for lamps and the world.
inline Float instance_float(const nodes::ShadingChunk& chunk, int i, std::size_t member, float fallback) {
    const Int instance = load(chunk.instance + i);
    const Mask have = instance >= Int(0);
    if (chunk.geometry == nullptr || chunk.geometry->instances == nullptr || none(have)) return Float(fallback);
    const float* base = reinterpret_cast<const float*>(chunk.geometry->instances);
    const Int index = max(instance, Int(0)) * Int(k_instance_stride) + Int(static_cast<int>(member / sizeof(float)));
    return select(have, gather(base, index), Float(fallback));
}

/// Rows of a 3×4 matrix over lanes.
struct LaneAffine {
    Float m[12];
    Vec3 point(Vec3 p) const { return vector(p) + Vec3{m[3], m[7], m[11]}; }
    Vec3 vector(Vec3 v) const {
        return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[4] * v.x + m[5] * v.y + m[6] * v.z,
                m[8] * v.x + m[9] * v.y + m[10] * v.z};
    }
    Vec3 transposed_vector(Vec3 v) const {
        return {m[0] * v.x + m[4] * v.y + m[8] * v.z, m[1] * v.x + m[5] * v.y + m[9] * v.z,
                m[2] * v.x + m[6] * v.y + m[10] * v.z};
    }
};

/// A matrix of the lanes' instances, `member` its byte offset; the identity for lamps and the world.
inline LaneAffine instance_affine(const nodes::ShadingChunk& chunk, int i, std::size_t member) {
    LaneAffine a;
    for (int k = 0; k < 12; ++k)
        a.m[k] =
            instance_float(chunk, i, member + sizeof(float) * static_cast<std::size_t>(k), k % 5 == 0 ? 1.0f : 0.0f);
    return a;
}

inline LaneAffine identity_affine() {
    LaneAffine a;
    for (int k = 0; k < 12; ++k) a.m[k] = Float(k % 5 == 0 ? 1.0f : 0.0f);
    return a;
}

inline LaneAffine uniform_affine(const Affine& source) {
    LaneAffine a;
    for (int k = 0; k < 12; ++k) a.m[k] = Float(floats_of(source)[k]);
    return a;
}

}  // namespace cardioid::CD_ISA_NS
