// SPDX-License-Identifier: GPL-3.0-or-later
#include "light/emit.h"

#include "light/emit_area.h"
#include "light/emit_infinite.h"
#include "light/emit_place.h"
#include "light/environment.h"
#include "scene/scene_desc.h"

namespace cardioid::CD_ISA_NS {
namespace {

namespace lamp = light::lamp;
namespace triangle = light::triangle;
using light::EmitterKind;
using light::LightData;

constexpr float k_infinity = 1e30f;

struct Cube {
    Vec2 point, direction;
};

void set_ray(PhotonRay& ray, Mask lanes, Vec3 origin, Vec3 direction, Vec3 normal) {
    ray.origin = select(lanes, origin, ray.origin);
    ray.direction = select(lanes, direction, ray.direction);
    ray.normal = select(lanes, normal, ray.normal);
}
/// `radiance`: intensity or irradiance of delta lamps.
void set_flux(PhotonRay& ray, Mask lanes, Spectrum radiance, Float density, Mask valid) {
    const Mask good = lanes & valid & (density > Float(0.0f));
    ray.flux = select(good, radiance * (1.0f / max(density, 1e-37f)), ray.flux);
    ray.density = select(lanes, density, ray.density);
    ray.valid &= ~lanes | good;
}

void emit_delta_point(const LightData& lights, RecordIndex index, RecordIndex place, Cube u, Int flags, Mask lanes,
                      PhotonRay& ray) {
    const MadeDirection made = sample_directions(lights, place, u.direction.x, u.direction.y);
    const Float factor = spot_attenuation(lights, index, flags, -made.d);
    set_ray(ray, lanes, fetch3(lights.lamp, index, lamp::position), made.d, made.d);
    set_flux(ray, lanes, fetch_rgb(lights.lamp, index, lamp::radiance) * factor, made.pdf, factor > Float(0.0f));
}

/// All rays of the direction d cross the disk of the lamp's radius across d. A sphere's rays start on it; those of a disk that
/// faces every receiver light only what lies beyond b²/√(r² - b²), b: their distance from the middle.
void emit_ball(const LightData& lights, RecordIndex index, RecordIndex place, Cube u, bool disk, Int flags, Mask lanes,
               PhotonRay& ray) {
    constexpr float k_inside = light::emission::k_inside_share;
    const Mask inside = disk ? mask_of(false) : u.direction.x < Float(k_inside);
    const Float rest = disk ? u.direction.x : (u.direction.x - k_inside) * (1.0f / (1.0f - k_inside));
    const MadeDirection outward = sample_directions(lights, place, max(rest, 0.0f), u.direction.y);
    const Vec3 all_around = sample_sphere(u.direction.x * (1.0f / k_inside), u.direction.y);
    const Vec3 d = select(inside, all_around, outward.d);

    const Float radius = fetch(lights.lamp, index, lamp::radius);
    const Float b = radius * sqrt(u.point.x), depth = radius * sqrt(max(1.0f - u.point.x, 1e-7f));
    Float s, c;
    sincos(k_two_pi * u.point.y, s, c);
    const Frame frame(d);
    const Vec3 across = frame.s * (b * c) + frame.t * (b * s);
    const Vec3 start = disk ? across : across + d * select(inside, -depth, depth);
    const Vec3 normal = disk ? d : start * (select(inside, Float(-1.0f), Float(1.0f)) / radius);
    set_ray(ray, lanes, fetch3(lights.lamp, index, lamp::position) + start, d, normal);
    if (disk) ray.t_min = select(lanes, b * b / depth, ray.t_min);
    ray.t_max = select(lanes & inside, 2.0f * depth, ray.t_max);

    const Float factor = select(inside, Float(1.0f), spot_attenuation(lights, index, flags, -d));
    const Float pdf = disk ? outward.pdf : select(inside, inside_pdf(), outside_pdf(outward.pdf));
    const Float section = ball_section(fetch(lights.lamp, index, lamp::radius_squared));
    set_flux(ray, lanes, fetch_rgb(lights.lamp, index, lamp::radiance) * factor, pdf / max(section, 1e-37f),
             factor > Float(0.0f));
}

void emit_area(const LightData& lights, RecordIndex index, Cube u, bool round, Mask lanes, PhotonRay& ray) {
    Float s, c;
    sincos(k_two_pi * u.point.y, s, c);
    const Float r = sqrt(u.point.x);
    const Float a = round ? r * c : 2.0f * u.point.x - 1.0f, b = round ? r * s : 2.0f * u.point.y - 1.0f;
    const Vec3 origin = fetch3(lights.lamp, index, lamp::position) +
                        fetch3(lights.lamp, index, lamp::axis_u) * (a * fetch(lights.lamp, index, lamp::half_u)) +
                        fetch3(lights.lamp, index, lamp::axis_v) * (b * fetch(lights.lamp, index, lamp::half_v));
    const Vec3 normal = fetch3(lights.lamp, index, lamp::normal);
    const AreaSpread spread = fetch_spread(lights, index);
    const SpreadDirection made = sample_spread(spread, u.direction.x, u.direction.y);
    const Float share = spread_share(spread, made.sin2);
    set_ray(ray, lanes, origin, Frame(normal).to_world(made.local), normal);
    set_flux(ray, lanes, fetch_rgb(lights.lamp, index, lamp::radiance) * share,
             spread_density(spread, made.sin2) * fetch(lights.lamp, index, lamp::inv_area), share > Float(0.0f));
    ray.barycentric_u = select(lanes, a * 0.5f + 0.5f, ray.barycentric_u);
    ray.barycentric_v = select(lanes, b * 0.5f + 0.5f, ray.barycentric_v);
}

/// `density`: of the direction, per sr.
void emit_from_afar(const LightData& lights, Vec3 direction, Float density, Spectrum radiance, Cube u, Mask lanes,
                    PhotonRay& ray) {
    const SectionRay section = sample_section(lights, direction, u.point.x, u.point.y);
    set_ray(ray, lanes, section.origin, direction, direction);
    set_flux(ray, lanes, radiance, density * section.density, section.meets);
    ray.infinite |= lanes;
}

void emit_sun(const LightData& lights, RecordIndex index, Cube u, Int flags, Mask lanes, PhotonRay& ray) {
    const Vec3 toward = fetch3(lights.lamp, index, lamp::position);
    const Float one_minus_cos = fetch(lights.lamp, index, lamp::sun_one_minus_cos);
    const Vec3 wi = Frame(toward).to_world(sample_cone(one_minus_cos, u.direction.x, u.direction.y).local);
    const Spectrum radiance = fetch_rgb(lights.lamp, index, lamp::radiance) * sun_factor(lights, index, flags, wi);
    emit_from_afar(lights, -wi, cone_pdf(one_minus_cos), radiance, u, lanes, ray);
}

void emit_delta_sun(const LightData& lights, RecordIndex index, Cube u, Mask lanes, PhotonRay& ray) {
    emit_from_afar(lights, -fetch3(lights.lamp, index, lamp::position), 1.0f,
                   fetch_rgb(lights.lamp, index, lamp::radiance), u, lanes, ray);
}

void emit_kind(const LightData& lights, RecordIndex index, RecordIndex place, Cube u, EmitterKind kind, Int flags,
               Mask lanes, PhotonRay& ray) {
    switch (kind) {
        case EmitterKind::delta_point: emit_delta_point(lights, index, place, u, flags, lanes, ray); return;
        case EmitterKind::sphere: emit_ball(lights, index, place, u, false, flags, lanes, ray); return;
        case EmitterKind::facing_disk: emit_ball(lights, index, place, u, true, flags, lanes, ray); return;
        case EmitterKind::rectangle: emit_area(lights, index, u, false, lanes, ray); return;
        case EmitterKind::ellipse: emit_area(lights, index, u, true, lanes, ray); return;
        case EmitterKind::delta_sun: emit_delta_sun(lights, index, u, lanes, ray); return;
        case EmitterKind::sun: emit_sun(lights, index, u, flags, lanes, ray); return;
        default: return;
    }
}

void emit_lamps(const LightData& lights, Int emitter, Cube u, Mask lanes, PhotonRay& ray) {
    const RecordIndex index = record_index(emitter, light::k_lamp_floats, lanes);
    const RecordIndex place = record_index(emitter, light::k_emission_floats, lanes);
    const RecordIndex numbers = record_index(emitter, light::k_lamp_ints, lanes);
    const Int kind = fetch(lights.lamp_int, numbers, lamp::kind);
    const Int flags = fetch(lights.lamp_int, numbers, lamp::flags);
    ray.program = select(lanes, fetch(lights.lamp_int, numbers, lamp::program), ray.program);
    ray.visibility = select(lanes, fetch(lights.lamp_int, numbers, lamp::visibility), ray.visibility);
    ray.max_bounces = select(lanes, fetch(lights.lamp_int, numbers, lamp::max_bounces), ray.max_bounces);
    for (std::uint32_t left = bits(lanes); left != 0;) {
        const int first = kind[std::countr_zero(left)];
        const Mask same = lanes & (kind == Int(first));
        emit_kind(lights, index, place, u, static_cast<EmitterKind>(first), flags, same, ray);
        left &= ~bits(same);
    }
}

void emit_triangles(const LightData& lights, Int emitter, Cube u, Mask lanes, PhotonRay& ray) {
    const Int id = emitter - Int(lights.lamp_count);
    const RecordIndex index = record_index(id, light::k_triangle_floats, lanes);
    const RecordIndex numbers = record_index(id, light::k_triangle_ints, lanes);
    const Float root = sqrt(u.point.x);
    const Float second = root * (1.0f - u.point.y), third = root * u.point.y;
    const Vec3 origin = fetch3(lights.triangle, index, triangle::origin) +
                        fetch3(lights.triangle, index, triangle::edge1) * second +
                        fetch3(lights.triangle, index, triangle::edge2) * third;
    const Mask two_sided = fetch(lights.triangle_int, numbers, triangle::two_sided) != Int(0);
    const Mask back = two_sided & (u.direction.x >= Float(0.5f));
    const Float rise = select(two_sided, 2.0f * u.direction.x - select(back, Float(1.0f), Float(0.0f)), u.direction.x);
    const Vec3 front = fetch3(lights.triangle, index, triangle::normal);
    const Vec3 normal = select(back, -front, front);
    Float s, c;
    sincos(k_two_pi * u.direction.y, s, c);
    const Float sine = sqrt(rise);
    const Vec3 d = Frame(normal).to_world({sine * c, sine * s, safe_sqrt(1.0f - rise)});
    const Float sides = select(two_sided, Float(0.5f), Float(1.0f));
    set_ray(ray, lanes, origin, d, normal);
    set_flux(ray, lanes, fetch_rgb(lights.triangle, index, triangle::radiance),
             sides * k_inv_pi / max(fetch(lights.triangle, index, triangle::area), 1e-30f), lanes);
    ray.program = select(lanes, fetch(lights.triangle_int, numbers, triangle::program), ray.program);
    ray.instance = select(lanes, fetch(lights.triangle_int, numbers, triangle::instance), ray.instance);
    ray.triangle = select(lanes, fetch(lights.triangle_int, numbers, triangle::index), ray.triangle);
    ray.barycentric_u = select(lanes, second, ray.barycentric_u);
    ray.barycentric_v = select(lanes, third, ray.barycentric_v);
}

void emit_world(const LightData& lights, Cube u, Mask lanes, PhotonRay& ray) {
    const light::EnvironmentData& env = lights.environment;
    const EnvironmentSample sample = sample_sent_direction(lights, u.direction.x, u.direction.y);
    emit_from_afar(lights, -sample.wi, sample.pdf, {env.color[0], env.color[1], env.color[2]}, u, lanes, ray);
    ray.program = select(lanes, Int(env.program), ray.program);
    ray.visibility = select(lanes, Int(env.visibility), ray.visibility);
    ray.max_bounces = select(lanes, Int(env.max_bounces), ray.max_bounces);
}

PhotonRay no_photon(Mask valid) {
    PhotonRay ray;
    ray.origin = {0.0f, 0.0f, 0.0f};
    ray.direction = ray.normal = {0.0f, 0.0f, 1.0f};
    ray.flux = Spectrum(0.0f);
    ray.density = ray.t_min = ray.barycentric_u = ray.barycentric_v = 0.0f;
    ray.t_max = k_infinity;
    ray.valid = valid;
    ray.infinite = mask_of(false);
    ray.program = ray.instance = ray.triangle = Int(-1);
    ray.visibility = Int(scene::visible_all);
    ray.max_bounces = Int(1024);
    return ray;
}

}  // namespace

PhotonRay emit_photon(const LightData& lights, Int emitter, Vec2 u_point, Vec2 u_direction, Mask active) {
    PhotonRay ray = no_photon(active);
    const Cube u{u_point, u_direction};
    const Mask lamps = active & (emitter < Int(lights.lamp_count));
    const Mask world = active & (emitter == Int(lights.environment.emitter));
    const Mask triangles = active & ~lamps & ~world;
    if (any(lamps)) emit_lamps(lights, emitter, u, lamps, ray);
    if (any(triangles)) emit_triangles(lights, emitter, u, triangles, ray);
    if (any(world)) emit_world(lights, u, world, ray);
    return ray;
}

}  // namespace cardioid::CD_ISA_NS
