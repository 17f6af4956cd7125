// SPDX-License-Identifier: GPL-3.0-or-later
// Densities of emit_photon as a camera path sees them: from the other end of the ray.
#include "light/emit.h"
#include "light/emit_area.h"
#include "light/emit_infinite.h"
#include "light/emit_place.h"
#include "light/environment.h"

namespace cardioid::CD_ISA_NS {
namespace {

namespace lamp = light::lamp;
using light::EmitterKind;
using light::LightData;

Float ball_density(const LightData& lights, int id, RecordIndex index, Vec3 p, Vec3 d, bool disk) {
    const RecordIndex place{Int(0), id * light::k_emission_floats};
    const Float r2 = fetch(lights.lamp, index, lamp::radius_squared);
    const Float per_section = 1.0f / max(ball_section(r2), 1e-37f);
    const Float directions = directions_pdf(lights, place, -d);
    if (disk) return directions * per_section;
    const Mask inside = length_squared(p - fetch3(lights.lamp, index, lamp::position)) <= r2;
    return select(inside, inside_pdf(), outside_pdf(directions)) * per_section;
}

Float area_density(const LightData& lights, RecordIndex index, Vec3 d) {
    const Vec3 off = -d - fetch3(lights.lamp, index, lamp::normal);
    const Float rise = 0.5f * length_squared(off);
    const Float density = spread_density(fetch_spread(lights, index), saturate(rise * (2.0f - rise)));
    return select(rise < Float(1.0f), density * fetch(lights.lamp, index, lamp::inv_area), Float(0.0f));
}

Float sun_density(const LightData& lights, RecordIndex index, Vec3 p, Vec3 d) {
    const Float limit = fetch(lights.lamp, index, lamp::sun_one_minus_cos);
    const Mask within = 0.5f * length_squared(d - fetch3(lights.lamp, index, lamp::position)) <= limit * 1.00001f;
    return select(within, cone_pdf(limit) * section_density_at(lights, p, d), Float(0.0f));
}

}  // namespace

Float lamp_emission_density(const LightData& lights, int id, Vec3 p, Vec3 d, Mask active) {
    if (!(lights.emission_power[id] > 0)) return 0.0f;
    const RecordIndex index{Int(0), id * light::k_lamp_floats};
    Float density = 0.0f;
    switch (static_cast<EmitterKind>(lights.lamp_int[id * light::k_lamp_ints + lamp::kind])) {
        case EmitterKind::sphere: density = ball_density(lights, id, index, p, d, false); break;
        case EmitterKind::facing_disk: density = ball_density(lights, id, index, p, d, true); break;
        case EmitterKind::rectangle:
        case EmitterKind::ellipse: density = area_density(lights, index, d); break;
        case EmitterKind::sun: density = sun_density(lights, index, p, d); break;
        default: break;
    }
    return select(active, density, Float(0.0f));
}

Float triangle_emission_density(const LightData& lights, Int instance, Int triangle_index, Int& emitter, Mask active) {
    emitter = triangle_emitter(lights, instance, triangle_index, active);
    const Mask known = active & (emitter >= Int(0));
    if (none(known)) return 0.0f;
    const Mask sends = known & (gather(lights.emission_power, select(known, emitter, Int(0))) > Float(0.0f));
    emitter = select(sends, emitter, Int(-1));
    if (none(sends)) return 0.0f;
    const Int id = emitter - Int(lights.lamp_count);
    const Float area = fetch(lights.triangle, record_index(id, light::k_triangle_floats, sends), light::triangle::area);
    const RecordIndex numbers = record_index(id, light::k_triangle_ints, sends);
    const Mask two_sided = fetch(lights.triangle_int, numbers, light::triangle::two_sided) != Int(0);
    const Float sides = select(two_sided, Float(0.5f), Float(1.0f));
    return select(sends, sides * k_inv_pi / max(area, 1e-30f), Float(0.0f));
}

Float environment_emission_density(const LightData& lights, Vec3 p, Vec3 d, Mask active) {
    const int emitter = lights.environment.emitter;
    if (emitter < 0 || !(lights.emission_power[emitter] > 0)) return 0.0f;
    const Float directions = sent_direction_density(lights, d);
    return select(active, directions * section_density_at(lights, p, d), Float(0.0f));
}

}  // namespace cardioid::CD_ISA_NS
