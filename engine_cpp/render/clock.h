// SPDX-License-Identifier: GPL-3.0-or-later
// Wall time of the stages of a render.
#pragma once

#include <chrono>

namespace cardioid::render {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }

}  // namespace cardioid::render
