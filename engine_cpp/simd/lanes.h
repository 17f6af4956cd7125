// SPDX-License-Identifier: GPL-3.0-or-later
// The lane types Float, Int and Mask: W values that move together. The only room with intrinsics is simd/.
// Kernels read like scalar code: `select(mask, a, b)` for `?:`, masks instead of branches.
// W = 1 is the same source and is a test. Built on GCC/Clang vector extensions.
#pragma once

#include "simd/isa.h"

#include <bit>
#include <cstdint>

#if CARDIOID_WIDTH > 1
#include <immintrin.h>
#endif

namespace cardioid::CD_ISA_NS {

inline constexpr int W = CARDIOID_WIDTH;

using RawFloat = float __attribute__((vector_size(4 * CARDIOID_WIDTH)));
using RawInt = std::int32_t __attribute__((vector_size(4 * CARDIOID_WIDTH)));
using RawUint = std::uint32_t __attribute__((vector_size(4 * CARDIOID_WIDTH)));

/// All bits of a lane are one (true) or zero (false).
struct Mask {
    RawInt v;
    friend Mask operator&(Mask a, Mask b) { return {a.v & b.v}; }
    friend Mask operator|(Mask a, Mask b) { return {a.v | b.v}; }
    friend Mask operator^(Mask a, Mask b) { return {a.v ^ b.v}; }
    friend Mask operator~(Mask a) { return {~a.v}; }
    Mask& operator&=(Mask b) {
        v &= b.v;
        return *this;
    }
    Mask& operator|=(Mask b) {
        v |= b.v;
        return *this;
    }
};

/// 32-bit integers; arithmetic wraps, `>>` is logical (hashes and Sobol need it).
struct Int {
    RawInt v;
    Int() = default;
    Int(RawInt raw) : v(raw) {}               // NOLINT(google-explicit-constructor)
    Int(std::int32_t x) : v(RawInt{} + x) {}  // NOLINT(google-explicit-constructor)
    static Int of_bits(std::uint32_t x) { return Int(static_cast<std::int32_t>(x)); }
    friend Int operator+(Int a, Int b) { return Int(RawInt(RawUint(a.v) + RawUint(b.v))); }
    friend Int operator-(Int a, Int b) { return Int(RawInt(RawUint(a.v) - RawUint(b.v))); }
    friend Int operator*(Int a, Int b) { return Int(RawInt(RawUint(a.v) * RawUint(b.v))); }
    friend Int operator&(Int a, Int b) { return Int(a.v & b.v); }
    friend Int operator|(Int a, Int b) { return Int(a.v | b.v); }
    friend Int operator^(Int a, Int b) { return Int(a.v ^ b.v); }
    friend Int operator~(Int a) { return Int(~a.v); }
    friend Int operator<<(Int a, int n) { return Int(RawInt(RawUint(a.v) << n)); }
    friend Int operator>>(Int a, int n) { return Int(RawInt(RawUint(a.v) >> n)); }
    friend Mask operator==(Int a, Int b) { return {RawInt(a.v == b.v)}; }
    friend Mask operator!=(Int a, Int b) { return {RawInt(a.v != b.v)}; }
    friend Mask operator<(Int a, Int b) { return {RawInt(a.v < b.v)}; }
    friend Mask operator>(Int a, Int b) { return {RawInt(a.v > b.v)}; }
    friend Mask operator<=(Int a, Int b) { return {RawInt(a.v <= b.v)}; }
    friend Mask operator>=(Int a, Int b) { return {RawInt(a.v >= b.v)}; }
    Int& operator+=(Int b) { return *this = *this + b; }
    Int& operator^=(Int b) { return *this = *this ^ b; }
    Int& operator*=(Int b) { return *this = *this * b; }
    std::int32_t operator[](int lane) const { return v[lane]; }
};

struct Float {
    RawFloat v;
    Float() = default;
    Float(RawFloat raw) : v(raw) {}        // NOLINT(google-explicit-constructor)
    Float(float x) : v(RawFloat{} + x) {}  // NOLINT(google-explicit-constructor)
    friend Float operator+(Float a, Float b) { return a.v + b.v; }
    friend Float operator-(Float a, Float b) { return a.v - b.v; }
    friend Float operator*(Float a, Float b) { return a.v * b.v; }
    friend Float operator/(Float a, Float b) { return a.v / b.v; }
    friend Float operator-(Float a) { return -a.v; }
    friend Mask operator<(Float a, Float b) { return {RawInt(a.v < b.v)}; }
    friend Mask operator>(Float a, Float b) { return {RawInt(a.v > b.v)}; }
    friend Mask operator<=(Float a, Float b) { return {RawInt(a.v <= b.v)}; }
    friend Mask operator>=(Float a, Float b) { return {RawInt(a.v >= b.v)}; }
    friend Mask operator==(Float a, Float b) { return {RawInt(a.v == b.v)}; }
    friend Mask operator!=(Float a, Float b) { return {RawInt(a.v != b.v)}; }
    Float& operator+=(Float b) {
        v += b.v;
        return *this;
    }
    Float& operator-=(Float b) {
        v -= b.v;
        return *this;
    }
    Float& operator*=(Float b) {
        v *= b.v;
        return *this;
    }
    Float& operator/=(Float b) {
        v /= b.v;
        return *this;
    }
    float operator[](int lane) const { return v[lane]; }
};

// Select and reductions -----------------------------------------------------------------------------------

inline Float select(Mask m, Float a, Float b) { return Float(m.v ? a.v : b.v); }
inline Int select(Mask m, Int a, Int b) { return Int(m.v ? a.v : b.v); }
inline Mask select(Mask m, Mask a, Mask b) { return {(m.v & a.v) | (~m.v & b.v)}; }
inline Mask mask_of(bool b) { return {RawInt{} - static_cast<std::int32_t>(b)}; }

/// Lane 0 in bit 0.
inline std::uint32_t bits(Mask m) {
#if CARDIOID_WIDTH == 16
    return _mm512_movepi32_mask(std::bit_cast<__m512i>(m.v));
#elif CARDIOID_WIDTH == 8
    return static_cast<std::uint32_t>(_mm256_movemask_ps(std::bit_cast<__m256>(m.v)));
#else
    return m.v[0] != 0 ? 1u : 0u;
#endif
}
inline bool any(Mask m) { return bits(m) != 0; }
inline bool all(Mask m) { return bits(m) == (W == 32 ? ~0u : (1u << W) - 1u); }
inline bool none(Mask m) { return bits(m) == 0; }
inline int count(Mask m) { return std::popcount(bits(m)); }

inline Int lane_index() {
    RawInt r{};
    for (int i = 0; i < W; ++i) r[i] = i;
    return Int(r);
}
/// True for the lanes whose index is under n: the tail of a list.
inline Mask first_lanes(int n) { return lane_index() < Int(n); }

// Casts ---------------------------------------------------------------------------------------------------

inline Float to_float(Int a) { return Float(__builtin_convertvector(a.v, RawFloat)); }
/// Truncates toward zero; the value must fit.
inline Int to_int(Float a) { return Int(__builtin_convertvector(a.v, RawInt)); }
inline Int bits_of(Float a) { return Int(RawInt(a.v)); }
inline Float float_of_bits(Int a) { return Float(RawFloat(a.v)); }

// Loads, stores, gathers ----------------------------------------------------------------------------------

inline Float load(const float* p) {
    RawFloat r;
    __builtin_memcpy(&r, p, sizeof r);
    return Float(r);
}
inline Int load(const std::int32_t* p) {
    RawInt r;
    __builtin_memcpy(&r, p, sizeof r);
    return Int(r);
}
inline void store(float* p, Float a) { __builtin_memcpy(p, &a.v, sizeof a.v); }
inline void store(std::int32_t* p, Int a) { __builtin_memcpy(p, &a.v, sizeof a.v); }
inline void store(float* p, Float a, Mask m) { store(p, select(m, a, load(p))); }
inline void store(std::int32_t* p, Int a, Mask m) { store(p, select(m, a, load(p))); }

/// p[index] per lane. Every index must be valid: clamp the lanes that are masked off first.
inline Float gather(const float* p, Int index) {
#if CARDIOID_WIDTH == 16
    return std::bit_cast<RawFloat>(_mm512_i32gather_ps(std::bit_cast<__m512i>(index.v), p, 4));
#elif CARDIOID_WIDTH == 8
    return std::bit_cast<RawFloat>(_mm256_i32gather_ps(p, std::bit_cast<__m256i>(index.v), 4));
#else
    return Float(p[index.v[0]]);
#endif
}
inline Int gather(const std::int32_t* p, Int index) {
#if CARDIOID_WIDTH == 16
    return std::bit_cast<RawInt>(_mm512_i32gather_epi32(std::bit_cast<__m512i>(index.v), p, 4));
#elif CARDIOID_WIDTH == 8
    return std::bit_cast<RawInt>(_mm256_i32gather_epi32(p, std::bit_cast<__m256i>(index.v), 4));
#else
    return Int(p[index.v[0]]);
#endif
}
inline Int gather(const std::uint32_t* p, Int index) { return gather(reinterpret_cast<const std::int32_t*>(p), index); }

/// Writes the lanes of `a` that m selects next to each other and returns how many. Writes up to W values: pad arrays by W.
inline int compress_store(std::int32_t* p, Int a, Mask m) {
#if CARDIOID_WIDTH == 16
    store(p, Int(std::bit_cast<RawInt>(
                 _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits(m)), std::bit_cast<__m512i>(a.v)))));
    return count(m);
#else
    int n = 0;
    for (std::uint32_t b = bits(m); b != 0; b &= b - 1) p[n++] = a.v[std::countr_zero(b)];
    return n;
#endif
}

// Elementary functions that the hardware has ---------------------------------------------------------------

inline Float min(Float a, Float b) { return select(a < b, a, b); }
inline Float max(Float a, Float b) { return select(a > b, a, b); }
inline Int min(Int a, Int b) { return select(a < b, a, b); }
inline Int max(Int a, Int b) { return select(a > b, a, b); }
inline Float abs(Float a) { return float_of_bits(bits_of(a) & Int(0x7fffffff)); }
inline Float clamp(Float x, Float lo, Float hi) { return min(max(x, lo), hi); }
inline Float saturate(Float x) { return clamp(x, 0.0f, 1.0f); }
inline Float copysign(Float mag, Float sign) {
    return float_of_bits((bits_of(mag) & Int(0x7fffffff)) | (bits_of(sign) & Int::of_bits(0x80000000u)));
}

inline Float sqrt(Float a) {
#if CARDIOID_WIDTH == 16
    return std::bit_cast<RawFloat>(_mm512_sqrt_ps(std::bit_cast<__m512>(a.v)));
#elif CARDIOID_WIDTH == 8
    return std::bit_cast<RawFloat>(_mm256_sqrt_ps(std::bit_cast<__m256>(a.v)));
#else
    return Float(__builtin_sqrtf(a.v[0]));
#endif
}
inline Float safe_sqrt(Float a) { return sqrt(max(a, 0.0f)); }

inline Float floor(Float a) {
#if CARDIOID_WIDTH == 16
    return std::bit_cast<RawFloat>(
        _mm512_roundscale_ps(std::bit_cast<__m512>(a.v), _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC));
#elif CARDIOID_WIDTH == 8
    return std::bit_cast<RawFloat>(_mm256_floor_ps(std::bit_cast<__m256>(a.v)));
#else
    return Float(__builtin_floorf(a.v[0]));
#endif
}
inline Float ceil(Float a) { return -floor(-a); }

/// a·b + c with one rounding where the hardware has it.
inline Float fma(Float a, Float b, Float c) {
#if CARDIOID_WIDTH == 16
    return std::bit_cast<RawFloat>(
        _mm512_fmadd_ps(std::bit_cast<__m512>(a.v), std::bit_cast<__m512>(b.v), std::bit_cast<__m512>(c.v)));
#elif CARDIOID_WIDTH == 8
    return std::bit_cast<RawFloat>(
        _mm256_fmadd_ps(std::bit_cast<__m256>(a.v), std::bit_cast<__m256>(b.v), std::bit_cast<__m256>(c.v)));
#else
    return Float(a.v[0] * b.v[0] + c.v[0]);
#endif
}

inline Mask is_finite(Float a) { return (bits_of(a) & Int(0x7f800000)) != Int(0x7f800000); }

inline float hsum(Float a) {
    float s = 0;
    for (int i = 0; i < W; ++i) s += a.v[i];
    return s;
}

}  // namespace cardioid::CD_ISA_NS
