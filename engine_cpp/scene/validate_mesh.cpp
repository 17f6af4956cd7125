// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/problems.h"

#include <algorithm>

namespace cardioid::scene {
namespace {

/// Embree ignores geometry beyond about 1.8e18; anything near it is a mistake.
constexpr float k_farthest = 1e18f;

std::size_t elements(const MeshDesc& mesh, Domain domain) {
    if (domain == Domain::point) return mesh.positions.size() / 3;
    return domain == Domain::face ? mesh.triangles.size() / 3 : mesh.triangles.size();
}

void empty_mesh(MeshDesc& mesh) {
    mesh.positions.clear();
    mesh.triangles.clear();
    mesh.slots.clear();
    mesh.corner_normals.clear();
    mesh.edges.clear();
    mesh.attributes.clear();
}

bool shapes_fit(MeshDesc& mesh, const std::string& who, ProblemList& problems) {
    const char* broken = mesh.positions.size() % 3 != 0   ? "positions that are not three numbers a vertex"
                         : mesh.triangles.size() % 3 != 0 ? "triangles that are not three indices each"
                                                          : nullptr;
    if (!broken) return true;
    problems.warn(who, std::string("has ") + broken + "; left out");
    empty_mesh(mesh);
    return false;
}

/// Arrays whose size does not fit the mesh are dropped.
void check_sizes(MeshDesc& mesh, const std::string& who, ProblemList& problems) {
    const auto check = [&](auto& values, std::size_t expected, const std::string& what) {
        if (values.empty() || values.size() == expected) return;
        problems.warn(who, "has " + std::to_string(values.size()) + ' ' + what + " where " + std::to_string(expected) +
                               " are expected; ignored");
        values.clear();
    };
    check(mesh.slots, mesh.triangles.size() / 3, "material slots");
    check(mesh.corner_normals, mesh.triangles.size() * 3, "values of normals");
    const std::size_t vertices = mesh.positions.size() / 3;
    const bool edges_fit = mesh.edges.size() % 2 == 0 && std::all_of(mesh.edges.begin(), mesh.edges.end(),
                                                                     [&](std::uint32_t v) { return v < vertices; });
    if (!edges_fit) {
        problems.warn(who, "has edges that are not pairs of its vertices; ignored");
        mesh.edges.clear();
    }
    std::erase_if(mesh.attributes, [&](const AttributeDesc& a) {
        const std::size_t channels = a.channels >= 1 && a.channels <= 4 ? static_cast<std::size_t>(a.channels) : 0;
        const std::size_t expected = elements(mesh, a.domain) * channels;
        if (channels > 0 && a.data.size() == expected) return false;
        problems.warn(who, "has an attribute \"" + a.name + "\" of " + std::to_string(a.data.size()) + " values in " +
                               std::to_string(a.channels) + " channels where " + std::to_string(expected) +
                               " are expected; ignored");
        return true;
    });
}

/// Keeps the elements whose triangle is kept; `stride` values each.
template <class T>
void compact(std::vector<T>& values, const std::vector<bool>& keep, std::size_t stride) {
    if (values.empty()) return;
    std::size_t to = 0;
    for (std::size_t t = 0; t < keep.size(); ++t) {
        if (!keep[t]) continue;
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(t * stride), stride,
                    values.begin() + static_cast<std::ptrdiff_t>(to));
        to += stride;
    }
    values.resize(to);
}

void keep_triangles(MeshDesc& mesh, const std::vector<bool>& keep) {
    compact(mesh.triangles, keep, 3);
    compact(mesh.slots, keep, 1);
    compact(mesh.corner_normals, keep, 9);
    for (AttributeDesc& a : mesh.attributes) {
        const auto channels = static_cast<std::size_t>(a.channels);
        if (a.domain == Domain::corner) compact(a.data, keep, 3 * channels);
        if (a.domain == Domain::face) compact(a.data, keep, channels);
    }
}

void drop_bad_triangles(MeshDesc& mesh, const std::string& who, ProblemList& problems) {
    const std::size_t vertices = mesh.positions.size() / 3, triangles = mesh.triangles.size() / 3;
    std::vector<bool> good(vertices);
    bool all_good = true;
    for (std::size_t i = 0; i < vertices; ++i) {
        const float* p = &mesh.positions[3 * i];
        good[i] = std::abs(p[0]) <= k_farthest && std::abs(p[1]) <= k_farthest && std::abs(p[2]) <= k_farthest;
        all_good = all_good && good[i];
    }
    const bool in_range =
        std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](std::uint32_t v) { return v < vertices; });
    if (all_good && in_range) return;

    std::vector<bool> keep(triangles);
    std::size_t outside = 0, infinite = 0;
    for (std::size_t t = 0; t < triangles; ++t) {
        const std::uint32_t* v = &mesh.triangles[3 * t];
        const bool known = v[0] < vertices && v[1] < vertices && v[2] < vertices;
        keep[t] = known && good[v[0]] && good[v[1]] && good[v[2]];
        outside += !known;
        infinite += known && !keep[t];
    }
    if (infinite > 0)
        problems.warn(who,
                      "has vertices that are not finite; " + counted(infinite, "triangle", "triangles") + " left out");
    if (outside > 0)
        problems.warn(
            who, "has " + counted(outside, "triangle", "triangles") + " with vertex indices out of range; left out");
    keep_triangles(mesh, keep);
    for (std::size_t i = 0; i < vertices; ++i)
        if (!good[i]) std::fill_n(mesh.positions.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, 0.0f);
}

Float3 vertex(const MeshDesc& mesh, std::size_t corner) {
    const float* p = &mesh.positions[3 * mesh.triangles[corner]];
    return {p[0], p[1], p[2]};
}

/// Normals that are not finite become the face's.
void repair_normals(MeshDesc& mesh, const std::string& who, ProblemList& problems) {
    std::size_t bad = 0;
    for (std::size_t corner = 0; corner < mesh.corner_normals.size() / 3; ++corner) {
        float* n = &mesh.corner_normals[3 * corner];
        if (finite(Float3{n[0], n[1], n[2]})) continue;
        ++bad;
        const std::size_t first = corner - corner % 3;
        const Float3 p = vertex(mesh, first);
        const Float3 face = normalize(cross(vertex(mesh, first + 1) - p, vertex(mesh, first + 2) - p));
        n[0] = face.x, n[1] = face.y, n[2] = face.z;
    }
    if (bad > 0)
        problems.warn(who, "has " + counted(bad, "normal that is", "normals that are") + " not finite; flat there");
}

void repair_attributes(MeshDesc& mesh, const std::string& who, ProblemList& problems) {
    for (AttributeDesc& attribute : mesh.attributes) {
        std::size_t bad = 0;
        for (float& value : attribute.data) {
            if (finite(value)) continue;
            value = 0;
            ++bad;
        }
        if (bad > 0)
            problems.warn(who, "has " + counted(bad, "value", "values") + " in attribute \"" + attribute.name +
                                   "\" that are not finite; 0 is used");
    }
}

void check_active(const MeshDesc& mesh, std::string& active, const char* what, const std::string& who,
                  ProblemList& problems) {
    if (active.empty()) return;
    for (const AttributeDesc& a : mesh.attributes)
        if (a.name == active) return;
    problems.warn(who, "has no " + std::string(what) + " \"" + active + '"');
    active.clear();
}

}  // namespace

void validate_mesh(MeshDesc& mesh, std::size_t index, ProblemList& problems) {
    const std::string who = label("mesh", mesh.name, index);
    if (mesh.triangles.empty()) {
        problems.warn(who, "has no faces");
        return empty_mesh(mesh);
    }
    if (!shapes_fit(mesh, who, problems)) return;
    check_sizes(mesh, who, problems);
    drop_bad_triangles(mesh, who, problems);
    for (std::int32_t& slot : mesh.slots) slot = std::max(slot, 0);
    repair_normals(mesh, who, problems);
    repair_attributes(mesh, who, problems);
    check_active(mesh, mesh.active_uv, "UV map", who, problems);
    check_active(mesh, mesh.active_color, "colour attribute", who, problems);
    if (!finite(mesh.generated_min) || !finite(mesh.generated_size)) {
        problems.warn(who, "has a texture space that is not finite");
        mesh.generated_min = {0, 0, 0};
        mesh.generated_size = {1, 1, 1};
    }
}

}  // namespace cardioid::scene
