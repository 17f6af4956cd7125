// SPDX-License-Identifier: GPL-3.0-or-later
// Fractal sums of Perlin noise: Noise (all versions) and Musgrave, and white noise.
#include "nodes/kernel.h"
#include "nodes/kernel_math.h"
#include "nodes/kernel_noise.h"

namespace cardioid::CD_ISA_NS {

using nodes::Instruction;
using nodes::NoiseType;

namespace {

/// `whole` octaves per lane and a last one with weight `rest`.
struct Fractal {
    Int whole;
    Float rest, roughness, lacunarity, offset, gain;
    int most;  ///< the largest count of any lane

    Fractal(Float octaves, bool one_more) {
        const Float f = floor(octaves);
        whole = to_int(f) + Int(one_more ? 1 : 0);
        rest = octaves - f;
        most = 0;
        for (int k = 0; k < W; ++k) most = whole[k] > most ? whole[k] : most;
    }
    Mask in_octave(int i) const { return Int(i) < whole; }
    /// The fractional octave comes after the whole ones.
    Mask in_rest(int i) const { return (whole == Int(i)) & (rest != Float(0.0f)); }
    bool wants(int i) const { return any(in_octave(i) | in_rest(i)); }
};

template <int D>
Float fbm(Vec4 p, const Fractal& f, bool normalize) {
    Float sum = 0.0f, amplitude = 1.0f, total = 0.0f, last = 0.0f;
    for (int i = 0; i <= f.most && f.wants(i); ++i) {
        const Float t = perlin<D>(p) * amplitude;
        const Mask on = f.in_octave(i);
        last = select(f.in_rest(i), t, last);
        sum = select(on, sum + t, sum);
        total = select(on, total + amplitude, total);
        amplitude = select(on, amplitude * f.roughness, amplitude);
        p = p * f.lacunarity;
    }
    if (!normalize) return sum + f.rest * last;
    const Float a = select(total > Float(0.0f), 0.5f * sum / total + 0.5f, Float(0.5f));
    const Float b = 0.5f * (sum + last) / max(total + amplitude, 1e-30f) + 0.5f;
    return select(f.rest != Float(0.0f), mix(a, b, f.rest), a);
}

template <int D>
Float multifractal(Vec4 p, const Fractal& f) {
    Float value = 1.0f, power = 1.0f;
    for (int i = 0; i <= f.most && f.wants(i); ++i) {
        const Float t = power * perlin<D>(p);
        value = select(f.in_octave(i), value * (t + 1.0f), select(f.in_rest(i), value * (f.rest * t + 1.0f), value));
        power = power * f.roughness;
        p = p * f.lacunarity;
    }
    return value;
}

template <int D>
Float hetero_terrain(Vec4 p, const Fractal& f) {
    Float value = f.offset + perlin<D>(p), power = f.roughness;
    p = p * f.lacunarity;
    // The first octave is always there; a fractional part below one octave is added after it.
    for (int i = 1; i <= (f.most > 1 ? f.most : 1); ++i) {
        const Mask rest = select(f.whole < Int(1), mask_of(i == 1) & (f.rest != Float(0.0f)), f.in_rest(i));
        if (none(f.in_octave(i) | rest)) break;
        const Float step = (perlin<D>(p) + f.offset) * power * value;
        value = select(f.in_octave(i), value + step, select(rest, value + f.rest * step, value));
        power = power * f.roughness;
        p = p * f.lacunarity;
    }
    return value;
}

template <int D>
Float hybrid_multifractal(Vec4 p, const Fractal& f) {
    Float value = 0.0f, power = 1.0f, weight = 1.0f;
    for (int i = 0; i <= f.most && f.wants(i); ++i) {
        const Mask heavy = weight > Float(0.001f);
        if (none(heavy)) break;
        const Float w = min(weight, 1.0f);
        const Float signal = (perlin<D>(p) + f.offset) * power;
        const Mask on = f.in_octave(i) & heavy, rest = f.in_rest(i) & heavy;
        value = select(on, value + w * signal, select(rest, value + f.rest * w * signal, value));
        weight = select(on, w * f.gain * signal, weight);
        power = power * f.roughness;
        p = p * f.lacunarity;
    }
    return value;
}

template <int D>
Float ridged_multifractal(Vec4 p, const Fractal& f) {
    const auto ridge = [&](Vec4 q) {
        const Float s = f.offset - abs(perlin<D>(q));
        return s * s;
    };
    Float signal = ridge(p), value = signal, power = f.roughness;
    for (int i = 1; i < f.most; ++i) {
        p = p * f.lacunarity;
        const Mask on = f.in_octave(i);
        const Float next = ridge(p) * saturate(signal * f.gain);
        signal = select(on, next, signal);
        value = select(on, value + signal * power, value);
        power = power * f.roughness;
    }
    return value;
}

template <int D>
Float fractal(Vec4 p, const Fractal& f, NoiseType type, bool normalize) {
    switch (type) {
        case NoiseType::fbm: return fbm<D>(p, f, normalize);
        case NoiseType::multifractal: return multifractal<D>(p, f);
        case NoiseType::hetero_terrain: return hetero_terrain<D>(p, f);
        case NoiseType::hybrid_multifractal: return hybrid_multifractal<D>(p, f);
        default: return ridged_multifractal<D>(p, f);
    }
}

/// Offsets that stand in for a seed.
template <int D>
Vec4 seed_offset(float seed) {
    if constexpr (D == 1) return {100.0f + random(Float(seed)) * 100.0f, 0.0f, 0.0f, 0.0f};
    const auto axis = [&](int k) {
        return k < D ? 100.0f + random(Float(seed), Float(static_cast<float>(k))) * 100.0f : Float(0.0f);
    };
    return {axis(0), axis(1), axis(2), axis(3)};
}

template <int D>
void noise(const Machine& m, const Instruction& in) {
    const auto type = static_cast<NoiseType>(in.imm >> nodes::noise_type_shift & 0xf);
    const bool normalize = in.imm & nodes::noise_normalize, musgrave = in.imm & nodes::noise_musgrave;
    const bool color = in.imm & nodes::noise_color;
    Source a[10];
    for (int k = 0; k < 10; ++k) a[k] = m.arg(in, k);
    for (int i = 0; i < m.end; i += W) {
        Vec4 p = {a[0].at(i), a[1].at(i), a[2].at(i), a[3].at(i)};
        Fractal f(a[4].at(i), !musgrave);
        f.roughness = a[5].at(i);
        f.lacunarity = a[6].at(i);
        f.offset = a[7].at(i);
        f.gain = a[8].at(i);
        const Float distortion = a[9].at(i);
        if (any(distortion != Float(0.0f))) {
            const auto shift = [&](int k) {
                return k < D ? perlin<D>(p + seed_offset<D>(static_cast<float>(k))) * distortion : Float(0.0f);
            };
            p = p + Vec4{shift(0), shift(1), shift(2), shift(3)};
        }
        const Float value = fractal<D>(p, f, type, normalize);
        store(m.dst(in, 0) + i, value);
        if (!color) continue;
        store(m.dst(in, 1) + i, fractal<D>(p + seed_offset<D>(static_cast<float>(D)), f, type, normalize));
        store(m.dst(in, 2) + i, fractal<D>(p + seed_offset<D>(static_cast<float>(D + 1)), f, type, normalize));
    }
}

template <int D>
void white_noise(const Machine& m, const Instruction& in) {
    const Source x = m.arg(in, 0), y = m.arg(in, 1), z = m.arg(in, 2), w = m.arg(in, 3);
    for (int i = 0; i < m.end; i += W) {
        const Vec4 p = {x.at(i), y.at(i), z.at(i), w.at(i)};
        store_vec(m, in, 0, i, random_color<D>(p));
    }
}

}  // namespace

void op_noise(const Machine& m, const Instruction& in) {
    switch (in.imm & nodes::noise_dimension_mask) {
        case 1: noise<1>(m, in); break;
        case 2: noise<2>(m, in); break;
        case 3: noise<3>(m, in); break;
        default: noise<4>(m, in); break;
    }
}

void op_white_noise(const Machine& m, const Instruction& in) {
    switch (in.imm) {
        case 1: white_noise<1>(m, in); break;
        case 2: white_noise<2>(m, in); break;
        case 3: white_noise<3>(m, in); break;
        default: white_noise<4>(m, in); break;
    }
}

}  // namespace cardioid::CD_ISA_NS
