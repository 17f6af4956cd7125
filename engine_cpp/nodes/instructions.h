// SPDX-License-Identifier: GPL-3.0-or-later
// The flat program that the interpreter runs. A row is one float per lane of the chunk; colours and vectors are three
// operands. An operand is a row of one of three places: a register, a constant, or a row of the ShadingChunk itself.
#pragma once

#include "nodes/ops.h"
#include "nodes/program.h"

#include <cstdint>
#include <vector>

namespace cardioid::nodes {

/// Registers of one interpreter; a program that needs more is refused by the compiler.
inline constexpr int k_max_registers = 1024;
/// A constant is stored once per lane of the widest kernel, so that loading it is like loading a row.
inline constexpr int k_constant_stride = 16;

enum OperandPlace : std::uint16_t {
    operand_register = 0,
    operand_constant = 1u << 14,
    operand_chunk = 2u << 14,  ///< index counts rows from ShadingChunk::position
};
inline constexpr std::uint16_t k_operand_index = (1u << 14) - 1;

/// Results go to consecutive registers from `dst`; how many operands and results is told by the op (op_info).
struct Instruction {
    Op op;
    std::uint16_t dst = 0;
    std::uint32_t args = 0;  ///< first operand in ProgramView::args
    std::uint32_t imm = 0;   ///< mode bits, name or image id; meaning by op
    std::uint32_t data = 0;  ///< first value in ProgramView::data (ramps, curves)
};
static_assert(sizeof(Instruction) == 16);

/// What kernels see: plain pointers.
struct ProgramView {
    const Instruction* code = nullptr;
    int instructions = 0;
    const std::uint16_t* args = nullptr;
    const float* constants = nullptr;
    const float* data = nullptr;
    const image::ImageStore* images = nullptr;
};

/// Owns what its view points to. Moving keeps the view valid.
struct Program {
    std::vector<Instruction> code;
    std::vector<std::uint16_t> args;
    std::vector<float> constants;
    std::vector<float> data;
    int registers = 0;
    ProgramView view;

    Program() = default;
    Program(Program&&) = default;
    Program& operator=(Program&&) = default;
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;
};

}  // namespace cardioid::nodes
