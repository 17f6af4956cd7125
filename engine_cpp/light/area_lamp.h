// SPDX-License-Identifier: GPL-3.0-or-later
// Area lamps: one-sided rectangles and ellipses, optionally with a spread (the attenuation of a soft box grid). With a
// spread only the part of the lamp that can light the receiver is sampled.
#pragma once

#include "light/fetch.h"
#include "light/kernels.h"
#include "light/rectangle.h"

namespace cardioid::CD_ISA_NS {

/// An area lamp as a receiver sees it. Coordinates (x, y) are along the lamp's axes, from the receiver's foot point.
struct SeenArea {
    Vec3 u, v, normal;
    Float center_x, center_y, half_u, half_v;
    Float tan_half_spread, spread_factor;
    SeenRectangle rect;
    Mask in_front;    ///< the receiver is on the side that emits, and something of the lamp can light it
    Mask round;       ///< ellipse
    Mask by_ellipse;  ///< sampled uniformly over the ellipse's area; otherwise through `rect`
};

inline SeenArea see_area(const light::LightData& lights, RecordIndex index, Mask round, Vec3 p, Mask active) {
    namespace lamp = light::lamp;
    SeenArea a;
    a.u = fetch3(lights.lamp, index, lamp::axis_u);
    a.v = fetch3(lights.lamp, index, lamp::axis_v);
    a.normal = fetch3(lights.lamp, index, lamp::normal);
    a.half_u = fetch(lights.lamp, index, lamp::half_u);
    a.half_v = fetch(lights.lamp, index, lamp::half_v);
    a.tan_half_spread = fetch(lights.lamp, index, lamp::tan_half_spread);
    a.spread_factor = fetch(lights.lamp, index, lamp::spread_factor);
    a.round = round;
    const Vec3 to_center = fetch3(lights.lamp, index, lamp::position) - p;
    a.center_x = dot(to_center, a.u);
    a.center_y = dot(to_center, a.v);
    const Float z = -dot(to_center, a.normal);
    a.in_front = active & (z > Float(1e-30f));

    // Light reaches the foot point's surroundings only out to this radius in the lamp's plane.
    const Float reach = min(z * a.tan_half_spread, 1e30f);
    const Float x0 = max(a.center_x - a.half_u, -reach), x1 = min(a.center_x + a.half_u, reach);
    const Float y0 = max(a.center_y - a.half_v, -reach), y1 = min(a.center_y + a.half_v, reach);
    a.in_front &= (x1 > x0) & (y1 > y0);
    a.by_ellipse = a.round & ((x1 - x0) * (y1 - y0) >= k_pi * a.half_u * a.half_v);
    a.rect = see_rectangle(x0, x1, y0, y1, z, a.in_front & ~a.by_ellipse);
    return a;
}

/// Share of the radiance that leaves toward a receiver at lateral distance² `r2` from the foot point.
inline Float spread_attenuation(const SeenArea& a, Float r2) {
    const Float tangent = sqrt(r2) / max(a.rect.z, 1e-30f);
    const Float open = max(a.tan_half_spread - tangent, 0.0f) * a.spread_factor;
    return select(a.tan_half_spread >= Float(light::lamp::k_no_spread), Float(1.0f), open);
}

inline Mask inside_ellipse(const SeenArea& a, Float x, Float y) {
    const Float ex = (x - a.center_x) / a.half_u, ey = (y - a.center_y) / a.half_v;
    return ex * ex + ey * ey <= Float(1.0f);
}

/// Density in solid angle of the point at squared distance t2 (if the lamp is there).
inline Float area_pdf(const SeenArea& a, Float t2) {
    const Float by_ellipse = t2 * sqrt(t2) / max(k_pi * a.half_u * a.half_v * a.rect.z, 1e-37f);
    return select(a.by_ellipse, by_ellipse, rectangle_pdf(a.rect, t2));
}

struct AreaPoint {
    Float x, y, t2, radiance_factor, pdf;
    Mask valid;
};
inline AreaPoint sample_area(const SeenArea& a, Float u, Float v) {
    RectanglePoint point = sample_rectangle(a.rect, u, v);
    if (any(a.by_ellipse)) {
        Float s, c;
        sincos(k_two_pi * v, s, c);
        const Float r = sqrt(u);
        point.x = select(a.by_ellipse, fma(r * c, a.half_u, a.center_x), point.x);
        point.y = select(a.by_ellipse, fma(r * s, a.half_v, a.center_y), point.y);
    }
    const Float r2 = fma(point.x, point.x, point.y * point.y);
    AreaPoint out;
    out.x = point.x;
    out.y = point.y;
    out.t2 = fma(a.rect.z, a.rect.z, r2);
    out.radiance_factor = spread_attenuation(a, r2);
    out.pdf = area_pdf(a, out.t2);
    out.valid = a.in_front & (out.radiance_factor > Float(0.0f)) &
                (~a.round | a.by_ellipse | inside_ellipse(a, point.x, point.y));
    return out;
}

}  // namespace cardioid::CD_ISA_NS
