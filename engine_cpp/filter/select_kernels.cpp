// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter/kernels.h"
#include "simd/width.h"

namespace cardioid {
namespace isa_w1 {
void filter_similar(const filter::KernelRequest&);
void geometry_weights(const filter::KernelRequest&, float*);
}  // namespace isa_w1
namespace isa_w8 {
void filter_similar(const filter::KernelRequest&);
void geometry_weights(const filter::KernelRequest&, float*);
}  // namespace isa_w8
namespace isa_w16 {
void filter_similar(const filter::KernelRequest&);
void geometry_weights(const filter::KernelRequest&, float*);
}  // namespace isa_w16

namespace filter {

std::size_t scratch_floats(const Tile& tile) {
    const auto stride = static_cast<std::size_t>(tile.area.width + 2 * k_patch + 16);
    const auto rows = static_cast<std::size_t>(tile.area.height + 2 * k_patch);
    constexpr std::size_t planes = 3 + 9 * k_signals;
    return planes * stride * rows + 64;
}

FilterTile select_filter_similar(int lanes) {
    return by_width<FilterTile>(lanes, isa_w1::filter_similar, isa_w8::filter_similar, isa_w16::filter_similar);
}

GeometryWeights select_geometry_weights(int lanes) {
    return by_width<GeometryWeights>(lanes, isa_w1::geometry_weights, isa_w8::geometry_weights,
                                     isa_w16::geometry_weights);
}

}  // namespace filter
}  // namespace cardioid
