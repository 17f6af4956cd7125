// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace/placed_list.h"

#include <algorithm>

namespace cardioid::trace {
namespace {

/// Groups may nest; validation refuses loops, this bound only keeps a bug from hanging.
constexpr int k_max_group_depth = 64;

}  // namespace

PlacedList::PlacedList(const scene::SceneDesc& desc) {
    meshes.reserve(desc.instances.size());
    for (const auto& i : desc.instances) place(desc, i, PlacedMesh{}, 0);
}

void PlacedList::place(const scene::SceneDesc& desc, const scene::InstanceDesc& instance, const PlacedMesh& parent,
                       int depth) {
    PlacedMesh here{&instance, depth == 0 ? instance.transform : parent.transform * instance.transform,
                    static_cast<std::uint8_t>(parent.visibility & instance.visibility), parent.group, instance.mesh};
    if (instance.mesh >= 0) {
        if (!desc.meshes[instance.mesh].triangles.empty()) meshes.push_back(here);
        return;
    }
    if (instance.group < 0 || depth >= k_max_group_depth) return;
    groups.push_back({&instance, parent.group});
    here.group = static_cast<std::int32_t>(groups.size()) - 1;
    for (const auto& child : desc.groups[instance.group].instances) place(desc, child, here, depth + 1);
}

std::vector<scene::InstanceValueDesc> PlacedList::values(const PlacedMesh& placed) const {
    std::vector<const scene::InstanceDesc*> chain{placed.desc};
    for (std::int32_t g = placed.group; g >= 0; g = groups[g].outer) chain.push_back(groups[g].desc);
    std::vector<scene::InstanceValueDesc> all;
    for (auto desc = chain.rbegin(); desc != chain.rend(); ++desc)
        all.insert(all.end(), (*desc)->values.begin(), (*desc)->values.end());
    return all;
}

int material_of_slot(const scene::InstanceDesc& instance, int slot, int default_material) {
    const auto& list = instance.materials;
    if (list.empty()) return default_material;
    const int id = list[std::min(static_cast<std::size_t>(slot), list.size() - 1)];
    return id < 0 ? default_material : id;
}

}  // namespace cardioid::trace
