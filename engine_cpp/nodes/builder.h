// SPDX-License-Identifier: GPL-3.0-or-later
// Programs while they are being built: values in single-assignment form. Every value is one row; a colour is three.
// The builder folds constants by running the interpreter, merges equal instructions and drops neutral arithmetic.
#pragma once

#include "bsdf/phase_kind.h"
#include "nodes/instructions.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

namespace cardioid::nodes {

/// A row: a constant, a row of the chunk, or a result of an instruction.
struct Ref {
    enum class Kind : std::uint8_t { constant, chunk, value };
    Kind kind = Kind::constant;
    std::uint8_t component = 0;
    std::uint32_t index = 0;  ///< of the constant, the chunk's row, or the instruction
    bool operator==(const Ref&) const = default;
    std::uint64_t key() const {
        return static_cast<std::uint64_t>(kind) << 40 | static_cast<std::uint64_t>(component) << 32 | index;
    }
};
struct Ref3 {
    Ref x, y, z;
    bool operator==(const Ref3&) const = default;
};

inline constexpr int k_max_results = 8;
using Results = std::array<Ref, k_max_results>;

/// Rows of the ShadingChunk that operands may name, in its order.
enum class ChunkRow : std::uint32_t {
    position = 0,
    normal_geometric = 3,
    normal = 6,
    wo = 9,
    barycentric_u = 12,
    barycentric_v = 13,
    dp_du = 14,
    dp_dv = 17,
    footprint = 20,
    ray_length = 21,
    time = 22,
    backfacing = 23,
};

struct IrInstruction {
    Op op;
    std::uint32_t imm = 0;
    std::uint32_t data = 0;
    std::uint32_t first_arg = 0;
    std::uint16_t args = 0;
};

class Builder {
public:
    explicit Builder(bool optimise);
    ~Builder();

    Ref constant(float value);
    Ref3 constant(Float3 v) { return {constant(v.x), constant(v.y), constant(v.z)}; }
    Ref chunk(ChunkRow row, std::uint32_t k = 0) const {
        return {Ref::Kind::chunk, 0, static_cast<std::uint32_t>(row) + k};
    }
    Ref3 chunk3(ChunkRow row) const { return {chunk(row, 0), chunk(row, 1), chunk(row, 2)}; }

    /// All results of an instruction (as many as op_info says).
    Results emit_all(Op op, std::span<const Ref> args, std::uint32_t imm = 0, std::uint32_t data = 0);
    Results emit_all(Op op, std::initializer_list<Ref> args, std::uint32_t imm = 0, std::uint32_t data = 0) {
        return emit_all(op, std::span<const Ref>(args.begin(), args.size()), imm, data);
    }
    Ref emit(Op op, std::initializer_list<Ref> args, std::uint32_t imm = 0, std::uint32_t data = 0) {
        return emit_all(op, args, imm, data)[0];
    }
    Ref3 emit3(Op op, std::initializer_list<Ref> args, std::uint32_t imm = 0, std::uint32_t data = 0) {
        const Results r = emit_all(op, args, imm, data);
        return {r[0], r[1], r[2]};
    }
    std::uint32_t add_data(std::span<const float> values);

    bool is_constant(Ref r) const { return r.kind == Ref::Kind::constant; }
    bool is_constant(Ref3 r) const { return is_constant(r.x) && is_constant(r.y) && is_constant(r.z); }
    bool is(Ref r, float value) const { return is_constant(r) && constants_[r.index] == value; }
    bool is(Ref3 r, float value) const { return is(r.x, value) && is(r.y, value) && is(r.z, value); }
    float value(Ref r) const { return constants_[r.index]; }
    Float3 value(Ref3 r) const { return {value(r.x), value(r.y), value(r.z)}; }
    bool optimise() const { return optimise_; }

    // Scalar arithmetic, neutral elements dropped.
    Ref add(Ref a, Ref b);
    Ref subtract(Ref a, Ref b);
    Ref multiply(Ref a, Ref b);
    Ref divide(Ref a, Ref b) { return is(b, 1) ? a : emit(Op::divide, {a, b}); }
    Ref mix(Ref a, Ref b, Ref t);
    Ref minimum(Ref a, Ref b) { return emit(Op::minimum, {a, b}); }
    Ref maximum(Ref a, Ref b) { return emit(Op::maximum, {a, b}); }
    Ref saturate(Ref a) { return emit(Op::clamp, {a, constant(0), constant(1)}); }
    Ref one_minus(Ref a) { return subtract(constant(1), a); }
    Ref select_positive(Ref c, Ref a, Ref b) { return a == b ? a : emit(Op::select_positive, {c, a, b}); }

    // The same by component, and true vector operations.
    template <class F>
    static Ref3 each(Ref3 a, F f) {
        return {f(a.x), f(a.y), f(a.z)};
    }
    template <class F>
    static Ref3 each(Ref3 a, Ref3 b, F f) {
        return {f(a.x, b.x), f(a.y, b.y), f(a.z, b.z)};
    }
    Ref3 add(Ref3 a, Ref3 b) {
        return each(a, b, [this](Ref p, Ref q) { return add(p, q); });
    }
    Ref3 subtract(Ref3 a, Ref3 b) {
        return each(a, b, [this](Ref p, Ref q) { return subtract(p, q); });
    }
    Ref3 multiply(Ref3 a, Ref3 b) {
        return each(a, b, [this](Ref p, Ref q) { return multiply(p, q); });
    }
    Ref3 multiply(Ref3 a, Ref s) {
        return each(a, [this, s](Ref p) { return multiply(p, s); });
    }
    Ref3 mix(Ref3 a, Ref3 b, Ref t) {
        return each(a, b, [this, t](Ref p, Ref q) { return mix(p, q, t); });
    }
    Ref3 saturate(Ref3 a) {
        return each(a, [this](Ref p) { return saturate(p); });
    }
    Ref3 maximum(Ref3 a, Ref b) {
        return each(a, [this, b](Ref p) { return maximum(p, b); });
    }
    Ref3 minimum(Ref3 a, Ref b) {
        return each(a, [this, b](Ref p) { return minimum(p, b); });
    }
    Ref3 broadcast(Ref a) const { return {a, a, a}; }
    Ref dot(Ref3 a, Ref3 b) { return emit(Op::dot, {a.x, a.y, a.z, b.x, b.y, b.z}); }
    Ref3 cross(Ref3 a, Ref3 b) { return emit3(Op::cross, {a.x, a.y, a.z, b.x, b.y, b.z}); }
    Ref3 normalize(Ref3 a) { return emit3(Op::normalize, {a.x, a.y, a.z}); }
    Ref length(Ref3 a) { return emit(Op::square_root, {dot(a, a)}); }
    Ref average(Ref3 a) { return multiply(add(add(a.x, a.y), a.z), constant(1.0f / 3.0f)); }
    Ref luminance(Ref3 c);

    // Effects.
    void emission(Ref3 radiance);
    void transparent(Ref3 weight);
    void holdout(Ref weight);
    void set_normal(Ref3 n) { emit(Op::set_normal, {n.x, n.y, n.z}); }
    void displacement(Ref3 offset) { emit(Op::displacement, {offset.x, offset.y, offset.z}); }
    void medium_absorption(Ref3 coefficient);
    void medium_emission(Ref3 radiance);
    void medium_phase(bsdf::PhaseKind kind, Ref3 scatter, Ref3 parameter);

    const std::vector<IrInstruction>& code() const { return code_; }
    std::span<const Ref> args(const IrInstruction& in) const { return {args_.data() + in.first_arg, in.args}; }
    const std::vector<float>& constants() const { return constants_; }
    const std::vector<float>& data() const { return data_; }

private:
    struct Folder;
    bool all_constant(std::span<const Ref> args) const;
    Results fold(Op op, std::span<const Ref> args, std::uint32_t imm, std::uint32_t data);
    Results results_of(std::uint32_t instruction) const;

    bool optimise_;
    std::vector<IrInstruction> code_;
    std::vector<Ref> args_;
    std::vector<float> constants_;
    std::vector<float> data_;
    std::unordered_map<std::uint32_t, std::uint32_t> constant_index_;  ///< by bit pattern
    std::unordered_multimap<std::uint64_t, std::uint32_t> merged_;     ///< instructions by hash
    std::unique_ptr<Folder> folder_;
};

}  // namespace cardioid::nodes
