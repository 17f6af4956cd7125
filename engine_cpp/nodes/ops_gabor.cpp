// SPDX-License-Identifier: GPL-3.0-or-later
// Gabor noise as Cycles has it: Lagae et al. 2009 with Hann-windowed kernels, Bernoulli weights (Tavernier et al. 2018) and
// the phasor of Tricard et al. 2019.
#include "nodes/kernel.h"
#include "nodes/kernel_hash.h"

namespace cardioid::CD_ISA_NS {

using nodes::Instruction;

namespace {

constexpr int k_impulses = 8;  ///< in a cell

struct Phasor {
    Float re = 0.0f, im = 0.0f;
};

struct Pattern {
    Float frequency, isotropy;
    Float angle;       ///< 2D
    Vec3 orientation;  ///< 3D, unit
};

void add_kernel(Phasor& sum, Float distance2, Float along, Float weight) {
    const Float window = (0.5f + 0.5f * cos(k_pi * distance2)) * exp(-k_pi * distance2);
    const Float size = select(distance2 < Float(1.0f), window * weight, Float(0.0f)), phase = 2.0f * k_pi * along;
    sum.re += size * cos(phase);
    sum.im += size * sin(phase);
}

Float sign_of(Float u) { return select(u < Float(0.5f), Float(-1.0f), Float(1.0f)); }

void add_cell_2d(Phasor& sum, Float cx, Float cy, Float x, Float y, const Pattern& p) {
    for (int i = 0; i < k_impulses; ++i) {
        const Float which(static_cast<float>(3 * i)), center = which + 1.0f;
        const Float dx = x - random(cx, cy, center), dy = y - random(center, cx, cy);
        const Float distance2 = dx * dx + dy * dy;
        if (none(distance2 < Float(1.0f))) continue;
        const Float angle = p.angle + (random(cx, cy, which) - 0.5f) * k_pi * p.isotropy;
        const Float along = p.frequency * (dx * cos(angle) + dy * sin(angle));
        add_kernel(sum, distance2, along, sign_of(random(cx, cy, which + 2.0f)));
    }
}

Vec3 turned(const Pattern& p, Vec3 cell, Float which) {
    const Float flat = sqrt(p.orientation.x * p.orientation.x + p.orientation.y * p.orientation.y);
    const Float side = select(p.orientation.y < Float(0.0f), Float(-1.0f), Float(1.0f));
    const Float a = acos(p.orientation.z) + random(cell.x, cell.y, cell.z, which) * k_pi * p.isotropy;
    const Float b = side * acos(p.orientation.x / flat) + random(cell.z, cell.x, which, cell.y) * k_pi * p.isotropy;
    return select(p.isotropy == Float(0.0f), p.orientation, Vec3{sin(a) * cos(b), sin(a) * sin(b), cos(a)});
}

void add_cell_3d(Phasor& sum, Vec3 c, Vec3 at, const Pattern& p) {
    for (int i = 0; i < k_impulses; ++i) {
        const Float which(static_cast<float>(3 * i)), center = which + 1.0f;
        const Vec3 d =
            at - Vec3{random(c.x, c.y, c.z, center), random(c.z, c.x, center, c.y), random(center, c.z, c.y, c.x)};
        const Float distance2 = dot(d, d);
        if (none(distance2 < Float(1.0f))) continue;
        const Float along = p.frequency * dot(d, turned(p, c, which));
        add_kernel(sum, distance2, along, sign_of(random(c.x, c.y, c.z, which + 2.0f)));
    }
}

Phasor gabor_2d(Vec3 q, const Pattern& p) {
    Phasor sum;
    const Float fx = floor(q.x), fy = floor(q.y);
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            const auto di = static_cast<float>(i), dj = static_cast<float>(j);
            add_cell_2d(sum, fx + di, fy + dj, q.x - fx - di, q.y - fy - dj, p);
        }
    }
    return sum;
}

Phasor gabor_3d(Vec3 q, const Pattern& p) {
    Phasor sum;
    const Vec3 first = {floor(q.x), floor(q.y), floor(q.z)};
    for (int cell = 0; cell < 27; ++cell) {
        const Vec3 d = {static_cast<float>(cell % 3 - 1), static_cast<float>(cell / 3 % 3 - 1),
                        static_cast<float>(cell / 9 - 1)};
        add_cell_3d(sum, first + d, q - first - d, p);
    }
    return sum;
}

}  // namespace

void op_gabor(const Machine& m, const Instruction& in) {
    const Source3 at = m.arg3(in, 0), orientation = m.arg3(in, 6);
    const Source frequency = m.arg(in, 3), anisotropy = m.arg(in, 4), angle = m.arg(in, 5);
    const bool solid = in.imm == 3;
    // Six standard deviations, by the integral of the squared kernel at high frequencies.
    const float inverse = 1.0f / (6.0f * (solid ? 0.84089642f : 1.0f));
    for (int i = 0; i < m.end; i += W) {
        const Pattern p = {max(frequency.at(i), 0.001f), 1.0f - saturate(anisotropy.at(i)), angle.at(i),
                           normalize(orientation.at(i))};
        const Phasor s = solid ? gabor_3d(at.at(i), p) : gabor_2d(at.at(i), p);
        store(m.dst(in, 0) + i, s.im * inverse * 0.5f + 0.5f);
        store(m.dst(in, 1) + i, (atan2(s.im, s.re) + k_pi) * (0.5f * k_inv_pi));
        store(m.dst(in, 2) + i, sqrt(s.re * s.re + s.im * s.im) * inverse);
    }
}

}  // namespace cardioid::CD_ISA_NS
