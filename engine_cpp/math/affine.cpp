// SPDX-License-Identifier: GPL-3.0-or-later
#include "math/types.h"

namespace cardioid {

Affine operator*(const Affine& a, const Affine& b) {
    Affine r;
    for (int row = 0; row < 3; ++row) {
        for (int col = 0; col < 4; ++col) {
            float sum = col == 3 ? a.m[4 * row + 3] : 0.0f;
            for (int k = 0; k < 3; ++k) sum += a.m[4 * row + k] * b.m[4 * k + col];
            r.m[4 * row + col] = sum;
        }
    }
    return r;
}

Affine inverse(const Affine& a) {
    const Float3 c0 = a.column(0), c1 = a.column(1), c2 = a.column(2);
    // In double: a scaled-down instance far from the origin would lose its position in float.
    const double det =
        static_cast<double>(c0.x) * (static_cast<double>(c1.y) * c2.z - static_cast<double>(c1.z) * c2.y) -
        static_cast<double>(c0.y) * (static_cast<double>(c1.x) * c2.z - static_cast<double>(c1.z) * c2.x) +
        static_cast<double>(c0.z) * (static_cast<double>(c1.x) * c2.y - static_cast<double>(c1.y) * c2.x);
    if (!(std::abs(det) > 0)) return {};
    const auto& m = a.m;
    const double i[9] = {
        (static_cast<double>(m[5]) * m[10] - static_cast<double>(m[6]) * m[9]) / det,
        (static_cast<double>(m[2]) * m[9] - static_cast<double>(m[1]) * m[10]) / det,
        (static_cast<double>(m[1]) * m[6] - static_cast<double>(m[2]) * m[5]) / det,
        (static_cast<double>(m[6]) * m[8] - static_cast<double>(m[4]) * m[10]) / det,
        (static_cast<double>(m[0]) * m[10] - static_cast<double>(m[2]) * m[8]) / det,
        (static_cast<double>(m[2]) * m[4] - static_cast<double>(m[0]) * m[6]) / det,
        (static_cast<double>(m[4]) * m[9] - static_cast<double>(m[5]) * m[8]) / det,
        (static_cast<double>(m[1]) * m[8] - static_cast<double>(m[0]) * m[9]) / det,
        (static_cast<double>(m[0]) * m[5] - static_cast<double>(m[1]) * m[4]) / det,
    };
    Affine r;
    for (int row = 0; row < 3; ++row) {
        for (int col = 0; col < 3; ++col) r.m[4 * row + col] = static_cast<float>(i[3 * row + col]);
        r.m[4 * row + 3] = static_cast<float>(-(i[3 * row] * m[3] + i[3 * row + 1] * m[7] + i[3 * row + 2] * m[11]));
    }
    return r;
}

}  // namespace cardioid
