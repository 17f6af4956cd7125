// SPDX-License-Identifier: GPL-3.0-or-later
#include "photon/cube_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace cardioid::photon {

namespace {

constexpr std::ptrdiff_t k_divisible = 8;  ///< samples of a box that is divided
constexpr double k_noise = 1;              ///< what a leaf costs, over its number of samples
constexpr double k_unseen = 0.05;          ///< samples taken to be in each half besides those that are
constexpr int k_most_halvings = 16;        ///< of an axis: float tells 256 places apart in what is left
constexpr int k_bins = 16;
constexpr float k_below_one = 0x1.fffffep-1f;

struct Sums {
    double weight = 0;
    double count = 0;  ///< of equal weights that would tell as much
    Sums(const Sample* begin, const Sample* end) {
        double squares = 0;
        for (const Sample* s = begin; s != end; ++s) {
            const double w = static_cast<double>(s->weight);
            weight += w;
            squares += w * w;
        }
        if (squares > 0) count = weight * weight / squares;
    }
};

/// Where the box [0,1)⁴ of the samples' own coordinates is least uniform. Optimal densities go with the root of the weight, and
/// the sum of roots over bins is what remains of the standard deviation. -1: no axis can be halved again.
int least_uniform_axis(const Sample* begin, const Sample* end, const Halvings& halvings) {
    double bins[k_cube][k_bins] = {};
    for (const Sample* s = begin; s != end; ++s) {
        for (int k = 0; k < k_cube; ++k) bins[k][static_cast<int>(s->u[k] * k_bins)] += static_cast<double>(s->weight);
    }
    int best = -1;
    double lowest = 0;
    for (int k = 0; k < k_cube; ++k) {
        if (halvings[static_cast<std::size_t>(k)] == k_most_halvings) continue;
        double sum = 0;
        for (const double b : bins[k]) sum += std::sqrt(b);
        if (best < 0 || sum < lowest) {
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

/// Share of `whole` given to a half that has `part`: not quite nothing where few samples were just not lucky.
double smoothed(double part, const Sums& whole) { return part + k_unseen * whole.weight / (whole.count + 1); }

}  // namespace

CubeTree::CubeTree(Sample* samples, std::size_t count) {
    const Sums sums(samples, samples + count);
    if (!(sums.weight > 0)) return;
    nodes_.push_back({});
    const Mass mass = divide(0, samples, samples + count, sums.weight, 1, {});
    set_leaves(0, {0, {}, {1, 1, 1, 1}}, 1);
    mass_ = mass.mass;
    concentration_ = mass_ / std::sqrt(sums.weight);
}

/// Mass of the node: sqrt(weight · volume) of a leaf, which is what minimises Σ weight/density, or the sum of its halves; they
/// are kept only where they promise more than chance would.
CubeTree::Mass CubeTree::divide(std::uint32_t node, Sample* begin, Sample* end, double weight, double volume,
                                Halvings halvings) {
    const Sums sums(begin, end);
    const double whole = std::sqrt(weight * volume);
    const Mass undivided{whole, whole * (1 + (sums.count > 0 ? k_noise / sums.count : 0))};
    nodes_[node] = {0, 0, 0, k_is_leaf};
    const int best = end - begin < k_divisible || !(sums.weight > 0) ? -1 : least_uniform_axis(begin, end, halvings);
    if (best < 0) return undivided;
    const auto axis = static_cast<std::uint32_t>(best);
    ++halvings[axis];
    Sample* middle = std::partition(begin, end, [axis](const Sample& s) { return s.u[axis] < 0.5f; });
    enlarge(begin, middle, axis, 0);
    enlarge(middle, end, axis, 0.5f);
    const double part = smoothed(Sums(begin, middle).weight, sums) / (sums.weight + 2 * smoothed(0, sums));
    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    const Mass left = divide(children, begin, middle, part * weight, 0.5 * volume, halvings);
    const Mass right = divide(children + 1, middle, end, (1 - part) * weight, 0.5 * volume, halvings);
    if (left.cost + right.cost >= undivided.cost) {
        nodes_.resize(children);
        return undivided;
    }
    const auto share = static_cast<float>(left.mass / (left.mass + right.mass));
    // A half without mass is never entered.
    nodes_[node] = {share, share > 0 ? 1 / share : 0, share < 1 ? 1 / (1 - share) : 0, axis | children << 2};
    return {left.mass + right.mass, left.cost + right.cost};
}

void CubeTree::set_leaves(std::uint32_t node, Leaf leaf, double density) {
    if (nodes_[node].next & k_is_leaf) {
        nodes_[node].next |= static_cast<std::uint32_t>(leaves_.size());
        leaf.density = static_cast<float>(density);
        leaves_.push_back(leaf);
        return;
    }
    const std::uint32_t axis = nodes_[node].next & 3u, children = nodes_[node].next >> 2;
    const double left = static_cast<double>(nodes_[node].left);
    leaf.size[axis] *= 0.5f;
    set_leaves(children, leaf, density * 2 * left);
    leaf.lower[axis] += leaf.size[axis];
    set_leaves(children + 1, leaf, density * 2 * (1 - left));
}

float CubeTree::draw(float (&u)[k_cube]) const {
    if (nodes_.empty()) return 1;
    const Node* node = nodes_.data();
    while (!(node->next & k_is_leaf)) {
        // No branches: which half it is cannot be predicted.
        float& t = u[node->next & 3u];
        const bool right = t >= node->left;
        t = (t - (right ? node->left : 0.0f)) * (right ? node->enlarge_right : node->enlarge_left);
        node = nodes_.data() + (node->next >> 2) + (right ? 1 : 0);
    }
    const Leaf& leaf = leaves_[node->next & ~k_is_leaf];
    for (int k = 0; k < k_cube; ++k) {
        const float upper = leaf.lower[k] + leaf.size[k];
        const float place = leaf.lower[k] + std::min(u[k], k_below_one) * leaf.size[k];
        // Rounding must not carry it into the next leaf.
        u[k] = place < upper ? place : std::bit_cast<float>(std::bit_cast<std::uint32_t>(upper) - 1);
    }
    return leaf.density;
}

const CubeTree::Leaf& CubeTree::leaf_at(const float (&u)[k_cube]) const {
    float t[k_cube] = {u[0], u[1], u[2], u[3]};
    const Node* node = nodes_.data();
    while (!(node->next & k_is_leaf)) {
        float& own = t[node->next & 3u];
        own *= 2;
        const bool right = own >= 1;
        own -= right ? 1.0f : 0.0f;
        node = nodes_.data() + (node->next >> 2) + (right ? 1 : 0);
    }
    return leaves_[node->next & ~k_is_leaf];
}

float CubeTree::density(const float (&u)[k_cube]) const { return nodes_.empty() ? 1 : leaf_at(u).density; }

double CubeTree::density_without(const float (&u)[k_cube], double weight) const {
    if (nodes_.empty()) return 1;
    const Leaf& leaf = leaf_at(u);
    const auto density = static_cast<double>(leaf.density);
    const double volume =
        static_cast<double>(leaf.size[0] * leaf.size[1]) * static_cast<double>(leaf.size[2] * leaf.size[3]);
    // Density goes with the root of the leaf's weight, which is mass²/volume.
    const double of_leaf = density * density * volume * mass_ * mass_;
    return density * std::sqrt(std::max(0.0, 1 - weight / of_leaf));
}

}  // namespace cardioid::photon
