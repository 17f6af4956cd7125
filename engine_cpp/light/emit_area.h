// SPDX-License-Identifier: GPL-3.0-or-later
// Directions in which area lamps send photons: by cosine, or within the spread nearly in proportion to its light.
#pragma once

#include "light/cone.h"
#include "light/fetch.h"
#include "light/light_data.h"

namespace cardioid::CD_ISA_NS {

/// Wider spreads (half angle 1.15) are nearly those of a lamp without: they are sampled by the cosine within.
inline constexpr float k_wide_spread = 2.2345f;

struct AreaSpread {
    Float tan_half, factor;
    Float sine2;  ///< sin² of the half angle
    Mask open, wide;
};

inline AreaSpread fetch_spread(const light::LightData& lights, RecordIndex at) {
    AreaSpread s;
    s.tan_half = fetch(lights.lamp, at, light::lamp::tan_half_spread);
    s.factor = fetch(lights.lamp, at, light::lamp::spread_factor);
    s.open = s.tan_half >= Float(light::lamp::k_no_spread);
    s.wide = s.tan_half > Float(k_wide_spread);
    const Float slope2 = min(s.tan_half * s.tan_half, 1e30f);
    s.sine2 = select(s.open, Float(1.0f), slope2 / (1.0f + slope2));
    return s;
}

/// Share of the radiance at this sin² of the angle to the normal.
inline Float spread_share(const AreaSpread& s, Float sin2) {
    const Float tangent = sqrt(sin2 / max(1.0f - sin2, 1e-30f));
    return select(s.open, Float(1.0f), max(s.tan_half - tangent, 0.0f) * s.factor);
}

/// Per projected sr. With x = sin θ / sin α, narrow spreads have density 6x(1 - x), wide ones 2x.
inline Float spread_density(const AreaSpread& s, Float sin2) {
    const Float x = sqrt(sin2 / s.sine2);
    const Float shape = select(s.wide, Float(1.0f), 3.0f * max(1.0f - x, 0.0f));
    return select(x <= Float(1.0f), shape * k_inv_pi / s.sine2, Float(0.0f));
}

struct SpreadDirection {
    Vec3 local;  ///< around z
    Float sin2;
};
inline SpreadDirection sample_spread(const AreaSpread& s, Float u, Float v) {
    // The inverse of 3x² - 2x³.
    const Float narrow = 0.5f - sin(asin(1.0f - 2.0f * u) * (1.0f / 3));
    const Float x = select(s.wide, sqrt(u), clamp(narrow, 0.0f, 1.0f));
    SpreadDirection out;
    out.sin2 = min(x * x * s.sine2, 1.0f);
    const Float sine = sqrt(out.sin2);
    Float sin_phi, cos_phi;
    sincos(k_two_pi * v, sin_phi, cos_phi);
    out.local = {sine * cos_phi, sine * sin_phi, safe_sqrt(1.0f - out.sin2)};
    return out;
}

}  // namespace cardioid::CD_ISA_NS
