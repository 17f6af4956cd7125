// SPDX-License-Identifier: GPL-3.0-or-later
#include "light/light_tree.h"

#include <array>
#include <limits>
#include <span>

namespace cardioid::light {
namespace {

constexpr int k_buckets = 12;
/// Below this depth a group is halved by count, which bounds the depth of the tree.
constexpr int k_greedy_depth = 40;

float component(Float3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

void write_record(const EmitterBounds& b, float* out) {
    const Float3 c = b.center();
    const float values[k_node_floats] = {c.x, c.y, c.z, b.sphere_radius_squared(), b.axis.x, b.axis.y, b.axis.z,
                                         std::cos(b.theta_o), std::cos(b.theta_e), b.energy, 0, 0};
    std::copy(std::begin(values), std::end(values), out);
}

EmitterBounds bounds_of(std::span<const TreeLeaf> leaves) {
    EmitterBounds all;
    for (const TreeLeaf& leaf : leaves) all = merge(all, leaf.bounds);
    return all;
}

struct CenterBox {
    Float3 lower{1e30f, 1e30f, 1e30f}, upper{-1e30f, -1e30f, -1e30f};
};
CenterBox centers_of(std::span<const TreeLeaf> leaves) {
    EmitterBounds box;
    for (const TreeLeaf& leaf : leaves) extend(box, leaf.bounds.center());
    return {box.lower, box.upper};
}

int bucket_of(const TreeLeaf& leaf, const CenterBox& box, int axis) {
    const float low = component(box.lower, axis), size = component(box.upper, axis) - low;
    const float at = (component(leaf.bounds.center(), axis) - low) / size;
    return std::clamp(static_cast<int>(at * k_buckets), 0, k_buckets - 1);
}

struct Split {
    int axis = -1;        ///< -1: no useful plane
    int bucket = 0;       ///< leaves in buckets up to this one go first
};

/// Cheapest of the planes between buckets along the three axes.
Split best_split(std::span<const TreeLeaf> leaves, const CenterBox& box) {
    Split best;
    float best_cost = std::numeric_limits<float>::infinity();
    const Float3 size = box.upper - box.lower;
    const float longest = std::max({size.x, size.y, size.z});
    for (int axis = 0; axis < 3; ++axis) {
        if (!(component(size, axis) > 1e-6f * longest)) continue;
        std::array<EmitterBounds, k_buckets> buckets;
        for (const TreeLeaf& leaf : leaves) {
            EmitterBounds& b = buckets[static_cast<std::size_t>(bucket_of(leaf, box, axis))];
            b = merge(b, leaf.bounds);
        }
        std::array<float, k_buckets> above{};
        EmitterBounds sum;
        for (std::size_t i = k_buckets - 1; i > 0; --i) {
            sum = merge(sum, buckets[i]);
            above[i - 1] = split_cost(sum);
        }
        sum = {};
        for (std::size_t i = 0; i + 1 < k_buckets; ++i) {
            sum = merge(sum, buckets[i]);
            // Long thin groups are split across (Conty Estevez & Kulla's regularisation).
            const float cost = (split_cost(sum) + above[i]) * longest / component(size, axis);
            if (sum.energy > 0 && above[i] > 0 && cost < best_cost) {
                best_cost = cost;
                best = {axis, static_cast<int>(i)};
            }
        }
    }
    return best;
}

std::size_t partition(std::span<TreeLeaf> leaves, int depth) {
    const CenterBox box = centers_of(leaves);
    if (depth < k_greedy_depth && leaves.size() > 2) {
        const Split split = best_split(leaves, box);
        if (split.axis >= 0) {
            const auto middle = std::stable_partition(leaves.begin(), leaves.end(), [&](const TreeLeaf& leaf) {
                return bucket_of(leaf, box, split.axis) <= split.bucket;
            });
            const auto count = static_cast<std::size_t>(middle - leaves.begin());
            if (count > 0 && count < leaves.size()) return count;
        }
    }
    return leaves.size() / 2;
}

struct Range {
    int node;
    std::size_t begin, end;
    int depth;
};

}  // namespace

int NodeStorage::add(const EmitterBounds& bounds, std::int32_t emitter, std::int32_t parent_node) {
    const int index = size();
    record.resize(record.size() + k_node_floats);
    write_record(bounds, record.data() + static_cast<std::ptrdiff_t>(index) * k_node_floats);
    child.push_back(~emitter);
    parent.push_back(parent_node);
    return index;
}

int build_light_tree(std::vector<TreeLeaf>& leaves, NodeStorage& nodes) {
    const std::span<TreeLeaf> all(leaves);
    const int root = nodes.add(all.size() == 1 ? all[0].bounds : bounds_of(all), all[0].emitter, -1);
    std::vector<Range> open{{root, 0, all.size(), 0}};
    while (!open.empty()) {
        const Range range = open.back();
        open.pop_back();
        if (range.end - range.begin == 1) continue;
        const std::size_t middle = range.begin + partition(all.subspan(range.begin, range.end - range.begin), range.depth);
        const std::size_t ends[3] = {range.begin, middle, range.end};
        nodes.child[static_cast<std::size_t>(range.node)] = nodes.size();
        for (int side = 0; side < 2; ++side) {
            const auto part = all.subspan(ends[side], ends[side + 1] - ends[side]);
            const int node = nodes.add(part.size() == 1 ? part[0].bounds : bounds_of(part), part[0].emitter, range.node);
            open.push_back({node, ends[side], ends[side + 1], range.depth + 1});
        }
    }
    return root;
}

}  // namespace cardioid::light
