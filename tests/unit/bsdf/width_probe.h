// SPDX-License-Identifier: GPL-3.0-or-later
// The same evaluations and samples at one kernel width, for comparison across widths.
#pragma once

namespace cardioid::test {

constexpr int k_probe_lobes = 90;  ///< each kind with each Fresnel term
constexpr int k_probe_values = 12;

/// 64 points for each lobe: out[(lobe·64 + lane)·k_probe_values + …] = eval f rgb, pdf; sampled wi, f rgb, pdf, valid.
using Probe = void (*)(float* out);
void probe_w1(float* out);
void probe_w8(float* out);
void probe_w16(float* out);

}  // namespace cardioid::test
