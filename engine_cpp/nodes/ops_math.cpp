// SPDX-License-Identifier: GPL-3.0-or-later
// Scalar arithmetic: Blender's Math node, and what the compiler builds other nodes from.
#include "nodes/kernel.h"
#include "nodes/kernel_math.h"

namespace cardioid::CD_ISA_NS {

using nodes::Instruction;

namespace {

Float unit(Mask m) { return select(m, Float(1.0f), Float(0.0f)); }

Float wrap_value(Float x, Float high, Float low) {
    const Float range = high - low;
    return select(range != Float(0.0f), x - range * floor((x - low) / range), low);
}

Float pingpong_value(Float a, Float b) {
    const Float t = (a - b) / (b * 2.0f);
    return select(b != Float(0.0f), abs((t - floor(t)) * b * 2.0f - b), Float(0.0f));
}

Float smooth_minimum_value(Float a, Float b, Float k) {
    const Float h = max(k - abs(a - b), 0.0f) / k;
    const Float plain = min(a, b);
    return select(k != Float(0.0f), plain - h * h * h * k * (1.0f / 6.0f), plain);
}

Float sinh_value(Float x) {
    const Float e = exp(x), x2 = x * x;
    const Float series = x * (1.0f + x2 * (1.0f / 6.0f) * (1.0f + x2 * (1.0f / 20.0f) * (1.0f + x2 * (1.0f / 42.0f))));
    return select(abs(x) < Float(0.5f), series, 0.5f * (e - 1.0f / e));
}

Float cosh_value(Float x) {
    const Float e = exp(x);
    return 0.5f * (e + 1.0f / e);
}

Float tanh_value(Float x) {
    const Float far = copysign(1.0f - 2.0f / (exp(2.0f * abs(x)) + 1.0f), x);
    return select(abs(x) < Float(0.5f), sinh_value(x) / cosh_value(x), far);
}

}  // namespace

void op_add(const Machine& m, const Instruction& in) {
    map2(m, in, [](Float a, Float b) { return a + b; });
}
void op_subtract(const Machine& m, const Instruction& in) {
    map2(m, in, [](Float a, Float b) { return a - b; });
}
void op_multiply(const Machine& m, const Instruction& in) {
    map2(m, in, [](Float a, Float b) { return a * b; });
}
void op_divide(const Machine& m, const Instruction& in) { map2(m, in, safe_divide); }
void op_multiply_add(const Machine& m, const Instruction& in) {
    map3(m, in, [](Float a, Float b, Float c) { return a * b + c; });
}
void op_mix(const Machine& m, const Instruction& in) {
    map3(m, in, [](Float a, Float b, Float t) { return a + t * (b - a); });
}
void op_blend(const Machine& m, const Instruction& in) {
    map3(m, in, [](Float a, Float b, Float t) { return (1.0f - t) * a + t * b; });
}
void op_minimum(const Machine& m, const Instruction& in) {
    map2(m, in, [](Float a, Float b) { return min(a, b); });
}
void op_maximum(const Machine& m, const Instruction& in) {
    map2(m, in, [](Float a, Float b) { return max(a, b); });
}
void op_clamp(const Machine& m, const Instruction& in) {
    map3(m, in, [](Float x, Float low, Float high) { return clamp(x, low, high); });
}
void op_power(const Machine& m, const Instruction& in) { map2(m, in, safe_power); }
void op_logarithm(const Machine& m, const Instruction& in) {
    map2(m, in, [](Float a, Float b) {
        const Mask bad = (a <= Float(0.0f)) | (b <= Float(0.0f));
        return select(bad, Float(0.0f), safe_divide(log2(a), log2(b)));
    });
}
void op_square_root(const Machine& m, const Instruction& in) {
    map1(m, in, [](Float a) { return safe_sqrt(a); });
}
void op_inverse_square_root(const Machine& m, const Instruction& in) {
    map1(m, in, [](Float a) { return select(a > Float(0.0f), 1.0f / sqrt(max(a, 1e-38f)), Float(0.0f)); });
}
void op_absolute(const Machine& m, const Instruction& in) {
    map1(m, in, [](Float a) { return abs(a); });
}
void op_exponent(const Machine& m, const Instruction& in) {
    map1(m, in, [](Float a) { return exp(a); });
}
void op_less_than(const Machine& m, const Instruction& in) {
    map2(m, in, [](Float a, Float b) { return unit(a < b); });
}
void op_greater_than(const Machine& m, const Instruction& in) {
    map2(m, in, [](Float a, Float b) { return unit(a > b); });
}
void op_sign(const Machine& m, const Instruction& in) {
    map1(m, in, [](Float a) { return select(a == Float(0.0f), Float(0.0f), copysign(1.0f, a)); });
}
void op_compare(const Machine& m, const Instruction& in) {
    map3(m, in, [](Float a, Float b, Float e) { return unit((a == b) | (abs(a - b) <= max(e, 1.1920929e-7f))); });
}
void op_smooth_minimum(const Machine& m, const Instruction& in) { map3(m, in, smooth_minimum_value); }
void op_round(const Machine& m, const Instruction& in) {
    map1(m, in, [](Float a) { return floor(a + 0.5f); });
}
void op_floor(const Machine& m, const Instruction& in) {
    map1(m, in, [](Float a) { return floor(a); });
}
void op_ceil(const Machine& m, const Instruction& in) {
    map1(m, in, [](Float a) { return ceil(a); });
}
void op_truncate(const Machine& m, const Instruction& in) { map1(m, in, truncate); }
void op_fraction(const Machine& m, const Instruction& in) {
    map1(m, in, [](Float a) { return a - floor(a); });
}
void op_modulo(const Machine& m, const Instruction& in) { map2(m, in, safe_modulo); }
void op_floored_modulo(const Machine& m, const Instruction& in) {
    map2(m, in,
         [](Float a, Float b) { return select(b != Float(0.0f), a - floor(safe_divide(a, b)) * b, Float(0.0f)); });
}
void op_wrap(const Machine& m, const Instruction& in) { map3(m, in, wrap_value); }
void op_snap(const Machine& m, const Instruction& in) {
    map2(m, in, [](Float a, Float b) { return floor(safe_divide(a, b)) * b; });
}
void op_pingpong(const Machine& m, const Instruction& in) { map2(m, in, pingpong_value); }
void op_sine(const Machine& m, const Instruction& in) {
    map1(m, in, [](Float a) { return sin(a); });
}
void op_cosine(const Machine& m, const Instruction& in) {
    map1(m, in, [](Float a) { return cos(a); });
}
void op_tangent(const Machine& m, const Instruction& in) {
    map1(m, in, [](Float a) { return tan(a); });
}
void op_arcsine(const Machine& m, const Instruction& in) {
    map1(m, in, [](Float a) { return asin(a); });
}
void op_arccosine(const Machine& m, const Instruction& in) {
    map1(m, in, [](Float a) { return acos(a); });
}
void op_arctangent(const Machine& m, const Instruction& in) {
    map1(m, in, [](Float a) { return atan(a); });
}
void op_arctan2(const Machine& m, const Instruction& in) {
    map2(m, in, [](Float y, Float x) { return atan2(y, x); });
}
void op_sinh(const Machine& m, const Instruction& in) { map1(m, in, sinh_value); }
void op_cosh(const Machine& m, const Instruction& in) { map1(m, in, cosh_value); }
void op_tanh(const Machine& m, const Instruction& in) { map1(m, in, tanh_value); }
void op_select_positive(const Machine& m, const Instruction& in) {
    map3(m, in, [](Float c, Float a, Float b) { return select(c > Float(0.0f), a, b); });
}

}  // namespace cardioid::CD_ISA_NS
