// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/passes.h"

#include <algorithm>

namespace cardioid::render {

std::vector<Pass> passes(int first, int samples, int most) {
    std::vector<Pass> list;
    const int end = first + samples;
    for (int number = 0, begin = 0; begin < end; ++number) {
        const int size = std::min({number < 2 ? 1 : 1 << std::min(number - 1, 3), most, 8});
        const int from = std::max(begin, first), to = std::min(begin + size, end);
        if (from < to) list.push_back({number, begin, size, from, to - from});
        begin += size;
    }
    return list;
}

}  // namespace cardioid::render
