// SPDX-License-Identifier: GPL-3.0-or-later
#include "nodes/builder.h"

#include "nodes/run.h"

#include <algorithm>
#include <bit>

namespace cardioid::nodes {

/// One instruction is run on one point; pure ops look at nothing but their operands.
struct Builder::Folder {
    ShadingChunk chunk{};
    SurfaceOutput out{};
    alignas(64) Row registers[k_max_results]{};
    Folder() { chunk.n = 1; }
};

Builder::Builder(bool optimise) : optimise_(optimise), folder_(std::make_unique<Folder>()) {}
Builder::~Builder() = default;

Ref Builder::constant(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const auto [it, added] = constant_index_.try_emplace(bits, static_cast<std::uint32_t>(constants_.size()));
    if (added) constants_.push_back(value);
    return {Ref::Kind::constant, 0, it->second};
}

std::uint32_t Builder::add_data(std::span<const float> values) {
    const auto at = std::search(data_.begin(), data_.end(), values.begin(), values.end());
    const auto offset = static_cast<std::uint32_t>(at - data_.begin());
    if (at == data_.end()) data_.insert(data_.end(), values.begin(), values.end());
    return offset;
}

bool Builder::all_constant(std::span<const Ref> args) const {
    return std::all_of(args.begin(), args.end(), [](Ref r) { return r.kind == Ref::Kind::constant; });
}

Results Builder::results_of(std::uint32_t instruction) const {
    Results r{};
    for (int k = 0; k < k_max_results; ++k) r[k] = {Ref::Kind::value, static_cast<std::uint8_t>(k), instruction};
    return r;
}

Results Builder::fold(Op op, std::span<const Ref> args, std::uint32_t imm, std::uint32_t data) {
    std::array<float, 32 * k_constant_stride> rows{};
    std::array<std::uint16_t, 32> operands{};
    for (std::size_t k = 0; k < args.size(); ++k) {
        std::fill_n(rows.begin() + static_cast<std::ptrdiff_t>(k * k_constant_stride), k_constant_stride,
                    constants_[args[k].index]);
        operands[k] = static_cast<std::uint16_t>(operand_constant | k);
    }
    const Instruction in{op, 0, 0, imm, data};
    const ProgramView view{&in, 1, operands.data(), rows.data(), data_.data(), nullptr};
    isa_w1::run_code(view, folder_->chunk, folder_->out, folder_->registers[0]);
    Results r{};
    for (int k = 0; k < op_info(op).results; ++k) r[k] = constant(folder_->registers[k][0]);
    return r;
}

Results Builder::emit_all(Op op, std::span<const Ref> args, std::uint32_t imm, std::uint32_t data) {
    const OpKind kind = op_info(op).kind;
    if (optimise_ && kind == OpKind::pure && all_constant(args)) return fold(op, args, imm, data);
    std::uint64_t hash = static_cast<std::uint64_t>(op) * 0x9e3779b97f4a7c15ull + imm * 0x85ebca6bull + data;
    for (const Ref r : args) hash = (hash ^ r.key()) * 0x100000001b3ull + (hash >> 29);
    if (optimise_ && kind != OpKind::effect) {
        const auto [begin, end] = merged_.equal_range(hash);
        for (auto it = begin; it != end; ++it) {
            const IrInstruction& other = code_[it->second];
            const auto same = this->args(other);
            if (other.op == op && other.imm == imm && other.data == data &&
                std::equal(same.begin(), same.end(), args.begin(), args.end()))
                return results_of(it->second);
        }
    }
    const auto index = static_cast<std::uint32_t>(code_.size());
    code_.push_back({op, imm, data, static_cast<std::uint32_t>(args_.size()), static_cast<std::uint16_t>(args.size())});
    args_.insert(args_.end(), args.begin(), args.end());
    if (kind != OpKind::effect) merged_.emplace(hash, index);
    return results_of(index);
}

Ref Builder::add(Ref a, Ref b) {
    if (optimise_ && is(a, 0)) return b;
    if (optimise_ && is(b, 0)) return a;
    return emit(Op::add, {a, b});
}

Ref Builder::subtract(Ref a, Ref b) {
    if (optimise_ && is(b, 0)) return a;
    return emit(Op::subtract, {a, b});
}

Ref Builder::multiply(Ref a, Ref b) {
    if (optimise_) {
        if (is(a, 1) || is(b, 0)) return b;
        if (is(b, 1) || is(a, 0)) return a;
    }
    return emit(Op::multiply, {a, b});
}

Ref Builder::mix(Ref a, Ref b, Ref t) {
    if (optimise_) {
        if (is(t, 0) || a == b) return a;
        if (is(t, 1)) return b;
    }
    return emit(Op::mix, {a, b, t});
}

Ref Builder::luminance(Ref3 c) {
    // The weights of Blender's default configuration, to all its digits.
    return dot(c, {constant(0.2126729f), constant(0.7151522f), constant(0.0721750f)});
}

void Builder::emission(Ref3 radiance) {
    if (optimise_ && is(radiance, 0)) return;
    emit(Op::emission, {radiance.x, radiance.y, radiance.z});
}

void Builder::transparent(Ref3 weight) {
    if (optimise_ && is(weight, 0)) return;
    emit(Op::transparent, {weight.x, weight.y, weight.z});
}

void Builder::holdout(Ref weight) {
    if (optimise_ && is(weight, 0)) return;
    emit(Op::holdout, {weight});
}

void Builder::medium_absorption(Ref3 coefficient) {
    if (optimise_ && is(coefficient, 0)) return;
    emit(Op::medium_absorption, {coefficient.x, coefficient.y, coefficient.z});
}

void Builder::medium_emission(Ref3 radiance) {
    if (optimise_ && is(radiance, 0)) return;
    emit(Op::medium_emission, {radiance.x, radiance.y, radiance.z});
}

void Builder::medium_phase(bsdf::PhaseKind kind, Ref3 scatter, Ref3 parameter) {
    if (optimise_ && is(scatter, 0)) return;
    emit(Op::medium_phase, {scatter.x, scatter.y, scatter.z, parameter.x, parameter.y, parameter.z},
         static_cast<std::uint32_t>(kind));
}

}  // namespace cardioid::nodes
