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
    return {select(zero, Float(1.0f), fma(a.cos, b.cos, a.sin * b.sin)), select(zero, Float(0.0f), a.sin * b.cos - a.cos * b.sin)};
}
Angle angle_of_cos(Float c) { return {c, safe_sqrt(fma(-c, c, 1.0f))}; }

/// Estimated irradiance from what a node bounds.
Float node_importance(const float* records, RecordIndex index, LightReceiver at, Mask one_sided) {
    const Vec3 v = fetch3(records, index, node::center) - at.p;
    const Float r2 = fetch(records, index, node::radius_squared);
    const Float d2 = max(dot(v, v), 1e-30f);
    const Float inv_d2 = 1.0f / d2;
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
    const Mask free = inside | ~one_sided;
    const Mask arrives = free | (cos_arrive >= Float(-k_slack));
    const Float received = select(free, Float(1.0f), max(cos_arrive, k_least_cosine));

    const Float value = fetch(records, index, node::energy) * emitted * received * min(inv_d2, 1.0f / max(r2, 1e-30f));
    return select(leaves & arrives, value, Float(0.0f));
}

Mask is_one_sided(LightReceiver at) { return length_squared(at.n) > Float(0.25f); }

/// Weights of all entries and their sum.
struct EntryWeights {
    Float weight[light::k_max_entries];
    Float total;
};
void weigh_entries(const light::LightData& lights, LightReceiver at, EntryWeights& out) {
    const Mask one_sided = is_one_sided(at);
    out.total = 0.0f;
    for (int k = 0; k < lights.entry_count; ++k) {
        const int offset = lights.entry_node[k] * light::k_node_floats;
        out.weight[k] = lights.entry_is_world[k] ? Float(lights.nodes.record[offset + node::energy])
                                                 : node_importance(lights.nodes.record, {Int(0), offset}, at, one_sided);
        out.total += out.weight[k];
    }
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
    const Float target = u * w.total;
    Position out{Int(lights.entry_node[0]), 0.0f, 0.0f, mask_of(false)};
    Float before = 0.0f;
    for (int k = 0; k < lights.entry_count; ++k) {
        const Mask possible = w.weight[k] > Float(0.0f);
        // The last possible entry takes what rounding leaves over, so an entry stays chosen until a later one claims the lane.
        const Mask take = possible & ((target >= before) | ~out.valid);
        out.node = select(take, Int(lights.entry_node[k]), out.node);
        out.pmf = select(take, w.weight[k] / w.total, out.pmf);
        out.u = select(take, min((target - before) / w.weight[k], 0.99999994f), out.u);
        out.valid |= take;
        before += w.weight[k];
    }
    out.valid &= active;
    return out;
}

/// Probability of the first of two siblings.
Float first_share(Float first, Float second) {
    const Float sum = first + second;
    return select(sum > Float(0.0f), first / sum, Float(0.5f));
}

}  // namespace

EmitterPick pick_emitter(const light::LightData& lights, LightReceiver at, Float u, Mask active) {
    if (lights.entry_count == 0) return {Int(-1), 0.0f, mask_of(false)};
    Position pos = pick_entry(lights, at, u, active);
    const Mask one_sided = is_one_sided(at);
    const float* records = lights.nodes.record;
    for (;;) {
        const Int child = fetch(lights.nodes.child, record_index(pos.node, 1, pos.valid), 0);
        const Mask inner = pos.valid & (child >= Int(0));
        if (none(inner)) return {select(pos.valid, Int(-1) - child, Int(-1)), pos.pmf, pos.valid};
        const Float a = node_importance(records, record_index(child, light::k_node_floats, inner), at, one_sided);
        const Float b = node_importance(records, record_index(child + Int(1), light::k_node_floats, inner), at, one_sided);
        const Float share = first_share(a, b);
        const Mask first = pos.u < share;
        const Float chance = select(first, share, 1.0f - share);
        const Float rest = select(first, pos.u, pos.u - share) / chance;
        pos.valid &= ~inner | (a + b > Float(0.0f));
        pos.node = select(inner, select(first, child, child + Int(1)), pos.node);
        pos.u = select(inner, min(rest, 0.99999994f), pos.u);
        pos.pmf = select(inner, pos.pmf * chance, pos.pmf);
    }
}

Float pick_probability(const light::LightData& lights, LightReceiver at, Int emitter, Mask active) {
    active &= emitter >= Int(0);
    if (lights.entry_count == 0 || none(active)) return 0.0f;
    Int at_node = fetch(lights.leaf_of, record_index(emitter, 1, active), 0);
    active &= at_node >= Int(0);
    const Mask one_sided = is_one_sided(at);
    const float* records = lights.nodes.record;
    Float pmf = 1.0f;
    for (Mask below = active;;) {
        const Int parent = fetch(lights.nodes.parent, record_index(at_node, 1, below), 0);
        below &= parent >= Int(0);
        if (none(below)) break;
        const Int child = fetch(lights.nodes.child, record_index(parent, 1, below), 0);
        const Float a = node_importance(records, record_index(child, light::k_node_floats, below), at, one_sided);
        const Float b = node_importance(records, record_index(child + Int(1), light::k_node_floats, below), at, one_sided);
        const Float share = first_share(a, b);
        const Float chance = select(at_node == child, share, 1.0f - share);
        pmf = select(below, select(a + b > Float(0.0f), pmf * chance, Float(0.0f)), pmf);
        at_node = select(below, parent, at_node);
    }
    if (lights.entry_count > 1) {
        EntryWeights w;
        weigh_entries(lights, at, w);
        Float weight = 0.0f;
        for (int k = 0; k < lights.entry_count; ++k) {
            weight = select(at_node == Int(lights.entry_node[k]), w.weight[k], weight);
        }
        pmf *= select(w.total > Float(0.0f), weight / w.total, Float(0.0f));
    }
    return select(active, pmf, Float(0.0f));
}

}  // namespace cardioid::CD_ISA_NS
