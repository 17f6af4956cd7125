// SPDX-License-Identifier: GPL-3.0-or-later
#include "photon/morton.h"

#include "photon/query.h"

#include <algorithm>
#include <array>
#include <limits>

namespace cardioid::photon {

namespace {

constexpr int k_shares = 16;
constexpr int k_lower_bits = 11;
constexpr int k_digit = 11;
constexpr std::size_t k_digits = std::size_t{1} << k_digit;

/// Bits 0 … 20 move to bits 0, 3, … 60.
std::uint64_t spread(std::uint64_t v) {
    v = (v | v << 32) & 0x001f00000000ffffu;
    v = (v | v << 16) & 0x001f0000ff0000ffu;
    v = (v | v << 8) & 0x100f00f00f00f00fu;
    v = (v | v << 4) & 0x10c30c30c30c30c3u;
    return (v | v << 2) & 0x1249249249249249u;
}

std::uint32_t coordinate(const Photon& photon, const PhotonMapView& view, int k) {
    return detail::to_cells(static_cast<double>(photon.position[k]) - view.lower[k], view.scale);
}

std::uint64_t upper_key(const Photon& photon, const PhotonMapView& view) {
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k) key |= spread(coordinate(photon, view, k) >> k_lower_bits) << k;
    return key;
}

std::uint64_t lower_key(const Photon& photon, const PhotonMapView& view) {
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k) key |= spread(coordinate(photon, view, k) & ((1u << k_lower_bits) - 1)) << k;
    return key;
}

struct Box {
    std::array<float, 3> lower, upper;
};

void set_cube(const std::vector<Photon>& photons, const Workers& workers, PhotonMapView& view) {
    constexpr float k_max = std::numeric_limits<float>::max();
    std::array<Box, k_shares> boxes;
    workers.run(k_shares, [&](int s) {
        Box box{{k_max, k_max, k_max}, {-k_max, -k_max, -k_max}};
        const Share share(photons.size(), s, k_shares);
        for (std::size_t i = share.begin; i < share.end; ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                box.lower[k] = std::min(box.lower[k], photons[i].position[k]);
                box.upper[k] = std::max(box.upper[k], photons[i].position[k]);
            }
        }
        boxes[static_cast<std::size_t>(s)] = box;
    });
    double edge = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        float lower = k_max, upper = -k_max;
        for (const Box& box : boxes) {
            lower = std::min(lower, box.lower[k]);
            upper = std::max(upper, box.upper[k]);
        }
        view.lower[k] = static_cast<double>(lower);
        view.upper[k] = upper;
        edge = std::max(edge, static_cast<double>(upper) - view.lower[k]);
    }
    view.scale = edge > 0 ? 4294967296.0 / edge : 0;
}

/// One pass of a stable radix sort; false: all keys have the same digit, nothing moved.
bool sort_digit(const std::vector<MortonKey>& from, std::vector<MortonKey>& to, int shift, const Workers& workers,
                std::vector<std::array<std::uint32_t, k_digits>>& offsets) {
    const auto digit = [shift](const MortonKey& key) {
        return static_cast<std::size_t>(key.upper >> shift) % k_digits;
    };
    workers.run(k_shares, [&](int s) {
        auto& counts = offsets[static_cast<std::size_t>(s)];
        counts.fill(0);
        const Share share(from.size(), s, k_shares);
        for (std::size_t i = share.begin; i < share.end; ++i) ++counts[digit(from[i])];
    });
    std::uint32_t sum = 0;
    for (std::size_t d = 0; d < k_digits; ++d) {
        const std::uint32_t before = sum;
        for (auto& counts : offsets) {
            const std::uint32_t count = counts[d];
            counts[d] = sum;
            sum += count;
        }
        if (sum - before == from.size()) return false;
    }
    workers.run(k_shares, [&](int s) {
        auto& next = offsets[static_cast<std::size_t>(s)];
        const Share share(from.size(), s, k_shares);
        for (std::size_t i = share.begin; i < share.end; ++i) to[next[digit(from[i])]++] = from[i];
    });
    return true;
}

/// Photons that the upper keys do not tell apart.
void sort_ties(const std::vector<Photon>& photons, const PhotonMapView& view, std::vector<MortonKey>& keys) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> run;
    for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
        for (end = begin + 1; end < keys.size() && keys[end].upper == keys[begin].upper;) ++end;
        if (end - begin < 2) continue;
        run.clear();
        for (std::size_t i = begin; i < end; ++i)
            run.emplace_back(lower_key(photons[keys[i].index], view), keys[i].index);
        if (!std::is_sorted(run.begin(), run.end())) std::sort(run.begin(), run.end());
        for (std::size_t i = begin; i < end; ++i) keys[i].index = run[i - begin].second;
    }
}

}  // namespace

std::uint32_t octant_of(const Photon& photon, const PhotonMapView& view, std::uint64_t upper, int level) {
    if (level >= k_lower_bits) return static_cast<std::uint32_t>(upper >> (3 * (level - k_lower_bits)) & 7u);
    return static_cast<std::uint32_t>(lower_key(photon, view) >> (3 * level) & 7u);
}

void sort_by_morton(const std::vector<Photon>& photons, const Workers& workers, PhotonMapView& view,
                    std::vector<MortonKey>& keys, std::vector<MortonKey>& scratch) {
    keys.resize(photons.size());
    scratch.resize(photons.size());
    set_cube(photons, workers, view);
    workers.run(k_shares, [&](int s) {
        const Share share(photons.size(), s, k_shares);
        for (std::size_t i = share.begin; i < share.end; ++i) {
            keys[i] = {upper_key(photons[i], view), static_cast<std::uint32_t>(i)};
        }
    });
    std::vector<std::array<std::uint32_t, k_digits>> offsets(k_shares);
    for (int shift = 0; shift < 63; shift += k_digit) {
        if (sort_digit(keys, scratch, shift, workers, offsets)) keys.swap(scratch);
    }
    sort_ties(photons, view, keys);
}

}  // namespace cardioid::photon
