// SPDX-License-Identifier: GPL-3.0-or-later
// Camera rays over lanes: pixel filter by importance sampling, thin lens with blades, clipping.
#pragma once

#include "path/dimensions.h"

namespace cardioid::CD_ISA_NS {

struct CameraRays {
    Vec3 o, d;
    Float t_min, t_max;
    Float width, spread;  ///< cone of the pixel
};

/// Quantile u of the pixel filter, in pixels around the centre.
inline Float filter_offset(const float* table, Float u) {
    const Float x = u * 1024.0f;
    const Int i = min(to_int(x), Int(1023));
    const Float f = x - to_float(i);
    const Float a = gather(table, i);
    return fma(gather(table, i + Int(1)) - a, f, a);
}

/// Point of the unit disk by concentric map (Shirley & Chiu 1997).
inline Vec2 concentric_disk(Vec2 u) {
    const Float x = 2.0f * u.x - 1.0f, y = 2.0f * u.y - 1.0f;
    const Mask wide = abs(x) > abs(y);
    const Float r = select(wide, x, y);
    const Float q = select(wide, y, x) / select(r == Float(0.0f), Float(1.0f), r);
    const Float phi = select(wide, q * 0.78539816f, 1.57079633f - q * 0.78539816f);
    Float s, c;
    sincos(phi, s, c);
    return {r * c, r * s};
}

/// Point of a regular polygon of unit circumradius.
inline Vec2 polygon_point(int blades, float rotation, Vec2 u) {
    const Float scaled = u.x * static_cast<float>(blades);
    const Float corner = floor(scaled);
    const Float r = sqrt(scaled - corner);
    const Float v = u.y;
    const float angle = k_pi / static_cast<float>(blades);
    const float c = __builtin_cosf(angle), s = __builtin_sinf(angle);
    const Float px = r * c, py = (2.0f * v - 1.0f) * r * s;
    Float sr, cr;
    sincos(corner * (2.0f * angle) + rotation, sr, cr);
    return {px * cr - py * sr, px * sr + py * cr};
}

inline Vec3 transform_vector(const Affine& m, Vec3 v) {
    return {m.m[0] * v.x + m.m[1] * v.y + m.m[2] * v.z, m.m[4] * v.x + m.m[5] * v.y + m.m[6] * v.z,
            m.m[8] * v.x + m.m[9] * v.y + m.m[10] * v.z};
}

inline CameraRays camera_rays(const trace::CameraView& camera, const float* filter_table, Float x, Float y,
                              Vec2 u_pixel, Vec2 u_lens) {
    const scene::CameraDesc& c = camera.desc;
    const Float px = c.view_plane[0] + (x + 0.5f + filter_offset(filter_table, u_pixel.x)) * camera.pixel_x;
    const Float py = c.view_plane[2] + (y + 0.5f + filter_offset(filter_table, u_pixel.y)) * camera.pixel_y;
    const bool ortho = c.kind == scene::CameraKind::orthographic;
    Vec3 o = ortho ? Vec3{px, py, 0.0f} : Vec3{0.0f, 0.0f, 0.0f};
    Vec3 d = ortho ? Vec3{0.0f, 0.0f, -1.0f} : Vec3{px, py, -1.0f};  // one unit along the axis per unit of t
    if (c.aperture_radius > 0) {
        Vec2 lens = c.blades >= 3 ? polygon_point(c.blades, c.blade_rotation, u_lens) : concentric_disk(u_lens);
        const Vec3 focus = o + d * c.focus_distance;
        o = o + Vec3{lens.x * (c.aperture_radius / c.aperture_ratio), lens.y * c.aperture_radius, 0.0f};
        d = (focus - o) * (1.0f / c.focus_distance);
    }
    const Float scale = length(d);
    CameraRays r;
    r.d = transform_vector(c.transform, d * (1.0f / scale));
    // A camera with a scaled matrix would leave directions that are not of unit length.
    r.d = normalize(r.d);
    r.o = transform_vector(c.transform, o) + Vec3{c.transform.m[3], c.transform.m[7], c.transform.m[11]};
    r.t_min = c.clip_start * scale;
    r.t_max = c.clip_end * scale;
    r.width = ortho ? Float(camera.pixel_x) : Float(0.0f);
    r.spread = ortho ? Float(0.0f) : camera.pixel_x / scale;
    return r;
}

}  // namespace cardioid::CD_ISA_NS
