// SPDX-License-Identifier: GPL-3.0-or-later
#include "light/lamp_boxes.h"

#include <algorithm>

namespace cardioid::light {
namespace {

constexpr std::size_t k_leaf_lamps = 4;

float component(Float3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

struct Range {
    std::size_t node, begin, end;
};

/// Sets the box of a node to that of its lamps and returns the longest axis of their middles.
int fit(LampBoxTree& tree, const Range& range, const std::vector<LampBox>& lamps) {
    Float3 lo = lamps[range.begin].lower, hi = lamps[range.begin].upper;
    Float3 mid_lo = (lo + hi) * 0.5f, mid_hi = mid_lo;
    const auto grow = [](Float3& low, Float3& high, Float3 a, Float3 b) {
        low = {std::min(low.x, a.x), std::min(low.y, a.y), std::min(low.z, a.z)};
        high = {std::max(high.x, b.x), std::max(high.y, b.y), std::max(high.z, b.z)};
    };
    for (std::size_t i = range.begin; i < range.end; ++i) {
        const Float3 middle = (lamps[i].lower + lamps[i].upper) * 0.5f;
        grow(lo, hi, lamps[i].lower, lamps[i].upper);
        grow(mid_lo, mid_hi, middle, middle);
    }
    const float values[6] = {lo.x, lo.y, lo.z, hi.x, hi.y, hi.z};
    std::copy(std::begin(values), std::end(values), tree.box.begin() + static_cast<std::ptrdiff_t>(range.node * 6));
    const Float3 size = mid_hi - mid_lo;
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

void add_nodes(LampBoxTree& tree, std::size_t n) {
    tree.box.resize(tree.box.size() + 6 * n);
    tree.first.resize(tree.first.size() + n);
    tree.count.resize(tree.count.size() + n);
}

}  // namespace

LampBoxTree build_lamp_boxes(std::vector<LampBox> lamps, int offset) {
    LampBoxTree tree;
    if (lamps.empty()) return tree;
    add_nodes(tree, 1);
    std::vector<Range> open{{0, 0, lamps.size()}};
    while (!open.empty()) {
        const Range range = open.back();
        open.pop_back();
        const int axis = fit(tree, range, lamps);
        if (range.end - range.begin <= k_leaf_lamps) {
            tree.first[range.node] = offset + static_cast<std::int32_t>(range.begin);
            tree.count[range.node] = static_cast<std::int32_t>(range.end - range.begin);
            continue;
        }
        const std::size_t middle = (range.begin + range.end) / 2;
        const auto at = [&](std::size_t i) { return lamps.begin() + static_cast<std::ptrdiff_t>(i); };
        std::stable_sort(at(range.begin), at(range.end), [axis](const LampBox& a, const LampBox& b) {
            return component(a.lower, axis) + component(a.upper, axis) <
                   component(b.lower, axis) + component(b.upper, axis);
        });
        const std::size_t child = tree.first.size();
        add_nodes(tree, 2);
        tree.first[range.node] = static_cast<std::int32_t>(child);
        tree.count[range.node] = 0;
        open.push_back({child, range.begin, middle});
        open.push_back({child + 1, middle, range.end});
    }
    for (const LampBox& lamp : lamps) tree.lamps.push_back(lamp.lamp);
    return tree;
}

}  // namespace cardioid::light
