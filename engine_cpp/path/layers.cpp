// SPDX-License-Identifier: GPL-3.0-or-later
// Radiance pairs (thesis 6.2, spec 3): every contribution R comes with I, the light that arrives at x_d times the cosine there;
// and what the surface at x_d looks like.
#include "path/bsdf_choice.h"

namespace cardioid::CD_ISA_NS {

void Tracer::add_features(const path::VertexChunk& chunk, int i, const DetailSum& detail, Int flags, Mask scatters) {
    const Spectrum throughput = load_rgb(chunk.throughput, i), d = throughput * detail.albedo;
    const Float weight = luminance(d);
    const Mask here = scatters & (scatterings_since_d(flags) == Int(0)) & (weight > Float(0.0f));
    if (none(here)) return;
    const auto& to_camera = scene.geometry.world_to_camera.m;
    const Vec3 p = cardioid::CD_ISA_NS::load3(chunk.position, i);
    const Float depth = -(to_camera[8] * p.x + to_camera[9] * p.y + to_camera[10] * p.z + to_camera[11]);
    const Vec3 n = normalize(detail.normal) * weight;
    const Float weighted_depth = depth * weight;
    const Spectrum mirrored = select(byte_of(load(chunk.depth + i), 0) > Int(0), d, Spectrum(0.0f));
    const Float values[] = {d.r,        d.g,        d.b,       n.x, n.y, n.z, weighted_depth, weighted_depth * depth,
                            mirrored.r, mirrored.g, mirrored.b};
    float* const rows[] = {
        result.detail[0],          result.detail[1],          result.detail[2],         result.feature_normal[0],
        result.feature_normal[1],  result.feature_normal[2],  result.feature_depth,     result.feature_depth_squared,
        result.mirrored_detail[0], result.mirrored_detail[1], result.mirrored_detail[2]};
    static_assert(sizeof rows / sizeof *rows == sizeof values / sizeof *values);
    for (std::uint32_t b = bits(here); b != 0; b &= b - 1) {
        const int k = std::countr_zero(b), path = chunk.path[i + k];
        for (std::size_t r = 0; r < sizeof rows / sizeof *rows; ++r) rows[r][path] += values[r][k];
    }
}

void Tracer::mark_incident(const path::VertexChunk& chunk, int i, const Choice& c, Int flags, Mask scatters) {
    const Mask here = scatters & c.valid & c.took_d & (scatterings_since_d(flags) == Int(0));
    if (none(here)) return;
    const Spectrum f = load_rgb(chunk.throughput, i) * c.f;
    const Float cosine = abs(dot(cardioid::CD_ISA_NS::load3(chunk.normal, i), c.wi));
    // A black channel says nothing of the light in it: the others stand for it, so that luminance is that of grey light.
    const auto shown = [](Float x) { return select(x > Float(0.0f), Float(1.0f), Float(0.0f)); };
    const Float seen = luminance(Spectrum{shown(f.r), shown(f.g), shown(f.b)});
    const Float scale = cosine / max(seen, 1e-6f);
    const auto inverse = [&](Float x) { return select(x > Float(0.0f), scale / max(x, 1e-30f), Float(0.0f)); };
    const Float values[] = {inverse(f.r), inverse(f.g), inverse(f.b)};
    for (std::uint32_t b = bits(here); b != 0; b &= b - 1) {
        const int k = std::countr_zero(b), path = chunk.path[i + k];
        for (std::size_t r = 0; r < 3; ++r) scratch.demodulation[r][path] = values[r][k];
    }
}

Spectrum Tracer::demodulated(Int path, Spectrum radiance) const {
    const auto row = [&](int k) { return gather(scratch.demodulation[k], path); };
    return radiance * Spectrum{row(0), row(1), row(2)};
}

}  // namespace cardioid::CD_ISA_NS
