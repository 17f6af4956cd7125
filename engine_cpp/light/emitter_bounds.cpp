// SPDX-License-Identifier: GPL-3.0-or-later
#include "light/emitter_bounds.h"

#include <numbers>

namespace cardioid::light {
namespace {

constexpr float k_pi = std::numbers::pi_v<float>;

Float3 rotate(Float3 v, Float3 unit_axis, float angle) {
    const float c = std::cos(angle), s = std::sin(angle);
    return v * c + cross(unit_axis, v) * s + unit_axis * (dot(unit_axis, v) * (1 - c));
}

/// Sets axis and theta_o of `out` to the smallest cone around the cones of a and b.
void merge_cones(const EmitterBounds& a, const EmitterBounds& b, EmitterBounds& out) {
    const EmitterBounds& wide = a.theta_o >= b.theta_o ? a : b;
    const EmitterBounds& narrow = a.theta_o >= b.theta_o ? b : a;
    const float between = std::acos(std::clamp(dot(wide.axis, narrow.axis), -1.0f, 1.0f));
    out.axis = wide.axis;
    out.theta_o = wide.theta_o;
    if (std::min(between + narrow.theta_o, k_pi) <= wide.theta_o) return;
    const float theta = 0.5f * (wide.theta_o + between + narrow.theta_o);
    const Float3 turn = cross(wide.axis, narrow.axis);
    if (theta >= k_pi || dot(turn, turn) < 1e-12f) {
        out.theta_o = between < 1e-3f ? std::min(theta + 1e-3f, k_pi) : k_pi;
        return;
    }
    out.theta_o = theta;
    out.axis = normalize(rotate(wide.axis, normalize(turn), theta - wide.theta_o));
}

}  // namespace

EmitterBounds merge(const EmitterBounds& a, const EmitterBounds& b) {
    if (a.energy <= 0) return b;
    if (b.energy <= 0) return a;
    EmitterBounds out = a;
    extend(out, b.lower);
    extend(out, b.upper);
    out.radius_squared = -1;
    merge_cones(a, b, out);
    out.theta_e = std::max(a.theta_e, b.theta_e);
    out.energy = a.energy + b.energy;
    return out;
}

float split_cost(const EmitterBounds& b) {
    if (b.energy <= 0) return 0;
    const Float3 d = b.upper - b.lower;
    const float area = d.x * d.y + d.y * d.z + d.z * d.x;
    const float theta_w = std::min(b.theta_o + b.theta_e, k_pi);
    const float solid_angle = 2 * k_pi * (1 - std::cos(b.theta_o)) +
                              0.5f * k_pi *
                                  (2 * theta_w * std::sin(b.theta_o) - std::cos(b.theta_o - 2 * theta_w) -
                                   2 * b.theta_o * std::sin(b.theta_o) + std::cos(b.theta_o));
    // A line or a point of lamps has no area; its length still tells good splits from bad ones.
    const float size = area + 1e-3f * dot(d, d);
    return b.energy * size * (solid_angle + 1e-3f);
}

}  // namespace cardioid::light
