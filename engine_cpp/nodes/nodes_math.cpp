// SPDX-License-Identifier: GPL-3.0-or-later
// Math and Vector Math, Map Range, Clamp.
#include "nodes/node_helpers.h"

namespace cardioid::nodes {

namespace {

struct MathOp {
    const char* name;
    Op op;
    int inputs;
};

/// Operations that are one instruction each; the others are built in math().
constexpr MathOp k_math[] = {
    {"ADD", Op::add, 2},
    {"SUBTRACT", Op::subtract, 2},
    {"MULTIPLY", Op::multiply, 2},
    {"DIVIDE", Op::divide, 2},
    {"MULTIPLY_ADD", Op::multiply_add, 3},
    {"POWER", Op::power, 2},
    {"LOGARITHM", Op::logarithm, 2},
    {"SQRT", Op::square_root, 1},
    {"INVERSE_SQRT", Op::inverse_square_root, 1},
    {"ABSOLUTE", Op::absolute, 1},
    {"EXPONENT", Op::exponent, 1},
    {"MINIMUM", Op::minimum, 2},
    {"MAXIMUM", Op::maximum, 2},
    {"LESS_THAN", Op::less_than, 2},
    {"GREATER_THAN", Op::greater_than, 2},
    {"SIGN", Op::sign, 1},
    {"COMPARE", Op::compare, 3},
    {"SMOOTH_MIN", Op::smooth_minimum, 3},
    {"ROUND", Op::round, 1},
    {"FLOOR", Op::floor, 1},
    {"CEIL", Op::ceil, 1},
    {"TRUNC", Op::truncate, 1},
    {"FRACT", Op::fraction, 1},
    {"MODULO", Op::modulo, 2},
    {"FLOORED_MODULO", Op::floored_modulo, 2},
    {"WRAP", Op::wrap, 3},
    {"SNAP", Op::snap, 2},
    {"PINGPONG", Op::pingpong, 2},
    {"SINE", Op::sine, 1},
    {"COSINE", Op::cosine, 1},
    {"TANGENT", Op::tangent, 1},
    {"ARCSINE", Op::arcsine, 1},
    {"ARCCOSINE", Op::arccosine, 1},
    {"ARCTANGENT", Op::arctangent, 1},
    {"ARCTAN2", Op::arctan2, 2},
    {"SINH", Op::sinh, 1},
    {"COSH", Op::cosh, 1},
    {"TANH", Op::tanh, 1},
};

const MathOp* find_math(const std::string& name) {
    for (const MathOp& m : k_math)
        if (name == m.name) return &m;
    return nullptr;
}

Ref apply(Builder& b, const MathOp& m, Ref x, Ref y, Ref z) {
    if (m.op == Op::add) return b.add(x, y);
    if (m.op == Op::subtract) return b.subtract(x, y);
    if (m.op == Op::multiply) return b.multiply(x, y);
    if (m.inputs == 1) return b.emit(m.op, {x});
    return m.inputs == 2 ? b.emit(m.op, {x, y}) : b.emit(m.op, {x, y, z});
}

Ref negative(Builder& b, Ref x) { return b.multiply(x, b.constant(-1)); }

void math(NodeContext& c) {
    const std::string name = c.text("operation", "ADD");
    const Ref x = c.number("Value"), y = c.number("Value_001"), z = c.number("Value_002");
    Ref r = c.b.constant(0);
    if (const MathOp* m = find_math(name))
        r = apply(c.b, *m, x, y, z);
    else if (name == "SMOOTH_MAX")
        r = negative(c.b, c.b.emit(Op::smooth_minimum, {negative(c.b, x), negative(c.b, y), z}));
    else if (name == "RADIANS")
        r = c.b.multiply(x, c.b.constant(0.017453292519943f));
    else if (name == "DEGREES")
        r = c.b.multiply(x, c.b.constant(57.29577951308232f));
    else
        c.warn("math " + name, c.place() + ": operation " + name + " is not supported; it gives 0");
    c.number_out("Value", c.flag("use_clamp") ? c.b.saturate(r) : r);
}

Ref3 project(Builder& b, Ref3 v, Ref3 onto) { return b.multiply(onto, b.divide(b.dot(v, onto), b.dot(onto, onto))); }

Ref3 reflect(Builder& b, Ref3 v, Ref3 normal) {
    const Ref3 n = b.normalize(normal);
    return b.subtract(v, b.multiply(n, b.multiply(b.dot(v, n), b.constant(2))));
}

Ref3 refract(Builder& b, Ref3 v, Ref3 normal, Ref eta) {
    const Ref3 n = b.normalize(normal);
    const Ref one = b.constant(1), cosine = b.dot(n, v);
    const Ref k = b.subtract(one, b.multiply(b.multiply(eta, eta), b.subtract(one, b.multiply(cosine, cosine))));
    const Ref along = b.add(b.multiply(eta, cosine), b.emit(Op::square_root, {k}));
    const Ref3 r = b.subtract(b.multiply(v, eta), b.multiply(n, along));
    // Total reflection gives zero.
    const Ref total = negative(b, k);
    return Builder::each(r, [&](Ref x) { return b.select_positive(total, b.constant(0), x); });
}

Ref3 face_forward(Builder& b, Ref3 v, Ref3 incident, Ref3 reference) {
    const Ref against = negative(b, b.dot(reference, incident));
    return Builder::each(v, [&](Ref x) { return b.select_positive(against, x, negative(b, x)); });
}

void vector_math(NodeContext& c) {
    Builder& b = c.b;
    const std::string name = c.text("operation", "ADD");
    const Ref3 x = c.vector("Vector"), y = c.vector("Vector_001"), z = c.vector("Vector_002");
    const Ref scale = c.number("Scale", 1), zero = b.constant(0);
    Ref3 v = {zero, zero, zero};
    Ref number = zero;
    if (name == "CROSS_PRODUCT")
        v = b.cross(x, y);
    else if (name == "PROJECT")
        v = project(b, x, y);
    else if (name == "REFLECT")
        v = reflect(b, x, y);
    else if (name == "REFRACT")
        v = refract(b, x, y, scale);
    else if (name == "FACEFORWARD")
        v = face_forward(b, x, y, z);
    else if (name == "DOT_PRODUCT")
        number = b.dot(x, y);
    else if (name == "DISTANCE")
        number = b.length(b.subtract(x, y));
    else if (name == "LENGTH")
        number = b.length(x);
    else if (name == "SCALE")
        v = b.multiply(x, scale);
    else if (name == "NORMALIZE")
        v = b.normalize(x);
    else if (name == "FRACTION")
        v = Builder::each(x, [&](Ref a) { return b.emit(Op::fraction, {a}); });
    else if (const MathOp* m = find_math(name))
        v = {apply(b, *m, x.x, y.x, z.x), apply(b, *m, x.y, y.y, z.y), apply(b, *m, x.z, y.z, z.z)};
    else
        c.warn("vector math " + name, c.place() + ": operation " + name + " is not supported; it gives 0");
    c.vector_out("Vector", v);
    c.number_out("Value", number);
}

/// 3t² - 2t³, or 6t⁵ - 15t⁴ + 10t³.
Ref smooth(Builder& b, Ref t, bool smoother) {
    const Ref t2 = b.multiply(t, t);
    if (!smoother) return b.multiply(t2, b.subtract(b.constant(3), b.multiply(b.constant(2), t)));
    const Ref inner = b.subtract(b.multiply(t, b.constant(6)), b.constant(15));
    return b.multiply(b.multiply(t2, t), b.add(b.multiply(t, inner), b.constant(10)));
}

struct Range {
    Ref from_min, from_max, to_min, to_max, steps;
};

Ref map_one(Builder& b, const std::string& type, Ref x, const Range& r, bool clamp) {
    Ref t = b.divide(b.subtract(x, r.from_min), b.subtract(r.from_max, r.from_min));
    const bool smoothed = type == "SMOOTHSTEP" || type == "SMOOTHERSTEP";
    if (type == "STEPPED") {
        const Ref whole = b.emit(Op::floor, {b.multiply(t, b.add(r.steps, b.constant(1)))});
        t = b.select_positive(r.steps, b.divide(whole, r.steps), b.constant(0));
    } else if (smoothed) {
        t = smooth(b, b.saturate(t), type == "SMOOTHERSTEP");
    }
    const Ref y = b.add(r.to_min, b.multiply(t, b.subtract(r.to_max, r.to_min)));
    if (!clamp || smoothed) return y;
    return b.emit(Op::clamp, {y, b.minimum(r.to_min, r.to_max), b.maximum(r.to_min, r.to_max)});
}

/// A range from a point to itself gives 0.
Ref map_number(NodeContext& c, const std::string& type) {
    Builder& b = c.b;
    const Range r = {c.number("From Min", 0), c.number("From Max", 1), c.number("To Min", 0), c.number("To Max", 1),
                     c.number("Steps", 4)};
    const Ref width = b.emit(Op::absolute, {b.subtract(r.from_max, r.from_min)});
    const Ref y = b.select_positive(width, map_one(b, type, c.number("Value", 1), r, false), b.constant(0));
    if (!c.flag("clamp", true) || type.starts_with("SMOOTH")) return y;
    return b.emit(Op::clamp, {y, b.minimum(r.to_min, r.to_max), b.maximum(r.to_min, r.to_max)});
}

void map_range(NodeContext& c) {
    const std::string type = c.text("interpolation_type", "LINEAR");
    if (c.text("data_type", "FLOAT") != "FLOAT_VECTOR") {
        c.number_out("Result", map_number(c, type));
        return;
    }
    const Ref3 x = c.vector("Vector"), a = c.vector("From_Min_FLOAT3"), b = c.vector("From_Max_FLOAT3", {1, 1, 1});
    const Ref3 p = c.vector("To_Min_FLOAT3"), q = c.vector("To_Max_FLOAT3", {1, 1, 1}),
               s = c.vector("Steps_FLOAT3", {4, 4, 4});
    const bool clamp = c.flag("clamp", true);
    c.vector_out("Vector", {map_one(c.b, type, x.x, {a.x, b.x, p.x, q.x, s.x}, clamp),
                            map_one(c.b, type, x.y, {a.y, b.y, p.y, q.y, s.y}, clamp),
                            map_one(c.b, type, x.z, {a.z, b.z, p.z, q.z, s.z}, clamp)});
}

void clamp_node(NodeContext& c) {
    const Ref x = c.number("Value", 1), low = c.number("Min", 0), high = c.number("Max", 1);
    const bool range = c.text("clamp_type", "MINMAX") == "RANGE";
    c.number_out("Result",
                 c.b.emit(Op::clamp, {x, range ? c.b.minimum(low, high) : low, range ? c.b.maximum(low, high) : high}));
}

constexpr NodeType k_nodes[] = {
    {"ShaderNodeMath", math, nullptr, Support::same, ""},
    {"ShaderNodeVectorMath", vector_math, nullptr, Support::same, ""},
    {"ShaderNodeMapRange", map_range, nullptr, Support::same, ""},
    {"ShaderNodeClamp", clamp_node, nullptr, Support::same, ""},
};

}  // namespace

std::span<const NodeType> math_nodes() { return k_nodes; }

}  // namespace cardioid::nodes
