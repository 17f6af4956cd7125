// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace/bounds.h"

#include <algorithm>

namespace cardioid::trace {

namespace {

Box mesh_bounds(const GeometryPool& pool, int mesh) {
    Box box;
    const float* p = pool.positions(mesh);
    for (std::uint32_t v = 0; v < pool.meshes()[mesh].vertices; ++v) box.add({p[3 * v], p[3 * v + 1], p[3 * v + 2]});
    return box;
}

}  // namespace

void Box::add(Float3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

Box scene_bounds(const GeometryPool& pool, const std::function<bool(int)>& wanted) {
    Box all;
    const auto& placed = pool.placed();
    std::vector<Box> meshes(pool.meshes().size());
    for (std::size_t i = 0; i < placed.size(); ++i) {
        if (!wanted(static_cast<int>(i))) continue;
        const int mesh = placed[i].mesh;
        Box& own = meshes[mesh];
        if (own.empty()) own = mesh_bounds(pool, mesh);
        if (own.empty()) continue;
        for (int corner = 0; corner < 8; ++corner) {
            const Float3 c{corner & 1 ? own.low.x : own.high.x, corner & 2 ? own.low.y : own.high.y,
                           corner & 4 ? own.low.z : own.high.z};
            all.add(pool.baked(static_cast<int>(i)) ? c : placed[i].transform.point(c));
        }
    }
    return all;
}

}  // namespace cardioid::trace
