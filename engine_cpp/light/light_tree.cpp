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
    const Float3 c = b.center(), half = (b.upper - b.lower) * 0.5f;
    const float values[k_node_floats] = {c.x,
                                         c.y,
                                         c.z,
                                         b.sphere_radius_squared(),
                                         b.axis.x,
                                         b.axis.y,
                                         b.axis.z,
                                         std::cos(b.theta_o),
                                         std::cos(b.theta_e),
                                         b.energy,
                                         half.x,
                                         half.y,
                                         half.z,
                                         0,
                                         0,
                                         0};
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
    int axis = -1;   ///< -1: no useful plane
    int bucket = 0;  ///< leaves in buckets up to this one go first
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

/// A run of leaves that becomes a node.
struct Range {
    std::size_t begin = 0, end = 0;
    int depth = 0;
    EmitterBounds bounds{};

    std::size_t size() const { return end - begin; }
};

Range make_range(std::span<const TreeLeaf> all, std::size_t begin, std::size_t end, int depth) {
    return {begin, end, depth, end - begin == 1 ? all[begin].bounds : bounds_of(all.subspan(begin, end - begin))};
}

/// Parting fewer leaves than this takes no time that a person would notice.
constexpr std::size_t k_leaves_between_checkpoints = 4096;

/// Splits a range into up to k_tree_width parts, each time the one that costs most.
std::vector<Range> children_of(std::span<TreeLeaf> all, const Range& range, const Checkpoint& checkpoint) {
    std::vector<Range> parts{range};
    while (parts.size() < k_tree_width) {
        const auto next = std::max_element(parts.begin(), parts.end(), [](const Range& a, const Range& b) {
            return (a.size() > 1 ? split_cost(a.bounds) : -1.0f) < (b.size() > 1 ? split_cost(b.bounds) : -1.0f);
        });
        if (next->size() <= 1) break;
        const Range whole = *next;
        if (checkpoint && whole.size() > k_leaves_between_checkpoints) checkpoint();
        const std::size_t middle = whole.begin + partition(all.subspan(whole.begin, whole.size()), whole.depth);
        *next = make_range(all, whole.begin, middle, whole.depth + 1);
        parts.push_back(make_range(all, middle, whole.end, whole.depth + 1));
    }
    return parts;
}

}  // namespace

int NodeStorage::add(const EmitterBounds& bounds, std::int32_t emitter, std::int32_t parent_node) {
    const int index = size();
    record.resize(record.size() + k_node_floats);
    write_record(bounds, record.data() + static_cast<std::ptrdiff_t>(index) * k_node_floats);
    child.push_back(~emitter);
    parent.push_back(parent_node);
    return index;
}

std::vector<int> build_light_tree(std::vector<TreeLeaf>& leaves, NodeStorage& nodes, const Checkpoint& checkpoint) {
    std::vector<int> top;
    if (leaves.empty()) return top;
    const std::span<TreeLeaf> all(leaves);
    struct Open {
        int node;
        Range range;
    };
    std::vector<Open> open;
    const auto add = [&](const Range& range, std::int32_t parent) {
        const int node = nodes.add(range.bounds, all[range.begin].emitter, parent);
        if (range.size() > 1) open.push_back({node, range});
        return node;
    };
    for (const Range& part : children_of(all, make_range(all, 0, all.size(), 0), checkpoint))
        top.push_back(add(part, -1));
    while (!open.empty()) {
        const Open next = open.back();
        open.pop_back();
        const std::vector<Range> parts = children_of(all, next.range, checkpoint);
        nodes.child[static_cast<std::size_t>(next.node)] = nodes.size();
        for (const Range& part : parts) add(part, next.node);
        for (std::size_t i = parts.size(); i < k_tree_width; ++i)
            nodes.add(EmitterBounds{{}, {}}, k_no_emitter, next.node);
    }
    return top;
}

}  // namespace cardioid::light
