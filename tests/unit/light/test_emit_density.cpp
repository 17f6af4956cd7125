// SPDX-License-Identifier: GPL-3.0-or-later
// The two ends of a ray agree: what a camera path that meets the lamp computes is what the photon had; and the densities are
// those of the rays that are made (chi² over cells of ray space: points × directions).
#include "statistics/chi2.h"

#include <gtest/gtest.h>

#include "emit_tests.h"

namespace cardioid::light_tests {
namespace {

using light::EmitterKind;

constexpr double k_level = 1e-4;
const Float3 k_low{-2, -2, -0.1f}, k_high{2, 2, 2.5f};
/// No casters, casters around the axes of spots; for spots also beside it (others would ask for a finer quadrature).
std::vector<light::PhotonTargets> targets_of(const Source& source) {
    std::vector<light::PhotonTargets> all{{}, casters_in({0.5f, 0.4f, 0.3f}, 0.4f)};
    if (!source.lamps.empty() && source.lamps.front().desc.kind == scene::LightKind::spot)
        all.push_back(casters_in({-0.6f, 0.7f, 0.4f}, 0.2f));
    return all;
}

Vec3 all_lanes(Float3 v) { return {v.x, v.y, v.z}; }

/// The density from the other end: p sees the emitter in the direction d.
float seen_density(const LightTable& table, int emitter, Float3 p, Float3 d) {
    const light::LightData& data = table.data();
    const Vec3 from = all_lanes(p), along = all_lanes(d);
    if (emitter == data.environment.emitter) return environment_emission_density(data, from, along, mask_of(true))[0];
    if (emitter < data.lamp_count) return lamp_emission_density(data, emitter, from, along, mask_of(true))[0];
    Int found;
    const Float density = triangle_emission_density(data, Int(0), Int(0), found, mask_of(true));
    EXPECT_EQ(found[0], emitter);
    return density[0];
}

/// Radiance that p sees in the direction d, 0 where there is nothing; of the world and triangles by their definition.
Float3 seen_radiance(const LightTable& table, const Source& source, Float3 p, Float3 d) {
    if (!source.triangles.empty()) return source.triangles.front().radiance;
    if (source.has_world) return source.world.constant ? source.world.color : Float3{1, 1, 1};
    const LightReceiver at{all_lanes(p), all_lanes({0, 0, 0})};
    const LampHit h = intersect_lamp(table.data(), 0, at, all_lanes(d), 1e30f, mask_of(true));
    return any(h.hit) ? lane(h.radiance, 0) : Float3{0, 0, 0};
}

bool is_close(float a, float b, float relative) {
    return std::fabs(a - b) <= relative * std::max(std::fabs(a), std::fabs(b));
}

class EmissionEnds : public testing::TestWithParam<Source> {};

std::vector<Source> sources_with_a_surface() {
    std::vector<Source> all;
    for (const Source& s : all_sources()) {
        if (s.lamps.empty() || hittable_lamps(table_of(s, k_low, k_high).data()) > 0) all.push_back(s);
    }
    return all;
}
INSTANTIATE_TEST_SUITE_P(All, EmissionEnds, testing::ValuesIn(sources_with_a_surface()),
                         [](const auto& which) { return which.param.name; });

TEST_P(EmissionEnds, Agree) {
    const Source& source = GetParam();
    for (const light::PhotonTargets& targets : targets_of(source)) {
        const LightTable table = table_of(source, k_low, k_high, targets);
        constexpr int k_photons = 6000;
        int seen = 0, other_density = 0, other_flux = 0, lit_out_of_range = 0;
        Uniform uniform(5);
        for_each_photon(table, k_photons, 3, [&](const Photon& photon) {
            if (!photon.valid) return;
            ++seen;
            const float reach = std::min(photon.t_max, photon.t_min + 2);
            const float t = photon.t_min + (reach - photon.t_min) * (0.02f + 0.96f * uniform());
            const Float3 p = photon.origin + photon.direction * t, back = photon.direction * -1.0f;
            other_density += is_close(seen_density(table, photon.emitter, p, back), photon.density, 1e-4f) ? 0 : 1;
            const Float3 radiance = seen_radiance(table, source, p, back);
            other_flux += is_close(radiance.x, photon.flux.x * photon.density, 1e-3f) &&
                                  is_close(radiance.z, photon.flux.z * photon.density, 1e-3f)
                              ? 0
                              : 1;
            if (photon.t_min > 0) {
                const Float3 before = photon.origin + photon.direction * (0.98f * photon.t_min);
                lit_out_of_range += seen_radiance(table, source, before, back).x != 0 ? 1 : 0;
            }
        });
        EXPECT_GT(seen, k_photons / 20);
        // Rays on the edge of a cone, of an aimed part or of a cell may fall to either side.
        EXPECT_LE(other_density, seen / 500) << targets.casters_min.x;
        EXPECT_LE(other_flux, seen / 250) << targets.casters_min.x;
        EXPECT_LE(lit_out_of_range, seen / 500) << targets.casters_min.x;
    }
}

/// A ray by five numbers in [0, 1): point, direction, side. In these coordinates the measure m² · projected sr is uniform.
struct Ray {
    Float3 p, d;
};
struct Coordinates {
    double u[5] = {};
};

struct Basis {
    Float3 s, t, n;
    explicit Basis(Float3 normal) : n(normal) {
        s = normalize(cross(n, std::fabs(n.x) < 0.7f ? Float3{1, 0, 0} : Float3{0, 1, 0}));
        t = cross(n, s);
    }
    Float3 world(double a, double b, double c) const {
        return s * static_cast<float>(a) + t * static_cast<float>(b) + n * static_cast<float>(c);
    }
};

double turns(double y, double x) {
    const double a = std::atan2(y, x) / (2 * k_pi_d);
    return std::clamp(a < 0 ? a + 1 : a, 0.0, 1 - 1e-9);
}

/// Space of all rays that an emitter could send, and more.
class RaySpace {
public:
    virtual ~RaySpace() = default;
    virtual Ray ray(const Coordinates& c) const = 0;
    virtual Coordinates coordinates(const Photon& photon) const = 0;
    double measure[2] = {};  ///< m² · projected sr of each side
    int sides = 1;
};

/// Directions in a cap (of the second side: all), points of a disk across them.
class DiskAcross final : public RaySpace {
public:
    DiskAcross(Float3 center, double radius, Float3 axis, double rise, float distance, int ball_sides)
        : center_(center), radius_(radius), axis_(axis), rise_(rise), distance_(distance) {
        sides = ball_sides;
        for (int side = 0; side < 2; ++side) measure[side] = 2 * k_pi_d * rise_of(side) * k_pi_d * radius * radius;
    }
    Ray ray(const Coordinates& c) const override {
        const double up = c.u[2] * rise_of(c.u[4] < 0.5 ? 0 : 1), sine = std::sqrt(up * (2 - up)),
                     phi = 2 * k_pi_d * c.u[3];
        const Float3 d = axis_.world(sine * std::cos(phi), sine * std::sin(phi), 1 - up);
        const double r = radius_ * std::sqrt(c.u[0]), turn = 2 * k_pi_d * c.u[1];
        const bool inside = sides == 2 && c.u[4] >= 0.5;
        return {center_ +
                    Basis(d).world(r * std::cos(turn), r * std::sin(turn), inside ? 0 : static_cast<double>(distance_)),
                d};
    }
    Coordinates coordinates(const Photon& photon) const override {
        const Float3 d = photon.direction, off = photon.origin - center_;
        const Float3 from_axis = d - axis_.n;
        const Basis across(d);
        const double x = static_cast<double>(dot(off, across.s)), y = static_cast<double>(dot(off, across.t));
        Coordinates c;
        c.u[0] = (x * x + y * y) / (radius_ * radius_);
        c.u[1] = turns(y, x);
        c.u[3] = turns(static_cast<double>(dot(d, axis_.t)), static_cast<double>(dot(d, axis_.s)));
        c.u[4] = photon.t_max < 1e29f ? 0.75 : 0.25;
        c.u[2] = 0.5 * static_cast<double>(dot(from_axis, from_axis)) / rise_of(c.u[4] < 0.5 ? 0 : 1);
        return c;
    }

private:
    double rise_of(int side) const { return side == 0 ? rise_ : 2; }

    Float3 center_;
    double radius_;
    Basis axis_;
    double rise_;
    float distance_;
};

/// A flat lamp or triangle: points of a parallelogram, an ellipse or a triangle, directions by cosine up to a largest sine.
class FlatSurface final : public RaySpace {
public:
    enum class Shape { rectangle, ellipse, triangle };
    FlatSurface(Float3 origin, Float3 a, Float3 b, Float3 normal, Shape shape, double sine2, int surface_sides)
        : origin_(origin), a_(a), b_(b), normal_(normal), shape_(shape), sine2_(sine2) {
        sides = surface_sides;
        const double area = static_cast<double>(length(cross(a, b)));
        const double share = shape == Shape::rectangle ? 4.0 : shape == Shape::ellipse ? k_pi_d : 0.5;
        measure[0] = measure[1] = area * share * k_pi_d * sine2;
    }
    Ray ray(const Coordinates& c) const override {
        double x = 2 * c.u[0] - 1, y = 2 * c.u[1] - 1;
        const double r = std::sqrt(c.u[0]), phi = 2 * k_pi_d * c.u[1];
        if (shape_ == Shape::ellipse) x = r * std::cos(phi), y = r * std::sin(phi);
        if (shape_ == Shape::triangle) x = r * (1 - c.u[1]), y = r * c.u[1];
        const double sine = std::sqrt(c.u[2] * sine2_), turn = 2 * k_pi_d * c.u[3];
        const double up = std::sqrt(1 - sine * sine) * (c.u[4] < 0.5 ? 1 : -1);
        const Float3 d = normal_.world(sine * std::cos(turn), sine * std::sin(turn), up);
        return {origin_ + a_ * static_cast<float>(x) + b_ * static_cast<float>(y) + d * 0.5f, d};
    }
    Coordinates coordinates(const Photon& photon) const override {
        const Float3 off = photon.origin - origin_;
        const Float3 n = cross(a_, b_);
        const double scale = static_cast<double>(dot(n, n));
        const double x = static_cast<double>(dot(cross(off, b_), n)) / scale;
        const double y = static_cast<double>(dot(cross(a_, off), n)) / scale;
        Coordinates c;
        c.u[0] = (x + 1) / 2;
        c.u[1] = (y + 1) / 2;
        if (shape_ == Shape::ellipse) c.u[0] = x * x + y * y, c.u[1] = turns(y, x);
        if (shape_ == Shape::triangle) c.u[0] = (x + y) * (x + y), c.u[1] = y / (x + y);
        const double p = static_cast<double>(dot(photon.direction, normal_.s)),
                     q = static_cast<double>(dot(photon.direction, normal_.t));
        c.u[2] = (p * p + q * q) / sine2_;
        c.u[3] = turns(q, p);
        c.u[4] = dot(photon.direction, normal_.n) > 0 ? 0.25 : 0.75;
        return c;
    }

private:
    Float3 origin_, a_, b_;
    Basis normal_;
    Shape shape_;
    double sine2_;
};

Float3 field(const float* record, int at) { return {record[at], record[at + 1], record[at + 2]}; }

std::unique_ptr<RaySpace> space_of(const LightTable& table, const Source& source) {
    const light::LightData& data = table.data();
    const auto make = [](auto&& space) { return std::make_unique<std::decay_t<decltype(space)>>(space); };
    const Float3 aim = field(data.casters.center, 0);
    const double around = static_cast<double>(data.scene.radius + length(field(data.scene.center, 0) - aim)) * 1.001;
    if (source.has_world) return make(DiskAcross(aim, around, {0, 0, 1}, 2, 0, 1));
    if (!source.triangles.empty()) {
        const light::EmissiveTriangle& t = source.triangles.front();
        const Float3 a = t.p1 - t.p0, b = t.p2 - t.p0;
        return make(
            FlatSurface(t.p0, a, b, normalize(cross(a, b)), FlatSurface::Shape::triangle, 1, t.two_sided ? 2 : 1));
    }
    namespace lamp = light::lamp;
    const float* r = data.lamp;
    const auto kind = static_cast<EmitterKind>(data.lamp_int[lamp::kind]);
    const Float3 at = field(r, lamp::position);
    if (kind == EmitterKind::sun)
        return make(DiskAcross(aim, around, at * -1.0f, static_cast<double>(r[lamp::sun_one_minus_cos]), 0, 1));
    if (kind == EmitterKind::sphere || kind == EmitterKind::facing_disk) {
        // The directions that the lamp was given, in cells of their own size.
        const Float3 axis = field(data.lamp_emission, light::emission::axis);
        const auto rise = static_cast<double>(data.lamp_emission[light::emission::one_minus_cos]);
        const auto radius = static_cast<double>(r[lamp::radius]);
        return make(DiskAcross(at, radius, axis, rise, 2 * r[lamp::radius], kind == EmitterKind::sphere ? 2 : 1));
    }
    const double slope = static_cast<double>(std::min(r[lamp::tan_half_spread], 1e9f));
    const auto shape = kind == EmitterKind::rectangle ? FlatSurface::Shape::rectangle : FlatSurface::Shape::ellipse;
    return make(FlatSurface(at, field(r, lamp::axis_u) * r[lamp::half_u], field(r, lamp::axis_v) * r[lamp::half_v],
                            field(r, lamp::normal), shape, slope * slope / (1 + slope * slope), 1));
}

constexpr int k_cells[4] = {4, 4, 10, 8};
constexpr int k_steps[4] = {24, 1, 8, 4};  ///< of the quadrature, within a cell

std::size_t cell_of(const RaySpace& space, const Coordinates& c, bool& outside) {
    std::size_t cell = space.sides == 2 && c.u[4] >= 0.5 ? 1 : 0;
    for (int i = 0; i < 4; ++i) {
        // Rounding at the edge of the space is not outside of it.
        outside |= !(c.u[i] > -1e-4 && c.u[i] < 1 + 1e-4);
        const int at = std::clamp(static_cast<int>(c.u[i] * k_cells[i]), 0, k_cells[i] - 1);
        cell = cell * static_cast<std::size_t>(k_cells[i]) + static_cast<std::size_t>(at);
    }
    return cell;
}

/// Mean of the density over each cell, by jittered steps.
std::vector<double> probabilities(const LightTable& table, const RaySpace& space, int emitter) {
    std::size_t count = static_cast<std::size_t>(space.sides);
    int steps = 1;
    for (int i = 0; i < 4; ++i) {
        count *= static_cast<std::size_t>(k_cells[i]);
        steps *= k_steps[i];
    }
    std::vector<double> p(count, 0.0);
    Uniform uniform(23);
    for (std::size_t cell = 0; cell < count; ++cell) {
        for (int step = 0; step < steps; ++step) {
            Coordinates c;
            std::size_t in_cell = cell;
            int in_step = step;
            for (int i = 3; i >= 0; --i) {
                const auto cells = static_cast<std::size_t>(k_cells[i]);
                const double within = (in_step % k_steps[i] + static_cast<double>(uniform())) / k_steps[i];
                c.u[i] = (static_cast<double>(in_cell % cells) + within) / k_cells[i];
                in_cell /= cells;
                in_step /= k_steps[i];
            }
            c.u[4] = in_cell == 0 ? 0.25 : 0.75;
            const Ray ray = space.ray(c);
            p[cell] += static_cast<double>(seen_density(table, emitter, ray.p, ray.d * -1.0f));
        }
        p[cell] *= space.measure[cell * static_cast<std::size_t>(space.sides) / count] * space.sides /
                   (static_cast<double>(count) * steps);
    }
    return p;
}

class EmissionDensity : public testing::TestWithParam<Source> {};

/// A hot spot of a few texels would ask for a finer quadrature.
std::vector<Source> smooth_sources() {
    std::vector<Source> all = sources_with_a_surface();
    for (Source& s : all) {
        if (s.name != "world_hot_spot") continue;
        s = world_source("world_smooth", [](Float3 d) {
            const float value = 1 + 0.7f * d.x + 0.2f * d.z;
            return Float3{value, value, value};
        });
    }
    return all;
}
INSTANTIATE_TEST_SUITE_P(All, EmissionDensity, testing::ValuesIn(smooth_sources()),
                         [](const auto& which) { return which.param.name; });

TEST_P(EmissionDensity, IsThatOfTheRays) {
    const Source& source = GetParam();
    for (const light::PhotonTargets& targets : targets_of(source)) {
        SCOPED_TRACE(targets.casters_min.x);
        const LightTable table = table_of(source, k_low, k_high, targets);
        const std::unique_ptr<RaySpace> space = space_of(table, source);
        std::vector<double> expected = probabilities(table, *space, only_emitter(table));
        std::vector<double> observed(expected.size(), 0.0);
        double integral = 0;
        for (const double p : expected) integral += p;
        EXPECT_NEAR(integral, 1, 0.005);
        constexpr int k_photons = 150'000;
        int outside = 0;
        for_each_photon(table, k_photons, 9, [&](const Photon& photon) {
            bool out = false;
            observed[cell_of(*space, space->coordinates(photon), out)] += 1;
            outside += out ? 1 : 0;
        });
        EXPECT_LE(outside, k_photons / 10000);
        for (double& p : expected) p *= k_photons / integral;
        const statistics::Chi2Result r = statistics::chi2_test(observed, expected, 5, 1e-4);
        EXPECT_FALSE(r.rejected(k_level))
            << r.statistic << " of " << r.degrees << " cells, impossible " << r.impossible;
    }
}

}  // namespace
}  // namespace cardioid::light_tests
