// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace/geometry_pool.h"

#include "nodes/compile.h"
#include "trace/mesh_attributes.h"
#include "trace/octahedral.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <unordered_map>

namespace cardioid::trace {

namespace {
/// Under which name a mesh has what programs call `name`.
std::string own_name(const scene::MeshDesc& mesh, const std::string& name) {
    if (name == nodes::k_active_uv) return mesh.active_uv;
    if (name == nodes::k_active_color) return mesh.active_color;
    const std::string prefix = nodes::k_tangent_prefix;
    return name == prefix + nodes::k_active_uv ? prefix + mesh.active_uv : name;
}

const scene::AttributeDesc* find_attribute(const scene::MeshDesc& mesh, const std::string& name) {
    const std::string wanted = own_name(mesh, name);
    for (const auto& a : mesh.attributes) {
        if (a.name == wanted) return &a;
    }
    return nullptr;
}
}  // namespace

GeometryPool::GeometryPool(const scene::SceneDesc& desc, const PoolNames& names, int default_material,
                           const MeshVariants& variants)
    : list_(desc) {
    Sources sources;
    for (const auto& mesh : desc.meshes) sources.push_back(&mesh);
    for (const auto& mesh : variants.meshes) sources.push_back(&mesh);
    for (std::size_t i = 0; i < variants.of.size(); ++i) {
        if (variants.of[i] >= 0) list_.meshes[i].mesh = static_cast<std::int32_t>(desc.meshes.size()) + variants.of[i];
    }
    copy_meshes(sources);
    copy_attributes(sources, names.attributes);
    make_instances(sources, default_material);
    add_lamps(desc);
    collect_values(names.instance_values);
}

void GeometryPool::copy_meshes(const Sources& sources) {
    std::vector<const PlacedMesh*> only_user(sources.size(), nullptr);
    std::vector<int> users(sources.size(), 0);
    for (const auto& p : list_.meshes) {
        ++users[p.mesh];
        only_user[p.mesh] = &p;
    }
    ranges_.resize(sources.size());
    std::size_t vertices = 0, triangles = 0;
    for (std::size_t m = 0; m < sources.size(); ++m) {
        MeshRange& r = ranges_[m];
        const scene::MeshDesc& mesh = *sources[m];
        r.used = users[m] > 0;
        if (!r.used) continue;
        r.baked = users[m] == 1;
        r.smooth = !mesh.corner_normals.empty();
        r.multi_material = std::any_of(mesh.slots.begin(), mesh.slots.end(), [](int s) { return s != 0; });
        r.first_vertex = static_cast<std::uint32_t>(vertices);
        r.first_triangle = static_cast<std::uint32_t>(triangles);
        r.vertices = static_cast<std::uint32_t>(mesh.positions.size() / 3);
        r.triangles = static_cast<std::uint32_t>(mesh.triangles.size() / 3);
        vertices += r.vertices;
        triangles += r.triangles;
    }
    // Embree reads up to 4 bytes past the last vertex; gathers of masked lanes need at least one element.
    positions_.assign(3 * vertices + 4, 0.0f);
    triangles_.assign(3 * triangles + 3, 0);
    const bool any_smooth =
        std::any_of(ranges_.begin(), ranges_.end(), [](const MeshRange& r) { return r.used && r.smooth; });
    packed_normals_.assign(any_smooth ? 3 * triangles + 3 : 3, 0);
    const bool any_slots =
        std::any_of(ranges_.begin(), ranges_.end(), [](const MeshRange& r) { return r.used && r.multi_material; });
    slots_.assign(any_slots ? triangles + 1 : 1, 0);
    for (std::size_t m = 0; m < sources.size(); ++m) {
        const MeshRange& r = ranges_[m];
        if (!r.used) continue;
        const scene::MeshDesc& mesh = *sources[m];
        std::memcpy(triangles_.data() + 3 * std::size_t{r.first_triangle}, mesh.triangles.data(),
                    mesh.triangles.size() * sizeof(std::uint32_t));
        float* out = positions_.data() + 3 * std::size_t{r.first_vertex};
        std::memcpy(out, mesh.positions.data(), mesh.positions.size() * sizeof(float));
        Affine normal_map;
        if (r.baked) {
            const Affine& t = only_user[m]->transform;
            normal_map = inverse(t);
            for (std::uint32_t i = 0; i < r.vertices; ++i) {
                const Float3 p = t.point({out[3 * i], out[3 * i + 1], out[3 * i + 2]});
                out[3 * i] = p.x;
                out[3 * i + 1] = p.y;
                out[3 * i + 2] = p.z;
            }
        }
        if (r.smooth) {
            std::uint32_t* packed = packed_normals_.data() + 3 * std::size_t{r.first_triangle};
            for (std::size_t c = 0; c < 3 * std::size_t{r.triangles}; ++c) {
                const float* n = mesh.corner_normals.data() + 3 * c;
                packed[c] =
                    pack_normal(r.baked ? normal_map.transposed_vector({n[0], n[1], n[2]}) : Float3{n[0], n[1], n[2]});
            }
        }
        if (r.multi_material) std::copy(mesh.slots.begin(), mesh.slots.end(), slots_.begin() + r.first_triangle);
    }
}

void GeometryPool::copy_attributes(const Sources& sources, const std::vector<std::string>& names) {
    attribute_names_ = static_cast<int>(names.size());
    // The last mesh is that of lamps: it has nothing.
    attributes_.assign(std::max<std::size_t>(1, (sources.size() + 1) * names.size()), {});
    floats_.assign(4, 0.0f);
    for (std::size_t m = 0; m < sources.size(); ++m) {
        if (!ranges_[m].used) continue;
        for (std::size_t a = 0; a < names.size(); ++a)
            add_attribute(*sources[m], names[a], attributes_[m * names.size() + a]);
    }
    mesh_infos_.assign(sources.size() + 1, {0, 0, {0, 0, 0}, {1, 1, 1}});
    for (std::size_t m = 0; m < sources.size(); ++m) {
        mesh_infos_[m] = {ranges_[m].first_triangle, ranges_[m].first_vertex, sources[m]->generated_min,
                          sources[m]->generated_size};
    }
}

void GeometryPool::add_attribute(const scene::MeshDesc& mesh, const std::string& name, nodes::AttributeRef& ref) {
    const auto add = [&](scene::Domain domain, int channels, const std::vector<float>& data) {
        ref.offset = static_cast<std::uint32_t>(floats_.size());
        ref.domain = static_cast<std::uint8_t>(domain);
        ref.channels = static_cast<std::uint8_t>(channels);
        floats_.insert(floats_.end(), data.begin(), data.end());
    };
    if (const scene::AttributeDesc* found = find_attribute(mesh, name)) {
        add(found->domain, found->channels, found->data);
    } else if (name == nodes::k_random_island) {
        add(scene::Domain::face, 1, random_per_island(mesh));
    } else if (name == nodes::k_pointiness) {
        add(scene::Domain::point, 1, pointiness(mesh));
    }
}

void GeometryPool::collect_values(const std::vector<std::string>& names) {
    instance_value_names_ = static_cast<int>(names.size());
    instance_values_.assign(std::max<std::size_t>(1, infos_.size() * names.size()) * 4, 0.0f);
    if (names.empty()) return;
    std::unordered_map<std::string_view, std::size_t> ids;
    for (std::size_t k = 0; k < names.size(); ++k) ids.emplace(names[k], k);
    for (std::size_t i = 0; i < list_.meshes.size(); ++i) {
        for (const scene::InstanceValueDesc& v : list_.values(list_.meshes[i])) {
            const auto id = ids.find(v.name);
            if (id == ids.end()) continue;
            std::copy(v.value.begin(), v.value.end(), &instance_values_[4 * (i * names.size() + id->second)]);
        }
    }
}

void GeometryPool::make_instances(const Sources& sources, int default_material) {
    for (const PlacedMesh& p : list_.meshes) {
        const int m = p.mesh;
        const MeshRange& r = ranges_[m];
        nodes::InstanceInfo info;
        info.object_to_world = p.transform;
        info.world_to_object = inverse(p.transform);
        info.mesh = m;
        info.random = p.desc->random;
        info.pass_index = static_cast<float>(p.desc->pass_index);
        std::copy(p.desc->color.begin(), p.desc->color.end(), info.color);
        info.location = p.transform.translation();
        info.dupli_generated = p.desc->dupli_generated;
        info.dupli_uv[0] = p.desc->dupli_uv[0];
        info.dupli_uv[1] = p.desc->dupli_uv[1];
        infos_.push_back(info);
        mesh_.push_back(m);
        first_triangle_.push_back(static_cast<std::int32_t>(r.first_triangle));
        first_vertex_.push_back(static_cast<std::int32_t>(r.first_vertex));
        smooth_.push_back(r.smooth);
        baked_.push_back(r.baked);
        flip_.push_back(r.baked && p.transform.determinant() < 0);
        slot_mask_.push_back(r.multi_material ? -1 : 0);
        first_material_.push_back(static_cast<std::int32_t>(slot_materials_.size()));
        holdout_.push_back(p.desc->holdout);
        visibility_.push_back(p.visibility);
        terminator_geometry_.push_back(r.smooth ? p.desc->terminator_geometry : 0);
        terminator_shading_.push_back(p.desc->terminator_shading);
        any_holdout_ = any_holdout_ || p.desc->holdout;
        const auto& slots = sources[m]->slots;
        const int slot_count = slots.empty() ? 1 : *std::max_element(slots.begin(), slots.end()) + 1;
        for (int s = 0; s < slot_count; ++s) {
            slot_materials_.push_back(material_of_slot(*p.desc, s, default_material));
        }
    }
    if (infos_.empty()) {
        infos_.emplace_back();
        for (auto* v : {&mesh_, &first_triangle_, &first_vertex_, &smooth_, &baked_, &flip_, &slot_mask_,
                        &first_material_, &holdout_, &visibility_})
            v->push_back(0);
        slot_materials_.push_back(default_material);
        terminator_geometry_.push_back(0);
        terminator_shading_.push_back(0);
    }
}

void GeometryPool::add_lamps(const scene::SceneDesc& desc) {
    first_lamp_ = static_cast<std::int32_t>(infos_.size());
    for (const scene::LightDesc& light : desc.lights) {
        nodes::InstanceInfo info;
        // Before Blender 4.5 lamps are no objects: of all transforms, only that of normals is theirs.
        info.object_to_world = light.transform;
        if (light.object_space) info.world_to_object = inverse(light.transform);
        if (light.object_space) info.location = light.transform.translation();
        info.mesh = static_cast<std::int32_t>(ranges_.size());
        info.random = light.random;
        std::fill(std::begin(info.color), std::end(info.color), 0.0f);
        infos_.push_back(info);
        mesh_.push_back(info.mesh);
    }
}

int GeometryPool::material(int instance, std::uint32_t triangle) const {
    const std::int32_t mask = slot_mask_[instance];
    const std::int32_t slot = mask != 0 ? slots_[first_triangle_[instance] + triangle] : 0;
    return slot_materials_[first_material_[instance] + slot];
}

std::vector<int> GeometryPool::materials_of(int instance) const {
    const MeshRange& r = ranges_[mesh_[instance]];
    std::vector<int> ids;
    if (!r.multi_material) {
        ids.push_back(slot_materials_[first_material_[instance]]);
        return ids;
    }
    std::vector<bool> seen;
    for (std::uint32_t t = 0; t < r.triangles; ++t) {
        const auto slot = static_cast<std::size_t>(slots_[r.first_triangle + t]);
        if (slot >= seen.size()) seen.resize(slot + 1, false);
        if (!seen[slot]) {
            seen[slot] = true;
            ids.push_back(slot_materials_[first_material_[instance] + static_cast<int>(slot)]);
        }
    }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
}

void GeometryPool::world_triangle(int instance, std::uint32_t triangle, Float3 corner[3]) const {
    const int mesh = mesh_[instance];
    const std::uint32_t* t = triangles(mesh) + 3 * std::size_t{triangle};
    for (int k = 0; k < 3; ++k) {
        const float* p = positions(mesh) + 3 * std::size_t{t[k]};
        corner[k] = {p[0], p[1], p[2]};
        if (!baked(instance)) corner[k] = infos_[instance].object_to_world.point(corner[k]);
    }
}

void GeometryPool::fill(SceneView& view) const {
    nodes::GeometryTables& g = view.geometry;
    g.triangles = triangles_.data();
    g.positions = positions_.data();
    g.floats = floats_.data();
    g.attributes = attributes_.data();
    g.attribute_names = attribute_names_;
    g.instances = infos_.data();
    g.meshes = mesh_infos_.data();
    g.instance_values = {instance_values_.data(), instance_value_names_};
    view.instances = {mesh_.data(),    first_triangle_.data(), first_vertex_.data(),        smooth_.data(),
                      baked_.data(),   flip_.data(),           slot_mask_.data(),           first_material_.data(),
                      holdout_.data(), visibility_.data(),     terminator_geometry_.data(), terminator_shading_.data()};
    const auto some = [](const std::vector<float>& v) {
        return std::any_of(v.begin(), v.end(), [](float x) { return x > 0; });
    };
    view.lifts_shadow_rays = some(terminator_geometry_);
    view.narrows_diffuse = some(terminator_shading_);
    view.first_lamp_instance = first_lamp_;
    view.packed_normals = packed_normals_.data();
    view.slots = slots_.data();
    view.slot_materials = slot_materials_.data();
    view.any_holdout = any_holdout_;
}

std::int64_t GeometryPool::memory_bytes() const {
    return static_cast<std::int64_t>(positions_.capacity() * 4 + triangles_.capacity() * 4 +
                                     packed_normals_.capacity() * 4 + slots_.capacity() * 4 + floats_.capacity() * 4 +
                                     instance_values_.capacity() * 4 + infos_.capacity() * sizeof(nodes::InstanceInfo) +
                                     mesh_.capacity() * 10 * 4 + slot_materials_.capacity() * 4);
}

}  // namespace cardioid::trace
