// SPDX-License-Identifier: GPL-3.0-or-later
// E[radiance · cos / pdf] is the irradiance that geometry gives: closed forms where there are, else quadrature over the lamp
// in double precision, written down again from the definition of the lamp (light/README.md) and not from the kernels.
#include "light_tests.h"
#include "statistics/ttest.h"

#include <gtest/gtest.h>

namespace cardioid::light_tests {
namespace {

constexpr double k_level = 1e-4;
constexpr int k_draws = 60'000;

struct Double3 {
    double x, y, z;
};
Double3 to_double(Float3 v) { return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}; }
Double3 minus(Double3 a, Double3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double dot_of(Double3 a, Double3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Double3 cross_of(Double3 a, Double3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Double3 unit(Double3 a) {
    const double l = std::sqrt(dot_of(a, a));
    return {a.x / l, a.y / l, a.z / l};
}

/// Lambert's polygon formula: irradiance of a polygon of radiance 1 that is above the horizon.
double polygon_irradiance(const std::vector<Float3>& corners, const Receiver& at) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Double3 a = unit(minus(to_double(corners[i]), to_double(at.p)));
        const Double3 b = unit(minus(to_double(corners[(i + 1) % corners.size()]), to_double(at.p)));
        sum += std::acos(std::min(1.0, dot_of(a, b))) * dot_of(unit(cross_of(a, b)), to_double(at.n));
    }
    return std::fabs(sum) / 2;
}

/// How a wrong estimator would weigh a draw; each must be noticed.
enum class Fault { none, density, distance };
double faulty(const Draw& d, const Receiver& at, Fault fault) {
    const double value = irradiance_of(d, at);
    if (fault == Fault::density) return value / 1.05;
    if (fault == Fault::distance) return value / static_cast<double>(d.distance * d.distance);
    return value;
}

statistics::TResult estimate(const LightTable& table, const Receiver& at, double expected, Fault fault = Fault::none) {
    statistics::Moments moments;
    for_each_draw(table, at, k_draws, 17, [&](const Draw& d) { moments.add(faulty(d, at, fault)); });
    return statistics::t_test(moments, expected, 2e-6 * std::fabs(expected));
}

void expect_irradiance(const LightTable& table, const Receiver& at, double expected) {
    const statistics::TResult good = estimate(table, at, expected);
    EXPECT_FALSE(good.rejected(k_level)) << "difference " << good.difference << " of " << expected << " ± "
                                         << good.error;
    EXPECT_TRUE(good.equivalent(0.02 * std::fabs(expected), 0.05)) << "too noisy to say anything";
    EXPECT_TRUE(estimate(table, at, expected, Fault::density).rejected(k_level));
    EXPECT_TRUE(estimate(table, at, expected, Fault::distance).rejected(k_level));
}

Affine placed(Float3 at) {
    Affine t;
    t.m[3] = at.x;
    t.m[7] = at.y;
    t.m[11] = at.z;
    return t;
}

const Receiver k_receiver{{0.4f, -0.3f, 0.2f}, {0, 0.6f, 0.8f}};

TEST(Irradiance, Sphere) {
    Case c = lamp_case("", scene::LightKind::point, 100, placed({0.2f, 0.5f, 2}));
    c.lamp.desc.radius = 0.4f;
    const Double3 to = minus({0.2, 0.5, 2}, to_double(k_receiver.p));
    const double d2 = dot_of(to, to);
    // E / (4 pi) is the intensity of the sphere: radiance times pi r².
    expect_irradiance(table_of({c.lamp}), k_receiver,
                      100 / (4 * k_pi_d) * dot_of(unit(to), to_double(k_receiver.n)) / d2);
}

TEST(Irradiance, FacingDisk) {
    Case c = lamp_case("", scene::LightKind::point, 100, placed({0.2f, 0.5f, 2}));
    c.lamp.desc.radius = 0.4f;
    c.lamp.desc.legacy_lamp = true;
    const Double3 to = minus({0.2, 0.5, 2}, to_double(k_receiver.p));
    const double d2 = dot_of(to, to), radiance = 100 / (4 * k_pi_d * k_pi_d * 0.16);
    expect_irradiance(table_of({c.lamp}), k_receiver,
                      k_pi_d * radiance * 0.16 / (0.16 + d2) * dot_of(unit(to), to_double(k_receiver.n)));
}

TEST(Irradiance, PointWithoutRadius) {
    Case c = lamp_case("", scene::LightKind::point, 100, placed({0.2f, 0.5f, 2}));
    const Double3 to = minus({0.2, 0.5, 2}, to_double(k_receiver.p));
    const double d2 = dot_of(to, to);
    expect_irradiance(table_of({c.lamp}), k_receiver,
                      100 / (4 * k_pi_d) * dot_of(unit(to), to_double(k_receiver.n)) / d2);
}

std::vector<Float3> square_corners(float half, Float3 center) {
    return {center + Float3{-half, -half, 0}, center + Float3{half, -half, 0}, center + Float3{half, half, 0},
            center + Float3{-half, half, 0}};
}

TEST(Irradiance, Square) {
    for (const float size : {0.05f, 0.5f, 4.0f}) {
        Case c = lamp_case("", scene::LightKind::area, 50, placed({0.6f, 0.9f, 3}));
        c.lamp.desc.size_x = size;
        const double form = polygon_irradiance(square_corners(size / 2, {0.6f, 0.9f, 3}), k_receiver),
                     area = static_cast<double>(size * size);
        expect_irradiance(table_of({c.lamp}), k_receiver, 50 / (k_pi_d * area) * form);
        c.lamp.desc.legacy_lamp = true;
        expect_irradiance(table_of({c.lamp}), k_receiver, 50 / (4 * area) * form);
        c.lamp.desc.energy = -50;
        expect_irradiance(table_of({c.lamp}), k_receiver, -50 / (4 * area) * form);
    }
}

TEST(Irradiance, SquareShinesOneWay) {
    Case c = lamp_case("", scene::LightKind::area, 50, placed({0.6f, 0.9f, -3}));
    const Receiver behind{{0, 0, 0}, {0, 0, -1}};
    for_each_draw(table_of({c.lamp}), behind, 1000, 3, [&](const Draw& d) { EXPECT_FALSE(d.valid); });
}

/// Sum over the lamp's surface of L(θ) cos cos / d², midpoints; the lamp is parallel to xy and shines down.
template <class Inside, class Radiance>
double flat_lamp(const Receiver& at, Float3 center, double half_x, double half_y, Inside inside, Radiance radiance) {
    constexpr int k_steps = 1200;
    double sum = 0;
    for (int y = 0; y < k_steps; ++y) {
        for (int x = 0; x < k_steps; ++x) {
            const double u = (x + 0.5) / k_steps * 2 - 1, v = (y + 0.5) / k_steps * 2 - 1;
            if (!inside(u, v)) continue;
            const Double3 c = to_double(center);
            const Double3 to = minus({c.x + u * half_x, c.y + v * half_y, c.z}, to_double(at.p));
            const double d2 = dot_of(to, to), cosine = to.z / std::sqrt(d2);
            const double received = std::max(0.0, dot_of(unit(to), to_double(at.n)));
            sum += radiance(cosine) * cosine * received / d2;
        }
    }
    return sum * 4 * half_x * half_y / (k_steps * static_cast<double>(k_steps));
}

TEST(Irradiance, EllipseAndSpread) {
    const Float3 center{0.6f, 0.9f, 2};
    struct Form {
        scene::AreaShape shape;
        float x, y, spread;
    };
    for (const Form f :
         {Form{scene::AreaShape::ellipse, 1.5f, 0.5f, 3.14159265f}, Form{scene::AreaShape::rectangle, 1.5f, 0.9f, 1.5f},
          Form{scene::AreaShape::ellipse, 1.8f, 1.2f, 1.2f}, Form{scene::AreaShape::disk, 3.0f, 3.0f, 0.8f}}) {
        Case c = lamp_case("", scene::LightKind::area, 50, placed(center));
        c.lamp.desc.shape = f.shape;
        c.lamp.desc.size_x = f.x;
        c.lamp.desc.size_y = f.y;
        c.lamp.desc.spread = f.spread;
        const bool round = f.shape != scene::AreaShape::rectangle;
        const double a = static_cast<double>(f.x) / 2, b = static_cast<double>(f.y) / 2,
                     half = static_cast<double>(f.spread) / 2;
        const double radiance = 50 / (k_pi_d * (round ? k_pi_d : 4.0) * a * b);
        const bool open = half > 1.57;
        const auto value = [&](double cosine) {
            if (open) return radiance;
            const double tangent = std::sqrt(1 - cosine * cosine) / cosine;
            return radiance * std::max(0.0, std::tan(half) - tangent) / (std::tan(half) - half);
        };
        const auto inside = [&](double u, double v) { return !round || u * u + v * v <= 1; };
        expect_irradiance(table_of({c.lamp}), k_receiver, flat_lamp(k_receiver, center, a, b, inside, value));
    }
}

/// Mean over the cone of L(θ) · max(0, n·w), midpoints.
template <class Radiance>
double cone_irradiance(Float3 axis, double half, const Receiver& at, Radiance radiance) {
    const Float3 s = normalize(cross(axis, {0.3f, 0.9f, 0.1f})), t = cross(axis, s);
    constexpr int k_steps = 1000;
    double sum = 0;
    for (int i = 0; i < k_steps; ++i) {
        const double theta = (i + 0.5) / k_steps * half;
        for (int j = 0; j < k_steps; ++j) {
            const double phi = 2 * k_pi_d * (j + 0.5) / k_steps;
            const double a = std::sin(theta) * std::cos(phi), b = std::sin(theta) * std::sin(phi), c = std::cos(theta);
            const Double3 S = to_double(s), T = to_double(t), N = to_double(axis), n = to_double(at.n);
            const double cosine = a * dot_of(S, n) + b * dot_of(T, n) + c * dot_of(N, n);
            sum += radiance(c) * std::max(0.0, cosine) * std::sin(theta);
        }
    }
    return sum * half * 2 * k_pi_d / (k_steps * static_cast<double>(k_steps));
}

TEST(Irradiance, Sun) {
    for (const float angle : {0.00918f, 0.5f, 2.4f}) {
        Case c = lamp_case("", scene::LightKind::sun, 3);
        c.lamp.desc.angle = angle;
        const Float3 toward = normalize(tilted().column(2));
        const double half = static_cast<double>(angle) / 2, sine = std::sin(half), slope = std::tan(half);
        const double even =
            cone_irradiance(toward, half, k_receiver, [&](double) { return 3 / (k_pi_d * sine * sine); });
        const LightTable table = table_of({c.lamp});
        EXPECT_FALSE(estimate(table, k_receiver, even).rejected(k_level));
        EXPECT_TRUE(estimate(table, k_receiver, even, Fault::density).rejected(k_level));
        c.lamp.desc.legacy_lamp = true;
        const double flat = cone_irradiance(toward, half, k_receiver, [&](double cosine) {
            return 3 / (k_pi_d * slope * slope * cosine * cosine * cosine);
        });
        EXPECT_FALSE(estimate(table_of({c.lamp}), k_receiver, flat).rejected(k_level));
    }
}

TEST(Irradiance, SunWithoutAngle) {
    Case c = lamp_case("", scene::LightKind::sun, 3);
    c.lamp.desc.angle = 0;
    const Float3 toward = normalize(tilted().column(2));
    const statistics::TResult r =
        estimate(table_of({c.lamp}), k_receiver, 3 * static_cast<double>(dot(toward, k_receiver.n)));
    EXPECT_FALSE(r.rejected(k_level)) << r.difference;
}

TEST(Irradiance, SpotFallsOff) {
    // Inside the cone, in its soft edge, outside: the smooth step between the cosine of the cone and the blend.
    const double half = 0.5, blend = 0.6, width = (1 - std::cos(half)) * blend;
    for (const double angle : {0.05, 0.3, 0.42, 0.48, 0.55}) {
        for (const bool legacy : {false, true}) {
            Case c = lamp_case("", scene::LightKind::spot, 100, placed({0, 0, 2}));
            c.lamp.desc.spot_angle = 2 * static_cast<float>(half);
            c.lamp.desc.spot_blend = static_cast<float>(blend);
            c.lamp.desc.legacy_lamp = legacy;
            const Receiver at{{static_cast<float>(2 * std::tan(angle)), 0, 0}, {0, 0, 1}};
            const double t = std::clamp((std::cos(angle) - std::cos(half)) / width, 0.0, 1.0);
            const double d2 = 4 / (std::cos(angle) * std::cos(angle));
            const double expected =
                100 / (4 * k_pi_d) * t * t * (3 - 2 * t) * std::cos(angle) / d2 * (legacy ? std::cos(angle) : 1);
            statistics::Moments m;
            for_each_draw(table_of({c.lamp}), at, 64, 1, [&](const Draw& d) { m.add(irradiance_of(d, at)); });
            EXPECT_NEAR(m.mean, expected, 2e-4 * expected + 1e-6) << angle << " " << legacy;
        }
    }
}

TEST(Irradiance, UniformWorld) {
    light::WorldInput world;
    world.color = {0.7f, 0.7f, 0.7f};
    const LightTable table({}, {}, &world, {}, {});
    EXPECT_FALSE(estimate(table, k_receiver, 0.7 * k_pi_d).rejected(k_level));
    // Without a side the whole sphere is sampled; what the receiver makes of it is its own business.
    const Receiver all{k_receiver.p, {0, 0, 0}};
    statistics::Moments sphere;
    for_each_draw(table, all, k_draws, 5,
                  [&](const Draw& d) { sphere.add(static_cast<double>(d.radiance.x / d.pdf)); });
    EXPECT_FALSE(statistics::t_test(sphere, 4 * k_pi_d * 0.7, 1e-5).rejected(k_level));
}

TEST(Irradiance, Triangle) {
    light::EmissiveTriangle t;
    t.p0 = {0, 0, 2};
    t.p1 = {1, 0.2f, 2.3f};
    t.p2 = {0.1f, 1.4f, 1.8f};
    t.radiance = {5, 5, 5};
    t.instance = 3;
    t.triangle = 7;
    t.program = -1;
    const double form = 5 * polygon_irradiance({t.p0, t.p1, t.p2}, k_receiver);
    expect_irradiance(LightTable({}, {t}, nullptr, {}, {}), k_receiver, form);
    // One-sided: the same from its front, nothing from behind (p0, p1, p2 go round against the clock seen from the front).
    t.two_sided = false;
    const LightTable back({}, {t}, nullptr, {}, {});
    for_each_draw(back, k_receiver, 500, 3, [&](const Draw& d) { EXPECT_FALSE(d.valid); });
    std::swap(t.p1, t.p2);
    expect_irradiance(LightTable({}, {t}, nullptr, {}, {}), k_receiver, form);
}

}  // namespace
}  // namespace cardioid::light_tests
