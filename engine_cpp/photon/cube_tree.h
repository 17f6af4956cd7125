// SPDX-License-Identifier: GPL-3.0-or-later
// A density on the unit cube [0,1)⁴, constant in each leaf of a binary tree of boxes: halves of halves along any axis.
#pragma once

#include "photon/emission.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cardioid::photon {

/// A place and how much the second moment of the picture is made of it (PhotonGuide::learn).
struct Sample {
    float u[k_cube];
    float weight;
};

using Halvings = std::array<std::uint8_t, k_cube>;  ///< by axis

/// Without nodes: 1 everywhere.
class CubeTree {
public:
    CubeTree() = default;
    /// Reorders the samples.
    CubeTree(Sample* samples, std::size_t count);

    /// Maps uniform `u` to a place with the tree's density, which it returns. One-to-one and monotone within each leaf.
    float draw(float (&u)[k_cube]) const;
    float density(const float (&u)[k_cube]) const;
    /// About what it would be without a sample of `weight` there.
    double density_without(const float (&u)[k_cube], double weight) const;
    /// Σ over leaves of sqrt(their share of the weight · volume), ≤ 1: how much smaller the standard deviation is than that of
    /// a uniform density.
    double concentration() const { return concentration_; }
    std::size_t memory_bytes() const { return nodes_.capacity() * sizeof(Node) + leaves_.capacity() * sizeof(Leaf); }

private:
    static constexpr std::uint32_t k_is_leaf = 0x80000000u;
    /// Where u splits, and what enlarges its halves to [0,1).
    struct Node {
        float left;
        float enlarge_left, enlarge_right;
        std::uint32_t
            next;  ///< axis | index of the left child << 2, the right one follows it; k_is_leaf | index of the leaf
    };
    struct Leaf {
        float density;
        float lower[k_cube], size[k_cube];
    };
    struct Mass {
        double mass, cost;
    };
    Mass divide(std::uint32_t node, Sample* begin, Sample* end, double weight, double volume, Halvings halvings);
    const Leaf& leaf_at(const float (&u)[k_cube]) const;
    void set_leaves(std::uint32_t node, Leaf leaf, double density);

    std::vector<Node> nodes_;
    std::vector<Leaf> leaves_;
    double mass_ = 0;
    double concentration_ = 1;
};

}  // namespace cardioid::photon
