// SPDX-License-Identifier: GPL-3.0-or-later
// Dead-code elimination from a purpose's effects, then registers by first fit over live ranges.
#include "nodes/emit_program.h"

#include "nodes/op_modes.h"

#include <algorithm>

namespace cardioid::nodes {

namespace {

bool wanted(Op op, Purpose purpose) {
    switch (op) {
        case Op::emission: return purpose == Purpose::surface || purpose == Purpose::emission;
        case Op::transparent:
        case Op::holdout: return purpose == Purpose::surface || purpose == Purpose::transparency;
        case Op::displacement: return purpose == Purpose::displacement;
        case Op::medium_absorption:
        case Op::medium_emission:
        case Op::medium_phase: return purpose == Purpose::volume;
        default: return purpose == Purpose::surface;
    }
}

/// Contiguous blocks of registers.
class Registers {
public:
    int take(int n) {
        int run = 0;
        for (int i = 0; i < k_max_registers; ++i) {
            run = used_[i] ? 0 : run + 1;
            if (run < n) continue;
            const int first = i - n + 1;
            std::fill_n(used_.begin() + first, n, true);
            highest_ = std::max(highest_, i + 1);
            return first;
        }
        return -1;
    }
    void give(int first, int n) { std::fill_n(used_.begin() + first, n, false); }
    int highest() const { return highest_; }

private:
    std::vector<bool> used_ = std::vector<bool>(k_max_registers, false);
    int highest_ = 0;
};

class Emitter {
public:
    Emitter(const Builder& builder, Purpose purpose)
        : builder_(builder),
          live_(live_instructions(builder, purpose)),
          purpose_(purpose),
          last_use_(live_.size(), -1),
          read_(live_.size(), false),
          register_(live_.size(), -1),
          constant_index_(builder.constants().size(), -1) {}

    bool run(Program& out) {
        find_last_uses();
        for (std::size_t k = 0; k < live_.size(); ++k)
            if (live_[k] && !place(out, k)) return false;
        out.registers = registers_.highest();
        if (!out.code.empty()) out.data = builder_.data();
        return true;
    }

private:
    void find_last_uses() {
        for (std::size_t k = 0; k < live_.size(); ++k) {
            if (!live_[k]) continue;
            for (const Ref r : builder_.args(builder_.code()[k])) {
                if (r.kind != Ref::Kind::value) continue;
                last_use_[r.index] = static_cast<int>(k);
                read_[r.index] = true;
            }
        }
    }

    std::uint16_t operand(Program& out, Ref r) {
        if (r.kind == Ref::Kind::chunk) return static_cast<std::uint16_t>(operand_chunk | r.index);
        if (r.kind == Ref::Kind::value)
            return static_cast<std::uint16_t>(operand_register | (register_[r.index] + r.component));
        int& slot = constant_index_[r.index];
        if (slot < 0) {
            slot = static_cast<int>(out.constants.size()) / k_constant_stride;
            out.constants.insert(out.constants.end(), k_constant_stride, builder_.constants()[r.index]);
        }
        return static_cast<std::uint16_t>(operand_constant | slot);
    }

    bool place(Program& out, std::size_t k) {
        const IrInstruction& ir = builder_.code()[k];
        const OpInfo& info = op_info(ir.op);
        Instruction in{ir.op, 0, static_cast<std::uint32_t>(out.args.size()), ir.imm, ir.data};
        if (ir.op == Op::lobe_ggx || ir.op == Op::lobe_sheen) {
            if (purpose_ == Purpose::surface) in.imm |= lobe_keep;
            if (read_[k]) in.imm |= lobe_layer;
        }
        for (const Ref r : builder_.args(ir)) out.args.push_back(operand(out, r));
        if (info.results > 0) {
            const int first = registers_.take(info.results);
            if (first < 0) return false;
            register_[k] = first;
            in.dst = static_cast<std::uint16_t>(first);
            if (!read_[k]) registers_.give(first, info.results);
        }
        // Operands are released after the results are placed: a kernel may write before it has read all.
        for (const Ref r : builder_.args(ir)) release(r, k);
        out.code.push_back(in);
        return out.constants.size() / k_constant_stride < k_operand_index;
    }

    void release(Ref r, std::size_t k) {
        if (r.kind != Ref::Kind::value || last_use_[r.index] != static_cast<int>(k)) return;
        last_use_[r.index] = -1;
        registers_.give(register_[r.index], op_info(builder_.code()[r.index].op).results);
    }

    const Builder& builder_;
    std::vector<bool> live_;
    Purpose purpose_;
    std::vector<int> last_use_;
    std::vector<bool> read_;
    std::vector<int> register_;
    std::vector<int> constant_index_;
    Registers registers_;
};

}  // namespace

std::vector<bool> live_instructions(const Builder& builder, Purpose purpose) {
    const auto& code = builder.code();
    std::vector<bool> live(code.size(), false);
    for (std::size_t k = code.size(); k-- > 0;) {
        const bool root = op_info(code[k].op).kind == OpKind::effect && wanted(code[k].op, purpose);
        if (root || !builder.optimise()) live[k] = live[k] || root || op_info(code[k].op).kind != OpKind::effect;
        if (!live[k]) continue;
        for (const Ref r : builder.args(code[k]))
            if (r.kind == Ref::Kind::value) live[r.index] = true;
    }
    return live;
}

Program emit_program(const Builder& builder, Purpose purpose, const image::ImageStore* images, bool& too_large) {
    Program p;
    if (!Emitter(builder, purpose).run(p)) {
        too_large = true;
        return {};
    }
    p.view = {p.code.data(), static_cast<int>(p.code.size()), p.args.data(), p.constants.data(), p.data.data(), images};
    return p;
}

}  // namespace cardioid::nodes
