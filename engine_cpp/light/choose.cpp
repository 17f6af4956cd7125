// SPDX-License-Identifier: GPL-3.0-or-later
#include "light/choose.h"

#include "light/fetch.h"

namespace cardioid::CD_ISA_NS {
namespace {

namespace node = light::node;

/// Bounds are conservative up to rounding: emission and horizon are cut this far (in cosine) outside of them.
constexpr float k_slack = 1e-4f;
/// Lobes and lamps are not all Lambertian: what is in the light keeps at least this share of its frontal weight.
constexpr float k_least_cosine = 0.02f;

struct Angle {
    Float cos, sin;
};
/// max(0, a - b).
Angle subtract_clamped(Angle a, Angle b) {
    const Mask zero = a.cos > b.cos;
    return {select(zero, Float(1.0f), fma(a.cos, b.cos, a.sin * b.sin)),
            select(zero, Float(0.0f), a.sin * b.cos - a.cos * b.sin)};
}
Angle angle_of_cos(Float c) { return {c, safe_sqrt(fma(-c, c, 1.0f))}; }

/// How far the box whose middle is at v from the receiver reaches above its horizon.
Float height_above(const float* records, RecordIndex index, Vec3 n, Vec3 v) {
    const Vec3 half = fetch3(records, index, node::half_size);
    return dot(n, v) + fma(abs(n.x), half.x, fma(abs(n.y), half.y, abs(n.z) * half.z));
}

/// Estimated irradiance from what a node bounds.
Float node_importance(const float* records, RecordIndex index, LightReceiver at, Mask one_sided) {
    const Vec3 v = fetch3(records, index, node::center) - at.p;
    const Float r2 = fetch(records, index, node::radius_squared);
    const Float d2 = max(dot(v, v), 1e-30f);
    const Float inv_d2 = 1.0f / d2, inv_size2 = min(inv_d2, 1.0f / max(r2, 1e-30f));
    const Vec3 dir = v * sqrt(inv_d2);
    const Mask inside = d2 <= r2;
    const Float sin_b2 = min(r2 * inv_d2, 1.0f);
    const Angle bound{sqrt(1.0f - sin_b2), sqrt(sin_b2)};

    const Angle to_axis = angle_of_cos(clamp(-dot(fetch3(records, index, node::axis), dir), -1.0f, 1.0f));
    const Angle cone = angle_of_cos(fetch(records, index, node::cos_o));
    const Float cos_leave = subtract_clamped(subtract_clamped(to_axis, cone), bound).cos;
    const Mask leaves = inside | (cos_leave >= fetch(records, index, node::cos_e) - k_slack);
    const Float emitted = select(inside, Float(1.0f), max(cos_leave, k_least_cosine));

    const Float cos_arrive = subtract_clamped(angle_of_cos(clamp(dot(at.n, dir), -1.0f, 1.0f)), bound).cos;
    // A group that just rises above the horizon has most of its lamps under it: its height is the better estimate.
    const Float height = height_above(records, index, at.n, v) * sqrt(inv_size2);
    const Mask arrives = ~one_sided | ((inside | (cos_arrive >= Float(-k_slack))) & (height >= Float(-k_slack)));
    const Float received =
        select(one_sided, max(min(select(inside, Float(1.0f), cos_arrive), height), k_least_cosine), Float(1.0f));

    const Float value = fetch(records, index, node::energy) * emitted * received * inv_size2;
    return select(leaves & arrives, value, Float(0.0f));
}

Mask is_one_sided(LightReceiver at) { return length_squared(at.n) > Float(0.25f); }

/// Weights of alternatives and their sum.
template <int n>
struct Weights {
    Float weight[n];
    Float total = 0.0f;
};
using EntryWeights = Weights<light::k_max_entries>;
using ChildWeights = Weights<light::k_tree_width>;

void weigh_entries(const light::LightData& lights, LightReceiver at, EntryWeights& out) {
    const Mask one_sided = is_one_sided(at);
    for (int k = 0; k < lights.entry_count; ++k) {
        const int offset = lights.entry_node[k] * light::k_node_floats;
        out.weight[k] = lights.entry_is_world[k]
                            ? Float(lights.nodes.record[offset + node::energy])
                            : node_importance(lights.nodes.record, {Int(0), offset}, at, one_sided);
        out.total += out.weight[k];
    }
}

/// Weights of the nodes first … first + k_tree_width - 1.
void weigh_children(const light::LightData& lights, Int first, LightReceiver at, Mask active, ChildWeights& out) {
    const Mask one_sided = is_one_sided(at);
    RecordIndex index = record_index(first, light::k_node_floats, active);
    for (int k = 0; k < light::k_tree_width; ++k) {
        out.weight[k] = node_importance(lights.nodes.record, index, at, one_sided);
        out.total += out.weight[k];
        index = {index.offset + Int(light::k_node_floats),
                 index.uniform >= 0 ? index.uniform + light::k_node_floats : -1};
    }
}

/// Which of n alternatives u falls on, and u within it. The last possible one takes what rounding leaves over.
struct Turn {
    Int which;
    Float u, chance;
    Mask possible;
};
template <int capacity>
Turn take_turn(const Weights<capacity>& w, int n, Float u) {
    const Float target = u * w.total;
    Turn out{Int(0), 0.0f, 0.0f, mask_of(false)};
    Float before = 0.0f;
    for (int k = 0; k < n; ++k) {
        const Mask take = (w.weight[k] > Float(0.0f)) & ((target >= before) | ~out.possible);
        out.which = select(take, Int(k), out.which);
        out.chance = select(take, w.weight[k] / w.total, out.chance);
        out.u = select(take, min((target - before) / w.weight[k], 0.99999994f), out.u);
        out.possible |= take;
        before += w.weight[k];
    }
    return out;
}

struct Position {
    Int node;
    Float u, pmf;
    Mask valid;
};

Position pick_entry(const light::LightData& lights, LightReceiver at, Float u, Mask active) {
    if (lights.entry_count == 1) return {Int(lights.entry_node[0]), u, 1.0f, active};
    EntryWeights w;
    weigh_entries(lights, at, w);
    const Turn turn = take_turn(w, lights.entry_count, u);
    Int picked = Int(lights.entry_node[0]);
    for (int k = 1; k < lights.entry_count; ++k)
        picked = select(turn.which == Int(k), Int(lights.entry_node[k]), picked);
    return {picked, turn.u, turn.chance, turn.possible & active};
}

}  // namespace

EmitterPick pick_emitter(const light::LightData& lights, LightReceiver at, Float u, Mask active) {
    if (lights.entry_count == 0) return {Int(-1), 0.0f, u, mask_of(false)};
    Position pos = pick_entry(lights, at, u, active);
    for (;;) {
        const Int child = fetch(lights.nodes.child, record_index(pos.node, 1, pos.valid), 0);
        const Mask inner = pos.valid & (child >= Int(0));
        if (none(inner)) return {select(pos.valid, Int(-1) - child, Int(-1)), pos.pmf, pos.u, pos.valid};
        ChildWeights w;
        weigh_children(lights, child, at, inner, w);
        const Turn turn = take_turn(w, light::k_tree_width, pos.u);
        pos.valid &= ~inner | turn.possible;
        pos.node = select(inner, child + turn.which, pos.node);
        pos.u = select(inner, turn.u, pos.u);
        pos.pmf = select(inner, pos.pmf * turn.chance, pos.pmf);
    }
}

Float pick_probability(const light::LightData& lights, LightReceiver at, Int emitter, Mask active) {
    active &= emitter >= Int(0);
    if (lights.entry_count == 0 || none(active)) return 0.0f;
    Int at_node = fetch(lights.leaf_of, record_index(emitter, 1, active), 0);
    active &= at_node >= Int(0);
    Float pmf = 1.0f;
    for (Mask below = active;;) {
        const Int parent = fetch(lights.nodes.parent, record_index(at_node, 1, below), 0);
        below &= parent >= Int(0);
        if (none(below)) break;
        const Int child = fetch(lights.nodes.child, record_index(parent, 1, below), 0);
        ChildWeights w;
        weigh_children(lights, child, at, below, w);
        Float weight = w.weight[0];
        for (int k = 1; k < light::k_tree_width; ++k) weight = select(at_node == child + Int(k), w.weight[k], weight);
        pmf = select(below, select(w.total > Float(0.0f), pmf * (weight / w.total), Float(0.0f)), pmf);
        at_node = select(below, parent, at_node);
    }
    if (lights.entry_count > 1) {
        EntryWeights w;
        weigh_entries(lights, at, w);
        Float weight = 0.0f;
        for (int k = 0; k < lights.entry_count; ++k)
            weight = select(at_node == Int(lights.entry_node[k]), w.weight[k], weight);
        pmf *= select(w.total > Float(0.0f), weight / w.total, Float(0.0f));
    }
    return select(active, pmf, Float(0.0f));
}

}  // namespace cardioid::CD_ISA_NS
