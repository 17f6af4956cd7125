// SPDX-License-Identifier: GPL-3.0-or-later
// How bright a cluster is to outlier rejection, and how many samples it stands for.
#pragma once

#include "film/cluster.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace cardioid::filter {

/// Samples are counted in whole numbers of this part of one, so that their sum does not depend on the order.
inline constexpr std::int64_t k_evidence = 65536;

struct Range {
    float low = 0, high = 0;
    bool touches(const Range& other) const { return high >= other.low && low <= other.high; }
};

inline Range operator*(const Range& r, float scale) { return {r.low * scale, r.high * scale}; }

struct Measure {
    Range range;
    std::int64_t evidence = 0;  ///< samples × k_evidence
};

/// As printed: by the light that arrives.
inline Measure measure_incident(const film::Cluster& c) {
    return {{c.min, c.max}, static_cast<std::int64_t>(c.samples) * k_evidence};
}

/// By the light that is added to the pixel. Samples of a glossy lobe arrive dim and are added bright, I = R/f, so that I would
/// rank them last. The dim samples of a cluster are no evidence for its bright ones: it counts as (ΣR)²/ΣR² of the latter, and
/// the fewer they are of its samples the nearer to them it begins.
inline Measure measure_added(const film::Cluster& c) {
    const float sum = film::luminance(c.radiance);
    if (!(sum > 0) || !(c.radiance_squared > 0)) return {{}, static_cast<std::int64_t>(c.samples) * k_evidence};
    const auto samples = static_cast<float>(c.samples);
    const Range range = Range{c.min, c.max} * (sum / c.incident);
    const float bright = c.radiance_squared / sum;
    const float alike = std::min(sum * (sum / c.radiance_squared), samples);
    const float low = bright - (bright - range.low) * (alike / samples);
    return {{low, std::max(range.high, bright)}, std::llround(static_cast<double>(alike) * k_evidence)};
}

/// How many samples of `m`, whose ends are two of them, lie in a range that it touches.
inline std::int64_t part_in(const Measure& m, const Range& range) {
    const bool low = m.range.low >= range.low, high = m.range.high <= range.high;
    if (low && high) return m.evidence;
    const float share =
        (std::min(m.range.high, range.high) - std::max(m.range.low, range.low)) / (m.range.high - m.range.low);
    const auto between =
        static_cast<double>(std::max<std::int64_t>(m.evidence - 2 * k_evidence, 0)) * static_cast<double>(share);
    return std::min(low || high ? k_evidence : 0, m.evidence) + static_cast<std::int64_t>(between);
}

}  // namespace cardioid::filter
