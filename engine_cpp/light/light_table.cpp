// SPDX-License-Identifier: GPL-3.0-or-later
#include "light/light_table.h"

#include "light/emission_records.h"
#include "light/environment_map.h"
#include "light/lamp_boxes.h"
#include "light/lamp_records.h"
#include "light/light_tree.h"

#include <algorithm>
#include <numbers>

namespace cardioid::light {
namespace {

constexpr float k_pi = std::numbers::pi_v<float>;
/// Lamps and triangles, suns, the world.
static_assert(2 * k_tree_width + 1 <= k_max_entries);

template <class T>
std::int64_t bytes(const std::vector<T>& v) {
    return static_cast<std::int64_t>(v.capacity() * sizeof(T));
}

float mean_absolute(Float3 c) { return (std::fabs(c.x) + std::fabs(c.y) + std::fabs(c.z)) / 3; }

}  // namespace

struct LightTable::Storage {
    LightData data;
    std::vector<float> lamp, triangle, lamp_emission, emission_power;
    EmissionTargets targets;
    std::vector<std::int32_t> lamp_int, triangle_int, leaf_of, hittable, triangle_base, triangle_span, triangle_emitter;
    NodeStorage nodes;
    LampBoxTree boxes;
    EnvironmentMap environment;

    void set_targets(Float3 scene_min, Float3 scene_max, const PhotonTargets& casters);
    void add_lamps(const std::vector<LampInput>& lamps, Float3 scene_min, Float3 scene_max,
                   std::vector<TreeLeaf>& finite, std::vector<TreeLeaf>& suns);
    void add_triangles(const std::vector<EmissiveTriangle>& triangles, std::vector<TreeLeaf>& finite);
    void add_triangle_lookup(const std::vector<EmissiveTriangle>& triangles);
    void add_world(const WorldInput& world);
    void add_tree(std::vector<TreeLeaf>& leaves, const Checkpoint& checkpoint);
    void add_entry(int node, bool is_world);
    void set_pointers();
};

void LightTable::Storage::set_targets(Float3 scene_min, Float3 scene_max, const PhotonTargets& casters) {
    Float3 low = scene_min, high = scene_max;
    if (casters.any_casters) {
        const Float3 a = casters.casters_min, b = casters.casters_max;
        targets.casters = sphere_around(a, b);
        low = {std::min(low.x, a.x), std::min(low.y, a.y), std::min(low.z, a.z)};
        high = {std::max(high.x, b.x), std::max(high.y, b.y), std::max(high.z, b.z)};
    }
    targets.scene = sphere_around(low, high);
    if (!(targets.casters.radius > 0))
        targets.casters = {{targets.scene.center[0], targets.scene.center[1], targets.scene.center[2]}, 0};
    data.scene = targets.scene;
    data.casters = targets.casters;
    // Photons that start on the box must start outside of what touches it, whatever rounding does.
    const float farthest = std::max({std::fabs(low.x), std::fabs(low.y), std::fabs(low.z), std::fabs(high.x),
                                     std::fabs(high.y), std::fabs(high.z)});
    const float pad = 1e-5f * targets.scene.radius + 1e-6f * farthest;
    const float lows[3] = {low.x, low.y, low.z}, highs[3] = {high.x, high.y, high.z};
    for (int i = 0; i < 3; ++i) {
        data.scene_low[i] = lows[i] - pad;
        data.scene_high[i] = highs[i] + pad;
    }
}

void LightTable::Storage::add_lamps(const std::vector<LampInput>& lamps, Float3 scene_min, Float3 scene_max,
                                    std::vector<TreeLeaf>& finite, std::vector<TreeLeaf>& suns) {
    std::vector<LampBox> boxed;
    data.lamp_count = static_cast<int>(lamps.size());
    for (int i = 0; i < data.lamp_count; ++i) {
        const LampRecord r = make_lamp_record(lamps[static_cast<std::size_t>(i)], scene_min, scene_max);
        lamp.insert(lamp.end(), std::begin(r.value), std::end(r.value));
        lamp_int.insert(lamp_int.end(), std::begin(r.number), std::end(r.number));
        const EmissionRecord emission = make_emission_record(r, targets.casters);
        lamp_emission.insert(lamp_emission.end(), std::begin(emission.value), std::end(emission.value));
        emission_power.push_back(lamp_emission_power(lamps[static_cast<std::size_t>(i)], r, emission, targets));
        if (r.bounds.energy > 0) (r.at_infinity() ? suns : finite).push_back({r.bounds, i});
        if (r.hittable && r.at_infinity()) hittable.push_back(i);
        if (r.hittable && !r.at_infinity()) boxed.push_back({r.box_lower, r.box_upper, i});
    }
    data.hittable_suns = static_cast<int>(hittable.size());
    boxes = build_lamp_boxes(std::move(boxed), data.hittable_suns);
    hittable.insert(hittable.end(), boxes.lamps.begin(), boxes.lamps.end());
}

void LightTable::Storage::add_triangles(const std::vector<EmissiveTriangle>& triangles, std::vector<TreeLeaf>& finite) {
    data.triangle_count = static_cast<int>(triangles.size());
    triangle.reserve(triangles.size() * k_triangle_floats);
    triangle_int.reserve(triangles.size() * k_triangle_ints);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const EmissiveTriangle& t = triangles[i];
        const Float3 e1 = t.p1 - t.p0, e2 = t.p2 - t.p0;
        const Float3 twice = cross(e1, e2);
        const float area = 0.5f * length(twice);
        const Float3 n = normalize(twice);
        const Float3 radiance = t.program >= 0 ? Float3{1, 1, 1} : t.radiance;
        const float record[k_triangle_floats] = {t.p0.x, t.p0.y,     t.p0.z,     e1.x,       e1.y, e1.z, e2.x, e2.y,
                                                 e2.z,   radiance.x, radiance.y, radiance.z, n.x,  n.y,  n.z,  area};
        triangle.insert(triangle.end(), std::begin(record), std::end(record));
        const std::int32_t numbers[k_triangle_ints] = {t.program, t.instance, t.triangle, t.two_sided ? 1 : 0};
        triangle_int.insert(triangle_int.end(), std::begin(numbers), std::end(numbers));

        EmitterBounds bounds;
        bounds.energy = mean_absolute(t.radiance) * area;
        const bool shines = bounds.energy > 0 && std::isfinite(bounds.energy) && area > 1e-30f;
        emission_power.push_back(shines ? triangle_emission_power(t, area) : 0);
        if (!shines) continue;
        for (const Float3 p : {t.p0, t.p1, t.p2}) extend(bounds, p);
        bounds.axis = n;
        bounds.theta_o = t.two_sided ? k_pi : 0;
        bounds.theta_e = k_pi / 2;
        finite.push_back({bounds, data.lamp_count + static_cast<std::int32_t>(i)});
    }
}

void LightTable::Storage::add_triangle_lookup(const std::vector<EmissiveTriangle>& triangles) {
    std::int32_t instances = 0;
    for (const EmissiveTriangle& t : triangles) instances = std::max(instances, t.instance + 1);
    triangle_span.assign(static_cast<std::size_t>(instances), 0);
    for (const EmissiveTriangle& t : triangles) {
        if (t.instance < 0) continue;
        std::int32_t& span = triangle_span[static_cast<std::size_t>(t.instance)];
        span = std::max(span, t.triangle + 1);
    }
    std::size_t total = 0;
    for (const std::int32_t span : triangle_span) {
        triangle_base.push_back(span > 0 ? static_cast<std::int32_t>(total) : -1);
        total += static_cast<std::size_t>(span);
    }
    triangle_emitter.assign(total, -1);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const EmissiveTriangle& t = triangles[i];
        if (t.instance < 0 || t.triangle < 0) continue;
        const auto base = static_cast<std::size_t>(triangle_base[static_cast<std::size_t>(t.instance)]);
        triangle_emitter[base + static_cast<std::size_t>(t.triangle)] = data.lamp_count + static_cast<std::int32_t>(i);
    }
}

void LightTable::Storage::add_world(const WorldInput& world) {
    if (world.sampling == scene::WorldSampling::none) return;
    EnvironmentData& out = data.environment;
    EmitterBounds bounds;
    if (world.constant) {
        bounds.energy = k_pi * mean_absolute(world.color);
    } else if (world.eval) {
        environment = make_environment_map(world.eval, environment_resolution(world), world.compensate);
        bounds.energy = environment.irradiance;
    }
    if (!(bounds.energy > 0) || !std::isfinite(bounds.energy)) return;
    out.emitter = data.lamp_count + data.triangle_count;
    out.constant = world.constant;
    out.color[0] = world.constant ? world.color.x : 1;
    out.color[1] = world.constant ? world.color.y : 1;
    out.color[2] = world.constant ? world.color.z : 1;
    out.program = world.constant ? -1 : world.program;
    out.visibility = world.visibility;
    out.max_bounces = world.max_bounces;
    out.width = environment.width;
    out.height = environment.height;
    bounds.lower = bounds.upper = {0, 0, 0};
    emission_power.back() = world_emission_power(bounds.energy / k_pi, targets);
    add_entry(nodes.add(bounds, out.emitter, -1), true);
}

void LightTable::Storage::add_entry(int node, bool is_world) {
    data.entry_node[data.entry_count] = node;
    data.entry_is_world[data.entry_count] = is_world;
    ++data.entry_count;
}

void LightTable::Storage::add_tree(std::vector<TreeLeaf>& leaves, const Checkpoint& checkpoint) {
    for (const int node : build_light_tree(leaves, nodes, checkpoint)) add_entry(node, false);
}

void LightTable::Storage::set_pointers() {
    leaf_of.assign(static_cast<std::size_t>(data.lamp_count) + static_cast<std::size_t>(data.triangle_count) + 1, -1);
    for (int node = 0; node < nodes.size(); ++node) {
        const std::int32_t child = nodes.child[static_cast<std::size_t>(node)];
        if (child < 0 && ~child != k_no_emitter) leaf_of[static_cast<std::size_t>(~child)] = node;
    }
    data.emitter_count = data.lamp_count + data.triangle_count + 1;
    data.emission_power = emission_power.data();
    data.lamp_emission = lamp_emission.data();
    data.lamp = lamp.data();
    data.lamp_int = lamp_int.data();
    data.triangle = triangle.data();
    data.triangle_int = triangle_int.data();
    data.environment.seen = {environment.seen.conditional.data(), environment.seen.marginal.data()};
    data.environment.sent = {environment.sent.conditional.data(), environment.sent.marginal.data()};
    data.environment.row_z = environment.row_z.data();
    data.nodes = {nodes.record.data(), nodes.child.data(), nodes.parent.data()};
    data.leaf_of = leaf_of.data();
    data.hittable = hittable.data();
    data.hittable_count = static_cast<int>(hittable.size());
    data.box_count = static_cast<int>(boxes.first.size());
    data.box = boxes.box.data();
    data.box_first = boxes.first.data();
    data.box_lamps = boxes.count.data();
    data.instance_count = static_cast<int>(triangle_base.size());
    data.triangle_base = triangle_base.data();
    data.triangle_span = triangle_span.data();
    data.triangle_emitter = triangle_emitter.data();
}

LightTable::LightTable(const std::vector<LampInput>& lamps, const std::vector<EmissiveTriangle>& triangles,
                       const WorldInput* world, Float3 scene_min, Float3 scene_max, const Checkpoint& checkpoint,
                       const PhotonTargets& targets)
    : storage_(std::make_unique<Storage>()) {
    std::vector<TreeLeaf> finite, suns;
    storage_->set_targets(scene_min, scene_max, targets);
    storage_->add_lamps(lamps, scene_min, scene_max, finite, suns);
    storage_->add_triangles(triangles, finite);
    if (checkpoint) checkpoint();
    storage_->add_triangle_lookup(triangles);
    storage_->add_tree(finite, checkpoint);
    storage_->add_tree(suns, checkpoint);
    storage_->emission_power.push_back(0);
    if (world != nullptr) storage_->add_world(*world);
    storage_->set_pointers();
}

LightTable::~LightTable() = default;
LightTable::LightTable(LightTable&&) noexcept = default;
LightTable& LightTable::operator=(LightTable&&) noexcept = default;

const LightData& LightTable::data() const { return storage_->data; }

bool LightTable::empty() const { return storage_->data.entry_count == 0; }

std::int64_t LightTable::memory_bytes() const {
    const Storage& s = *storage_;
    return bytes(s.lamp) + bytes(s.lamp_int) + bytes(s.lamp_emission) + bytes(s.emission_power) + bytes(s.triangle) +
           bytes(s.triangle_int) + bytes(s.leaf_of) + bytes(s.hittable) + bytes(s.triangle_base) +
           bytes(s.triangle_span) + bytes(s.triangle_emitter) + bytes(s.nodes.record) + bytes(s.nodes.child) +
           bytes(s.nodes.parent) + bytes(s.boxes.box) + bytes(s.boxes.first) + bytes(s.boxes.count) +
           bytes(s.boxes.lamps) + bytes(s.environment.seen.conditional) + bytes(s.environment.seen.marginal) +
           bytes(s.environment.sent.conditional) + bytes(s.environment.sent.marginal) + bytes(s.environment.row_z);
}

}  // namespace cardioid::light
