// SPDX-License-Identifier: GPL-3.0-or-later
// Perlin noise in 1 to 4 dimensions over lanes, with Blender's gradients and scale: about [-1, 1].
#pragma once

#include "nodes/kernel_hash.h"

namespace cardioid::CD_ISA_NS {

struct Cell {
    Int i;
    Float f, fade;
    explicit Cell(Float x) {
        const Float whole = floor(x);
        i = to_int(whole);
        f = x - whole;
        fade = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
    }
};

/// x, or -x where the bit of h is set.
inline Float flip(Float x, Int h, int bit) {
    return float_of_bits(bits_of(x) ^ ((h << (31 - bit)) & Int::of_bits(0x80000000u)));
}
inline Mask bit_set(Int h, int bit) { return (h & Int(1 << bit)) != Int(0); }
inline Float lerp(Float a, Float b, Float t) { return a + t * (b - a); }

inline Float gradient(Int hash, Float x) {
    const Float g = 1.0f + to_float(hash & Int(7));
    return flip(g, hash, 3) * x;
}
inline Float gradient(Int hash, Float x, Float y) {
    const Mask low = ~bit_set(hash, 2);
    return flip(select(low, x, y), hash, 0) + flip(2.0f * select(low, y, x), hash, 1);
}
inline Float gradient(Int hash, Float x, Float y, Float z) {
    const Int h = hash & Int(15);
    const Mask odd = (h == Int(12)) | (h == Int(14));
    const Float u = select(h < Int(8), x, y), v = select(h < Int(4), y, select(odd, x, z));
    return flip(u, h, 0) + flip(v, h, 1);
}
inline Float gradient(Int hash, Float x, Float y, Float z, Float w) {
    const Int h = hash & Int(31);
    const Float u = select(h < Int(24), x, y), v = select(h < Int(16), y, z), s = select(h < Int(8), z, w);
    return flip(u, h, 0) + flip(v, h, 1) + flip(s, h, 2);
}

inline Float perlin(Float px) {
    const Cell x(px);
    const Int one(1);
    return lerp(gradient(hash1(x.i), x.f), gradient(hash1(x.i + one), x.f - 1.0f), x.fade) * 0.25f;
}

inline Float perlin(Float px, Float py) {
    const Cell x(px), y(py);
    const Int one(1);
    const auto row = [&](Int yi, Float yf) {
        return lerp(gradient(hash2(x.i, yi), x.f, yf), gradient(hash2(x.i + one, yi), x.f - 1.0f, yf), x.fade);
    };
    return lerp(row(y.i, y.f), row(y.i + one, y.f - 1.0f), y.fade) * 0.6616f;
}

inline Float perlin(Float px, Float py, Float pz) {
    const Cell x(px), y(py), z(pz);
    const Int one(1);
    const auto row = [&](Int yi, Float yf, Int zi, Float zf) {
        return lerp(gradient(hash3(x.i, yi, zi), x.f, yf, zf), gradient(hash3(x.i + one, yi, zi), x.f - 1.0f, yf, zf),
                    x.fade);
    };
    const auto plane = [&](Int zi, Float zf) {
        return lerp(row(y.i, y.f, zi, zf), row(y.i + one, y.f - 1.0f, zi, zf), y.fade);
    };
    return lerp(plane(z.i, z.f), plane(z.i + one, z.f - 1.0f), z.fade) * 0.9820f;
}

inline Float perlin(Float px, Float py, Float pz, Float pw) {
    const Cell x(px), y(py), z(pz), w(pw);
    const Int one(1);
    const auto row = [&](Int yi, Float yf, Int zi, Float zf, Int wi, Float wf) {
        return lerp(gradient(hash4(x.i, yi, zi, wi), x.f, yf, zf, wf),
                    gradient(hash4(x.i + one, yi, zi, wi), x.f - 1.0f, yf, zf, wf), x.fade);
    };
    const auto plane = [&](Int zi, Float zf, Int wi, Float wf) {
        return lerp(row(y.i, y.f, zi, zf, wi, wf), row(y.i + one, y.f - 1.0f, zi, zf, wi, wf), y.fade);
    };
    const auto space = [&](Int wi, Float wf) {
        return lerp(plane(z.i, z.f, wi, wf), plane(z.i + one, z.f - 1.0f, wi, wf), z.fade);
    };
    return lerp(space(w.i, w.f), space(w.i + one, w.f - 1.0f), w.fade) * 0.8344f;
}

template <int D>
inline Float perlin(Vec4 p) {
    if constexpr (D == 1)
        return perlin(p.x);
    else if constexpr (D == 2)
        return perlin(p.x, p.y);
    else if constexpr (D == 3)
        return perlin(p.x, p.y, p.z);
    else
        return perlin(p.x, p.y, p.z, p.w);
}

}  // namespace cardioid::CD_ISA_NS
