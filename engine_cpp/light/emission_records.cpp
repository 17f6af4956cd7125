// SPDX-License-Identifier: GPL-3.0-or-later
#include "light/emission_records.h"

#include <numbers>

namespace cardioid::light {
namespace {

constexpr double k_pi = std::numbers::pi;
/// However few of a lamp's directions lead to casters, it keeps this share of its power: the rest of the scene wants light too.
constexpr float k_least_share = 0.05f;

Float3 get(const LampRecord& r, int field) { return {r.value[field], r.value[field + 1], r.value[field + 2]}; }

float mean_absolute(Float3 c) { return (std::fabs(c.x) + std::fabs(c.y) + std::fabs(c.z)) / 3; }

void put(EmissionRecord& e, int field, Float3 v) {
    e.value[field] = v.x;
    e.value[field + 1] = v.y;
    e.value[field + 2] = v.z;
}

/// 1 - cos, exact for small angles.
double rise(double angle) {
    const double s = std::sin(0.5 * angle);
    return 2 * s * s;
}

/// Directions within `edge` of the axis.
struct LightCone {
    Float3 axis;
    double edge = 0;
};

/// The tangent is across the axis, as near to `away` as possible.
void put_frame(EmissionRecord& e, const LightCone& cone, Float3 away) {
    const Float3 axis = cone.axis;
    e.value[emission::one_minus_cos] = static_cast<float>(rise(cone.edge));
    const Float3 across = away - axis * dot(axis, away);
    const Float3 other = std::fabs(axis.x) < 0.7f ? Float3{1, 0, 0} : Float3{0, 1, 0};
    const bool lies_across = dot(across, across) > 1e-10f;
    put(e, emission::axis, axis);
    put(e, emission::tangent, normalize(lies_across ? across : cross(axis, other)));
}

/// In the coordinates of light::emission.
struct Rectangle {
    double x0, x1, half_y;
};
constexpr Rectangle k_whole{0, 1, 0.5};

/// Holds all directions of the cone within `half` of a direction that leans from its axis toward azimuth 1/2.
Rectangle rectangle_around(const LightCone& cone, double lean, double half) {
    const double whole = rise(cone.edge);
    const double x0 = rise(std::max(lean - half, 0.0)) / whole;
    const double x1 = rise(std::min(lean + half, cone.edge)) / whole;
    const bool around_axis = lean <= half || lean + half >= k_pi;
    const double turn = around_axis ? k_pi : std::asin(std::min(std::sin(half) / std::sin(lean), 1.0));
    return {std::min(x0, x1), x1, turn / (2 * k_pi)};
}

/// Half of the density inside of the rectangle, half outside; the whole square where the rectangle is none, large, or too thin
/// for float.
void put_rectangle(EmissionRecord& e, Rectangle r) {
    const double size = (r.x1 - r.x0) * 2 * r.half_y;
    const bool aimed = size > 1e-12 && r.x1 - r.x0 > 1e-5 * r.x0 && size < 0.5;
    const Rectangle& exact = aimed ? r : k_whole;
    // As kernels read them: the densities are those of the rounded borders.
    const double x0 = double{static_cast<float>(exact.x0)}, x1 = double{static_cast<float>(exact.x1)},
                 half_y = double{static_cast<float>(exact.half_y)};
    const double area = (x1 - x0) * 2 * half_y;
    const double in = aimed ? 0.5 / area : 1, out = aimed ? 0.5 / (1 - area) : 1;
    const double across = 2 * half_y * in + (1 - 2 * half_y) * out;
    const auto put_value = [&](int field, double v) { e.value[field] = static_cast<float>(v); };
    put_value(emission::x0, x0);
    put_value(emission::x1, x1);
    put_value(emission::half_y, half_y);
    put_value(emission::density_in, in);
    put_value(emission::density_out, out);
    put_value(emission::mass_below, x0 * out);
    put_value(emission::mass_between, (x1 - x0) * across);
    put_value(emission::mass_side, (0.5 - half_y) * out / across);
}

bool sends_from_a_place(EmitterKind kind) {
    return kind == EmitterKind::delta_point || kind == EmitterKind::sphere || kind == EmitterKind::facing_disk;
}

/// Flux of a lamp with a place, into all directions.
double lamp_flux(const LampRecord& r, double brightness) {
    const double radius = double{r.value[lamp::radius]};
    const double intensity = r.kind() == EmitterKind::delta_point ? brightness : brightness * k_pi * radius * radius;
    if ((r.number[lamp::flags] & lamp::is_spot) == 0) return 4 * k_pi * intensity;
    const double open = 1 - double{r.value[lamp::spot_cos]};
    const double blend = std::min(1 / double{r.value[lamp::spot_inv_blend]}, open);
    return 2 * k_pi * intensity * (open - 0.5 * blend);
}

double sun_irradiance(const LampRecord& r, double brightness) {
    const double rise = double{r.value[lamp::sun_one_minus_cos]};
    return r.kind() == EmitterKind::delta_sun ? brightness : brightness * k_pi * rise * (2 - rise);
}

/// m² of the cross section that counts: photons aimed at the casters are half of all.
double cross_section(const EmissionTargets& targets) {
    const double scene = double{targets.scene.radius}, casters = double{targets.casters.radius};
    const double whole = k_pi * scene * scene;
    return casters > 0 ? std::min(2 * k_pi * casters * casters, whole) : whole;
}

}  // namespace

EmissionRecord make_emission_record(const LampRecord& r, const Sphere& casters) {
    EmissionRecord e;
    if (!sends_from_a_place(r.kind())) return e;
    const bool spot = (r.number[lamp::flags] & lamp::is_spot) != 0;
    LightCone light;
    light.axis = get(r, lamp::normal);
    light.edge = spot ? std::acos(std::clamp(1 - double{r.value[lamp::spot_one_minus_cos]}, -1.0, 1.0)) : k_pi;
    const Float3 to = Float3{casters.center[0], casters.center[1], casters.center[2]} - get(r, lamp::position);
    const double distance = double{length(to)}, reach = double{casters.radius} + double{r.value[lamp::radius]};
    if (!(casters.radius > 0) || !(distance > reach) || !std::isfinite(distance)) {
        put_frame(e, light, light.axis);
        put_rectangle(e, k_whole);
        return e;
    }
    const Float3 toward = normalize(to);
    const double half = std::asin(reach / distance);
    const double lean = 2 * std::asin(std::min(0.5 * double{length(light.axis - toward)}, 1.0));
    const LightCone around_casters{toward, std::min(light.edge + lean, k_pi)};
    const double share = rise(half) / rise(around_casters.edge);
    if (light.edge >= k_pi || (lean <= half && share < 0.5)) light = around_casters;
    const bool same_axis = light.axis == toward;
    put_frame(e, light, toward * -1.0f);
    put_rectangle(e, same_axis ? Rectangle{0, share, 0.5} : rectangle_around(light, lean, half));
    return e;
}

float lamp_emission_power(const LampInput& in, const LampRecord& r, const EmissionRecord& e,
                          const EmissionTargets& targets) {
    if (!(r.bounds.energy > 0)) return 0;
    const double brightness = static_cast<double>(mean_absolute(get(r, lamp::radiance) * in.program_estimate));
    if (r.at_infinity()) return static_cast<float>(sun_irradiance(r, brightness) * cross_section(targets));
    if (!sends_from_a_place(r.kind())) return static_cast<float>(k_pi * brightness / double{r.value[lamp::inv_area]});
    // The cone of the record may be wider than that of a spot.
    const bool spot = (r.number[lamp::flags] & lamp::is_spot) != 0;
    const float wider = spot ? e.value[emission::one_minus_cos] / r.value[lamp::spot_one_minus_cos] : 1.0f;
    const float share = std::clamp(wider / e.value[emission::density_in], k_least_share, 1.0f);
    return static_cast<float>(lamp_flux(r, brightness)) * share;
}

float triangle_emission_power(const EmissiveTriangle& t, float area) {
    return mean_absolute(t.radiance) * area * static_cast<float>(k_pi) * (t.two_sided ? 2.0f : 1.0f);
}

float world_emission_power(float brightness, const EmissionTargets& targets) {
    return static_cast<float>(4 * k_pi * double{brightness} * cross_section(targets));
}

Sphere sphere_around(Float3 low, Float3 high) {
    Sphere s;
    const Float3 center = (low + high) * 0.5f;
    const float radius = 0.5f * length(high - low);
    if (!(low.x <= high.x) || !std::isfinite(radius) || !std::isfinite(dot(center, center))) return s;
    s.center[0] = center.x;
    s.center[1] = center.y;
    s.center[2] = center.z;
    s.radius = radius;
    return s;
}

}  // namespace cardioid::light
