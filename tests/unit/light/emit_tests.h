// SPDX-License-Identifier: GPL-3.0-or-later
// Common ground of the tests of photon emission: emitters by name, tables that aim at a target, photons as plain numbers.
#pragma once

#include "light/emit.h"
#include "light_tests.h"

#include <gtest/gtest.h>

#include <functional>

namespace cardioid::light_tests {

/// One lane of a PhotonRay; `emitter` is what it was asked for.
struct Photon {
    Float3 origin, direction, normal, flux;
    float density = 0, t_min = 0, t_max = 0;
    bool valid = false, infinite = false;
    int emitter = -1;
};

using Radiance = std::function<Float3(Float3)>;

/// One emitter and the radiance of its program (worlds that are not constant), by direction toward it.
struct Source {
    std::string name;
    std::vector<LampInput> lamps;
    std::vector<light::EmissiveTriangle> triangles;
    bool has_world = false;
    light::WorldInput world;
    Radiance program;

    Float3 radiance_at(Float3 radiance, Float3 wi) const { return program ? radiance * program(wi) : radiance; }
};
inline void PrintTo(const Source& s, std::ostream* out) { *out << s.name; }

inline LightTable table_of(const Source& s, Float3 low, Float3 high, const light::PhotonTargets& targets = {}) {
    return LightTable(s.lamps, s.triangles, s.has_world ? &s.world : nullptr, low, high, {}, targets);
}

inline Source lamp_source(const Case& c) { return {c.name, {c.lamp}, {}, false, {}, {}}; }

inline Source world_source(std::string name, Radiance radiance) {
    Source s;
    s.name = std::move(name);
    s.has_world = true;
    s.world.constant = false;
    s.world.map_resolution = 64;
    s.world.sampling = scene::WorldSampling::manual;
    s.world.program = 0;
    s.world.compensate = false;
    s.world.eval = [radiance](int n, const Float3* d, Float3* out) {
        for (int i = 0; i < n; ++i) out[i] = radiance(d[i]);
    };
    s.program = radiance;
    return s;
}

inline Source triangle_source(std::string name, bool two_sided) {
    light::EmissiveTriangle t;
    t.p0 = {-0.4f, -0.9f, 2};
    t.p1 = {0.1f, 0.6f, 1.8f};
    t.p2 = {1, -0.5f, 2.3f};
    t.radiance = {5, 4, 3};
    t.instance = 0;
    t.triangle = 0;
    t.program = -1;
    t.two_sided = two_sided;
    return {std::move(name), {}, {t}, false, {}, {}};
}

inline std::vector<Source> all_sources() {
    using scene::LightKind;
    std::vector<Source> all;
    for (const Case& c : surface_lamps()) {
        // A lamp of 20 m sends one photon in a thousand to the patches of the tests.
        if (c.name != "square_huge") all.push_back(lamp_source(c));
    }
    Case c = lamp_case("point", LightKind::point, 100);
    c.lamp.desc.radius = 0;
    all.push_back(lamp_source(c));
    c = lamp_case("spot", LightKind::spot, 100);
    c.lamp.desc.radius = 0;
    c.lamp.desc.spot_angle = 1.4f;
    c.lamp.desc.spot_blend = 0.4f;
    all.push_back(lamp_source(c));
    c.name = "spot_wide_blend_legacy";
    c.lamp.desc.legacy_lamp = true;
    c.lamp.desc.spot_angle = 3.0f;
    c.lamp.desc.spot_blend = 1;
    all.push_back(lamp_source(c));
    c = lamp_case("spot_stretched", LightKind::spot, 100);
    c.lamp.desc.radius = 0.1f;
    c.lamp.desc.spot_angle = 1;
    for (const std::size_t i : {0, 4, 8}) c.lamp.desc.transform.m[i] *= 2;
    all.push_back(lamp_source(c));
    c = lamp_case("negative", LightKind::point, -100);
    c.lamp.desc.radius = 0.2f;
    all.push_back(lamp_source(c));
    c = lamp_case("delta_sun", LightKind::sun, 3);
    c.lamp.desc.angle = 0;
    all.push_back(lamp_source(c));
    c = lamp_case("soft_falloff", LightKind::spot, 100);
    c.lamp.soft_falloff = true;
    c.lamp.desc.radius = 0.4f;
    c.lamp.desc.spot_angle = 1.5f;
    all.push_back(lamp_source(c));
    all.push_back(triangle_source("triangle", false));
    all.push_back(triangle_source("triangle_two_sided", true));
    Source world;
    world.name = "world";
    world.has_world = true;
    world.world.color = {0.7f, 0.6f, 0.5f};
    all.push_back(world);
    all.push_back(world_source("world_hot_spot", [](Float3 d) {
        const Float3 spot = normalize(Float3{0.4f, 0.3f, 0.8f});
        const float off = 1 - dot(d, spot);
        const float value = 0.3f + 0.2f * d.x + (off < 0.02f ? 60.0f : 0.0f);
        return Float3{value, value, value};
    }));
    return all;
}

/// n photons of the emitters that `choose` gives (for a random number), to visit(photon, probability of the emitter).
template <class Choose, class Visit>
void for_each_photon(const LightTable& table, int n, std::uint32_t seed, Choose choose, Visit visit) {
    Uniform uniform(seed);
    for (int k = 0; k < n; k += W) {
        const Vec3 a = uniform.lanes(), b = uniform.lanes();
        Int emitter(0);
        float probability[W];
        for (int i = 0; i < W; ++i) {
            const auto [id, p] = choose(b.z[i]);
            emitter.v[i] = id;
            probability[i] = p;
        }
        const PhotonRay r = emit_photon(table.data(), emitter, {a.x, a.y}, {b.x, b.y}, first_lanes(n - k));
        for (int i = 0; i < W && k + i < n; ++i) {
            visit(Photon{lane(r.origin, i), lane(r.direction, i), lane(r.normal, i), lane(r.flux, i), r.density[i],
                         r.t_min[i], r.t_max[i], ((bits(r.valid) >> i) & 1) != 0, ((bits(r.infinite) >> i) & 1) != 0,
                         emitter[i]},
                  probability[i]);
        }
    }
}

/// The only emitter of a table with one.
inline int only_emitter(const LightTable& table) {
    for (int i = 0; i < table.data().emitter_count; ++i) {
        if (table.data().emission_power[i] > 0) return i;
    }
    return -1;
}

template <class Visit>
void for_each_photon(const LightTable& table, int n, std::uint32_t seed, Visit visit) {
    const int emitter = only_emitter(table);
    ASSERT_GE(emitter, 0);
    for_each_photon(
        table, n, seed, [&](float) { return std::pair<int, float>(emitter, 1.0f); },
        [&](const Photon& photon, float) { visit(photon); });
}

inline light::PhotonTargets casters_in(Float3 middle, float half) {
    const Float3 h{half, half, half};
    return {true, middle - h, middle + h};
}

}  // namespace cardioid::light_tests
