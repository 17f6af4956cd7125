// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "nodes/builder.h"

namespace cardioid::nodes {

/// Instructions of `builder` that the purpose needs, with registers assigned. An empty program when it would need more
/// registers than the interpreter has (`too_large` is set).
Program emit_program(const Builder& builder, Purpose purpose, const image::ImageStore* images, bool& too_large);

/// Instructions that the purpose needs, by index into builder.code().
std::vector<bool> live_instructions(const Builder& builder, Purpose purpose);

}  // namespace cardioid::nodes
