// SPDX-License-Identifier: GPL-3.0-or-later
// Frames are orthonormal and right-handed everywhere on the sphere, the poles included.
#include "lanes_of.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace cardioid::simd_tests {
namespace {

struct Direction {
    float x, y, z;
};

std::vector<Direction> directions() {
    std::vector<Direction> all{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, -0.0f}};
    for (const float e : {1e-3f, 1e-5f, 1e-7f}) {
        all.push_back({e, 0, -std::sqrt(1 - e * e)});
        all.push_back({0, -e, -std::sqrt(1 - e * e)});
        all.push_back({std::sqrt(1 - e * e), 0, -e});
    }
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    for (int k = 0; k < 5000; ++k) {
        const float x = normal(random), y = normal(random), z = normal(random), l = std::sqrt(x * x + y * y + z * z);
        all.push_back({x / l, y / l, z / l});
    }
    return all;
}

Vec3 lanes(Direction d) { return {d.x, d.y, d.z}; }

/// Largest deviation of the frame from orthonormal and right-handed.
float defect(const Frame& f) {
    const Vec3 c = cross(f.s, f.t) - f.n;
    float most = 0;
    for (const Float e : {abs(dot(f.s, f.t)), abs(dot(f.s, f.n)), abs(dot(f.t, f.n)), abs(dot(f.s, f.s) - 1.0f),
                          abs(dot(f.t, f.t) - 1.0f), length(c)}) {
        if (!(e[0] <= most)) most = e[0];
    }
    return most;
}

TEST(Frames, OrthonormalRightHanded) {
    for (const Direction d : directions()) ASSERT_LT(defect(Frame(lanes(d))), 2e-6f) << d.x << " " << d.y << " " << d.z;
}

TEST(Frames, WithATangent) {
    const auto all = directions();
    for (std::size_t k = 0; k + 1 < all.size(); ++k) {
        const Vec3 n = lanes(all[k]), tangent = lanes(all[k + 1]);
        const Frame f(n, tangent);
        const Vec3 in_plane = tangent - n * dot(n, tangent);
        // The part of the tangent in the plane carries the rounding error of the whole.
        ASSERT_LT(defect(f), 4e-6f + 2e-7f / std::max(length(in_plane)[0], 1e-6f)) << k;
        if (length(in_plane)[0] < 1e-3f) continue;
        ASSERT_LT(defect(f), 2e-4f) << k;
        ASSERT_GT(dot(f.s, normalize(in_plane))[0], 0.9999f) << k;
    }
    // A tangent along the normal leaves nothing to follow.
    for (const Direction d : all) ASSERT_LT(defect(Frame(lanes(d), lanes(d))), 4e-5f);
}

TEST(Frames, LocalAndBack) {
    const auto all = directions();
    for (std::size_t k = 0; k + 1 < all.size(); k += 7) {
        const Frame f(lanes(all[k]));
        const Vec3 w = lanes(all[k + 1]), back = f.to_world(f.to_local(w));
        ASSERT_LT(length(back - w)[0], 2e-6f);
        ASSERT_NEAR(f.to_local(lanes(all[k])).z[0], 1, 2e-6);
    }
}

TEST(Frames, TheMeasureNoticesASkewedFrame) {
    Frame f(Vec3{0.0f, 0.0f, 1.0f});
    f.s = f.s * 1.001f;
    EXPECT_GT(defect(f), 1e-3f);
    Frame mirrored(Vec3{0.0f, 0.0f, 1.0f});
    mirrored.t = -mirrored.t;
    EXPECT_GT(defect(mirrored), 1.0f);
}

TEST(Vectors, NormalizeKeepsZero) {
    const Vec3 zero{0.0f, 0.0f, 0.0f};
    EXPECT_EQ(length(normalize(zero))[0], 0.0f);
    EXPECT_NEAR(length(normalize(Vec3{3e-10f, 0.0f, 4e-10f}))[0], 1, 1e-6);
}

TEST(Vectors, CrossAndLuminance) {
    const Vec3 c = cross(Vec3{1.0f, 0.0f, 0.0f}, Vec3{0.0f, 1.0f, 0.0f});
    EXPECT_EQ(c.z[W - 1], 1.0f);
    EXPECT_NEAR(luminance(Spectrum(1.0f))[0], 1, 1e-6);
    EXPECT_NEAR(luminance(Spectrum(0.0f, 1.0f, 0.0f))[0], 0.7152, 1e-6);
    EXPECT_EQ(max_component(Spectrum(0.1f, 0.7f, 0.3f))[0], 0.7f);
}

}  // namespace
}  // namespace cardioid::simd_tests
