// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter/cross_bilateral.h"
#include "simd/width.h"

namespace cardioid {
namespace isa_w1 {
void filter_cross_bilateral(const filter::KernelRequest&);
}
namespace isa_w8 {
void filter_cross_bilateral(const filter::KernelRequest&);
}
namespace isa_w16 {
void filter_cross_bilateral(const filter::KernelRequest&);
}

namespace filter {

FilterTile select_filter_cross_bilateral(int lanes) {
    return by_width<FilterTile>(lanes, isa_w1::filter_cross_bilateral, isa_w8::filter_cross_bilateral,
                                isa_w16::filter_cross_bilateral);
}

}  // namespace filter
}  // namespace cardioid
