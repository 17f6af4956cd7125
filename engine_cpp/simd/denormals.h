// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <xmmintrin.h>

namespace cardioid {

/// Denormals are slow and mean nothing here: flushed to zero on this thread for the life of the object.
class FlushDenormals {
public:
    FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | k_flush_and_zero); }
    ~FlushDenormals() { _mm_setcsr(saved_); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
    static constexpr unsigned k_flush_and_zero = 0x8040;
    unsigned saved_;
};

}  // namespace cardioid
