// SPDX-License-Identifier: GPL-3.0-or-later
// The placed meshes of a scene with groups taken apart, always in the same order.
#pragma once

#include "scene/scene_desc.h"

#include <cstdint>
#include <vector>

namespace cardioid::trace {

struct PlacedMesh {
    const scene::InstanceDesc* desc = nullptr;
    Affine transform;
    std::uint8_t visibility = scene::visible_all;
    std::int32_t group = -1;  ///< the placed group that it stands in, of PlacedList::groups; -1: none
    std::int32_t mesh = -1;   ///< in SceneDesc::meshes; GeometryPool puts variants after those
};

struct PlacedGroup {
    const scene::InstanceDesc* desc;
    std::int32_t outer;  ///< group that it stands in itself, or -1
};

struct PlacedList {
    std::vector<PlacedMesh> meshes;
    std::vector<PlacedGroup> groups;

    /// Meshes without triangles are left out.
    explicit PlacedList(const scene::SceneDesc& desc);
    /// What nodes read by name: the inner instance's values after those of the groups around it, so that the last one counts.
    std::vector<scene::InstanceValueDesc> values(const PlacedMesh& placed) const;

private:
    void place(const scene::SceneDesc& desc, const scene::InstanceDesc& instance, const PlacedMesh& parent, int depth);
};

/// Material of a slot of an instance; a slot beyond the list takes the last one, as in Blender.
int material_of_slot(const scene::InstanceDesc& instance, int slot, int default_material);

}  // namespace cardioid::trace
