// SPDX-License-Identifier: GPL-3.0-or-later
#include "light/area_lamp.h"
#include "light/choose.h"
#include "light/environment.h"
#include "light/point_lamp.h"
#include "scene/scene_desc.h"

namespace cardioid::CD_ISA_NS {
namespace {

namespace lamp = light::lamp;
namespace triangle = light::triangle;
using light::EmitterKind;
using light::LightData;

constexpr float k_infinity = 1e30f;

/// Density of the chosen point for its emitter alone; 0 makes the lane invalid.
void set_direction(LightSample& s, Mask lanes, Vec3 wi, Float distance, Vec3 position, Vec3 normal) {
    s.wi = select(lanes, wi, s.wi);
    s.distance = select(lanes, distance, s.distance);
    s.position = select(lanes, position, s.position);
    s.normal = select(lanes, normal, s.normal);
}
void set_value(LightSample& s, Mask lanes, Spectrum radiance, Float pdf, Mask valid) {
    s.radiance = select(lanes, radiance, s.radiance);
    s.pdf = select(lanes, pdf, s.pdf);
    s.valid &= ~lanes | (valid & (pdf > Float(0.0f)));
}

void sample_area_lamp(const LightData& lights, RecordIndex index, LightReceiver at, Vec2 u, Mask round, Mask lanes,
                      LightSample& s) {
    const SeenArea area = see_area(lights, index, round, at.p, lanes);
    const AreaPoint point = sample_area(area, u.x, u.y);
    const Vec3 offset = area.u * point.x + area.v * point.y - area.normal * area.rect.z;
    const Float distance = sqrt(point.t2);
    set_direction(s, lanes, offset * (1.0f / max(distance, 1e-30f)), distance, at.p + offset, area.normal);
    set_value(s, lanes, fetch_rgb(lights.lamp, index, lamp::radiance) * point.radiance_factor, point.pdf, point.valid);
    s.barycentric_u = select(lanes, (point.x - area.center_x) / area.half_u * 0.5f + 0.5f, s.barycentric_u);
    s.barycentric_v = select(lanes, (point.y - area.center_y) / area.half_v * 0.5f + 0.5f, s.barycentric_v);
}

void sample_ball_lamp(const LightData& lights, RecordIndex index, LightReceiver at, Vec2 u, Mask disk, Int flags,
                      Mask lanes, LightSample& s) {
    const SeenBall ball = see_ball(lights, index, disk, flags, at.p);
    const BallSample point = sample_ball(ball, at, u.x, u.y);
    const Vec3 center = fetch3(lights.lamp, index, lamp::position);
    const Vec3 position =
        select(disk, at.p + point.wi * point.t, center + point.normal * fetch(lights.lamp, index, lamp::radius));
    const Float factor = select(ball.within, Float(1.0f), spot_attenuation(lights, index, flags, point.wi));
    set_direction(s, lanes, point.wi, point.t, position, point.normal);
    set_value(s, lanes, fetch_rgb(lights.lamp, index, lamp::radiance) * factor, point.pdf,
              point.valid & (factor > Float(0.0f)));
}

void sample_delta_point(const LightData& lights, RecordIndex index, LightReceiver at, Int flags, Mask lanes,
                        LightSample& s) {
    const Vec3 center = fetch3(lights.lamp, index, lamp::position);
    const Vec3 to = center - at.p;
    const Float d2 = length_squared(to);
    const Float distance = sqrt(d2);
    const Vec3 wi = to * (1.0f / max(distance, 1e-15f));
    const Float factor = spot_attenuation(lights, index, flags, wi);
    set_direction(s, lanes, wi, distance, center, -wi);
    const Spectrum intensity = fetch_rgb(lights.lamp, index, lamp::radiance) * (factor / max(d2, 1e-30f));
    set_value(s, lanes, intensity, 1.0f, (factor > Float(0.0f)) & (d2 > Float(1e-30f)));
}

void sample_sun(const LightData& lights, RecordIndex index, Vec2 u, Int flags, Mask lanes, LightSample& s) {
    const Vec3 toward = fetch3(lights.lamp, index, lamp::position);
    const Float one_minus_cos = fetch(lights.lamp, index, lamp::sun_one_minus_cos);
    const Vec3 wi = Frame(toward).to_world(sample_cone(one_minus_cos, u.x, u.y).local);
    set_direction(s, lanes, wi, k_infinity, wi, -wi);
    const Spectrum radiance = fetch_rgb(lights.lamp, index, lamp::radiance) * sun_factor(lights, index, flags, wi);
    set_value(s, lanes, radiance, cone_pdf(one_minus_cos), lanes);
    s.infinite |= lanes;
}

void sample_delta_sun(const LightData& lights, RecordIndex index, Mask lanes, LightSample& s) {
    const Vec3 wi = fetch3(lights.lamp, index, lamp::position);
    set_direction(s, lanes, wi, k_infinity, wi, -wi);
    set_value(s, lanes, fetch_rgb(lights.lamp, index, lamp::radiance), 1.0f, lanes);
    s.infinite |= lanes;
}

void sample_lamp_kind(const LightData& lights, RecordIndex index, LightReceiver at, Vec2 u, EmitterKind kind, Int flags,
                      Mask lanes, LightSample& s) {
    switch (kind) {
        case EmitterKind::delta_point: sample_delta_point(lights, index, at, flags, lanes, s); return;
        case EmitterKind::sphere: sample_ball_lamp(lights, index, at, u, mask_of(false), flags, lanes, s); return;
        case EmitterKind::facing_disk: sample_ball_lamp(lights, index, at, u, mask_of(true), flags, lanes, s); return;
        case EmitterKind::rectangle: sample_area_lamp(lights, index, at, u, mask_of(false), lanes, s); return;
        case EmitterKind::ellipse: sample_area_lamp(lights, index, at, u, mask_of(true), lanes, s); return;
        case EmitterKind::delta_sun: sample_delta_sun(lights, index, lanes, s); return;
        case EmitterKind::sun: sample_sun(lights, index, u, flags, lanes, s); return;
        default: return;
    }
}

void sample_lamps(const LightData& lights, LightReceiver at, Vec2 u, Mask lanes, LightSample& s) {
    const RecordIndex index = record_index(s.emitter, light::k_lamp_floats, lanes);
    const RecordIndex numbers = record_index(s.emitter, light::k_lamp_ints, lanes);
    const Int kind = fetch(lights.lamp_int, numbers, lamp::kind);
    const Int flags = fetch(lights.lamp_int, numbers, lamp::flags);
    s.program = select(lanes, fetch(lights.lamp_int, numbers, lamp::program), s.program);
    s.visibility = select(lanes, fetch(lights.lamp_int, numbers, lamp::visibility), s.visibility);
    s.max_bounces = select(lanes, fetch(lights.lamp_int, numbers, lamp::max_bounces), s.max_bounces);
    s.casts_shadow &= ~lanes | ((flags & Int(lamp::no_shadow)) == Int(0));
    s.delta |= lanes & ((flags & Int(lamp::never_hit)) != Int(0));
    for (std::uint32_t left = bits(lanes); left != 0;) {
        const int first = kind[std::countr_zero(left)];
        const Mask same = lanes & (kind == Int(first));
        sample_lamp_kind(lights, index, at, u, static_cast<EmitterKind>(first), flags, same, s);
        left &= ~bits(same);
    }
}

void sample_triangles(const LightData& lights, LightReceiver at, Vec2 u, Mask lanes, LightSample& s) {
    const Int id = s.emitter - Int(lights.lamp_count);
    const RecordIndex index = record_index(id, light::k_triangle_floats, lanes);
    const RecordIndex numbers = record_index(id, light::k_triangle_ints, lanes);
    const Float root = sqrt(u.x);
    const Float second = root * (1.0f - u.y), third = root * u.y;
    const Vec3 position = fetch3(lights.triangle, index, triangle::origin) +
                          fetch3(lights.triangle, index, triangle::edge1) * second +
                          fetch3(lights.triangle, index, triangle::edge2) * third;
    const Vec3 normal = fetch3(lights.triangle, index, triangle::normal);
    const Vec3 to = position - at.p;
    const Float d2 = max(length_squared(to), 1e-30f);
    const Float distance = sqrt(d2);
    const Vec3 wi = to * (1.0f / distance);
    const Float cosine = -dot(normal, wi);
    const Mask emits = (cosine > Float(0.0f)) | (fetch(lights.triangle_int, numbers, triangle::two_sided) != Int(0));
    const Float area = fetch(lights.triangle, index, triangle::area);
    const Float pdf = d2 / max(abs(cosine) * area, 1e-37f);
    set_direction(s, lanes, wi, distance, position, normal);
    set_value(s, lanes, fetch_rgb(lights.triangle, index, triangle::radiance), pdf,
              emits & (abs(cosine) > Float(1e-7f)));
    s.program = select(lanes, fetch(lights.triangle_int, numbers, triangle::program), s.program);
    s.instance = select(lanes, fetch(lights.triangle_int, numbers, triangle::instance), s.instance);
    s.triangle = select(lanes, fetch(lights.triangle_int, numbers, triangle::index), s.triangle);
    s.barycentric_u = select(lanes, second, s.barycentric_u);
    s.barycentric_v = select(lanes, third, s.barycentric_v);
}

void sample_world(const LightData& lights, LightReceiver at, Vec2 u, Mask lanes, LightSample& s) {
    const light::EnvironmentData& env = lights.environment;
    const EnvironmentSample sample = sample_environment(lights, at, u.x, u.y);
    const Vec3 zero{0.0f, 0.0f, 0.0f};
    set_direction(s, lanes, sample.wi, k_infinity, sample.wi, zero);
    set_value(s, lanes, {env.color[0], env.color[1], env.color[2]}, sample.pdf, lanes);
    s.program = select(lanes, Int(env.program), s.program);
    s.visibility = select(lanes, Int(env.visibility), s.visibility);
    s.max_bounces = select(lanes, Int(env.max_bounces), s.max_bounces);
    s.infinite |= lanes;
}

LightSample empty_sample(const EmitterPick& pick) {
    LightSample s;
    s.wi = s.position = s.normal = {0.0f, 0.0f, 0.0f};
    s.radiance = Spectrum(0.0f);
    s.distance = s.pdf = s.barycentric_u = s.barycentric_v = 0.0f;
    s.valid = pick.valid;
    s.delta = s.infinite = mask_of(false);
    s.emitter = pick.emitter;
    s.program = s.instance = s.triangle = Int(-1);
    s.visibility = Int(scene::visible_all);
    s.max_bounces = Int(1024);
    s.casts_shadow = mask_of(true);
    return s;
}

}  // namespace

LightSample sample_light(const LightData& lights, LightReceiver at, Vec2 u, Mask active) {
    const EmitterPick pick = pick_emitter(lights, at, u.x, active);
    u.x = pick.u;
    LightSample s = empty_sample(pick);
    const Mask lamps = pick.valid & (s.emitter < Int(lights.lamp_count));
    const Mask world = pick.valid & (s.emitter == Int(lights.environment.emitter));
    const Mask triangles = pick.valid & ~lamps & ~world;
    if (any(lamps)) sample_lamps(lights, at, u, lamps, s);
    if (any(triangles)) sample_triangles(lights, at, u, triangles, s);
    if (any(world)) sample_world(lights, at, u, world, s);
    s.pdf *= pick.pmf;
    s.valid &= s.pdf > Float(0.0f);
    return s;
}

Float pdf_triangle(const LightData& lights, LightReceiver at, Int instance, Int triangle_index, Vec3 hit,
                   Vec3 hit_normal, Mask active) {
    const Int emitter = triangle_emitter(lights, instance, triangle_index, active);
    active &= emitter >= Int(0);
    if (none(active)) return 0.0f;
    const Int id = emitter - Int(lights.lamp_count);
    const Float area = fetch(lights.triangle, record_index(id, light::k_triangle_floats, active), triangle::area);
    const RecordIndex numbers = record_index(id, light::k_triangle_ints, active);
    const Vec3 to = hit - at.p;
    const Float d2 = max(length_squared(to), 1e-30f);
    const Float cosine = -dot(hit_normal, to) / sqrt(d2);
    const Mask emits = (cosine > Float(0.0f)) | (fetch(lights.triangle_int, numbers, triangle::two_sided) != Int(0));
    const Float pdf = d2 / max(abs(cosine) * area, 1e-37f) * pick_probability(lights, at, emitter, active);
    return select(active & emits, pdf, Float(0.0f));
}

}  // namespace cardioid::CD_ISA_NS
