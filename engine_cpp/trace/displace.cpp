// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace/displace.h"

#include "nodes/compile.h"
#include "nodes/run.h"
#include "trace/displaced_normals.h"
#include "trace/mesh_attributes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <memory>
#include <thread>

namespace cardioid::trace {
namespace {

using scene::MeshDesc;

constexpr std::size_t k_chunks_a_round = 2048;  ///< between two looks at whether to go on

/// A vertex and the corner of the triangle whose material moves it.
struct Move {
    std::int32_t material;
    std::uint32_t corner;
};

/// Displacing material of each slot that a mesh uses, -1 for the others: what tells variants apart.
using SlotKey = std::vector<int>;

SlotKey displacing_slots(const MeshDesc& mesh, const scene::InstanceDesc& instance,
                         const std::vector<MaterialView>& materials, int default_material) {
    SlotKey key(mesh.slots.empty() ? 1 : 1 + *std::max_element(mesh.slots.begin(), mesh.slots.end()), -1);
    bool any = false;
    for (std::size_t t = 0; t < std::max<std::size_t>(1, mesh.slots.size()); ++t) {
        const int slot = mesh.slots.empty() ? 0 : mesh.slots[t];
        const int id = material_of_slot(instance, slot, default_material);
        if (!materials[id].displacement) continue;
        key[slot] = id;
        any = true;
    }
    return any ? key : SlotKey{};
}

float finite_or_zero(float x) { return std::isfinite(x) ? x : 0.0f; }

Float3 position(const MeshDesc& mesh, std::uint32_t vertex) {
    const float* p = &mesh.positions[3 * std::size_t{vertex}];
    return {p[0], p[1], p[2]};
}

void set_row(Row rows[3], int lane, Float3 v) {
    rows[0][lane] = v.x;
    rows[1][lane] = v.y;
    rows[2][lane] = v.z;
}

/// Works out where vertices of one mesh go under its first instance; one for each thread.
class Evaluator {
public:
    Evaluator(const MeshDesc& mesh, const std::vector<Float3>& normals, const nodes::GeometryTables& geometry,
              const std::vector<MaterialView>& materials)
        : mesh_(mesh), normals_(normals), at_(geometry.instances[0]), materials_(materials) {
        chunk_->geometry = &geometry;
    }

    /// Up to k_chunk moves of one material; writes offsets in object space, by vertex.
    void run(const Move* moves, int n, std::vector<Float3>& offsets) {
        nodes::ShadingChunk& c = *chunk_;
        c.n = n;
        c.material_pass_index = materials_[moves[0].material].pass_index;
        for (int lane = 0; lane < k_chunk; ++lane) set_lane(lane, moves[std::min(lane, n - 1)].corner);
        for (auto& row : out_->displacement) std::fill_n(row, k_chunk, 0.0f);
        CD_ISA_NS::run_program(*materials_[moves[0].material].displacement, c, *out_, *scratch_);
        for (int lane = 0; lane < n; ++lane) {
            const Float3 world{out_->displacement[0][lane], out_->displacement[1][lane], out_->displacement[2][lane]};
            const Float3 d = at_.world_to_object.vector(world);
            offsets[mesh_.triangles[moves[lane].corner]] = {finite_or_zero(d.x), finite_or_zero(d.y),
                                                            finite_or_zero(d.z)};
        }
    }

private:
    /// There is no ray: the view direction is zero, as in Cycles.
    void set_lane(int lane, std::uint32_t corner) {
        nodes::ShadingChunk& c = *chunk_;
        const std::uint32_t triangle = corner / 3, vertex = mesh_.triangles[corner];
        const std::uint32_t* v = &mesh_.triangles[3 * std::size_t{triangle}];
        const Float3 p0 = position(mesh_, v[0]), e1 = position(mesh_, v[1]) - p0, e2 = position(mesh_, v[2]) - p0;
        set_row(c.position, lane, at_.object_to_world.point(position(mesh_, vertex)));
        set_row(c.normal, lane, normalize(at_.world_to_object.transposed_vector(normals_[vertex])));
        set_row(c.normal_geometric, lane, normalize(at_.world_to_object.transposed_vector(cross(e1, e2))));
        set_row(c.dp_du, lane, at_.object_to_world.vector(e1));
        set_row(c.dp_dv, lane, at_.object_to_world.vector(e2));
        c.barycentric_u[lane] = corner % 3 == 1 ? 1.0f : 0.0f;
        c.barycentric_v[lane] = corner % 3 == 2 ? 1.0f : 0.0f;
        c.triangle[lane] = static_cast<std::int32_t>(triangle);
    }

    const MeshDesc& mesh_;
    const std::vector<Float3>& normals_;
    const nodes::InstanceInfo& at_;
    const std::vector<MaterialView>& materials_;
    std::unique_ptr<nodes::ShadingChunk> chunk_ = std::make_unique<nodes::ShadingChunk>();
    std::unique_ptr<nodes::SurfaceOutput> out_ = std::make_unique<nodes::SurfaceOutput>();
    std::unique_ptr<nodes::Scratch> scratch_ = std::make_unique<nodes::Scratch>();
};

/// Every vertex that moves, sorted by material so that chunks are full.
std::vector<Move> moves_of(const MeshDesc& mesh, const SlotKey& slots) {
    std::vector<bool> done(mesh.positions.size() / 3, false);
    std::vector<Move> moves;
    for (std::uint32_t c = 0; c < mesh.triangles.size(); ++c) {
        const int id = slots[mesh.slots.empty() ? 0 : mesh.slots[c / 3]];
        if (id < 0 || done[mesh.triangles[c]]) continue;
        done[mesh.triangles[c]] = true;
        moves.push_back({id, c});
    }
    std::stable_sort(moves.begin(), moves.end(), [](Move a, Move b) { return a.material < b.material; });
    return moves;
}

/// First move of each chunk, and the end.
std::vector<std::size_t> chunks_of(const std::vector<Move>& moves) {
    std::vector<std::size_t> begins;
    for (std::size_t i = 0; i < moves.size(); ++i) {
        const bool full = !begins.empty() && i - begins.back() == k_chunk;
        if (i == 0 || full || moves[i].material != moves[i - 1].material) begins.push_back(i);
    }
    begins.push_back(moves.size());
    return begins;
}

/// Moves the vertices on `threads` threads. Each is worked out alone, so their number changes nothing.
void move_vertices(MeshDesc& mesh, const SlotKey& slots, const nodes::GeometryTables& geometry,
                   const std::vector<MaterialView>& materials, int threads, const std::function<void()>& checkpoint) {
    const std::vector<Move> moves = moves_of(mesh, slots);
    const std::vector<std::size_t> begins = chunks_of(moves);
    const std::vector<Float3> normals = smooth_normals(mesh);
    std::vector<Float3> offsets(mesh.positions.size() / 3);
    std::vector<std::unique_ptr<Evaluator>> evaluators;
    for (int t = 0; t < threads; ++t)
        evaluators.push_back(std::make_unique<Evaluator>(mesh, normals, geometry, materials));
    for (std::size_t first = 0; first + 1 < begins.size(); first += k_chunks_a_round) {
        checkpoint();
        const std::size_t end = std::min(first + k_chunks_a_round, begins.size() - 1);
        std::atomic<std::size_t> next{first};
        const auto work = [&](Evaluator& evaluator) {
            for (std::size_t k = next++; k < end; k = next++)
                evaluator.run(&moves[begins[k]], static_cast<int>(begins[k + 1] - begins[k]), offsets);
        };
        std::vector<std::jthread> others;
        for (std::size_t t = 1; t < evaluators.size(); ++t) others.emplace_back([&, t] { work(*evaluators[t]); });
        work(*evaluators[0]);
    }
    for (std::size_t v = 0; v < offsets.size(); ++v) {
        mesh.positions[3 * v] += offsets[v].x;
        mesh.positions[3 * v + 1] += offsets[v].y;
        mesh.positions[3 * v + 2] += offsets[v].z;
    }
}

int thread_count(const scene::Settings& settings) {
    const int all = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
    return settings.threads > 0 ? std::min(settings.threads, all) : all;
}

/// Named attributes that would follow from the moved shape are stored as they were before.
void keep_shape_attributes(MeshDesc& mesh, const std::vector<std::string>& names) {
    const auto wanted = [&](const char* name) {
        return std::find(names.begin(), names.end(), name) != names.end() &&
               std::none_of(mesh.attributes.begin(), mesh.attributes.end(),
                            [&](const auto& a) { return a.name == name; });
    };
    if (wanted(nodes::k_random_island))
        mesh.attributes.push_back({nodes::k_random_island, scene::Domain::face, 1, random_per_island(mesh)});
    if (wanted(nodes::k_pointiness))
        mesh.attributes.push_back({nodes::k_pointiness, scene::Domain::point, 1, pointiness(mesh)});
    if (wanted(nodes::k_undisplaced))
        mesh.attributes.push_back({nodes::k_undisplaced, scene::Domain::point, 3, mesh.positions});
}

/// The mesh alone, placed as `placed` is.
scene::SceneDesc alone(const MeshDesc& mesh, const PlacedMesh& placed, const PlacedList& list) {
    scene::SceneDesc one;
    one.meshes.push_back(mesh);
    one.instances.push_back(*placed.desc);
    one.instances[0].mesh = 0;
    one.instances[0].transform = placed.transform;
    one.instances[0].values = list.values(placed);
    return one;
}

MeshDesc displaced(const MeshDesc& mesh, const PlacedMesh& placed, const PlacedList& list, const SlotKey& slots,
                   const PoolNames& names, const SceneView& view, const std::vector<MaterialView>& materials,
                   const std::vector<scene::MaterialDesc>& descs, int default_material,
                   const std::function<void()>& checkpoint) {
    scene::SceneDesc one = alone(mesh, placed, list);
    keep_shape_attributes(one.meshes[0], names.attributes);
    const GeometryPool pool(one, names, default_material);
    SceneView probe = view;
    pool.fill(probe);
    MeshDesc moved = std::move(one.meshes[0]);
    move_vertices(moved, slots, probe.geometry, materials, thread_count(view.settings), checkpoint);
    const auto reshaded = [&](std::size_t triangle) {
        const int id = slots[moved.slots.empty() ? 0 : moved.slots[triangle]];
        return id >= 0 && descs[id].displacement_method == scene::DisplacementMethod::displacement;
    };
    if (!moved.corner_normals.empty()) moved.corner_normals = displaced_normals(mesh, moved.positions, reshaded);
    return moved;
}

}  // namespace

MeshVariants displaced_meshes(const scene::SceneDesc& desc, const PoolNames& names, const SceneView& view,
                              const std::vector<MaterialView>& materials, int default_material,
                              const std::function<void()>& checkpoint) {
    MeshVariants variants;
    if (std::none_of(materials.begin(), materials.end(), [](const MaterialView& m) { return m.displacement; }))
        return variants;
    const PlacedList list(desc);
    variants.of.assign(list.meshes.size(), -1);
    std::map<std::pair<int, SlotKey>, int> known;
    for (std::size_t i = 0; i < list.meshes.size(); ++i) {
        const PlacedMesh& placed = list.meshes[i];
        const MeshDesc& mesh = desc.meshes[placed.mesh];
        SlotKey slots = displacing_slots(mesh, *placed.desc, materials, default_material);
        if (slots.empty()) continue;
        const auto [entry, fresh] =
            known.try_emplace({placed.mesh, std::move(slots)}, static_cast<int>(variants.meshes.size()));
        variants.of[i] = entry->second;
        if (!fresh) continue;
        variants.meshes.push_back(displaced(mesh, placed, list, entry->first.second, names, view, materials,
                                            desc.materials, default_material, checkpoint));
    }
    return variants;
}

}  // namespace cardioid::trace
