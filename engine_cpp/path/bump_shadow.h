// SPDX-License-Identifier: GPL-3.0-or-later
// Softened shadows of bumped diffuse surfaces.
#pragma once

#include "path/tracer.h"

namespace cardioid::CD_ISA_NS {

/// Masking of facets as rough as the smooth normal is far from the bumped one; 0 where light and bump are not on one side.
inline Float ggx_bump_shadow(Float cos_bump, Float cos_smooth, Float cos_turn) {
    const auto tan2 = [](Float cosine) { return 1.0f / max(cosine * cosine, 1e-12f) - 1.0f; };
    const Float alpha2 = saturate(0.125f * tan2(cos_turn));
    const Float masking = 2.0f / (1.0f + sqrt(1.0f + alpha2 * max(tan2(cos_smooth), 0.0f)));
    const Mask dark = (cos_bump * cos_smooth * cos_turn < Float(0.0f)) | (abs(cos_smooth) < Float(1e-6f));
    return select(dark, Float(0.0f), masking);
}

/// Cycles' softening of the border where light is under the smooth surface but over the bumped one (Chiang et al. 2019; from 4.5
/// on Estevez et al. 2019); for diffuse lobes with a normal of their own.
inline Float bump_shadow(const path::VertexChunk& chunk, const bsdf::Lobe& lobe, int i, Vec3 wi) {
    Vec3 smooth = load3(chunk.normal, i);
    const Vec3 bumped = load3(lobe.normal, i);
    const Float cos_light = dot(bumped, wi);
    if (chunk.ggx_bump_shadow) return ggx_bump_shadow(cos_light, dot(smooth, wi), dot(smooth, bumped));
    smooth = select(cos_light < Float(0.0f), -smooth, smooth);
    const Float g = dot(smooth, wi) / max(abs(cos_light) * abs(dot(smooth, bumped)), 1e-20f);
    const Float soft = select(g < Float(0.0f), Float(0.0f), fma(g * g, 1.0f - g, g));
    return select(g >= Float(1.0f), Float(1.0f), soft);
}

}  // namespace cardioid::CD_ISA_NS
