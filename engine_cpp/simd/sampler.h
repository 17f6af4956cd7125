// SPDX-License-Identifier: GPL-3.0-or-later
// Owen-scrambled Sobol (0,2) pairs, padded over dimensions (Burley 2020, "Practical Hash-based Owen Scrambling"), stateless in
// (seed, pixel, sample, dimension). Everything is computed with the first binary digit in bit 0, where an Owen scramble is a
// Laine–Karras hash; one bit reversal at the end gives the number.
#pragma once

#include "simd/vec.h"

namespace cardioid::CD_ISA_NS {

/// A well mixed 32-bit value (PCG output permutation, Jarzynski & Olano 2020).
inline Int hash(Int x) {
    x = x * Int::of_bits(747796405u) + Int::of_bits(2891336453u);
    // The shift of PCG-RXS depends on the value; a fixed one mixes as well here and is one instruction.
    x = ((x >> 16) ^ x) * Int::of_bits(277803737u);
    x = ((x >> 15) ^ x) * Int::of_bits(0x846ca68bu);
    return (x >> 16) ^ x;
}
inline Int hash(Int a, Int b) { return hash(a ^ (hash(b) + Int::of_bits(0x9e3779b9u))); }

inline Int reverse_bits(Int x) {
    x = ((x >> 1) & Int(0x55555555)) | ((x & Int(0x55555555)) << 1);
    x = ((x >> 2) & Int(0x33333333)) | ((x & Int(0x33333333)) << 2);
    x = ((x >> 4) & Int(0x0f0f0f0f)) | ((x & Int(0x0f0f0f0f)) << 4);
    x = ((x >> 8) & Int(0x00ff00ff)) | ((x & Int(0x00ff00ff)) << 8);
    return (x >> 16) | (x << 16);
}

/// Owen scramble of a value whose first digit is bit 0 (Vegdahl's constants).
inline Int owen_scramble(Int x, Int seed) {
    x ^= x * Int(0x3d20adea);
    x += seed;
    x *= (seed >> 16) | Int(1);
    x ^= x * Int(0x05526c56);
    x ^= x * Int(0x53a22864);
    return x;
}

/// [0,1): 24 bits of a value whose first digit is bit 31.
inline Float unit_float(Int x) { return to_float(x >> 8) * 5.9604644775390625e-8f; }

/// Second Sobol dimension of an index, first digit in bit 0 (Pascal matrix mod 2: digit j sums the index bits that contain j).
inline Int sobol_second(Int x) {
    x ^= (x >> 1) & Int(0x55555555);
    x ^= (x >> 2) & Int(0x33333333);
    x ^= (x >> 4) & Int(0x0f0f0f0f);
    x ^= (x >> 8) & Int(0x00ff00ff);
    x ^= x >> 16;
    return x;
}

/// The pair of dimensions `dimension` of a sample in the sequence of `pixel_seed`. `reversed_index` is reverse_bits(sample
/// number): the order of samples is shuffled for every pair by an Owen scramble from the number's highest bit down, which keeps
/// each aligned block of 2^k samples a (0,2) net.
inline Vec2 sample_pair(Int pixel_seed, Int reversed_index, Int dimension) {
    const Int seed = hash(pixel_seed, dimension);
    const Int shuffled = reverse_bits(owen_scramble(reversed_index, seed));
    const Int x = owen_scramble(shuffled, hash(seed ^ Int::of_bits(0xa511e9b3u)));
    const Int y = owen_scramble(sobol_second(shuffled), hash(seed ^ Int::of_bits(0x63d83595u)));
    return {unit_float(reverse_bits(x)), unit_float(reverse_bits(y))};
}

}  // namespace cardioid::CD_ISA_NS
