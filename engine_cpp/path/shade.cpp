// SPDX-License-Identifier: GPL-3.0-or-later
// One chunk: rays that hit the same material. Runs its program, keeps the vertices as a record, samples where paths go on.
#include "path/bsdf_choice.h"
#include "path/media.h"

namespace cardioid::CD_ISA_NS {

namespace {

void scale_rows(Row (&rows)[3], int i, Mask dark) {
    for (auto& row : rows) store(row + i, select(dark, Float(0.0f), load(row + i)));
}

/// Cycles' Reflective and Refractive Caustics switches: glossy lobes are dark for light that a diffuse lobe collects.
void drop_caustic_lobes(const scene::Settings& settings, bsdf::Lobe& lobe, int i, Mask after_diffuse) {
    using bsdf::LobeKind;
    // Of glass whose refraction stays, VertexChunk::dark_glass_reflection takes the other half.
    const bool whole_glass = lobe.kind == LobeKind::ggx_glass && !settings.refractive_caustics;
    const bool reflects = lobe.kind == LobeKind::ggx_reflection || whole_glass || lobe.kind == LobeKind::toon_glossy;
    if (reflects && !settings.reflective_caustics) scale_rows(lobe.weight, i, after_diffuse);
    if (lobe.kind == LobeKind::ggx_refraction && !settings.refractive_caustics)
        scale_rows(lobe.weight, i, after_diffuse);
    if (lobe.kind == LobeKind::ggx_glass && !settings.refractive_caustics)
        scale_rows(lobe.tint_transmission, i, after_diffuse);
}

/// Filter Glossy: after an unlikely bounce, near-mirrors are roughened. What makes up for light lost between facets stays that
/// of the smoother lobe, as in Cycles.
void blur_glossy(bsdf::Lobe& lobe, int i, Vec3 wo, Float least_alpha) {
    if (!bsdf::is_microfacet(lobe.kind)) return;
    const bool compensated = lobe.preserve_energy && !lobe.walks_facets && lobe.kind != bsdf::LobeKind::ggx_refraction;
    const Spectrum before = compensated ? energy_compensation(lobe, i, wo) : Spectrum(1.0f);
    store(lobe.alpha_x + i, max(load(lobe.alpha_x + i), least_alpha));
    store(lobe.alpha_y + i, max(load(lobe.alpha_y + i), least_alpha));
    if (compensated)
        store_rgb(lobe.weight, i, load_rgb(lobe.weight, i) * divide(before, energy_compensation(lobe, i, wo)));
}

}  // namespace

path::VertexChunk* Tracer::new_record(int lobes, bool in_medium) {
    for (int attempt = 0; attempt < 2; ++attempt) {
        const std::size_t mark = scratch.arena.mark();
        auto* chunk = scratch.arena.allocate<path::VertexChunk>(1);
        auto* lobe = scratch.arena.allocate<bsdf::Lobe>(static_cast<std::size_t>(lobes));
        auto* pick = scratch.arena.allocate<Row>(static_cast<std::size_t>(lobes));
        auto* media = scene.has_volumes ? scratch.arena.allocate<path::MediaRecord>(1) : nullptr;
        auto* medium = in_medium ? scratch.arena.allocate<path::MediumRecord>(1) : nullptr;
        if (chunk && lobe && pick && (media || !scene.has_volumes) && (medium || !in_medium)) {
            chunk->next = nullptr;
            chunk->media = media;
            chunk->medium = medium;
            chunk->boundary = false;
            if (media) media->surface_material = -1;
            chunk->lobe = lobe;
            chunk->pick = pick;
            chunk->dark_glass_reflection = !scene.settings.reflective_caustics && scene.settings.refractive_caustics;
            chunk->narrows = false;
            return chunk;
        }
        // Full: evaluate what is recorded so far and start again.
        scratch.arena.reset(mark);
        add_direct_light();
    }
    return nullptr;
}

void Tracer::write_first_hit(const std::int32_t* list, int n) {
    const nodes::ShadingChunk& s = scratch.shading;
    const Affine& to_camera = scene.geometry.world_to_camera;
    for (int i = 0; i < n; ++i) {
        const int path = now->path[list[i]];
        if (result.depth[path] < 1e10f) continue;
        const Float3 p = to_camera.point({s.position[0][i], s.position[1][i], s.position[2][i]});
        result.depth[path] = -p.z;
        for (int c = 0; c < 3; ++c) result.normal[c][path] = s.normal[c][i];
    }
}

void Tracer::shade(int material, const std::int32_t* list, int n) {
    const trace::MaterialView& m = scene.materials[material];
    nodes::SurfaceOutput& out = scratch.surface;
    // First of all: a full arena is emptied by evaluating direct light, which uses the same scratch.
    path::VertexChunk* chunk = new_record(room_for_lobes(m.info));
    if (!chunk) return;
    fill_shading(material, list, n);
    out.lobe = chunk->lobe;
    run_program(*m.surface, scratch.shading, out, scratch.registers);
    if (m.info.sets_normal) take_bumped_normal(n);
    scratch.counters.vertices += static_cast<std::uint64_t>(n);
    if ((now->flags[list[0]] & nodes::ray_camera) != 0) write_first_hit(list, n);
    if (m.info.has_emission) add_surface_emission(material, list);
    chunk->n = n;
    chunk->lobes = out.lobes;
    chunk->own_normals = chunk->all_sides = m.info.own_normals;
    chunk->ggx_bump_shadow = m.info.ggx_bump_shadow;
    for (int k = 0; k < out.lobes; ++k) chunk->all_sides |= bsdf::sends_light_through(out.lobe[k].kind);
    if (m.info.has_subsurface) add_twins(*chunk, list, false);
    chunk->boundary = is_boundary(m);
    if (m.volume) chunk->media->surface_material = material;
    scatter(*chunk, list);
    if (scratch.log) log_vertices(*chunk, material);
    keep_record(chunk);
}

void Tracer::keep_record(path::VertexChunk* chunk) {
    if (chunk->lobes == 0 || !scene.has_lights) return;
    *scratch.last_chunk = chunk;
    scratch.last_chunk = &chunk->next;
}

void Tracer::log_vertices(const path::VertexChunk& chunk, int material) {
    path::PathLog& log = *scratch.log;
    for (int i = 0; i < chunk.n && log.n < log.capacity; ++i) {
        path::LoggedVertex& v = log.vertex[log.n++];
        v.path = chunk.path[i];
        v.material = material;
        v.instance = scratch.shading.instance[i];
        v.triangle = scratch.shading.triangle[i];
        v.flags = chunk.flags[i];
        v.depth = chunk.depth[i];
        v.distance = chunk.distance[i];
        v.lobes = chunk.lobes;
        for (int c = 0; c < 3; ++c) {
            v.position[c] = chunk.position[c][i];
            v.normal[c] = chunk.normal[c][i];
            v.throughput[c] = chunk.throughput[c][i];
        }
        for (int k = 0; k < chunk.lobes; ++k) {
            v.pick[k] = chunk.pick[k][i];
            v.kind[k] = chunk.lobe[k].kind;
        }
    }
}

void Tracer::apply_holdout(Int path, Spectrum throughput, Float holdout, Mask lanes) {
    lanes &= holdout > Float(0.0f);
    if (none(lanes)) return;
    const Float hole = average(throughput) * holdout;
    for (std::uint32_t b = bits(lanes); b != 0; b &= b - 1) {
        const int k = std::countr_zero(b);
        result.alpha[path[k]] -= hole[k];
    }
}

void Tracer::adjust_lobes(path::VertexChunk& chunk, int i, Int flags, Float min_pdf) {
    const scene::Settings& settings = scene.settings;
    const bool drop_caustics = !settings.reflective_caustics || !settings.refractive_caustics;
    if (!drop_caustics && settings.filter_glossy <= 0) return;
    const Mask after_diffuse = (flags & Int(nodes::ray_diffuse)) != Int(0);
    const Vec3 wo = cardioid::CD_ISA_NS::load3(scratch.shading.wo, i);
    for (int k = 0; k < chunk.lobes; ++k) {
        bsdf::Lobe& lobe = chunk.lobe[k];
        if (drop_caustics) drop_caustic_lobes(settings, lobe, i, after_diffuse);
        if (settings.filter_glossy <= 0) continue;
        const Float blur_pdf = min_pdf * (1.0f / settings.filter_glossy);
        if (any(blur_pdf < Float(1.0f))) blur_glossy(lobe, i, wo, 0.5f * safe_sqrt(1.0f - blur_pdf));
    }
}

}  // namespace cardioid::CD_ISA_NS
