// SPDX-License-Identifier: GPL-3.0-or-later
// Fresnel's equations and what follows from them for a slab of glass.
#pragma once

#include <cmath>

namespace cardioid::test {

/// Reflectance of a smooth dielectric for unpolarised light; ior: inside over outside.
inline double fresnel(double cos_i, double ior) {
    const double cos_t = std::sqrt(1 - (1 - cos_i * cos_i) / (ior * ior));
    const double s = (cos_i - ior * cos_t) / (cos_i + ior * cos_t), p = (cos_t - ior * cos_i) / (cos_t + ior * cos_i);
    return 0.5 * (s * s + p * p);
}

/// What a slab lets through, with all reflections inside.
inline double slab_transmittance(double cos_i, double ior) {
    const double r = fresnel(cos_i, ior);
    return (1 - r) / (1 + r);
}

}  // namespace cardioid::test
