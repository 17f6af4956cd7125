// SPDX-License-Identifier: GPL-3.0-or-later
#include "path/emitter_point.h"

#include "light/fetch.h"

namespace cardioid::CD_ISA_NS {

namespace {

namespace lamp = light::lamp;
using light::EmitterKind;

/// Geometry ▸ Parametric's two numbers.
struct Place {
    Float x, y;
};

Place on_area(const light::LightData& lights, RecordIndex index, Vec3 position) {
    const Vec3 from = position - fetch3(lights.lamp, index, lamp::position);
    const auto along = [&](int axis, int half) {
        return dot(from, fetch3(lights.lamp, index, axis)) / (2.0f * fetch(lights.lamp, index, half)) + 0.5f;
    };
    return {along(lamp::axis_u, lamp::half_u), along(lamp::axis_v, lamp::half_v)};
}

Vec3 in_lamp_space(const light::LightData& lights, RecordIndex index, Vec3 d) {
    return {dot(fetch3(lights.lamp, index, lamp::spot_rows), d),
            dot(fetch3(lights.lamp, index, lamp::spot_rows + 3), d),
            dot(fetch3(lights.lamp, index, lamp::spot_rows + 6), d)};
}

/// Longitude and latitude; before Blender 4.0 of the direction in the world, in another order.
Place on_sphere(Vec3 d, Mask legacy) {
    const Float longitude = 0.5f - atan2(d.x, d.y) * (0.5f * k_inv_pi);
    const Float across = sqrt(fma(d.x, d.x, d.y * d.y));
    const Float latitude = 1.0f - atan2(across, d.z) * k_inv_pi;
    return {select(legacy, 1.0f - longitude - latitude, longitude), select(legacy, longitude, latitude)};
}

/// The whole picture fills the cone, whatever its angle.
Place in_cone(const light::LightData& lights, RecordIndex index, Vec3 local) {
    const Float cosine = fetch(lights.lamp, index, lamp::spot_cos);
    const Float factor = 0.5f * cosine / max(safe_sqrt(1.0f - cosine * cosine), 1e-6f) / local.z;
    return {fma(local.x, factor, Float(0.5f)), fma(local.y, factor, Float(0.5f))};
}

Place on_sun(const light::LightData& lights, RecordIndex index, Vec3 toward) {
    const Vec3 axis = fetch3(lights.lamp, index, lamp::position);
    // 1 - cos of the half angle is twice the square of the sine of its half.
    const Float half_sine = sqrt(0.5f * fetch(lights.lamp, index, lamp::sun_one_minus_cos));
    const Float factor = 0.5f / max(half_sine * length(toward + axis), 1e-12f);
    return {fma(dot(toward, fetch3(lights.lamp, index, lamp::sun_rows)), factor, Float(0.5f)),
            fma(dot(toward, fetch3(lights.lamp, index, lamp::sun_rows + 3)), factor, Float(0.5f))};
}

Place place_of(const light::LightData& lights, Int id, const ShadedPoint& at, Mask lamps) {
    const RecordIndex index = record_index(id, light::k_lamp_floats, lamps);
    const RecordIndex numbers = record_index(id, light::k_lamp_ints, lamps);
    const Int kind = fetch(lights.lamp_int, numbers, lamp::kind), flags = fetch(lights.lamp_int, numbers, lamp::flags);
    const auto is = [&](EmitterKind k) { return lamps & (kind == Int(static_cast<int>(k))); };
    const Mask legacy = (flags & Int(lamp::legacy_place)) != Int(0), spot = (flags & Int(lamp::is_spot)) != Int(0);
    const Mask area = is(EmitterKind::rectangle) | is(EmitterKind::ellipse);
    const Mask sun = is(EmitterKind::sun) | is(EmitterKind::delta_sun);
    const Mask point = lamps & ~area & ~sun;
    Place place{0.0f, 0.0f};
    const auto take = [&](Mask here, Place p) {
        place.x = select(here, p.x, place.x);
        place.y = select(here, p.y, place.y);
    };
    if (any(area)) take(area, on_area(lights, index, at.position));
    if (any(sun)) take(sun, on_sun(lights, index, -at.wo));
    const Mask globe = point & (legacy | ~spot), cone = point & ~legacy & spot;
    if (any(globe)) {
        const Vec3 n = at.normal;
        take(globe, on_sphere(select(legacy, n, in_lamp_space(lights, index, n)), legacy));
    }
    if (any(cone)) take(cone, in_cone(lights, index, in_lamp_space(lights, index, at.wo)));
    return place;
}

/// Cross product of the edges as they are stored, which is what hits bring.
Vec3 stored_normal(const trace::SceneView& scene, Int instance, Int triangle) {
    const Int corner = (gather(scene.instances.first_triangle, instance) + triangle) * Int(3);
    const Int base = gather(scene.instances.first_vertex, instance);
    Vec3 p[3];
    for (int k = 0; k < 3; ++k) {
        const Int vertex = (base + gather(scene.geometry.triangles, corner + Int(k))) * Int(3);
        p[k] = {gather(scene.geometry.positions, vertex), gather(scene.geometry.positions + 1, vertex),
                gather(scene.geometry.positions + 2, vertex)};
    }
    return cross(p[1] - p[0], p[2] - p[0]);
}

}  // namespace

void place_on_lamp(const trace::SceneView& scene, Int id, ShadedPoint& at, Mask lamps) {
    const Place place = place_of(*scene.lights, id, at, lamps);
    at.instance = select(lamps, Int(scene.first_lamp_instance) + id, at.instance);
    at.triangle = select(lamps, Int(0), at.triangle);
    at.u = select(lamps, place.y, at.u);
    at.v = select(lamps, 1.0f - place.x - place.y, at.v);
    at.flags = select(lamps, Int(0), at.flags);
}

void place_on_triangle(const trace::SceneView& scene, ShadedPoint& at, Mask triangles) {
    const Int instance = select(triangles, at.instance, Int(0)), triangle = select(triangles, at.triangle, Int(0));
    const Vec3 raw = stored_normal(scene, instance, triangle);
    const SurfaceNormals normals = surface_normals(scene, instance, triangle, raw, at.u, at.v, at.wo);
    at.normal_geometric = select(triangles, normals.ng, at.normal_geometric);
    at.normal = select(triangles, normals.n, at.normal);
    at.backfacing = select(triangles & normals.backfacing, Float(1.0f), at.backfacing);
}

}  // namespace cardioid::CD_ISA_NS
