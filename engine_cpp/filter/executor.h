// SPDX-License-Identifier: GPL-3.0-or-later
// How the filter runs its tiles: the caller brings the threads (render/ has TBB), progress and cancelling.
#pragma once

#include <functional>

namespace cardioid::filter {

/// Calls body(i) for each i in [0, n), in any order, in any threads. Returns false when it was stopped: some were left out.
using ForEach = std::function<bool(int n, const std::function<void(int)>& body)>;

/// One after the other in this thread.
inline bool run_serially(int n, const std::function<void(int)>& body) {
    for (int i = 0; i < n; ++i) body(i);
    return true;
}

}  // namespace cardioid::filter
