// SPDX-License-Identifier: GPL-3.0-or-later
// Bob Jenkins' lookup3 hash over lanes, as Blender's textures use it: seeds that count the words, floats by their bits.
#pragma once

#include "simd/vec.h"

namespace cardioid::CD_ISA_NS {

inline Int rotate_left(Int x, int k) { return (x << k) | (x >> (32 - k)); }

struct HashState {
    Int a, b, c;
    explicit HashState(int words)
        : a(Int::of_bits(0xdeadbeefu + (static_cast<std::uint32_t>(words) << 2) + 13u)), b(a), c(a) {}
    void mix() {
        a = (a - c) ^ rotate_left(c, 4);
        c += b;
        b = (b - a) ^ rotate_left(a, 6);
        a += c;
        c = (c - b) ^ rotate_left(b, 8);
        b += a;
        a = (a - c) ^ rotate_left(c, 16);
        c += b;
        b = (b - a) ^ rotate_left(a, 19);
        a += c;
        c = (c - b) ^ rotate_left(b, 4);
        b += a;
    }
    Int finish() {
        c = (c ^ b) - rotate_left(b, 14);
        a = (a ^ c) - rotate_left(c, 11);
        b = (b ^ a) - rotate_left(a, 25);
        c = (c ^ b) - rotate_left(b, 16);
        a = (a ^ c) - rotate_left(c, 4);
        b = (b ^ a) - rotate_left(a, 14);
        c = (c ^ b) - rotate_left(b, 24);
        return c;
    }
};

inline Int hash1(Int x) {
    HashState s(1);
    s.a += x;
    return s.finish();
}
inline Int hash2(Int x, Int y) {
    HashState s(2);
    s.a += x;
    s.b += y;
    return s.finish();
}
inline Int hash3(Int x, Int y, Int z) {
    HashState s(3);
    s.a += x;
    s.b += y;
    s.c += z;
    return s.finish();
}
inline Int hash4(Int x, Int y, Int z, Int w) {
    HashState s(4);
    s.a += x;
    s.b += y;
    s.c += z;
    s.mix();
    s.a += w;
    return s.finish();
}

/// An unsigned word to [0, 1].
inline Float unit_float(Int h) {
    const Float high = to_float(h >> 16), low = to_float(h & Int(0xffff));
    return (high * 65536.0f + low) * (1.0f / 4294967295.0f);
}

inline Float random(Float x) { return unit_float(hash1(bits_of(x))); }
inline Float random(Float x, Float y) { return unit_float(hash2(bits_of(x), bits_of(y))); }
inline Float random(Float x, Float y, Float z) { return unit_float(hash3(bits_of(x), bits_of(y), bits_of(z))); }
inline Float random(Float x, Float y, Float z, Float w) {
    return unit_float(hash4(bits_of(x), bits_of(y), bits_of(z), bits_of(w)));
}

/// Coordinates of a texture in 1 to 4 dimensions; the unused ones are 0.
struct Vec4 {
    Float x, y, z, w;
    friend Vec4 operator+(Vec4 a, Vec4 b) { return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w}; }
    friend Vec4 operator-(Vec4 a, Vec4 b) { return {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w}; }
    friend Vec4 operator*(Vec4 a, Float s) { return {a.x * s, a.y * s, a.z * s, a.w * s}; }
};

template <int D>
inline Float random(Vec4 p) {
    if constexpr (D == 1)
        return random(p.x);
    else if constexpr (D == 2)
        return random(p.x, p.y);
    else if constexpr (D == 3)
        return random(p.x, p.y, p.z);
    else
        return random(p.x, p.y, p.z, p.w);
}

/// Three numbers in [0, 1] from one point.
template <int D>
inline Vec3 random_color(Vec4 p) {
    if constexpr (D == 1)
        return {random(p.x), random(p.x, Float(1.0f)), random(p.x, Float(2.0f))};
    else if constexpr (D == 2)
        return {random(p.x, p.y), random(p.x, p.y, Float(1.0f)), random(p.x, p.y, Float(2.0f))};
    else if constexpr (D == 3)
        return {random(p.x, p.y, p.z), random(p.x, p.y, p.z, Float(1.0f)), random(p.x, p.y, p.z, Float(2.0f))};
    else
        return {random(p.x, p.y, p.z, p.w), random(p.z, p.x, p.w, p.y), random(p.w, p.z, p.y, p.x)};
}

}  // namespace cardioid::CD_ISA_NS
