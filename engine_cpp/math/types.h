// SPDX-License-Identifier: GPL-3.0-or-later
// Plain scalar value types for scene building and film code; lanes live in simd/.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace cardioid {

/// Lanes in a shading chunk: vertices of one material are shaded 64 at a time.
inline constexpr int k_chunk = 64;

/// One value per lane of a chunk.
using Row = float[k_chunk];

struct Float3 {
    float x = 0, y = 0, z = 0;
    friend Float3 operator+(Float3 a, Float3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Float3 operator-(Float3 a, Float3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Float3 operator*(Float3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
    friend Float3 operator*(Float3 a, Float3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
    bool operator==(const Float3&) const = default;
};
inline float dot(Float3 a, Float3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Float3 cross(Float3 a, Float3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(Float3 a) { return std::sqrt(dot(a, a)); }
/// The zero vector stays zero.
inline Float3 normalize(Float3 a) {
    const float l = length(a);
    return l > 0 ? a * (1.0f / l) : a;
}
/// Rec.709 luminance of scene-linear RGB.
inline float luminance(Float3 c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

/// Affine map, row major 3×4: p' = M·(p, 1).
struct Affine {
    std::array<float, 12> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    Float3 point(Float3 p) const {
        return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
    }
    Float3 vector(Float3 p) const {
        return {m[0] * p.x + m[1] * p.y + m[2] * p.z, m[4] * p.x + m[5] * p.y + m[6] * p.z,
                m[8] * p.x + m[9] * p.y + m[10] * p.z};
    }
    /// Mᵀ·n of the linear part: with the inverse of a transform it maps normals.
    Float3 transposed_vector(Float3 n) const {
        return {m[0] * n.x + m[4] * n.y + m[8] * n.z, m[1] * n.x + m[5] * n.y + m[9] * n.z,
                m[2] * n.x + m[6] * n.y + m[10] * n.z};
    }
    Float3 column(int c) const { return {m[c], m[4 + c], m[8 + c]}; }
    Float3 translation() const { return column(3); }
    float determinant() const { return dot(column(0), cross(column(1), column(2))); }
    bool operator==(const Affine&) const = default;
};
Affine operator*(const Affine& a, const Affine& b);
/// Inverse; a singular matrix gives the identity (validation names those before they get here).
Affine inverse(const Affine& a);

}  // namespace cardioid
