// SPDX-License-Identifier: GPL-3.0-or-later
// Picks an index by weight: inverse of the cumulative distribution, so that stratified numbers give stratified picks; a table
// of starting points makes it one or two steps for any number of indices.
#pragma once

#include <cstdint>
#include <vector>

namespace cardioid::photon {

class Pick {
public:
    Pick() = default;
    /// Negative and non-finite weights count as 0.
    explicit Pick(const std::vector<double>& weights);

    /// No weight is above 0.
    bool empty() const { return cumulative_.empty(); }
    std::size_t size() const { return cumulative_.size(); }
    /// `choice` in [0,1). Never an index of probability 0. Not when empty().
    std::int32_t draw(double choice) const;
    double probability(std::int32_t index) const;
    std::size_t memory_bytes() const;

private:
    std::vector<double> cumulative_;    ///< up to and with each index; the last is 1
    std::vector<std::uint32_t> first_;  ///< by choice·size: the first index that may be meant
};

}  // namespace cardioid::photon
