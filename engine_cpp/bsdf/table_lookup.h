// SPDX-License-Identifier: GPL-3.0-or-later
// Linear interpolation in the tables of tables.h over lanes; coordinates are in [0, 1] and clamped.
#pragma once

#include "bsdf/tables.h"
#include "simd/vec.h"

namespace cardioid::CD_ISA_NS {

/// Position on an axis of n entries: cell and the fraction inside it.
struct TableAxis {
    Int cell;
    Float t;
    TableAxis(Float x, int n) {
        const Float y = saturate(x) * static_cast<float>(n - 1);
        cell = min(to_int(y), Int(n - 2));
        t = y - to_float(cell);
    }
};

inline Float lookup1(const float* table, TableAxis x, Int offset = Int(0)) {
    const Int k = x.cell + offset;
    const Float a = gather(table, k), b = gather(table + 1, k);
    return fma(b - a, x.t, a);
}
inline Float lookup2(const float* table, int nx, TableAxis x, TableAxis y, Int offset = Int(0)) {
    const Int k = y.cell * Int(nx) + offset;
    const Float a = lookup1(table, x, k), b = lookup1(table + nx, x, k);
    return fma(b - a, y.t, a);
}
inline Float lookup3(const float* table, int nx, int ny, TableAxis x, TableAxis y, TableAxis z) {
    const Int k = z.cell * Int(nx * ny);
    const Float a = lookup2(table, nx, x, y, k), b = lookup2(table + nx * ny, nx, x, y, k);
    return fma(b - a, z.t, a);
}

/// Roughness axis of a GGX lobe; anisotropic lobes are looked up at their mean alpha.
inline Float roughness_of(Float alpha_x, Float alpha_y) { return sqrt(sqrt(alpha_x * alpha_y)); }
/// Axis z of an index, above or below 1.
inline Float index_coordinate(Float eta) { return sqrt(abs(eta - 1.0f) / (eta + 1.0f)); }

}  // namespace cardioid::CD_ISA_NS
