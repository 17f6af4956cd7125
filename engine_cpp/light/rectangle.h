// SPDX-License-Identifier: GPL-3.0-or-later
// Rectangles seen from a point: solid angle, and uniform sampling in it (Ureña, Fajardo & King 2013). Coordinates are
// relative to the receiver: the rectangle [x0,x1]×[y0,y1] lies in the plane at distance z > 0.
#pragma once

#include "simd/vec.h"

namespace cardioid::CD_ISA_NS {

struct SeenRectangle {
    Float x0, x1, y0, y1, z;
    Float left;  ///< solid angle, signed, between the foot point and the side x0
    Float solid_angle;
    Mask by_solid_angle;  ///< otherwise by area: far, or too small an angle for float
};

/// Beyond this many diagonals (squared) the density over the area hardly varies and the corners need not be evaluated.
inline constexpr float k_far_diagonals2 = 9.0f;
inline constexpr float k_least_solid_angle = 1e-3f;

/// Signed solid angle between the foot point and the side at x from y0 to y1: the difference of the angles atan(xy / zd) at
/// its two ends, taken as the angle of one complex product. Each is under pi/2, so nothing wraps.
inline Float side_angle(Float x, Float y0, Float y1, Float z) {
    const Float side2 = fma(x, x, z * z);
    const Float re0 = z * sqrt(fma(y0, y0, side2)), re1 = z * sqrt(fma(y1, y1, side2));
    const Float im0 = x * y0, im1 = x * y1;
    return atan2(im1 * re0 - im0 * re1, fma(re1, re0, im1 * im0));
}

inline SeenRectangle see_rectangle(Float x0, Float x1, Float y0, Float y1, Float z, Mask active) {
    SeenRectangle r;
    r.x0 = x0;
    r.x1 = x1;
    r.y0 = y0;
    r.y1 = y1;
    r.z = z;
    const Float w = x1 - x0, h = y1 - y0, mx = 0.5f * (x0 + x1), my = 0.5f * (y0 + y1);
    const Float distance2 = fma(mx, mx, fma(my, my, z * z));
    const Mask near = active & (distance2 < k_far_diagonals2 * fma(w, w, h * h));
    r.by_solid_angle = near;
    r.left = r.solid_angle = 0.0f;
    if (none(near)) return r;
    r.left = side_angle(x0, y0, y1, z);
    r.solid_angle = side_angle(x1, y0, y1, z) - r.left;
    r.by_solid_angle = near & (r.solid_angle > Float(k_least_solid_angle));
    return r;
}

/// Density in solid angle of the point at squared distance t2.
inline Float rectangle_pdf(const SeenRectangle& r, Float t2) {
    const Float area = (r.x1 - r.x0) * (r.y1 - r.y0);
    const Float by_area = t2 * sqrt(t2) / max(area * r.z, 1e-37f);
    return select(r.by_solid_angle, 1.0f / max(r.solid_angle, k_least_solid_angle), by_area);
}

struct RectanglePoint {
    Float x, y;
};

inline RectanglePoint sample_solid_angle(const SeenRectangle& r, Float u, Float v) {
    const Float b0 = -r.y0 / sqrt(fma(r.y0, r.y0, r.z * r.z));
    const Float b1 = r.y1 / sqrt(fma(r.y1, r.y1, r.z * r.z));
    const Float angle = fma(u, r.solid_angle, r.left);
    Float s, c;
    sincos(angle, s, c);
    const Float safe_s = copysign(max(abs(s), 1e-12f), s);
    const Float fu = fma(c, b0, b1) / safe_s;
    const Float cu = copysign(min(1.0f / sqrt(fma(fu, fu, b0 * b0)), 1.0f), fu);
    const Float x = clamp(cu * r.z / max(safe_sqrt(1.0f - cu * cu), 1e-7f), r.x0, r.x1);
    const Float d2 = fma(x, x, r.z * r.z);
    const Float h0 = r.y0 / sqrt(fma(r.y0, r.y0, d2));
    const Float h1 = r.y1 / sqrt(fma(r.y1, r.y1, d2));
    const Float h = fma(v, h1 - h0, h0);
    const Float h2 = h * h;
    const Float y = select(h2 < Float(1.0f - 1e-6f), h * sqrt(d2 / max(1.0f - h2, 1e-7f)), r.y1);
    return {x, clamp(y, r.y0, r.y1)};
}

inline RectanglePoint sample_rectangle(const SeenRectangle& r, Float u, Float v) {
    RectanglePoint out{fma(u, r.x1 - r.x0, r.x0), fma(v, r.y1 - r.y0, r.y0)};
    if (none(r.by_solid_angle)) return out;
    const RectanglePoint near = sample_solid_angle(r, u, v);
    return {select(r.by_solid_angle, near.x, out.x), select(r.by_solid_angle, near.y, out.y)};
}

}  // namespace cardioid::CD_ISA_NS
