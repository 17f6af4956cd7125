// SPDX-License-Identifier: GPL-3.0-or-later
// A density on the unit cube [0,1)⁴, constant in each leaf of a binary tree of boxes: halves of halves along any axis.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cardioid::photon {

inline constexpr int k_cube = 4;  ///< point (2), direction (2)

/// A place and how much the second moment of the picture is made of it (PhotonGuide::learn).
struct Sample {
    float u[k_cube];
    float weight;
};

/// Without nodes: 1 everywhere.
class CubeTree {
public:
    CubeTree() = default;
    /// Reorders the samples.
    CubeTree(Sample* samples, std::size_t count);

    /// Maps uniform `u` to a place with the tree's density, which it returns. One-to-one and monotone within each leaf.
    float draw(float (&u)[k_cube]) const;
    float density(const float (&u)[k_cube]) const;
    /// Σ over leaves of sqrt(their share of the weight · volume), ≤ 1: how much smaller the standard deviation is than that of
    /// a uniform density.
    double concentration() const { return concentration_; }
    std::size_t memory_bytes() const { return nodes_.capacity() * sizeof(Node); }

private:
    struct Node {
        float left;              ///< share of the left half
        float density;           ///< leaf: density in the cube
        std::uint32_t children;  ///< left, and right after it; 0: a leaf
        std::uint32_t axis;
    };
    double divide(std::uint32_t node, Sample* begin, Sample* end, double weight, double volume, int depth);
    void set_densities(std::uint32_t node, double density);

    std::vector<Node> nodes_;
    double concentration_ = 1;
};

}  // namespace cardioid::photon
