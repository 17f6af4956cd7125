// SPDX-License-Identifier: GPL-3.0-or-later
// Lamps that rays run into. They have no geometry in the ray tracer, because they do not occlude.
#include "light/area_lamp.h"
#include "light/choose.h"
#include "light/point_lamp.h"

namespace cardioid::CD_ISA_NS {
namespace {

namespace lamp = light::lamp;
using light::EmitterKind;
using light::LightData;

constexpr float k_infinity = 1e30f;

void hit_area(const LightData& lights, RecordIndex index, LightReceiver from, Vec3 d, Mask round, Mask active,
              LampHit& h) {
    const SeenArea area = see_area(lights, index, round, from.p, active);
    const Float toward = -dot(d, area.normal);
    h.t = area.rect.z / max(toward, 1e-20f);
    const Float x = dot(d, area.u) * h.t, y = dot(d, area.v) * h.t;
    const Mask on = select(round, inside_ellipse(area, x, y),
                           (abs(x - area.center_x) <= area.half_u) & (abs(y - area.center_y) <= area.half_v));
    const Float r2 = fma(x, x, y * y);
    const Float factor = spread_attenuation(area, r2);
    h.hit = area.in_front & (toward > Float(1e-12f)) & on & (factor > Float(0.0f));
    h.pdf = area_pdf(area, fma(area.rect.z, area.rect.z, r2));
    h.radiance = h.radiance * factor;
    h.normal = area.normal;
}

void hit_point_lamp(const LightData& lights, RecordIndex index, LightReceiver from, Vec3 d, Mask disk, Int flags,
                    Mask active, LampHit& h) {
    const SeenBall ball = see_ball(lights, index, disk, flags, from.p);
    const BallHit hit = hit_ball(ball, d);
    const Float factor = select(ball.within, Float(1.0f), spot_attenuation(lights, index, flags, d));
    h.t = hit.t;
    h.hit = active & hit.hit & (factor > Float(0.0f));
    h.pdf = ball_pdf(ball, from, d);
    h.radiance = h.radiance * factor;
    h.normal = select(disk, -d, normalize(d * hit.t - ball.to_center));
}

void hit_sun(const LightData& lights, RecordIndex index, Vec3 d, Int flags, Mask active, LampHit& h) {
    const Vec3 toward = fetch3(lights.lamp, index, lamp::position);
    const Float limit = fetch(lights.lamp, index, lamp::sun_one_minus_cos);
    // |d - toward|² / 2 is 1 - cos without cancellation.
    h.hit = active & (0.5f * length_squared(d - toward) <= limit);
    h.t = k_infinity;
    h.pdf = cone_pdf(limit);
    h.radiance = h.radiance * sun_factor(lights, index, flags, d);
    h.normal = -d;
}

void hit_kind(const LightData& lights, EmitterKind kind, RecordIndex index, LightReceiver from, Vec3 d, Int flags,
              Mask active, LampHit& h) {
    switch (kind) {
        case EmitterKind::sphere: hit_point_lamp(lights, index, from, d, mask_of(false), flags, active, h); return;
        case EmitterKind::facing_disk: hit_point_lamp(lights, index, from, d, mask_of(true), flags, active, h); return;
        case EmitterKind::rectangle: hit_area(lights, index, from, d, mask_of(false), active, h); return;
        case EmitterKind::ellipse: hit_area(lights, index, from, d, mask_of(true), active, h); return;
        case EmitterKind::sun: hit_sun(lights, index, d, flags, active, h); return;
        default: return;
    }
}

}  // namespace

int hittable_lamps(const LightData& lights) { return lights.hittable_count; }

LampHit intersect_lamp(const LightData& lights, int which, LightReceiver from, Vec3 d, Float t_max, Mask active) {
    const int id = lights.hittable[which];
    const std::int32_t* numbers = lights.lamp_int + id * light::k_lamp_ints;
    const RecordIndex index{Int(0), id * light::k_lamp_floats};
    const EmitterKind kind = static_cast<EmitterKind>(numbers[lamp::kind]);
    LampHit h;
    h.hit = mask_of(false);
    h.t = h.pdf = 0.0f;
    h.normal = {0.0f, 0.0f, 0.0f};
    h.radiance = fetch_rgb(lights.lamp, index, lamp::radiance);
    h.program = numbers[lamp::program];
    h.max_bounces = numbers[lamp::max_bounces];
    h.visibility = static_cast<std::uint8_t>(numbers[lamp::hit_visibility]);
    hit_kind(lights, kind, index, from, d, Int(numbers[lamp::flags]), active, h);
    h.hit &= kind == EmitterKind::sun ? t_max >= Float(k_infinity) : (h.t > Float(0.0f)) & (h.t < t_max);
    h.position = kind == EmitterKind::sun ? d : from.p + d * h.t;
    const bool sampled = numbers[lamp::hit_visibility] == numbers[lamp::visibility] && any(h.hit);
    h.pdf = sampled ? select(h.hit, h.pdf * pick_probability(lights, from, Int(id), h.hit), Float(0.0f)) : Float(0.0f);
    return h;
}

LampWalk::LampWalk(const LightData& lights, Vec3 origin, Vec3 d, Float t_max, Mask active)
    : lights_(lights), origin_(origin), t_max_(t_max), active_(active) {
    const auto safe_inverse = [](Float x) { return 1.0f / copysign(max(abs(x), 1e-18f), x); };
    inverse_ = {safe_inverse(d.x), safe_inverse(d.y), safe_inverse(d.z)};
    run_end_ = lights.hittable_suns;
    if (lights.box_count > 0) stack_[top_++] = 0;
}

bool LampWalk::crosses(int node) const {
    const float* box = lights_.box + 6 * node;
    Float near = 0.0f, far = t_max_;
    const Float origin[3] = {origin_.x, origin_.y, origin_.z}, inverse[3] = {inverse_.x, inverse_.y, inverse_.z};
    for (int axis = 0; axis < 3; ++axis) {
        const Float a = (box[axis] - origin[axis]) * inverse[axis], b = (box[axis + 3] - origin[axis]) * inverse[axis];
        near = max(near, min(a, b));
        far = min(far, max(a, b));
    }
    // Boxes of lamps in a plane are flat: rounding must not lose them.
    return any(active_ & (near <= far * 1.00001f + 1e-12f));
}

int LampWalk::next() {
    while (run_ == run_end_) {
        if (top_ == 0) return -1;
        const int node = stack_[--top_];
        if (!crosses(node)) continue;
        const int first = lights_.box_first[node];
        if (lights_.box_lamps[node] > 0) {
            run_ = first;
            run_end_ = first + lights_.box_lamps[node];
        } else {
            stack_[top_++] = first + 1;
            stack_[top_++] = first;
        }
    }
    return run_++;
}

}  // namespace cardioid::CD_ISA_NS
