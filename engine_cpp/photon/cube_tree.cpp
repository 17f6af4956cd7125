// SPDX-License-Identifier: GPL-3.0-or-later
#include "photon/cube_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace cardioid::photon {

namespace {

constexpr std::ptrdiff_t k_divisible = 64;  ///< samples of a box that is divided
constexpr int k_deepest = 40;
constexpr int k_bins = 16;
constexpr float k_below_one = 0x1.fffffep-1f;

/// Where the box [0,1)⁴ of the samples' own coordinates is least uniform. Optimal densities go with the root of the weight, and
/// the sum of roots over bins is what remains of the standard deviation.
std::uint32_t least_uniform_axis(const Sample* begin, const Sample* end) {
    double bins[k_cube][k_bins] = {};
    for (const Sample* s = begin; s != end; ++s) {
        for (int k = 0; k < k_cube; ++k) bins[k][static_cast<int>(s->u[k] * k_bins)] += static_cast<double>(s->weight);
    }
    std::uint32_t best = 0;
    double lowest = -1;
    for (std::uint32_t k = 0; k < k_cube; ++k) {
        double sum = 0;
        for (const double b : bins[k]) sum += std::sqrt(b);
        if (lowest < 0 || sum < lowest) {
            lowest = sum;
            best = k;
        }
    }
    return best;
}

/// Into the half's own coordinates; exact.
void enlarge(Sample* begin, Sample* end, std::uint32_t axis, float origin) {
    for (Sample* s = begin; s != end; ++s) s->u[axis] = (s->u[axis] - origin) * 2;
}

double total(const Sample* begin, const Sample* end) {
    double sum = 0;
    for (const Sample* s = begin; s != end; ++s) sum += static_cast<double>(s->weight);
    return sum;
}

}  // namespace

CubeTree::CubeTree(Sample* samples, std::size_t count) {
    const double weight = total(samples, samples + count);
    if (!(weight > 0)) return;
    nodes_.push_back({});
    const double mass = divide(0, samples, samples + count, weight, 1, 0);
    set_densities(0, 1);
    concentration_ = mass / std::sqrt(weight);
}

/// Returns the mass of the node: sqrt(weight · volume) of a leaf, which is what minimises Σ weight/density, or the sum of its
/// halves.
double CubeTree::divide(std::uint32_t node, Sample* begin, Sample* end, double weight, double volume, int depth) {
    if (end - begin < k_divisible || depth == k_deepest) return std::sqrt(weight * volume);
    const std::uint32_t axis = least_uniform_axis(begin, end);
    Sample* middle = std::partition(begin, end, [axis](const Sample& s) { return s.u[axis] < 0.5f; });
    enlarge(begin, middle, axis, 0);
    enlarge(middle, end, axis, 0.5f);
    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    const double left = divide(children, begin, middle, total(begin, middle), 0.5 * volume, depth + 1);
    const double right = divide(children + 1, middle, end, total(middle, end), 0.5 * volume, depth + 1);
    nodes_[node] = {static_cast<float>(left / (left + right)), 0, children, axis};
    return left + right;
}

void CubeTree::set_densities(std::uint32_t node, double density) {
    nodes_[node].density = static_cast<float>(density);
    if (nodes_[node].children == 0) return;
    const double left = static_cast<double>(nodes_[node].left);
    set_densities(nodes_[node].children, density * 2 * left);
    set_densities(nodes_[node].children + 1, density * 2 * (1 - left));
}

float CubeTree::draw(float (&u)[k_cube]) const {
    if (nodes_.empty()) return 1;
    float lower[k_cube] = {}, size[k_cube] = {1, 1, 1, 1};
    std::uint32_t at = 0;
    while (nodes_[at].children != 0) {
        const Node& node = nodes_[at];
        float& t = u[node.axis];
        float& half = size[node.axis];
        half *= 0.5f;
        if (t < node.left) {
            t /= node.left;
            at = node.children;
        } else {
            t = (t - node.left) / (1 - node.left);
            lower[node.axis] += half;
            at = node.children + 1;
        }
    }
    for (int k = 0; k < k_cube; ++k) {
        const float upper = lower[k] + size[k];
        const float place = lower[k] + std::min(u[k], k_below_one) * size[k];
        // Rounding must not carry it into the next leaf.
        u[k] = place < upper ? place : std::bit_cast<float>(std::bit_cast<std::uint32_t>(upper) - 1);
    }
    return nodes_[at].density;
}

float CubeTree::density(const float (&u)[k_cube]) const {
    if (nodes_.empty()) return 1;
    float t[k_cube] = {u[0], u[1], u[2], u[3]};
    std::uint32_t at = 0;
    while (nodes_[at].children != 0) {
        const Node& node = nodes_[at];
        float& own = t[node.axis];
        own *= 2;
        const bool right = own >= 1;
        own -= right ? 1.0f : 0.0f;
        at = node.children + (right ? 1u : 0u);
    }
    return nodes_[at].density;
}

}  // namespace cardioid::photon
