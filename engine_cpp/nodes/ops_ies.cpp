// SPDX-License-Identifier: GPL-3.0-or-later
// IES Texture: cubic interpolation in the table of nodes/ies.h, wrapped around where the file covers the circle.
#include "nodes/kernel.h"

namespace cardioid::CD_ISA_NS {

using nodes::Instruction;

namespace {

struct IesView {
    int h_count, v_count;
    const float *h, *v, *value;
    float keep;  ///< share of the last value that is left beyond it
    bool round;  ///< goes on around the circle
    IesView(const float* data, std::uint32_t mode)
        : h_count(static_cast<int>(data[0])),
          v_count(static_cast<int>(data[1])),
          h(data + 2),
          v(h + h_count),
          value(v + v_count),
          keep((mode & nodes::ies_keeps_ends) != 0 ? 1.0f : 0.0f),
          round((mode & nodes::ies_is_round) != 0) {}
    float at(int row, int column) const { return value[row * v_count + column]; }
};

float cubic(float a, float b, float c, float d, float x) {
    return 0.5f * (((d + 3 * (b - c) - a) * x + (2 * a - 5 * b + 4 * c - d)) * x + (c - a)) * x + b;
}

int cell_of(const float* angles, int count, float angle) {
    int i = 0;
    while (i + 2 < count && angles[i + 1] < angle) ++i;
    return i;
}

float share(const float* angles, int i, float angle) {
    const float size = angles[i + 1] - angles[i];
    return size != 0 ? (angle - angles[i]) / size : 0;
}

/// Along one horizontal angle. Beyond the poles it goes on at the same one, as if the lamp were symmetric.
float vertical(const IesView& t, int row, int v, float x) {
    const float first = t.v[0], last = t.v[t.v_count - 1];
    const bool low = t.round || (first < 1e-7f), high = !t.round && (last > 3.14159265f - 1e-7f);
    const float b = t.at(row, v), c = t.at(row, v + 1);
    const float a = v > 0 ? t.at(row, v - 1) : low ? t.at(row, 1) : t.keep * b;
    const float d = v + 2 < t.v_count ? t.at(row, v + 2) : high ? t.at(row, t.v_count - 2) : t.keep * c;
    return cubic(a, b, c, d, x);
}

float look_up(const IesView& t, float h, float v) {
    const float h_low = t.h[0], h_high = t.h[t.h_count - 1];
    if (!(v < t.v[t.v_count - 1])) return 0;
    if (!t.round && (v < t.v[0] || h < h_low || h >= h_high)) return 0;
    const bool around = t.round || (h_low < 1e-7f && h_high > 6.2831853f - 1e-7f);
    const int i = cell_of(t.h, t.h_count, h), j = cell_of(t.v, t.v_count, v);
    const float x = share(t.h, i, h), y = share(t.v, j, v);
    const float b = vertical(t, i, j, y), c = vertical(t, i + 1, j, y);
    const float a = i > 0 ? vertical(t, i - 1, j, y) : around ? vertical(t, t.h_count - 2, j, y) : t.keep * b;
    const float d = i + 2 < t.h_count ? vertical(t, i + 2, j, y) : around ? vertical(t, 1, j, y) : t.keep * b;
    const float r = cubic(a, b, c, d, x);
    return r > 0 ? r : 0;
}

}  // namespace

void op_ies(const Machine& m, const Instruction& in) {
    const IesView table(m.view.data + in.data, in.imm);
    const Source3 direction = m.arg3(in, 0);
    alignas(64) Row h, v;
    for (int i = 0; i < m.end; i += W) {
        const Vec3 d = normalize(direction.at(i));
        store(h + i, atan2(d.x, d.y) + k_pi);
        store(v + i, acos(clamp(-d.z, -1.0f, 1.0f)));
    }
    for (int i = 0; i < m.end; ++i) m.dst(in)[i] = look_up(table, h[i], v[i]);
}

}  // namespace cardioid::CD_ISA_NS
