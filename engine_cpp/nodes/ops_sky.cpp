// SPDX-License-Identifier: GPL-3.0-or-later
// Sky Texture: analytic models by coefficients, and pictures with the sun's disc; results are linear Rec.709 without negative
// channels, as in Cycles.
#include "nodes/kernel.h"
#include "nodes/sky_data.h"

namespace cardioid::CD_ISA_NS {

using nodes::Instruction;

namespace {

Vec3 rgb_of(Vec3 c) {
    const Vec3 rgb = {3.2404542f * c.x - 1.5371385f * c.y - 0.4985314f * c.z,
                      -0.9692660f * c.x + 1.8760108f * c.y + 0.0415560f * c.z,
                      0.0556434f * c.x - 0.2040259f * c.y + 1.0572252f * c.z};
    return {max(rgb.x, 0.0f), max(rgb.y, 0.0f), max(rgb.z, 0.0f)};
}

Float safe_acos(Float x) { return acos(clamp(x, -1.0f, 1.0f)); }

Float preetham(const float* c, Float cos_theta, Float gamma, Float cos_gamma) {
    return (1.0f + c[0] * exp(c[1] / cos_theta)) * (1.0f + c[2] * exp(c[3] * gamma) + c[4] * cos_gamma * cos_gamma);
}

Float hosek(const float* c, Float cos_theta, Float gamma, Float cos_gamma) {
    const Float ray = cos_gamma * cos_gamma, base = 1.0f + c[8] * c[8] - 2.0f * c[8] * cos_gamma;
    const Float mie = (1.0f + ray) / (base * sqrt(base));
    return (1.0f + c[0] * exp(c[1] / (cos_theta + 0.01f))) *
           (c[2] + c[3] * exp(c[4] * gamma) + c[5] * ray + c[6] * mie + c[7] * sqrt(max(cos_theta, 0.0f)));
}

/// The picture at x, y in [0, 1], linear, its borders repeated.
Vec3 picture(const float* data, Float x, Float y) {
    const float* pixels = data + nodes::sky_pixels;
    const auto w = static_cast<int>(data[nodes::sky_width]), h = static_cast<int>(data[nodes::sky_height]);
    const Float px = x * static_cast<float>(w) - 0.5f, py = y * static_cast<float>(h) - 0.5f;
    const Float fx = floor(px), fy = floor(py), tx = px - fx, ty = py - fy;
    const auto column = [&](Int i) { return min(max(i, Int(0)), Int(w - 1)); };
    const auto row = [&](Int i) { return min(max(i, Int(0)), Int(h - 1)); };
    const Int x0 = column(to_int(fx)), x1 = column(to_int(fx) + Int(1)), y0 = row(to_int(fy)),
              y1 = row(to_int(fy) + Int(1));
    const auto pixel = [&](Int i, Int j) {
        const Int at = (j * Int(w) + i) * Int(3);
        return Vec3{gather(pixels, at), gather(pixels + 1, at), gather(pixels + 2, at)};
    };
    const Vec3 low = pixel(x0, y0) * (1.0f - tx) + pixel(x1, y0) * tx;
    const Vec3 high = pixel(x0, y1) * (1.0f - tx) + pixel(x1, y1) * tx;
    return low * (1.0f - ty) + high * ty;
}

/// XYZ of the sun's disc; `on` tells which lanes see it.
Vec3 sun(const float* data, Vec3 d, Float elevation, bool whole, Mask& on) {
    const float diameter = data[nodes::sky_diameter], center = data[nodes::sky_elevation], half = 0.5f * diameter;
    const Vec3 s = {data[nodes::sky_sun], data[nodes::sky_sun + 1], data[nodes::sky_sun + 2]};
    const Float angle = 2.0f * atan2(length(d - s), length(d + s));
    on = (angle < Float(half)) & (whole ? elevation > Float(data[nodes::sky_ground]) : d.z >= Float(0.0f));
    const bool cut = !whole && center - half <= 0;
    const Float t = cut ? elevation * (1.0f / (center + half)) : (elevation - center) * (1.0f / diameter) + 0.5f;
    const Float ratio = angle * (1.0f / half);
    const Float dim = 1.0f - 0.6f * (1.0f - sqrt(max(1.0f - ratio * ratio, 0.0f)));
    const auto channel = [&](int k) {
        const float bottom = data[nodes::sky_bottom + k], top = data[nodes::sky_top + k];
        const Float v = (bottom + (top - bottom) * t) * dim * data[nodes::sky_intensity];
        return select(on, v, Float(0.0f));
    };
    if (center + half <= 0 && !whole) return {0.0f, 0.0f, 0.0f};
    return {channel(0), channel(1), channel(2)};
}

}  // namespace

void op_sky_model(const Machine& m, const Instruction& in) {
    const float* c = m.view.data + in.data;
    const Source3 direction = m.arg3(in, 0);
    for (int i = 0; i < m.end; i += W) {
        const Vec3 d = direction.at(i);
        const Float theta = safe_acos(d.z), phi = 0.5f * k_pi - atan2(d.y, d.x);
        const float sun_sine = __builtin_sinf(c[1]), sun_cosine = __builtin_cosf(c[1]);
        const Float cos_gamma = sun_sine * sin(theta) * cos(phi - c[0]) + sun_cosine * cos(theta);
        const Float gamma = safe_acos(cos_gamma), cos_theta = cos(min(theta, 0.5f * k_pi - 0.001f));
        const auto value = [&](int k) {
            const float* table = c + 5 + 9 * k;
            return c[2 + k] * (in.imm == 0 ? preetham(table, cos_theta, gamma, cos(gamma))
                                           : hosek(table, cos_theta, gamma, cos(gamma)));
        };
        const Float a = value(0), b = value(1), e = value(2);
        if (in.imm != 0) {
            store_vec(m, in, 0, i, rgb_of({a, b, e}) * Float(2.0f * k_pi / 683.0f));
            continue;
        }
        // a is Y; b and e are x and y.
        const Float s = select(e != Float(0.0f), a / e, Float(0.0f));
        store_vec(m, in, 0, i, rgb_of({b * s, a, (1.0f - b - e) * s}));
    }
}

void op_sky_image(const Machine& m, const Instruction& in) {
    const float* data = m.view.data + in.data;
    const bool whole = in.imm != 0;
    const Source3 direction = m.arg3(in, 0);
    for (int i = 0; i < m.end; i += W) {
        const Vec3 d = direction.at(i);
        const Float elevation = 0.5f * k_pi - safe_acos(d.z), around = atan2(d.y, d.x);
        const Float turn = (data[nodes::sky_rotation] - around - 0.5f * k_pi) * (0.5f * k_inv_pi);
        const Float x = turn - floor(turn), bent = sqrt(abs(elevation) * (2.0f * k_inv_pi));
        Vec3 xyz = picture(
            data, x, whole ? copysign(bent, elevation) * 0.5f + 0.5f : select(d.z >= Float(0.0f), bent, Float(0.0f)));
        if (!whole) {
            const Float fade = max(1.0f + 2.5f * d.z, 0.0f);
            xyz = xyz * select(d.z >= Float(0.0f), Float(1.0f), fade * fade * fade);
        }
        if (data[nodes::sky_diameter] > 0) {
            Mask on = mask_of(false);
            const Vec3 disc = sun(data, d, elevation, whole, on);
            xyz = whole ? xyz + disc : select(on, disc, xyz);
        }
        store_vec(m, in, 0, i, rgb_of(xyz));
    }
}

}  // namespace cardioid::CD_ISA_NS
