// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace/mesh_attributes.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numbers>
#include <numeric>
#include <unordered_set>

namespace cardioid::trace {
namespace {

using scene::MeshDesc;

Float3 position(const MeshDesc& mesh, std::uint32_t vertex) {
    const float* p = &mesh.positions[3 * std::size_t{vertex}];
    return {p[0], p[1], p[2]};
}

/// Union by rank: which vertex represents a part is decided by the order of the edges, so this must be the usual scheme.
class Islands {
public:
    explicit Islands(std::size_t vertices) : parent_(vertices), rank_(vertices, 0) {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }
    std::uint32_t find(std::uint32_t v) {
        while (parent_[v] != v) {
            parent_[v] = parent_[parent_[v]];
            v = parent_[v];
        }
        return v;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        if (a == b) return;
        if (rank_[a] < rank_[b]) std::swap(a, b);
        parent_[b] = a;
        if (rank_[a] == rank_[b]) ++rank_[a];
    }

private:
    std::vector<std::uint32_t> parent_;
    std::vector<std::uint8_t> rank_;
};

/// Jenkins' lookup3 of one word, to [0, 1].
float hash_to_float(std::uint32_t key) {
    std::uint32_t a = 0xdeadbeefu + (1u << 2) + 13u, b = a, c = a;
    a += key;
    c = (c ^ b) - std::rotl(b, 14);
    a = (a ^ c) - std::rotl(c, 11);
    b = (b ^ a) - std::rotl(a, 25);
    c = (c ^ b) - std::rotl(b, 16);
    a = (a ^ c) - std::rotl(c, 4);
    b = (b ^ a) - std::rotl(a, 14);
    c = (c ^ b) - std::rotl(b, 24);
    return static_cast<float>(c) * (1.0f / 4294967296.0f);
}

/// For each vertex the one that stands for all at its place.
std::vector<std::uint32_t> welded(const MeshDesc& mesh) {
    constexpr float near = std::numeric_limits<float>::epsilon();
    const std::size_t count = mesh.positions.size() / 3;
    const auto sum = [&](std::uint32_t v) {
        const Float3 p = position(mesh, v);
        return p.x + p.y + p.z;
    };
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const float x = sum(a), y = sum(b);
        return x != y ? x < y : a > b;
    });
    std::vector<std::uint32_t> original(count);
    std::iota(original.begin(), original.end(), 0u);
    // From the last on, so that what a vertex finds is final already.
    for (std::size_t i = count; i-- > 0;) {
        const Float3 p = position(mesh, order[i]);
        for (std::size_t j = i + 1; j < count && sum(order[j]) - sum(order[i]) <= 3 * near; ++j) {
            const Float3 d = position(mesh, order[j]) - p;
            if (dot(d, d) >= near) continue;
            original[order[i]] = original[order[j]];
            break;
        }
    }
    return original;
}

/// Edges between welded vertices, each once.
std::vector<std::uint32_t> welded_edges(const MeshDesc& mesh, const std::vector<std::uint32_t>& original) {
    std::vector<std::uint32_t> edges = edges_of(mesh), once;
    std::unordered_set<std::uint64_t> seen;
    seen.reserve(edges.size() / 2);
    for (std::size_t e = 0; e < edges.size(); e += 2) {
        const std::uint32_t a = original[edges[e]], b = original[edges[e + 1]];
        if (!seen.insert(std::uint64_t{std::min(a, b)} << 32 | std::max(a, b)).second) continue;
        once.push_back(a);
        once.push_back(b);
    }
    return once;
}

/// The host's normals of the vertices, or those of the triangles.
std::vector<Float3> given_normals(const MeshDesc& mesh) {
    for (const scene::AttributeDesc& a : mesh.attributes) {
        if (a.name != k_vertex_normal || a.domain != scene::Domain::point || a.channels != 3) continue;
        std::vector<Float3> normals(a.data.size() / 3);
        for (std::size_t v = 0; v < normals.size(); ++v)
            normals[v] = {a.data[3 * v], a.data[3 * v + 1], a.data[3 * v + 2]};
        return normals;
    }
    return vertex_normals(mesh);
}

float angle_between(Float3 a, Float3 b) { return std::acos(std::clamp(dot(a, b), -1.0f, 1.0f)); }

}  // namespace

std::vector<std::uint32_t> edges_of(const MeshDesc& mesh) {
    if (!mesh.edges.empty()) return mesh.edges;
    std::vector<std::uint32_t> edges;
    edges.reserve(2 * mesh.triangles.size());
    for (std::size_t c = 0; c < mesh.triangles.size(); ++c) {
        edges.push_back(mesh.triangles[c]);
        edges.push_back(mesh.triangles[c % 3 == 2 ? c - 2 : c + 1]);
    }
    return edges;
}

std::vector<Float3> vertex_normals(const MeshDesc& mesh) {
    std::vector<Float3> normals(mesh.positions.size() / 3);
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
        const std::uint32_t* v = &mesh.triangles[t];
        const Float3 p[3] = {position(mesh, v[0]), position(mesh, v[1]), position(mesh, v[2])};
        const Float3 face = normalize(cross(p[1] - p[0], p[2] - p[0]));
        for (int k = 0; k < 3; ++k) {
            const Float3 next = normalize(p[(k + 1) % 3] - p[k]), before = normalize(p[(k + 2) % 3] - p[k]);
            normals[v[k]] = normals[v[k]] + face * angle_between(next, before);
        }
    }
    for (Float3& n : normals) n = normalize(n);
    return normals;
}

std::vector<float> random_per_island(const MeshDesc& mesh) {
    Islands islands(mesh.positions.size() / 3);
    const std::vector<std::uint32_t> edges = edges_of(mesh);
    for (std::size_t e = 0; e < edges.size(); e += 2) islands.join(edges[e], edges[e + 1]);
    std::vector<float> random(mesh.triangles.size() / 3);
    for (std::size_t t = 0; t < random.size(); ++t) random[t] = hash_to_float(islands.find(mesh.triangles[3 * t]));
    return random;
}

std::vector<float> pointiness(const MeshDesc& mesh) {
    const std::vector<std::uint32_t> original = welded(mesh);
    const std::vector<std::uint32_t> edges = welded_edges(mesh, original);
    const std::size_t count = original.size();
    std::vector<Float3> normal(count), along(count);
    const std::vector<Float3> own = given_normals(mesh);
    for (std::size_t v = 0; v < count; ++v) normal[original[v]] = normal[original[v]] + own[v];
    std::vector<float> neighbours(count, 0.0f);
    for (std::size_t e = 0; e < edges.size(); e += 2) {
        const std::uint32_t a = edges[e], b = edges[e + 1];
        const Float3 direction = normalize(position(mesh, b) - position(mesh, a));
        along[a] = along[a] + direction;
        along[b] = along[b] - direction;
        ++neighbours[a];
        ++neighbours[b];
    }
    std::vector<float> raw(count, 0.0f);
    for (std::size_t v = 0; v < count; ++v) {
        if (original[v] != v || neighbours[v] == 0) continue;
        raw[v] = angle_between(normalize(normal[v]), along[v] * (1 / neighbours[v])) / std::numbers::pi_v<float>;
    }
    std::vector<float> blurred = raw;
    for (std::size_t e = 0; e < edges.size(); e += 2) {
        blurred[edges[e]] += raw[edges[e + 1]];
        blurred[edges[e + 1]] += raw[edges[e]];
    }
    for (std::size_t v = 0; v < count; ++v) blurred[v] /= neighbours[v] + 1;
    std::vector<float> result(count);
    for (std::size_t v = 0; v < count; ++v) result[v] = blurred[original[v]];
    return result;
}

}  // namespace cardioid::trace
