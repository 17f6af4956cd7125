// SPDX-License-Identifier: GPL-3.0-or-later
// All meshes and placed instances in flat arrays, as GeometryTables and InstanceArrays want them. Groups are flattened here;
// a mesh that is placed once is stored in world space, which saves every ray an instance transform.
#pragma once

#include "scene/scene_desc.h"
#include "trace/placed_list.h"
#include "trace/scene_view.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cardioid::trace {

/// What programs read by name: the index is the id.
struct PoolNames {
    std::vector<std::string> attributes, instance_values;
};

/// Meshes that stand in for those of the scene in some of their places.
struct MeshVariants {
    std::vector<scene::MeshDesc> meshes;
    std::vector<std::int32_t> of;  ///< by place in PlacedList: index into `meshes`, or -1; empty: none at all
};

class GeometryPool {
public:
    /// `default_material`: id for empty slots. Copies what it needs of `variants`.
    GeometryPool(const scene::SceneDesc& desc, const PoolNames& names, int default_material,
                 const MeshVariants& variants = {});

    void fill(SceneView& view) const;
    std::int64_t memory_bytes() const;

    struct MeshRange {
        std::uint32_t first_triangle = 0, triangles = 0, first_vertex = 0, vertices = 0;
        bool used = false, baked = false, smooth = false;
        bool multi_material = false;
    };
    const std::vector<MeshRange>& meshes() const { return ranges_; }
    const std::vector<PlacedMesh>& placed() const { return list_.meshes; }
    const float* positions(int mesh) const { return positions_.data() + 3 * std::size_t{ranges_[mesh].first_vertex}; }
    const std::uint32_t* triangles(int mesh) const {
        return triangles_.data() + 3 * std::size_t{ranges_[mesh].first_triangle};
    }
    bool baked(int instance) const { return baked_[instance] != 0; }
    /// Material id of a triangle of an instance.
    int material(int instance, std::uint32_t triangle) const;
    /// Materials that the instance's mesh really uses, without repeats.
    std::vector<int> materials_of(int instance) const;
    /// Corners of a triangle in world space.
    void world_triangle(int instance, std::uint32_t triangle, Float3 corner[3]) const;

private:
    using Sources = std::vector<const scene::MeshDesc*>;

    void copy_meshes(const Sources& sources);
    void copy_attributes(const Sources& sources, const std::vector<std::string>& names);
    void add_attribute(const scene::MeshDesc& mesh, const std::string& name, nodes::AttributeRef& ref);
    void collect_values(const std::vector<std::string>& names);
    void make_instances(const Sources& sources, int default_material);
    void add_lamps(const scene::SceneDesc& desc);

    PlacedList list_;
    std::vector<MeshRange> ranges_;
    std::vector<float> positions_;
    std::vector<std::uint32_t> triangles_;
    std::vector<std::uint32_t> packed_normals_;
    std::vector<std::int32_t> slots_;
    std::vector<std::int32_t> slot_materials_;
    std::vector<float> floats_;
    std::vector<nodes::AttributeRef> attributes_;
    std::vector<nodes::InstanceInfo> infos_;
    std::vector<nodes::MeshInfo> mesh_infos_;
    std::vector<std::int32_t> mesh_, first_triangle_, first_vertex_, smooth_, baked_, flip_, slot_mask_,
        first_material_, holdout_, visibility_;
    std::vector<float> instance_values_;
    int attribute_names_ = 0, instance_value_names_ = 0;
    std::vector<float> terminator_geometry_, terminator_shading_;
    std::int32_t first_lamp_ = 0;
    bool any_holdout_ = false;
};

}  // namespace cardioid::trace
