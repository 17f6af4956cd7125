// SPDX-License-Identifier: GPL-3.0-or-later
// Common ground of the light tests: lamps by name, receivers, and lanes unpacked into plain numbers.
#pragma once

#include "light/choose.h"
#include "light/environment.h"
#include "light/kernels.h"
#include "light/light_table.h"

#include <cmath>
#include <numbers>
#include <ostream>
#include <random>
#include <string>
#include <vector>

namespace cardioid::light_tests {

using namespace CD_ISA_NS;  // NOLINT(google-build-using-namespace): the width under test
using light::LampInput;
using light::LightTable;

inline constexpr double k_pi_d = std::numbers::pi;

/// Lamp at (0.3, -0.2, 2) that looks down, a little tilted.
inline Affine tilted(float x = 0.3f, float y = -0.2f, float z = 2.0f) {
    const float a = 0.3f, c = std::cos(a), s = std::sin(a);
    Affine t;
    t.m = {1, 0, 0, x, 0, c, -s, y, 0, s, c, z};
    return t;
}

struct Receiver {
    Float3 p{0, 0, 0}, n{0, 0, 1};
    LightReceiver lanes() const { return {{p.x, p.y, p.z}, {n.x, n.y, n.z}}; }
};

/// One lane of a LightSample.
struct Draw {
    Float3 wi, position, radiance;
    float distance = 0, pdf = 0;
    bool valid = false, delta = false;
    int emitter = -1;
};

inline Float3 lane(Vec3 v, int i) { return {v.x[i], v.y[i], v.z[i]}; }
inline Float3 lane(Spectrum v, int i) { return {v.r[i], v.g[i], v.b[i]}; }

inline void set_lane(Float& f, int i, float x) { f.v[i] = x; }
inline void set_lane(Vec3& v, int i, Float3 x) {
    set_lane(v.x, i, x.x);
    set_lane(v.y, i, x.y);
    set_lane(v.z, i, x.z);
}

class Uniform {
public:
    explicit Uniform(std::uint32_t seed) : engine_(seed) {}
    float operator()() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }
    Vec3 lanes() {
        Vec3 u{0.0f, 0.0f, 0.0f};
        for (int i = 0; i < W; ++i) set_lane(u, i, {(*this)(), (*this)(), (*this)()});
        return u;
    }

private:
    std::mt19937 engine_;
};

/// Three numbers are drawn for every sample, two are used.
inline LightSample sample_light(const light::LightData& lights, LightReceiver at, Vec3 u, Mask active) {
    return CD_ISA_NS::sample_light(lights, at, Vec2{u.x, u.y}, active);
}

template <class Visit>
void for_each_draw(const LightTable& table, const Receiver& at, int n, std::uint32_t seed, Visit visit) {
    Uniform uniform(seed);
    for (int k = 0; k < n; k += W) {
        const LightSample s = sample_light(table.data(), at.lanes(), uniform.lanes(), mask_of(true));
        for (int i = 0; i < W && k + i < n; ++i) {
            visit(Draw{lane(s.wi, i), lane(s.position, i), lane(s.radiance, i), s.distance[i], s.pdf[i],
                       ((bits(s.valid) >> i) & 1) != 0, ((bits(s.delta) >> i) & 1) != 0, s.emitter[i]});
        }
    }
}

/// Value of one draw for the irradiance (red) at the receiver.
inline double irradiance_of(const Draw& d, const Receiver& at) {
    if (!d.valid) return 0;
    return static_cast<double>(d.radiance.x) * std::max(0.0f, dot(d.wi, at.n)) / static_cast<double>(d.pdf);
}

/// Density with which sample_light would give direction d at the receiver, from the functions that the path tracer uses for
/// directions that the BSDF chose. Lanes hold different directions.
inline Float density(const LightTable& table, LightReceiver at, Vec3 d) {
    Float sum = pdf_environment(table.data(), at, d, mask_of(true));
    for (int k = 0; k < hittable_lamps(table.data()); ++k) {
        const LampHit h = intersect_lamp(table.data(), k, at, d, 1e30f, mask_of(true));
        sum += select(h.hit, h.pdf, Float(0.0f));
    }
    return sum;
}

struct Case {
    std::string name;
    LampInput lamp;
};

inline void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

inline Case lamp_case(std::string name, scene::LightKind kind, float energy, Affine transform = tilted()) {
    Case c;
    c.name = std::move(name);
    c.lamp.desc.kind = kind;
    c.lamp.desc.energy = energy;
    c.lamp.desc.transform = transform;
    return c;
}

/// Every kind of lamp that has a surface.
inline std::vector<Case> surface_lamps() {
    using scene::AreaShape;
    using scene::LightKind;
    std::vector<Case> all;
    const auto point = [&](const char* name, float radius, bool legacy) {
        Case c = lamp_case(name, LightKind::point, 100);
        c.lamp.desc.radius = radius;
        c.lamp.desc.legacy_lamp = legacy;
        all.push_back(c);
    };
    point("sphere", 0.5f, false);
    point("tiny_sphere", 1e-3f, false);
    point("facing_disk", 0.5f, true);
    const auto spot = [&](const char* name, float radius, float angle, float blend, bool legacy) {
        Case c = lamp_case(name, LightKind::spot, 100);
        c.lamp.desc.radius = radius;
        c.lamp.desc.spot_angle = angle;
        c.lamp.desc.spot_blend = blend;
        c.lamp.desc.legacy_lamp = legacy;
        all.push_back(c);
    };
    spot("spot_sphere", 0.3f, 1.2f, 0.5f, false);
    spot("spot_legacy", 0.3f, 1.2f, 0.5f, true);
    spot("spot_narrow", 1.0f, 0.4f, 0.3f, false);
    const auto sun = [&](const char* name, float angle, bool legacy) {
        Case c = lamp_case(name, LightKind::sun, 3);
        c.lamp.desc.angle = angle;
        c.lamp.desc.legacy_lamp = legacy;
        all.push_back(c);
    };
    sun("sun", 0.00918f, false);
    sun("wide_sun", 1.0f, false);
    sun("wide_sun_legacy", 1.0f, true);
    const auto area = [&](const char* name, AreaShape shape, float x, float y, float spread) {
        Case c = lamp_case(name, LightKind::area, 50);
        c.lamp.desc.shape = shape;
        c.lamp.desc.size_x = x;
        c.lamp.desc.size_y = y;
        c.lamp.desc.spread = spread;
        all.push_back(c);
    };
    const float open = std::numbers::pi_v<float>;
    area("square", AreaShape::square, 1, 1, open);
    area("square_far", AreaShape::square, 0.2f, 0.2f, open);
    area("square_huge", AreaShape::square, 20, 20, open);
    area("rectangle", AreaShape::rectangle, 2, 0.3f, open);
    area("disk", AreaShape::disk, 1.2f, 1.2f, open);
    area("ellipse", AreaShape::ellipse, 1.5f, 0.5f, open);
    area("square_spread", AreaShape::square, 1.5f, 1.5f, 0.7f);
    area("disk_spread", AreaShape::disk, 2, 2, 1.0f);
    area("ellipse_spread_wide", AreaShape::ellipse, 0.5f, 0.4f, 2.6f);
    return all;
}

inline LightTable table_of(const std::vector<LampInput>& lamps) {
    return LightTable(lamps, {}, nullptr, {-5, -5, -5}, {5, 5, 5});
}

}  // namespace cardioid::light_tests
