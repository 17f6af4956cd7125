// SPDX-License-Identifier: GPL-3.0-or-later
// Random triangles for the ray tests, and small meshes for the pool.
#pragma once

#include "scene/scene_desc.h"

#include <random>

namespace cardioid::trace_tests {

inline Affine moved(float x, float y, float z) {
    Affine a;
    a.m[3] = x;
    a.m[7] = y;
    a.m[11] = z;
    return a;
}

inline Affine scaled(float x, float y, float z) {
    Affine a;
    a.m[0] = x;
    a.m[5] = y;
    a.m[10] = z;
    return a;
}

/// `n` triangles with corners around random points of the box [-1, 1]³.
inline scene::MeshDesc soup(int n, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-1, 1), edge(-0.3f, 0.3f);
    scene::MeshDesc mesh;
    mesh.name = "soup";
    for (int t = 0; t < n; ++t) {
        const float c[3] = {place(random), place(random), place(random)};
        for (int k = 0; k < 3; ++k) {
            for (const float x : c) mesh.positions.push_back(x + edge(random));
            mesh.triangles.push_back(static_cast<std::uint32_t>(3 * t + k));
        }
    }
    return mesh;
}

/// Two triangles of the unit square in z = 0, facing +z, with slots 0 and 1.
inline scene::MeshDesc square() {
    scene::MeshDesc mesh;
    mesh.name = "square";
    mesh.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    mesh.triangles = {0, 1, 2, 0, 2, 3};
    mesh.slots = {0, 1};
    return mesh;
}

inline scene::InstanceDesc placed(int mesh, const Affine& transform, std::vector<int> materials = {}) {
    scene::InstanceDesc i;
    i.mesh = mesh;
    i.transform = transform;
    i.materials = std::move(materials);
    return i;
}

}  // namespace cardioid::trace_tests
