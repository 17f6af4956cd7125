// SPDX-License-Identifier: GPL-3.0-or-later
#include "math/types.h"

#include <gtest/gtest.h>

#include <random>

namespace cardioid {
namespace {

Affine random_affine(std::mt19937& random, float size) {
    std::uniform_real_distribution<float> u(-size, size);
    Affine a;
    for (float& m : a.m) m = u(random);
    return a;
}

float distance(Float3 a, Float3 b) { return length(a - b); }

/// Error of inverse(a) as a map, relative to the reach of the point.
float round_trip(const Affine& a, const Affine& inv, Float3 p) {
    return distance(inv.point(a.point(p)), p) / std::max(length(p), 1.0f);
}

TEST(Affine, ProductIsComposition) {
    std::mt19937 random(1);
    for (int k = 0; k < 200; ++k) {
        const Affine a = random_affine(random, 3), b = random_affine(random, 3);
        const Float3 p{1.5f, -2, 0.25f};
        EXPECT_LT(distance((a * b).point(p), a.point(b.point(p))), 1e-4f);
        EXPECT_LT(distance((a * b).vector(p), a.vector(b.vector(p))), 1e-4f);
    }
    const Affine a = random_affine(random, 3);
    EXPECT_EQ(a * Affine{}, a);
    EXPECT_EQ(Affine{} * a, a);
}

TEST(Affine, ProductIsNotCommutative) {
    Affine move, scale;
    move.m[3] = 1;
    scale.m[0] = 2;
    EXPECT_EQ((scale * move).point({0, 0, 0}).x, 2);
    EXPECT_EQ((move * scale).point({0, 0, 0}).x, 1);
}

TEST(Affine, InverseUndoes) {
    std::mt19937 random(2);
    int tested = 0;
    for (int k = 0; k < 500; ++k) {
        const Affine a = random_affine(random, 2);
        if (std::fabs(a.determinant()) < 0.5f) continue;
        ++tested;
        EXPECT_LT(round_trip(a, inverse(a), {1, 2, -3}), 3e-5f);
        EXPECT_LT(round_trip(inverse(a), a, {1, 2, -3}), 3e-5f);
    }
    EXPECT_GT(tested, 300);
}

TEST(Affine, TheRoundTripNoticesATranspose) {
    std::mt19937 random(3);
    const Affine a = random_affine(random, 2);
    Affine wrong = inverse(a);
    std::swap(wrong.m[1], wrong.m[4]);
    EXPECT_GT(round_trip(a, wrong, {1, 2, -3}), 1e-2f);
}

TEST(Affine, InverseOfExtremes) {
    for (const float s : {1e-12f, 1e-6f, 1e6f, 1e12f}) {
        Affine a;
        a.m[0] = a.m[5] = a.m[10] = s;
        const Affine inv = inverse(a);
        EXPECT_NEAR(inv.m[0] * s, 1, 1e-6) << s;
        EXPECT_NEAR(inv.m[10] * s, 1, 1e-6) << s;
    }
    // Small and far away: the position survives.
    Affine far;
    far.m[0] = far.m[5] = far.m[10] = 1e-3f;
    far.m[3] = 1000;
    EXPECT_LT(distance(inverse(far).point(far.point({0, 0, 0})), {0, 0, 0}), 1e-1f);
    // Very unequal scales, mirrored.
    Affine flat;
    flat.m[0] = -1e5f;
    flat.m[5] = 1e-5f;
    EXPECT_LT(flat.determinant(), 0);
    EXPECT_LT(round_trip(flat, inverse(flat), {1, 2, 3}), 1e-5f);
}

TEST(Affine, InverseOfASingularMatrixIsTheIdentity) {
    Affine flat;
    flat.m[10] = 0;
    EXPECT_EQ(inverse(flat), Affine{});
    Affine nan;
    nan.m[0] = std::nanf("");
    EXPECT_EQ(inverse(nan), Affine{});
}

TEST(Affine, NormalsStayPerpendicular) {
    std::mt19937 random(4);
    for (int k = 0; k < 200; ++k) {
        const Affine a = random_affine(random, 2);
        if (std::fabs(a.determinant()) < 0.3f) continue;
        const Float3 n{0, 0, 1}, t{1, 2, 0};
        const Float3 n2 = normalize(inverse(a).transposed_vector(n)), t2 = normalize(a.vector(t));
        EXPECT_NEAR(dot(n2, t2), 0, 2e-5);
    }
}

TEST(Affine, DeterminantIsTheVolume) {
    Affine a;
    a.m = {2, 0, 0, 9, 0, 0, 3, 9, 0, 4, 0, 9};
    EXPECT_FLOAT_EQ(a.determinant(), -24);
}

TEST(Float3s, NormalizeAndLuminance) {
    EXPECT_EQ(normalize({0, 0, 0}), (Float3{0, 0, 0}));
    EXPECT_NEAR(length(normalize({1e-15f, 2e-15f, 0})), 1, 1e-6);
    EXPECT_NEAR(luminance({1, 1, 1}), 1, 1e-6);
    EXPECT_EQ(cross({1, 0, 0}, {0, 1, 0}), (Float3{0, 0, 1}));
}

}  // namespace
}  // namespace cardioid
