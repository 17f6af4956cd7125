// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace/displaced_normals.h"

#include "trace/mesh_attributes.h"

namespace cardioid::trace {
namespace {

using scene::MeshDesc;

/// Cosine over which two normals are the same one, rounded.
constexpr float k_same = 0.99999f;

bool same(Float3 a, Float3 b) { return dot(a, b) > k_same; }

Float3 corner_normal(const MeshDesc& mesh, std::size_t corner) {
    const float* n = &mesh.corner_normals[3 * corner];
    return normalize({n[0], n[1], n[2]});
}

Float3 face_normal(const MeshDesc& mesh, const std::vector<float>& positions, std::size_t triangle) {
    const auto at = [&](std::size_t k) {
        const float* p = &positions[3 * std::size_t{mesh.triangles[3 * triangle + k]}];
        return Float3{p[0], p[1], p[2]};
    };
    const Float3 first = at(0);
    return normalize(cross(at(1) - first, at(2) - first));
}

/// Corners of each vertex, one list after the other.
struct CornersOf {
    std::vector<std::uint32_t> first, corner;

    explicit CornersOf(const MeshDesc& mesh) : first(mesh.positions.size() / 3 + 1, 0), corner(mesh.triangles.size()) {
        for (const std::uint32_t v : mesh.triangles) ++first[v + 1];
        for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        for (std::uint32_t c = 0; c < mesh.triangles.size(); ++c) corner[next[mesh.triangles[c]]++] = c;
    }
};

std::vector<Float3> face_normals(const MeshDesc& mesh, const std::vector<float>& positions) {
    std::vector<Float3> normals(mesh.triangles.size() / 3);
    for (std::size_t t = 0; t < normals.size(); ++t) normals[t] = face_normal(mesh, positions, t);
    return normals;
}

/// What the corners of a mesh are shaded by before it moves.
struct Before {
    std::vector<Float3> corner, vertex, face;

    explicit Before(const MeshDesc& mesh)
        : corner(mesh.triangles.size()), vertex(vertex_normals(mesh)), face(face_normals(mesh, mesh.positions)) {
        for (std::size_t c = 0; c < corner.size(); ++c) corner[c] = corner_normal(mesh, c);
    }

    /// Its corners have the face's normal while some vertex is not turned that way.
    bool is_flat(const MeshDesc& mesh, std::size_t triangle) const {
        bool turned = false;
        for (std::size_t c = 3 * triangle; c < 3 * triangle + 3; ++c) {
            if (!same(corner[c], face[triangle])) return false;
            turned = turned || !same(vertex[mesh.triangles[c]], face[triangle]);
        }
        return turned;
    }
};

}  // namespace

std::vector<Float3> smooth_normals(const MeshDesc& mesh) {
    std::vector<Float3> normals = vertex_normals(mesh);
    if (mesh.corner_normals.empty()) return normals;
    std::vector<Float3> given(normals.size());
    std::vector<bool> agree(normals.size(), true);
    for (std::size_t c = 0; c < mesh.triangles.size(); ++c) {
        const std::uint32_t v = mesh.triangles[c];
        const Float3 n = corner_normal(mesh, c);
        if (given[v] == Float3{}) given[v] = n;
        if (!same(given[v], n)) agree[v] = false;
    }
    for (std::size_t v = 0; v < normals.size(); ++v)
        if (agree[v] && !(given[v] == Float3{})) normals[v] = given[v];
    return normals;
}

std::vector<float> displaced_normals(const MeshDesc& mesh, const std::vector<float>& positions,
                                     const std::function<bool(std::size_t)>& reshaded) {
    const Before before(mesh);
    const std::vector<Float3> faces = face_normals(mesh, positions);
    const CornersOf corners(mesh);
    std::vector<float> normals = mesh.corner_normals;
    for (std::size_t c = 0; c < mesh.triangles.size(); ++c) {
        if (!reshaded(c / 3)) continue;
        Float3 sum;
        if (before.is_flat(mesh, c / 3)) {
            sum = faces[c / 3];
        } else {
            const std::uint32_t v = mesh.triangles[c];
            // A normal that is the vertex's own has every face in it, flat ones too.
            const bool whole = same(before.corner[c], before.vertex[v]);
            for (std::uint32_t k = corners.first[v]; k < corners.first[v + 1]; ++k) {
                const std::uint32_t other = corners.corner[k];
                if (reshaded(other / 3) && (whole || same(before.corner[other], before.corner[c])))
                    sum = sum + faces[other / 3];
            }
        }
        sum = normalize(sum);
        if (sum == Float3{}) continue;
        normals[3 * c] = sum.x;
        normals[3 * c + 1] = sum.y;
        normals[3 * c + 2] = sum.z;
    }
    return normals;
}

}  // namespace cardioid::trace
