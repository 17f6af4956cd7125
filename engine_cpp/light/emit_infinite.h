// SPDX-License-Identifier: GPL-3.0-or-later
// Photons of suns and of the world: through a disk across their direction, half of them through the casters' cross section.
#pragma once

#include "light/kernels.h"

namespace cardioid::CD_ISA_NS {

/// Disk around the casters' middle that holds the cross sections of the casters (to inner²) and of the scene (to outer²).
struct CrossSection {
    Vec3 center;
    Float inner2, outer2;
};

/// `d`: along the rays, either way.
inline CrossSection cross_section(const light::LightData& lights, Vec3 d) {
    const light::Sphere &scene = lights.scene, &casters = lights.casters;
    const Vec3 offset{scene.center[0] - casters.center[0], scene.center[1] - casters.center[1],
                      scene.center[2] - casters.center[2]};
    const Float radius = length(offset - d * dot(offset, d)) + scene.radius;
    CrossSection c;
    c.center = {casters.center[0], casters.center[1], casters.center[2]};
    c.outer2 = radius * radius;
    // With half of the area inside, aiming ends in the uniform disk.
    const float casters2 = casters.radius > 0 ? casters.radius * casters.radius : 1e37f;
    c.inner2 = min(casters2, 0.5f * c.outer2);
    return c;
}

/// Per m² at the squared distance from the middle.
inline Float section_density(const CrossSection& c, Float r2) {
    const Float area = select(r2 <= c.inner2, c.inner2, c.outer2 - c.inner2) * k_pi;
    return select(r2 <= c.outer2, 0.5f / area, Float(0.0f));
}

/// Density of the ray through p along the unit direction d, per m² across it.
inline Float section_density_at(const light::LightData& lights, Vec3 p, Vec3 d) {
    const CrossSection c = cross_section(lights, d);
    const Vec3 to = p - c.center;
    return section_density(c, length_squared(to - d * dot(to, d)));
}

struct SectionRay {
    Vec3 origin;
    Float density;
    Mask meets;  ///< the ray crosses the box of the scene
};

/// The ray along d through the disk, from where it enters the scene's box: near it, so that float resolves it.
inline SectionRay sample_section(const light::LightData& lights, Vec3 d, Float u, Float v) {
    const CrossSection c = cross_section(lights, d);
    const Mask aimed = u < Float(0.5f);
    const Float part = 2.0f * u - select(aimed, Float(0.0f), Float(1.0f));
    const Float r2 = select(aimed, part * c.inner2, fma(part, c.outer2 - c.inner2, c.inner2));
    const Float r = sqrt(r2);
    Float s, k;
    sincos(k_two_pi * v, s, k);
    const Frame frame(d);
    const Vec3 middle = c.center + frame.s * (r * k) + frame.t * (r * s);
    const Float at[3] = {middle.x, middle.y, middle.z}, along[3] = {d.x, d.y, d.z};
    Float near = -1e30f, far = 1e30f;
    for (int i = 0; i < 3; ++i) {
        const Float inverse = 1.0f / copysign(max(abs(along[i]), 1e-18f), along[i]);
        const Float a = (lights.scene_low[i] - at[i]) * inverse, b = (lights.scene_high[i] - at[i]) * inverse;
        near = max(near, min(a, b));
        far = min(far, max(a, b));
    }
    SectionRay out;
    out.meets = near <= far;
    out.origin = middle + d * select(out.meets, near, Float(0.0f));
    out.density = 0.5f / (k_pi * select(aimed, c.inner2, c.outer2 - c.inner2));
    return out;
}

}  // namespace cardioid::CD_ISA_NS
