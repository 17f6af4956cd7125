// SPDX-License-Identifier: GPL-3.0-or-later
// The kernels of width 1, 8 and 16 give the same samples, up to rounding.
#include "light/light_data.h"
#include "light/light_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace cardioid {
namespace isa_w1 {
void probe_light(const light::LightData& lights, int n, const float* in, float* out);
void probe_emission(const light::LightData& lights, int n, const float* in, float* out);
}  // namespace isa_w1
namespace isa_w8 {
void probe_light(const light::LightData& lights, int n, const float* in, float* out);
void probe_emission(const light::LightData& lights, int n, const float* in, float* out);
}  // namespace isa_w8
namespace isa_w16 {
void probe_light(const light::LightData& lights, int n, const float* in, float* out);
void probe_emission(const light::LightData& lights, int n, const float* in, float* out);
}  // namespace isa_w16
namespace {

light::LightTable mixed_table() {
    std::vector<light::LampInput> lamps;
    std::mt19937 engine(3);
    const auto u = [&] { return static_cast<float>(engine() >> 8) * 0x1p-24f; };
    for (int i = 0; i < 60; ++i) {
        light::LampInput in;
        scene::LightDesc& d = in.desc;
        d.kind = static_cast<scene::LightKind>(i % 4);
        d.shape = static_cast<scene::AreaShape>(i % 3);
        d.energy = d.kind == scene::LightKind::sun ? 0.1f : 20;
        d.radius = i % 3 == 0 ? 0.0f : 0.3f;
        d.spread = i % 8 == 3 ? 1.2f : 3.14159265f;
        d.spot_angle = 1.5f;
        d.legacy_lamp = i % 5 == 0;
        d.transform.m = {1, 0, 0, 6 * u() - 3, 0, 1, 0, 6 * u() - 3, 0, 0, 1, 1 + 2 * u()};
        lamps.push_back(in);
    }
    light::WorldInput world;
    world.constant = false;
    world.map_resolution = 128;
    world.sampling = scene::WorldSampling::manual;
    world.eval = [](int n, const Float3* d, Float3* out) {
        for (int i = 0; i < n; ++i) out[i] = Float3{1, 1, 1} * (1 + d[i].x);
    };
    const light::EmissiveTriangle triangle{{0, 0, 1}, {1, 0, 1}, {0, 1, 1.5f}, {5, 4, 3}, 0, 0, -1, true};
    return light::LightTable(lamps, {triangle}, &world, {-4, -4, 0}, {4, 4, 4}, {}, {true, {-1, -1, 0}, {0, 0, 1}});
}

constexpr int k_count = 4001;

void expect_same(const std::vector<float>& a, const std::vector<float>& b) {
    int other = 0;
    for (int k = 0; k < k_count; ++k) {
        const float *x = a.data() + k * 10, *y = b.data() + k * 10;
        bool same = x[8] == y[8] && x[9] == y[9];
        for (int f = 0; same && x[8] > 0 && f < 8; ++f) {
            same = std::fabs(x[f] - y[f]) <= 2e-3f * std::max(std::fabs(x[f]), std::fabs(y[f])) + 1e-4f;
        }
        other += same ? 0 : 1;
    }
    // A random number on the border between two lamps, or a sample on the edge of a cone, may fall to either side.
    EXPECT_LE(other, k_count / 250);
}

TEST(LightWidths, Agree) {
    const light::LightTable table = mixed_table();
    std::mt19937 engine(7);
    std::vector<float> in;
    for (int k = 0; k < k_count; ++k) {
        const auto u = [&] { return static_cast<float>(engine() >> 8) * 0x1p-24f; };
        const float side = k % 5 == 0 ? 0.0f : 1.0f;
        for (const float f : {6 * u() - 3, 6 * u() - 3, 0.0f, 0.0f, 0.6f * side, 0.8f * side, u(), u(), u()})
            in.push_back(f);
    }
    std::vector<float> one(k_count * 10), eight(k_count * 10), sixteen(k_count * 10);
    isa_w1::probe_light(table.data(), k_count, in.data(), one.data());
    int valid = 0;
    for (int k = 0; k < k_count; ++k) valid += one[static_cast<std::size_t>(k) * 10 + 8] > 0 ? 1 : 0;
    EXPECT_GT(valid, k_count * 3 / 4);
    if (__builtin_cpu_supports("avx2") != 0) {
        isa_w8::probe_light(table.data(), k_count, in.data(), eight.data());
        expect_same(one, eight);
    }
    if (__builtin_cpu_supports("avx512dq") != 0) {
        isa_w16::probe_light(table.data(), k_count, in.data(), sixteen.data());
        expect_same(one, sixteen);
    }
}

void expect_same_photons(const std::vector<float>& a, const std::vector<float>& b) {
    int other = 0;
    for (int k = 0; k < k_count; ++k) {
        const float *x = a.data() + k * 16, *y = b.data() + k * 16;
        bool same = x[15] == y[15];
        for (int f = 0; same && x[15] > 0 && f < 15; ++f) {
            same = std::fabs(x[f] - y[f]) <= 2e-3f * std::max(std::fabs(x[f]), std::fabs(y[f])) + 1e-4f;
        }
        other += same ? 0 : 1;
    }
    // A photon on an edge may fall to either side.
    EXPECT_LE(other, k_count / 250);
}

TEST(LightWidths, AgreeOnPhotons) {
    const light::LightTable table = mixed_table();
    const light::LightData& data = table.data();
    std::mt19937 engine(9);
    const auto u = [&] { return static_cast<float>(engine() >> 8) * 0x1p-24f; };
    std::vector<int> senders;
    for (int i = 0; i < data.emitter_count; ++i) {
        if (data.emission_power[i] > 0) senders.push_back(i);
    }
    ASSERT_GT(senders.size(), 50u);
    std::vector<float> in;
    for (int k = 0; k < k_count; ++k) {
        in.push_back(static_cast<float>(senders[static_cast<std::size_t>(k) % senders.size()]));
        for (int i = 0; i < 4; ++i) in.push_back(u());
    }
    std::vector<float> one(k_count * 16), eight(k_count * 16), sixteen(k_count * 16);
    isa_w1::probe_emission(data, k_count, in.data(), one.data());
    int valid = 0;
    for (int k = 0; k < k_count; ++k) valid += one[static_cast<std::size_t>(k) * 16 + 15] > 0 ? 1 : 0;
    EXPECT_GT(valid, k_count / 2);
    if (__builtin_cpu_supports("avx2") != 0) {
        isa_w8::probe_emission(data, k_count, in.data(), eight.data());
        expect_same_photons(one, eight);
    }
    if (__builtin_cpu_supports("avx512dq") != 0) {
        isa_w16::probe_emission(data, k_count, in.data(), sixteen.data());
        expect_same_photons(one, sixteen);
    }
}

}  // namespace
}  // namespace cardioid
