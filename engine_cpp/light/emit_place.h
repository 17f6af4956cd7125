// SPDX-License-Identifier: GPL-3.0-or-later
// Photons of point and spot lamps (spheres, facing disks, size zero): a direction, half of them toward the casters, and a point
// of the lamp's cross section. Both ends of a ray compute its density here.
#pragma once

#include "light/emit.h"
#include "light/fetch.h"
#include "light/point_lamp.h"

namespace cardioid::CD_ISA_NS {

/// light::emission's record of each lane.
struct DirectionMap {
    Vec3 axis, tangent;
    Float one_minus_cos, x0, x1, half_y, density_in, density_out;
};

inline DirectionMap fetch_directions(const light::LightData& lights, RecordIndex at) {
    namespace emission = light::emission;
    const float* p = lights.lamp_emission;
    return {
        fetch3(p, at, emission::axis),      fetch3(p, at, emission::tangent),   fetch(p, at, emission::one_minus_cos),
        fetch(p, at, emission::x0),         fetch(p, at, emission::x1),         fetch(p, at, emission::half_y),
        fetch(p, at, emission::density_in), fetch(p, at, emission::density_out)};
}

struct MadeDirection {
    Vec3 d;
    Float pdf;  ///< per sr
};

/// Two numbers in [0, 1) stretched so that half of them fall into the rectangle: piecewise linear and one-to-one.
inline MadeDirection sample_directions(const light::LightData& lights, RecordIndex at, Float u, Float v) {
    namespace emission = light::emission;
    const DirectionMap m = fetch_directions(lights, at);
    const Float below = fetch(lights.lamp_emission, at, emission::mass_below);
    const Float between = fetch(lights.lamp_emission, at, emission::mass_between);
    const Float side = fetch(lights.lamp_emission, at, emission::mass_side);
    const Mask before = u < below, within = ~before & (u < below + between);
    const Float thin = 1.0f / m.density_out;
    const Float x =
        select(before, u * thin,
               select(within, fma((u - below) / between, m.x1 - m.x0, m.x0), fma(u - below - between, thin, m.x1)));
    const Mask under = v < side, over = v >= 1.0f - side;
    const Float bottom = 0.5f - m.half_y, height = 2.0f * m.half_y, scale = bottom / max(side, 1e-30f);
    const Float middle = fma(v - side, height / max(1.0f - 2.0f * side, 1e-30f), bottom);
    const Float stretched = select(under, v * scale, select(over, fma(v - 1.0f, scale, 1.0f), middle));
    const Float y = select(within, stretched, v);
    const ConeDirection cone = sample_cone(m.one_minus_cos, min(x, 1.0f), y);
    MadeDirection out;
    out.d = m.tangent * cone.local.x + cross(m.axis, m.tangent) * cone.local.y + m.axis * cone.local.z;
    const Mask in = within & ~under & ~over;
    out.pdf = select(in, m.density_in, m.density_out) / (k_two_pi * m.one_minus_cos);
    return out;
}

inline Float directions_pdf(const light::LightData& lights, RecordIndex at, Vec3 d) {
    const DirectionMap m = fetch_directions(lights, at);
    // |d - axis|² / 2 is 1 - cos without cancellation.
    const Float x = 0.5f * length_squared(d - m.axis) / m.one_minus_cos;
    const Float turn = atan2(dot(d, cross(m.axis, m.tangent)), dot(d, m.tangent)) * (1.0f / k_two_pi);
    const Float y = select(turn < Float(0.0f), turn + 1.0f, turn);
    const Mask in = (x >= m.x0) & (x <= m.x1) & (abs(y - 0.5f) <= m.half_y);
    const Float density = select(in, m.density_in, m.density_out) / (k_two_pi * m.one_minus_cos);
    return select(x <= Float(1.000001f), density, Float(0.0f));
}

/// Rays of a sphere fill its inside, too: a small share of the photons, with a uniform direction, from the far side.
inline Float inside_pdf() { return k_inv_four_pi * light::emission::k_inside_share; }
inline Float outside_pdf(Float directions) { return directions * (1.0f - light::emission::k_inside_share); }

/// m² of a lamp's cross section.
inline Float ball_section(Float radius_squared) { return k_pi * radius_squared; }

}  // namespace cardioid::CD_ISA_NS
