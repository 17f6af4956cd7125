// SPDX-License-Identifier: GPL-3.0-or-later
// Vec3, Spectrum and Frame over lanes. Directions point away from the surface.
#pragma once

#include "simd/elementary.h"

namespace cardioid::CD_ISA_NS {

struct Vec2 {
    Float x, y;
};

struct Vec3 {
    Float x, y, z;
    friend Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vec3 operator*(Vec3 a, Float s) { return {a.x * s, a.y * s, a.z * s}; }
    friend Vec3 operator*(Float s, Vec3 a) { return a * s; }
    friend Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
};

inline Float dot(Vec3 a, Vec3 b) { return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z)); }
inline Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline Float length_squared(Vec3 a) { return dot(a, a); }
inline Float length(Vec3 a) { return sqrt(dot(a, a)); }
/// The zero vector stays zero.
inline Vec3 normalize(Vec3 a) { return a * (1.0f / sqrt(max(dot(a, a), 1e-38f))); }
inline Vec3 select(Mask m, Vec3 a, Vec3 b) { return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)}; }

/// Scene-linear RGB. The one name for colour, so that a spectral build stays possible.
struct Spectrum {
    Float r, g, b;
    Spectrum() = default;
    Spectrum(Float r_, Float g_, Float b_) : r(r_), g(g_), b(b_) {}
    explicit Spectrum(Float x) : r(x), g(x), b(x) {}
    friend Spectrum operator+(Spectrum a, Spectrum c) { return {a.r + c.r, a.g + c.g, a.b + c.b}; }
    friend Spectrum operator-(Spectrum a, Spectrum c) { return {a.r - c.r, a.g - c.g, a.b - c.b}; }
    friend Spectrum operator*(Spectrum a, Spectrum c) { return {a.r * c.r, a.g * c.g, a.b * c.b}; }
    friend Spectrum operator*(Spectrum a, Float s) { return {a.r * s, a.g * s, a.b * s}; }
    friend Spectrum operator*(Float s, Spectrum a) { return a * s; }
    Spectrum& operator+=(Spectrum c) { return *this = *this + c; }
    Spectrum& operator*=(Spectrum c) { return *this = *this * c; }
};
/// Rec.709 luminance, the one place with these weights over lanes.
inline Float luminance(Spectrum c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }
inline Float max_component(Spectrum c) { return max(c.r, max(c.g, c.b)); }
inline Float average(Spectrum c) { return (c.r + c.g + c.b) * (1.0f / 3.0f); }
inline Spectrum select(Mask m, Spectrum a, Spectrum b) {
    return {select(m, a.r, b.r), select(m, a.g, b.g), select(m, a.b, b.b)};
}

/// Orthonormal basis with z = n (Duff et al. 2017). n must be of unit length.
struct Frame {
    Vec3 s, t, n;
    explicit Frame(Vec3 normal) : n(normal) {
        const Float sign = copysign(1.0f, normal.z);
        const Float a = -1.0f / (sign + normal.z);
        const Float b = normal.x * normal.y * a;
        s = {fma(sign * normal.x * normal.x, a, 1.0f), sign * b, -(sign * normal.x)};
        t = {b, fma(normal.y * normal.y, a, sign), -normal.y};
    }
    /// s along the part of `tangent` orthogonal to n; falls back to the frame above where that part vanishes.
    Frame(Vec3 normal, Vec3 tangent) : Frame(normal) {
        const Vec3 u = tangent - normal * dot(normal, tangent);
        const Mask ok = length_squared(u) > Float(1e-12f);
        s = select(ok, normalize(u), s);
        t = select(ok, cross(normal, s), t);
    }
    Vec3 to_local(Vec3 w) const { return {dot(w, s), dot(w, t), dot(w, n)}; }
    Vec3 to_world(Vec3 w) const { return s * w.x + t * w.y + n * w.z; }
};

/// SoA row access: three arrays that share an index.
inline Vec3 load3(const float (*rows)[64], int i) { return {load(rows[0] + i), load(rows[1] + i), load(rows[2] + i)}; }
inline void store3(float (*rows)[64], int i, Vec3 a) {
    store(rows[0] + i, a.x);
    store(rows[1] + i, a.y);
    store(rows[2] + i, a.z);
}
inline Spectrum load_rgb(const float (*rows)[64], int i) {
    return {load(rows[0] + i), load(rows[1] + i), load(rows[2] + i)};
}
inline void store_rgb(float (*rows)[64], int i, Spectrum c) {
    store(rows[0] + i, c.r);
    store(rows[1] + i, c.g);
    store(rows[2] + i, c.b);
}

}  // namespace cardioid::CD_ISA_NS
