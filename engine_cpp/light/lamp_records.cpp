// SPDX-License-Identifier: GPL-3.0-or-later
#include "light/lamp_records.h"

#include <numbers>

namespace cardioid::light {
namespace {

using scene::LightDesc;
using scene::LightKind;

constexpr float k_pi = std::numbers::pi_v<float>;
/// Smaller lamps are points: the square of the radius would leave the range of float.
constexpr float k_least_radius = 1e-8f;

void put(LampRecord& r, int field, Float3 v) {
    r.value[field] = v.x;
    r.value[field + 1] = v.y;
    r.value[field + 2] = v.z;
}

float mean_absolute(Float3 c) { return (std::fabs(c.x) + std::fabs(c.y) + std::fabs(c.z)) / 3; }

bool is_finite(Float3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool is_usable(const LampInput& in) {
    const LightDesc& d = in.desc;
    for (const float m : d.transform.m) {
        if (!std::isfinite(m)) return false;
    }
    for (const float v : {d.energy, d.radius, d.spot_angle, d.spot_blend, d.angle, d.size_x, d.size_y, d.spread}) {
        if (!std::isfinite(v)) return false;
    }
    return is_finite(d.color) && is_finite(in.program_estimate) && !d.portal;
}

/// Direction of the lamp, -z of its transform; straight down where the transform has none.
Float3 direction(const LightDesc& d) {
    const Float3 dir = normalize(d.transform.column(2) * -1.0f);
    return dot(dir, dir) > 0.5f ? dir : Float3{0, 0, -1};
}

Float3 any_perpendicular(Float3 n) {
    const Float3 other = std::fabs(n.x) < 0.7f ? Float3{1, 0, 0} : Float3{0, 1, 0};
    return normalize(cross(n, other));
}

/// The first `count` rows of the inverse of the linear part; zeros where there is none.
void put_rows(const Affine& t, int field, int count, LampRecord& r) {
    if (t.determinant() == 0) return;
    const Affine inv = inverse(t);
    for (int k = 0; k < count; ++k) {
        const auto row = static_cast<std::size_t>(4 * k);
        put(r, field + 3 * k, {inv.m[row], inv.m[row + 1], inv.m[row + 2]});
    }
}

void make_point(const LampInput& in, LampRecord& r) {
    const LightDesc& d = in.desc;
    const float radius = std::fabs(d.radius) < k_least_radius ? 0 : std::fabs(d.radius);
    const bool disk = d.legacy_lamp || in.soft_falloff;
    const EmitterKind kind = radius == 0 ? EmitterKind::delta_point
                             : disk      ? EmitterKind::facing_disk
                                         : EmitterKind::sphere;
    // Watts leave a sphere of area 4 pi r²; the facing disk has the same intensity on its axis.
    const float unit_area = radius == 0 ? 4.0f : 4 * k_pi * radius * radius;
    const Float3 value = d.color * (d.energy / (k_pi * (d.normalize ? unit_area : 1.0f)));
    const float intensity_area = radius == 0 ? 1.0f : k_pi * radius * radius;

    const Float3 at = d.transform.translation();
    r.number[lamp::kind] = static_cast<std::int32_t>(kind);
    put(r, lamp::position, at);
    put(r, lamp::radiance, value);
    r.value[lamp::radius] = radius;
    r.value[lamp::radius_squared] = radius * radius;
    put(r, lamp::normal, direction(d));
    put_rows(d.transform, lamp::spot_rows, 3, r);
    const Float3 reach{radius, radius, radius};
    extend(r.bounds, at - reach);
    extend(r.bounds, at + reach);
    r.bounds.radius_squared = radius * radius;
    r.bounds.theta_o = k_pi;
    r.bounds.theta_e = k_pi / 2;
    r.bounds.energy = mean_absolute(value * in.program_estimate) * intensity_area;
    r.hittable = radius > 0;
}

void make_spot(const LampInput& in, LampRecord& r) {
    const LightDesc& d = in.desc;
    make_point(in, r);
    const float half = std::clamp(0.5f * d.spot_angle, 1e-4f, k_pi / 2);
    const float cos_half = std::cos(half);
    const float blend = (1 - cos_half) * std::max(d.spot_blend, 0.0f);
    const Float3 dir = direction(d);
    const Affine& t = d.transform;
    float cos_wide = cos_half;
    if (d.legacy_lamp || t.determinant() == 0) {
        const Float3 u = any_perpendicular(dir);
        put(r, lamp::spot_rows, u);
        put(r, lamp::spot_rows + 3, cross(dir, u));
        put(r, lamp::spot_rows + 6, dir);
    } else {
        // The cone follows the lamp's scale, so a stretched lamp has an elliptic cone.
        for (int k = 6; k < 9; ++k) r.value[lamp::spot_rows + k] *= -1.0f;
        const float u2 = dot(t.column(0), t.column(0)), v2 = dot(t.column(1), t.column(1)),
                    w2 = dot(t.column(2), t.column(2));
        const float slope = std::tan(half);
        cos_wide = half >= k_pi / 2 - 1e-4f ? 0.0f : 1 / std::sqrt(1 + slope * slope * std::max(u2, v2) / w2);
        // A sheared cone leans away from its axis: then the whole half space is kept.
        const float lean = std::fabs(dot(t.column(0), t.column(2))) + std::fabs(dot(t.column(1), t.column(2))) +
                           std::fabs(dot(t.column(0), t.column(1)));
        if (lean > 1e-4f * (u2 + v2 + w2)) cos_wide = -1;
    }
    r.value[lamp::spot_cos] = cos_half;
    r.value[lamp::spot_inv_blend] = 1 / std::max(blend, 1e-12f);
    r.value[lamp::spot_one_minus_cos] = 1 - cos_wide;
    r.number[lamp::flags] |= lamp::is_spot | (d.legacy_lamp ? lamp::spot_cosine : 0);
    r.bounds.axis = dir;
    r.bounds.theta_o = std::acos(std::clamp(cos_wide, -1.0f, 1.0f));
    r.bounds.theta_e = 1e-3f;
}

void make_sun(const LampInput& in, Float3 scene_min, Float3 scene_max, LampRecord& r) {
    const LightDesc& d = in.desc;
    const float half = std::clamp(0.5f * std::fabs(d.angle), 0.0f, d.legacy_lamp ? 1.57f : k_pi / 2);
    const bool delta = half < 1e-6f;
    const float s = std::sin(half), slope = std::tan(half);
    const float area = d.legacy_lamp ? k_pi * slope * slope : d.normalize ? k_pi * s * s : 1.0f;
    const Float3 value = d.color * (delta ? d.energy : d.energy / area);
    const Float3 toward = direction(d) * -1.0f;
    const float half_sine = std::sin(0.5f * half);
    r.number[lamp::kind] = static_cast<std::int32_t>(delta ? EmitterKind::delta_sun : EmitterKind::sun);
    r.number[lamp::flags] |= d.legacy_lamp ? lamp::legacy_sun : 0;
    put(r, lamp::position, toward);
    put(r, lamp::radiance, value);
    put(r, lamp::normal, toward * -1.0f);
    r.value[lamp::sun_one_minus_cos] = 2 * half_sine * half_sine;
    put_rows(d.transform, lamp::sun_rows, 2, r);
    r.hittable = !delta;

    // For choosing, a sun is a lamp so far away that its direction and distance are the same for the whole scene.
    const Float3 middle = (scene_min + scene_max) * 0.5f;
    const bool bounded = is_finite(middle) && scene_max.x >= scene_min.x;
    const float reach = bounded ? length(scene_max - scene_min) + length(middle) : 1.0f;
    const float far = 1e5f * std::clamp(reach, 1.0f, 1e8f);
    const Float3 at = (bounded ? middle : Float3{}) + toward * far;
    const float radius = far * (s + 1e-4f);
    extend(r.bounds, at - Float3{radius, radius, radius});
    extend(r.bounds, at + Float3{radius, radius, radius});
    r.bounds.radius_squared = radius * radius;
    r.bounds.theta_o = k_pi;
    r.bounds.theta_e = k_pi / 2;
    r.bounds.energy = mean_absolute(value * in.program_estimate) * (delta ? 1.0f : k_pi * s * s) * far * far;
}

/// Spread of a soft box grid: attenuation is (tan_half - tan θ) × factor, normalised to the same power at every spread.
void put_spread(const LightDesc& d, LampRecord& r) {
    const float least = d.legacy_lamp ? k_pi / 180 : 0.1f * k_pi / 180;
    const float half = 0.5f * std::max(d.spread, least);
    if (half >= k_pi / 2 - 1e-4f) {
        r.value[lamp::tan_half_spread] = lamp::k_no_spread;
        r.value[lamp::spread_factor] = 1 / lamp::k_no_spread;
        r.bounds.theta_e = k_pi / 2;
        return;
    }
    const float slope = std::tan(half);
    r.value[lamp::tan_half_spread] = slope;
    r.value[lamp::spread_factor] = half > 0.05f ? 1 / (slope - half) : 3 / (half * half * half);
    r.number[lamp::flags] |= lamp::has_spread;
    r.bounds.theta_e = half;
}

void make_area(const LampInput& in, LampRecord& r) {
    const LightDesc& d = in.desc;
    const bool square = d.shape == scene::AreaShape::square || d.shape == scene::AreaShape::disk;
    const bool round = d.shape == scene::AreaShape::disk || d.shape == scene::AreaShape::ellipse;
    const Float3 x = d.transform.column(0), y = d.transform.column(1);
    const float half_u = 0.5f * std::fabs(d.size_x) * length(x);
    const float half_v = 0.5f * std::fabs(square ? d.size_x : d.size_y) * length(y);
    const float area = 4 * half_u * half_v * (round ? k_pi / 4 : 1);
    if (!(area > 1e-30f)) return;
    const Float3 u = normalize(x);
    const Float3 normal = normalize(cross(u, normalize(y)));
    if (dot(normal, normal) < 0.5f) return;
    const Float3 v = cross(normal, u);
    const Float3 emits = dot(normal, direction(d)) >= 0 ? normal : normal * -1.0f;
    // Blender 4.0 changed the radiance of area lamps from E/(4A) to E/(pi A); see light/README.md.
    const Float3 value = d.color * (d.energy / ((d.legacy_lamp ? 4.0f : k_pi) * (d.normalize ? area : 1.0f)));

    r.number[lamp::kind] = static_cast<std::int32_t>(round ? EmitterKind::ellipse : EmitterKind::rectangle);
    const Float3 at = d.transform.translation();
    put(r, lamp::position, at);
    put(r, lamp::radiance, value);
    put(r, lamp::normal, emits);
    put(r, lamp::axis_u, u);
    put(r, lamp::axis_v, v);
    r.value[lamp::half_u] = half_u;
    r.value[lamp::half_v] = half_v;
    r.value[lamp::inv_area] = 1 / area;
    put_spread(d, r);
    for (const float a : {-1.0f, 1.0f}) {
        for (const float b : {-1.0f, 1.0f}) extend(r.bounds, at + u * (a * half_u) + v * (b * half_v));
    }
    r.bounds.radius_squared =
        round ? std::max(half_u, half_v) * std::max(half_u, half_v) : half_u * half_u + half_v * half_v;
    r.bounds.axis = emits;
    const float peak = r.value[lamp::tan_half_spread] * r.value[lamp::spread_factor];
    r.bounds.energy = mean_absolute(value * in.program_estimate) * area * peak;
    r.hittable = true;
}

void make_kind(const LampInput& in, Float3 scene_min, Float3 scene_max, LampRecord& r) {
    switch (in.desc.kind) {
        case LightKind::point: make_point(in, r); return;
        case LightKind::spot: make_spot(in, r); return;
        case LightKind::sun: make_sun(in, scene_min, scene_max, r); return;
        case LightKind::area: make_area(in, r); return;
    }
}

}  // namespace

LampRecord make_lamp_record(const LampInput& in, Float3 scene_min, Float3 scene_max) {
    LampRecord r;
    if (!is_usable(in)) return r;
    const LightDesc& d = in.desc;
    r.number[lamp::program] = in.program;
    r.number[lamp::flags] = (d.cast_shadow ? 0 : lamp::no_shadow) | (d.legacy_lamp ? lamp::legacy_place : 0);
    r.number[lamp::visibility] = d.visibility;
    r.number[lamp::hit_visibility] = d.use_mis ? d.visibility : d.visibility & scene::visible_camera;
    r.number[lamp::max_bounces] = d.max_bounces;
    make_kind(in, scene_min, scene_max, r);
    r.box_lower = r.bounds.lower;
    r.box_upper = r.bounds.upper;
    const bool gives_light = r.bounds.energy > 0 && std::isfinite(r.bounds.energy);
    r.hittable = r.hittable && gives_light && r.number[lamp::hit_visibility] != 0;
    // Cycles never shows a sun that is not found by its sampling.
    r.hittable = r.hittable && (d.use_mis || d.kind != LightKind::sun);
    if (!r.hittable || !d.use_mis) r.number[lamp::flags] |= lamp::never_hit;
    const int lighting =
        scene::visible_diffuse | scene::visible_glossy | scene::visible_transmission | scene::visible_volume;
    if (!gives_light || (d.visibility & lighting) == 0) r.bounds.energy = 0;
    return r;
}

}  // namespace cardioid::light
