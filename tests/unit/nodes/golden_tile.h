// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh of make_golden.py's tiles, and chunks of points on it: a quad that is tilted, turned and stretched, seen from
// above by an orthographic camera.
#pragma once

#include "nodes/compile.h"
#include "nodes/golden_file.h"
#include "nodes/shading.h"

#include <algorithm>
#include <cmath>

namespace cardioid::test {

class GoldenTile {
public:
    GoldenTile(const GoldenCase& c, const std::vector<std::string>& names) : case_(c) {
        const float cs = std::cos(0.4f), sn = std::sin(0.4f);
        instance_.object_to_world.m = {1.5f * cs, -0.8f * sn,  0, c.center[0], 1.5f * sn, 0.8f * cs,
                                       0,         c.center[1], 0, 0,           1.2f,      0};
        instance_.world_to_object.m = {cs / 1.5f, sn / 1.5f, 0, 0, -sn / 0.8f, cs / 0.8f, 0, 0, 0, 0, 1 / 1.2f, 0};
        const Float3 origin = instance_.world_to_object.vector({-c.center[0], -c.center[1], 0});
        instance_.world_to_object.m[3] = origin.x;
        instance_.world_to_object.m[7] = origin.y;
        instance_.world_to_object.m[11] = origin.z;
        instance_.location = {c.center[0], c.center[1], 0};
        instance_.pass_index = 7;
        add_corners();
        add_attributes(names);
        tables_.triangles = triangles_;
        tables_.positions = positions_;
        tables_.floats = floats_.data();
        tables_.attributes = refs_.data();
        tables_.attribute_names = static_cast<int>(refs_.size());
        tables_.instances = &instance_;
        tables_.meshes = &mesh_;
        tables_.camera_to_world.m[11] = 10;
        tables_.world_to_camera.m[11] = -10;
        tables_.orthographic = true;
        tables_.view_plane = {-16, 16, -case_.half_height, case_.half_height};
    }

    void fill(nodes::ShadingChunk& chunk) const {
        chunk.geometry = &tables_;
        for (int i = 0; i < k_chunk; ++i) fill_lane(chunk, i, static_cast<std::size_t>(std::min(i, chunk.n - 1)) * 3);
    }

    bool on_diagonal(int i) const {
        const std::size_t p = static_cast<std::size_t>(i) * 3;
        return std::abs(case_.points[p] - case_.center[0] - (case_.points[p + 1] - case_.center[1])) < 1e-3f;
    }

private:
    static constexpr float k_corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

    void add_corners() {
        Float3 low{1e9f, 1e9f, 1e9f}, high{-1e9f, -1e9f, -1e9f};
        for (int k = 0; k < 4; ++k) {
            const float x = k_corner[k][0], y = k_corner[k][1];
            world_[k] = {case_.center[0] + x, case_.center[1] + y, 0.3f * x + 0.2f * y};
            const Float3 p = instance_.world_to_object.point(world_[k]);
            positions_[3 * k] = p.x;
            positions_[3 * k + 1] = p.y;
            positions_[3 * k + 2] = p.z;
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
        mesh_.generated_min = low;
        mesh_.generated_size = high - low;
    }

    void add_attributes(const std::vector<std::string>& names) {
        for (const std::uint32_t v : triangles_) {
            const float x = k_corner[v][0], y = k_corner[v][1];
            floats_.insert(floats_.end(), {x * 0.7f + y * 0.2f, y * 0.6f});
        }
        const auto colors = static_cast<std::uint32_t>(floats_.size());
        for (int k = 0; k < 4; ++k) {
            const float f = static_cast<float>(k);
            floats_.insert(floats_.end(), {0.2f * f, 0.9f - 0.1f * f, 0.3f, 1 - 0.2f * f});
        }
        for (const auto& name : names) {
            if (name == "UVMap" || name == nodes::k_active_uv)
                refs_.push_back({0, 1, 2});
            else if (name == "Col" || name == nodes::k_active_color)
                refs_.push_back({colors, 0, 4});
            else
                refs_.push_back({});
        }
    }

    void fill_lane(nodes::ShadingChunk& c, int i, std::size_t point) const {
        const float a = case_.points[point] - case_.center[0], b = case_.points[point + 1] - case_.center[1];
        const Float3 n = normalize(Float3{-0.3f, -0.2f, 1});
        const bool first = a > b + 5e-4f;  // Cycles gives the diagonal to the second triangle
        c.triangle[i] = first ? 0 : 1;
        c.mesh[i] = c.instance[i] = 0;
        c.barycentric_u[i] = first ? (a - b) / 2 : (a + 1) / 2;
        c.barycentric_v[i] = first ? (b + 1) / 2 : (b - a) / 2;
        const std::uint32_t* t = triangles_ + (first ? 0 : 3);
        set(c.position, i, {case_.points[point], case_.points[point + 1], case_.points[point + 2]});
        set(c.normal, i, n);
        set(c.normal_geometric, i, n);
        set(c.wo, i, {0, 0, 1});
        set(c.dp_du, i, world_[t[1]] - world_[t[0]]);
        set(c.dp_dv, i, world_[t[2]] - world_[t[0]]);
        c.footprint[i] = case_.pixel;
        c.ray_length[i] = 9.9f - case_.points[point + 2];  // from the near clipping plane
        c.backfacing[i] = 0;
        c.ray_flags[i] = nodes::ray_camera;
    }

    static void set(Row* rows, int i, Float3 v) {
        rows[0][i] = v.x;
        rows[1][i] = v.y;
        rows[2][i] = v.z;
    }

    const GoldenCase& case_;
    std::uint32_t triangles_[6] = {0, 1, 2, 0, 2, 3};
    float positions_[12]{};
    Float3 world_[4];
    std::vector<float> floats_;
    std::vector<nodes::AttributeRef> refs_;
    nodes::InstanceInfo instance_;
    nodes::MeshInfo mesh_;
    nodes::GeometryTables tables_;
};

}  // namespace cardioid::test
