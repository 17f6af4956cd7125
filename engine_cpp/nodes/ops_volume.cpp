// SPDX-License-Identifier: GPL-3.0-or-later
// The medium: what a program leaves in the VolumeOutput.
#include "nodes/kernel.h"

namespace cardioid::CD_ISA_NS {

using nodes::Instruction;

namespace {

void add_rows(const Machine& m, const Instruction& in, Row* rows) {
    for (int c = 0; c < 3; ++c) {
        const Source s = m.arg(in, c);
        for (int i = 0; i < m.end; i += W) store(rows[c] + i, load(rows[c] + i) + s.at(i));
    }
}

}  // namespace

void op_medium_absorption(const Machine& m, const Instruction& in) { add_rows(m, in, m.out.volume->absorption); }
void op_medium_emission(const Machine& m, const Instruction& in) { add_rows(m, in, m.out.volume->emission); }

void op_medium_phase(const Machine& m, const Instruction& in) {
    nodes::MediumPhase& phase = m.out.volume->phase[m.out.volume->phases++];
    phase.kind = static_cast<nodes::PhaseKind>(in.imm);
    for (int c = 0; c < 3; ++c) {
        const Source scatter = m.arg(in, c), parameter = m.arg(in, 3 + c);
        for (int i = 0; i < m.end; i += W) {
            store(phase.scatter[c] + i, scatter.at(i));
            store(phase.parameter[c] + i, parameter.at(i));
        }
    }
}

}  // namespace cardioid::CD_ISA_NS
