// SPDX-License-Identifier: GPL-3.0-or-later
// Which of the compiled lane widths a processor runs.
#pragma once

namespace cardioid {

/// Widest lanes that this processor can run: 1, 8 or 16.
inline int best_width() {
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512bw")) {
        return 16;
    }
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2")) return 8;
    return 1;
}

/// The kernel for `width` lanes, at most the processor's best; 0: the best.
template <class Kernel>
Kernel by_width(int width, Kernel w1, Kernel w8, Kernel w16) {
    const int best = best_width();
    if (width == 0 || width > best) width = best;
    if (width == 16) return w16;
    return width == 8 ? w8 : w1;
}

}  // namespace cardioid
