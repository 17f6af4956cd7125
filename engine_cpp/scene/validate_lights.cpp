// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/problems.h"

#include <algorithm>
#include <numbers>

namespace cardioid::scene {
namespace {

constexpr float k_pi = std::numbers::pi_v<float>;
constexpr float k_large = 1e18f;

void set_column(Affine& transform, std::size_t column, Float3 v) {
    transform.m[column] = v.x;
    transform.m[4 + column] = v.y;
    transform.m[8 + column] = v.z;
}

/// A lamp's direction survives a scale of zero along the other axes: what is flat becomes a size of zero.
bool straighten(LightDesc& light) {
    Affine& t = light.transform;
    const float x = length(t.column(0)), y = length(t.column(1)), z = length(t.column(2));
    const float longest = std::max({x, y, z});
    const float volume = x * y * z > 0 ? t.determinant() / (x * y * z) : 0;
    if (longest > 0 && std::min({x, y, z}) > 1e-12f * longest && std::abs(volume) > 1e-7f) return true;
    const bool aimed = z > 1e-12f * longest && z > 0;
    if (!aimed && light.kind != LightKind::point) return false;
    const Float3 w = aimed ? normalize(t.column(2)) : Float3{0, 0, 1};
    const Float3 helper = std::abs(w.x) < 0.9f ? Float3{1, 0, 0} : Float3{0, 1, 0};
    const Float3 u = normalize(cross(helper, w));
    set_column(t, 0, u);
    set_column(t, 1, cross(w, u));
    set_column(t, 2, w);
    light.size_x *= x;
    light.size_y *= y;
    return true;
}

bool check_light(LightDesc& light, const std::string& who, ProblemList& problems) {
    if (!finite(light.energy) || !finite(light.color)) {
        problems.warn(who, "has an energy or colour that is not finite; left out");
        return false;
    }
    if (!finite(light.transform)) {
        problems.warn(who, "has a transform that is not finite; left out");
        return false;
    }
    if (!straighten(light)) {
        problems.warn(who, "has a singular transform and no direction; left out");
        return false;
    }
    // Blender mirrors a lamp of negative size, which changes nothing.
    light.size_x = std::abs(light.size_x);
    light.size_y = std::abs(light.size_y);
    repair(problems, who, "size_x", light.size_x, 0, k_large, 0);
    repair(problems, who, "size_y", light.size_y, 0, k_large, 0);
    repair(problems, who, "radius", light.radius, 0, k_large, 0);
    repair(problems, who, "spot_angle", light.spot_angle, 0, k_pi, 0.7853982f);
    repair(problems, who, "spot_blend", light.spot_blend, 0, 1, 0);
    repair(problems, who, "angle", light.angle, 0, k_pi, 0);
    repair(problems, who, "spread", light.spread, 0, k_pi, k_pi);
    repair(problems, who, "max_bounces", light.max_bounces, 0, 1 << 20);
    repair(problems, who, "random", light.random, 0, 1, 0);
    light.visibility &= visible_all;
    return true;
}

}  // namespace

void validate_lights(SceneDesc& scene, ProblemList& problems) {
    std::size_t index = 0;
    std::erase_if(scene.lights, [&](LightDesc& light) {
        const std::string who = label("light", light.name, index++);
        if (!check_light(light, who, problems)) return true;
        validate_graph(light.graph, who, scene.images.size(), problems);
        return false;
    });
}

}  // namespace cardioid::scene
