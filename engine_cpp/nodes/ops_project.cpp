// SPDX-License-Identifier: GPL-3.0-or-later
// Directions and points to image coordinates.
#include "nodes/kernel.h"

namespace cardioid::CD_ISA_NS {

using nodes::Instruction;

namespace {

template <class F>
void to_uv(const Machine& m, const Instruction& in, F f) {
    const Source3 p = m.arg3(in, 0);
    for (int i = 0; i < m.end; i += W) {
        Float u, v;
        f(p.at(i), u, v);
        store(m.dst(in, 0) + i, u);
        store(m.dst(in, 1) + i, v);
    }
}

}  // namespace

void op_map_equirectangular(const Machine& m, const Instruction& in) {
    to_uv(m, in, [](Vec3 d, Float& u, Float& v) {
        u = 0.5f - atan2(d.y, d.x) * (0.5f * k_inv_pi);
        v = 1.0f - acos(d.z) * k_inv_pi;
    });
}

void op_map_mirror_ball(const Machine& m, const Instruction& in) {
    to_uv(m, in, [](Vec3 d, Float& u, Float& v) {
        const Float div = 2.0f * safe_sqrt(-0.5f * (d.y - 1.0f));
        const Float inv = select(div > Float(0.0f), 1.0f / div, Float(1.0f));
        u = 0.5f * (d.x * inv + 1.0f);
        v = 0.5f * (d.z * inv + 1.0f);
    });
}

void op_map_sphere(const Machine& m, const Instruction& in) {
    to_uv(m, in, [](Vec3 p, Float& u, Float& v) {
        const Float l = length(p);
        const Mask axis = (p.x == Float(0.0f)) & (p.y == Float(0.0f));
        const Mask ok = l > Float(0.0f);
        u = select(axis, Float(0.0f), 0.5f * (1.0f - atan2(p.x, p.y) * k_inv_pi));
        v = select(ok, 1.0f - acos(p.z / max(l, 1e-38f)) * k_inv_pi, Float(0.0f));
    });
}

void op_map_tube(const Machine& m, const Instruction& in) {
    to_uv(m, in, [](Vec3 p, Float& u, Float& v) {
        const Mask ok = (p.x * p.x + p.y * p.y) > Float(0.0f);
        u = select(ok, 0.5f * (1.0f - atan2(p.x, p.y) * k_inv_pi), Float(0.0f));
        v = select(ok, 0.5f * (p.z + 1.0f), Float(0.0f));
    });
}

/// Shares of the three axes of a box projection for a normal and a blend width.
void op_box_weights(const Machine& m, const Instruction& in) {
    const Source3 normal = m.arg3(in, 0);
    const Source width = m.arg(in, 3);
    for (int i = 0; i < m.end; i += W) {
        const Vec3 s = normal.at(i);
        Vec3 n = {abs(s.x), abs(s.y), abs(s.z)};
        n = n * (1.0f / max(n.x + n.y + n.z, 1e-30f));
        const Float blend = width.at(i), limit = 0.5f * (1.0f + blend), inv = 1.0f / max(blend, 1e-20f);
        const Float zero = 0.0f, one = 1.0f;
        const auto pair = [&](Float a, Float b) {
            return saturate((a / max(a + b, 1e-30f) - 0.5f * (1.0f - blend)) * inv);
        };
        // Three in the middle, then pairs, then single sides: the later ones overrule.
        const Float k = 1.0f / max(2.0f * limit - 1.0f, 1e-20f), shift = limit - 1.0f;
        Vec3 w = {((2.0f - limit) * n.x + shift) * k, ((2.0f - limit) * n.y + shift) * k,
                  ((2.0f - limit) * n.z + shift) * k};
        const Mask no_y = n.y < (1.0f - limit) * (n.x + n.z), no_x = n.x < (1.0f - limit) * (n.y + n.z);
        const Mask no_z = n.z < (1.0f - limit) * (n.y + n.x);
        const Float xz = pair(n.x, n.z), yz = pair(n.y, n.z), xy = pair(n.x, n.y);
        w = select(no_y, Vec3{xz, zero, 1.0f - xz}, w);
        w = select(no_x, Vec3{zero, yz, 1.0f - yz}, w);
        w = select(no_z, Vec3{xy, 1.0f - xy, zero}, w);
        w = select(blend > zero, w, Vec3{one, zero, zero});
        const Mask x = (n.x > limit * (n.x + n.y)) & (n.x > limit * (n.x + n.z));
        const Mask y = (n.y > limit * (n.x + n.y)) & (n.y > limit * (n.y + n.z));
        const Mask z = (n.z > limit * (n.x + n.z)) & (n.z > limit * (n.y + n.z));
        w = select(z, Vec3{zero, zero, one}, w);
        w = select(y, Vec3{zero, one, zero}, w);
        w = select(x, Vec3{one, zero, zero}, w);
        store_vec(m, in, 0, i, w);
    }
}

}  // namespace cardioid::CD_ISA_NS
