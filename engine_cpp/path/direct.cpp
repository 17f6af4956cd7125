// SPDX-License-Identifier: GPL-3.0-or-later
// Next-event estimation for the recorded vertices. Runs when the paths of the batch are built, so that shadow rays of all
// bounces fill whole packets.
#include "path/bsdf_choice.h"
#include "path/emitter_point.h"
#include "path/fast_gi.h"
#include "path/media.h"
#include "path/terminator.h"

namespace cardioid::CD_ISA_NS {

namespace {

/// All lobes of a vertex toward wi, apart by class; densities carry the choice of the lobe.
struct BsdfEval {
    Spectrum d{0.0f}, s{0.0f};
    Float pdf_d = 0.0f, pdf_s = 0.0f;
};

/// Where Cycles evaluates Hair BSDF's reflection: above the shading normal's horizon, on wo's side of the strand. Rays find
/// what is left out, with the weight that they have beside lamps.
Mask hair_reflects_lamps(const bsdf::Lobe& lobe, int i, Vec3 wo, Vec3 wi) {
    const Vec3 along = normalize(load3(lobe.tangent, i));
    const Mask near_side = dot(wo, wi) >= dot(wo, along) * dot(wi, along);
    return near_side & (dot(load3(lobe.normal, i), wi) >= Float(0.0f));
}

/// `visibility`: bits of the light, to leave out the lobes that it must not light; null when every lamp lights all.
BsdfEval eval_bsdf(const path::VertexChunk& chunk, int i, Vec3 wo, Vec3 wi, Vec3 ng, const scene::Settings& settings,
                   const Int* visibility) {
    const float caustic_roughness = settings.caustic_roughness;
    BsdfEval sum;
    for (int k = 0; k < chunk.lobes; ++k) {
        LobeEval e = eval_lobe(chunk.lobe[k], i, wo, wi, ng);
        if (chunk.lobe[k].kind == bsdf::LobeKind::hair_reflection) {
            const Mask seen = hair_reflects_lamps(chunk.lobe[k], i, wo, wi);
            e = {select(seen, e.f_cos, Spectrum(0.0f)), select(seen, e.pdf, Float(0.0f))};
        }
        e.f_cos = carried_value(chunk, chunk.lobe[k], i, wo, wi, ng, e.f_cos, mask_of(false), Transport::radiance,
                                settings.physical_refraction);
        if (visibility) {
            const Mask seen = (*visibility & lobe_visibility(chunk.lobe[k].kind, wi, ng)) != Int(0);
            e.f_cos = select(seen, e.f_cos, Spectrum(0.0f));
        }
        const Float pdf = e.pdf * load(chunk.pick[k] + i);
        if (caustic_roughness <= 0) {
            // Only deltas are specular, and those evaluate to 0.
            sum.d += e.f_cos;
            sum.pdf_d += pdf;
            continue;
        }
        const Mask specular = is_specular(chunk.lobe[k], i, caustic_roughness);
        sum.d += select(specular, Spectrum(0.0f), e.f_cos);
        sum.s += select(specular, e.f_cos, Spectrum(0.0f));
        sum.pdf_d += select(specular, Float(0.0f), pdf);
        sum.pdf_s += select(specular, pdf, Float(0.0f));
    }
    return sum;
}

/// The phase function of a vertex in a medium.
BsdfEval eval_phases(const path::VertexChunk& chunk, int i, Vec3 wo, Vec3 wi, const Int* visibility, Mask lanes) {
    BsdfEval sum;
    sum.pdf_d = eval_medium(*chunk.medium, i, wo, wi, lanes);
    sum.d = Spectrum(sum.pdf_d);
    if (visibility) sum.d = select((*visibility & Int(scene::visible_volume)) != Int(0), sum.d, Spectrum(0.0f));
    return sum;
}

/// Media that a ray from a vertex toward wi starts in.
MediaLanes media_toward(const path::VertexChunk& chunk, int i, Vec3 wi, Vec3 ng, Mask lanes) {
    MediaLanes media = load_media(*chunk.media, i);
    if (chunk.media->surface_material >= 0)
        cross_surface(media, load(chunk.media->surface_instance + i), Int(chunk.media->surface_material),
                      load(chunk.media->backfacing + i) != Int(0), lanes & (dot(wi, ng) < Float(0.0f)));
    return media;
}

Mask not_black(Spectrum c) { return (c.r != Float(0.0f)) | (c.g != Float(0.0f)) | (c.b != Float(0.0f)); }

}  // namespace

void Tracer::add_direct_light() {
    for (const path::VertexChunk* chunk = scratch.first_chunk; chunk; chunk = chunk->next) {
        for (int i = 0; i < chunk->n; i += W) {
            connect(*chunk, i);
            if (request.photons) gather_photons(*chunk, i);
            if (scratch.shadows.n > path::ShadowQueue::capacity - 2 * W) flush_shadows();
        }
    }
    flush_shadows();
    scratch.first_chunk = nullptr;
    scratch.last_chunk = &scratch.first_chunk;
    scratch.arena.reset();
}

void Tracer::connect(const path::VertexChunk& chunk, int i) {
    const Spectrum throughput = load_rgb(chunk.throughput, i);
    const Int state = state_of(load(chunk.flags + i));
    const Int after_d = chunk.medium ? state_in_medium(state) : step_state(state, mask_of(false));
    Mask active = first_lanes(chunk.n - i) & not_black(throughput);
    const bool all_classes = request.partition.camera == path::k_all_classes;
    const Mask before_d = state == Int(static_cast<int>(path::State::specular));
    // Rough specular lobes of the first vertices are connected too (class D1).
    if (!all_classes) active &= in_set(after_d, request.partition.camera) | before_d;
    if (none(active)) return;
    const Vec3 p = cardioid::CD_ISA_NS::load3(chunk.position, i),
               ng = cardioid::CD_ISA_NS::load3(chunk.normal_geometric, i);
    const Vec3 wo = cardioid::CD_ISA_NS::load3(chunk.wo, i), n = cardioid::CD_ISA_NS::load3(chunk.normal, i);
    // Masked lanes may hold garbage indices from the list's padding.
    const Int path = select(active, load(chunk.path + i), Int(0));
    const Int event = load(chunk.event + i), depth = load(chunk.depth + i);
    const Int seed = gather(scratch.pixel_seed, path), index = gather(scratch.sample_index, path);
    const Vec2 u = sample_pair(seed, index, event_dimension(event, pair_light));
    const LightReceiver at{p, chunk.all_sides ? Vec3{0.0f, 0.0f, 0.0f} : n};
    const LightSample light = sample_light(*scene.lights, at, u, active);
    Mask lit = active & light.valid & (light.pdf > Float(0.0f));
    scratch.counters.light_samples += static_cast<std::uint64_t>(count(active));
    if (none(lit)) return;

    if (scene.lights_are_limited) lit &= byte_of(depth, 0) <= light.max_bounces;
    Int seen_by = light.visibility;
    const bool sky_alone = replaces_bounces(scene.settings) && scene.lights->environment.constant;
    if (sky_alone) {
        const Mask sky = light.emitter == Int(scene.lights->environment.emitter);
        seen_by = select(sky, seen_by & ~short_lobes(scene.settings, depth), seen_by);
    }
    const Int* visibility = scene.lights_are_limited || sky_alone ? &seen_by : nullptr;
    const Vec3 side = scene.lifts_shadow_rays && !chunk.medium ? terminator_side(scene, chunk, i) : ng;
    const BsdfEval f = chunk.medium ? eval_phases(chunk, i, wo, light.wi, visibility, lit)
                                    : eval_bsdf(chunk, i, wo, light.wi, side, scene.settings, visibility);
    lit &= not_black(f.d) | not_black(f.s);
    if (none(lit)) return;
    Spectrum radiance = light.radiance;
    const Mask programmed = lit & (light.program >= Int(0));
    if (any(programmed)) {
        ShadedPoint point;
        point.position = select(light.infinite, light.wi, light.position);
        point.normal_geometric = point.normal = select(light.infinite, -light.wi, light.normal);
        point.wo = -light.wi;
        point.instance = light.instance;
        point.triangle = light.triangle;
        point.u = light.barycentric_u;
        point.v = light.barycentric_v;
        point.depth = one_bounce_further(depth);
        point.flags = Int(0);
        point.ray_length = light.distance;
        const Mask lamps = programmed & (light.emitter < Int(scene.lights->lamp_count));
        if (any(lamps)) place_on_lamp(scene, light.emitter, point, lamps);
        const Mask triangles = programmed & (light.instance >= Int(0));
        if (any(triangles)) place_on_triangle(scene, point, triangles);
        const Spectrum e = shade_points(*this, nodes::Purpose::emission, light.program, point, programmed);
        radiance = select(programmed, radiance * e, radiance);
        lit &= not_black(radiance);
        if (none(lit)) return;
    }

    const Spectrum arriving = throughput * radiance * (1.0f / max(light.pdf, 1e-37f));
    const Int bounce = byte_of(depth, 0);
    const float clamp_direct = scene.settings.clamp_direct, clamp_indirect = scene.settings.clamp_indirect;
    const Vec3 from = scene.lifts_shadow_rays && !chunk.medium ? p + shadow_lift(scene, chunk, i, light.wi, lit) : p;
    const Vec3 origin = offset_origin(from, ng, light.wi, load(chunk.distance + i));
    const Float reach =
        max(max(abs(light.position.x), abs(light.position.y)), max(abs(light.position.z), light.distance));
    // Aimed anew from the moved origin: in the old direction the ray would end behind the emitter and be stopped by it.
    const Vec3 to_light = light.position - origin;
    const Float distance = length(to_light);
    const Vec3 direction = select(light.infinite, light.wi, to_light * (1.0f / max(distance, 1e-37f)));
    const Float t_max = select(light.infinite, Float(1e30f), distance - reach * 1e-5f);
    path::ShadowQueue& q = scratch.shadows;
    const bool layers = request.layers;
    const Int since_d = scatterings_since_d(load(chunk.flags + i));
    const Float cosine = chunk.medium ? Float(1.0f) : abs(dot(n, light.wi));
    const Spectrum incident = radiance * (cosine / max(light.pdf, 1e-37f));
    MediaLanes media;
    if (scene.has_volumes) media = media_toward(chunk, i, light.wi, ng, lit);
    const auto queue = [&](Spectrum f_cos, Float pdf, Int after, bool d_lobes, Mask m) {
        const Float weight = select(light.delta, Float(1.0f), power_heuristic(light.pdf, pdf));
        const Spectrum whole = arriving * f_cos * weight;
        const Float kept = clamp_factor(whole, bounce, clamp_direct, clamp_indirect);
        const Spectrum c = whole * kept;
        m &= not_black(c);
        Light found{c};
        if (layers && d_lobes) {
            found.incident = select(since_d == Int(0), incident * (weight * kept), demodulated(path, c));
            found.layer = min(since_d, Int(path::k_layers - 1));
            // Light of media before x_d is not filtered.
            if (chunk.medium) found.layer = select(since_d == Int(0), Int(k_no_layer), found.layer);
        }
        const Mask shadowed = m & light.casts_shadow;
        const int at_n = q.n;
        append(q.origin[0], at_n, origin.x, shadowed);
        append(q.origin[1], at_n, origin.y, shadowed);
        append(q.origin[2], at_n, origin.z, shadowed);
        append(q.direction[0], at_n, direction.x, shadowed);
        append(q.direction[1], at_n, direction.y, shadowed);
        append(q.direction[2], at_n, direction.z, shadowed);
        append(q.t_max, at_n, t_max, shadowed);
        append(q.radiance[0], at_n, c.r, shadowed);
        append(q.radiance[1], at_n, c.g, shadowed);
        append(q.radiance[2], at_n, c.b, shadowed);
        if (layers) {
            append(q.incident[0], at_n, found.incident.r, shadowed);
            append(q.incident[1], at_n, found.incident.g, shadowed);
            append(q.incident[2], at_n, found.incident.b, shadowed);
            compress_store(q.layer + at_n, found.layer, shadowed);
        }
        if (scene.has_volumes) {
            for (int k = 0; k < path::k_media; ++k) {
                compress_store(q.media_instance[k] + at_n, media.instance[k], shadowed);
                compress_store(q.media_material[k] + at_n, media.material[k], shadowed);
            }
        }
        compress_store(q.path + at_n, path, shadowed);
        q.n += compress_store(q.path_class + at_n, after, shadowed);
        add_light(result, layers, after, path, found, m & ~light.casts_shadow);
    };
    Mask by_d = lit & not_black(f.d);
    if (!all_classes) by_d &= in_set(after_d, request.partition.camera);
    queue(f.d, f.pdf_d, after_d, true, by_d);
    // Rough specular lobes are connected only while every vertex before was specular: after a D that is a caustic.
    const Mask rough_specular = lit & not_black(f.s) & before_d;
    if (any(rough_specular)) queue(f.s, f.pdf_s, Int(static_cast<int>(path::State::specular)), false, rough_specular);
}

void Tracer::flush_shadows() {
    path::ShadowQueue& q = scratch.shadows;
    scratch.counters.shadow_rays += static_cast<std::uint64_t>(q.n);
    for (int i = 0; i < q.n; i += W) {
        const Mask lanes = first_lanes(q.n - i);
        RayLanes ray;
        ray.o = load3(q.origin, i);
        ray.d = load3(q.direction, i);
        ray.t_min = 0.0f;
        ray.t_max = load(q.t_max + i);
        ray.time = 0.0f;
        ray.mask = Int(trace::mask_shadow_opaque);
        if (scratch.ray_log) log_rays(*scratch.ray_log, ray, lanes, path::ray_kind_shadow);
        Mask visible = lanes & ~occluded(scene.embree, ray, lanes);
        Light light{{load(q.radiance[0] + i), load(q.radiance[1] + i), load(q.radiance[2] + i)}};
        if (request.layers) {
            light.incident = {load(q.incident[0] + i), load(q.incident[1] + i), load(q.incident[2] + i)};
            light.layer = load(q.layer + i);
        }
        if ((scene.has_transparent_shadows || scene.has_volumes) && any(visible)) {
            MediaLanes media;
            for (int k = 0; scene.has_volumes && k < path::k_media; ++k) {
                media.instance[k] = load(q.media_instance[k] + i);
                media.material[k] = load(q.media_material[k] + i);
            }
            const Spectrum passed = through_transparent(ray, visible, scene.has_volumes ? &media : nullptr);
            light.radiance *= passed;
            light.incident *= passed;
        }
        add_light(result, request.layers, load(q.path_class + i), load(q.path + i), light, visible);
    }
    q.n = 0;
}

Spectrum Tracer::through_transparent(RayLanes ray, Mask& visible, MediaLanes* media) {
    Spectrum passed(1.0f);
    const Int number = hash(bits_of(ray.d.x), bits_of(ray.o.x));
    Float begin = ray.t_min;
    Int passed_surfaces(0);
    ray.mask = Int(trace::mask_shadow_transparent);
    Mask active = visible;
    // One more than the limit: the surface beyond it blocks, as in Cycles.
    const int most = scene.settings.max_transparent_bounces;
    for (int layer = 0; layer <= most + (media ? k_most_bounds : 0); ++layer) {
        const HitLanes h = intersect(scene.embree, ray, active, false);
        if (media) {
            const Float end = select(h.hit, h.t, ray.t_max);
            const Spectrum rest = transmittance(*this, *media, ray.o, ray.d, begin, end, number, active);
            passed = select(active, passed * rest, passed);
            begin = end;
        }
        active &= h.hit;
        if (none(active)) return passed;
        scratch.counters.shadow_rays += static_cast<std::uint64_t>(count(active));
        const Int instance = select(h.hit, h.instance, Int(0)), triangle = select(h.hit, h.triangle, Int(0));
        const SurfaceNormals normals = surface_normals(scene, instance, triangle, h.ng, h.u, h.v, -ray.d);
        ShadedPoint point;
        point.position = ray.o + ray.d * h.t;
        point.normal_geometric = normals.ng;
        point.normal = normals.n;
        point.wo = -ray.d;
        point.instance = instance;
        point.triangle = triangle;
        point.u = h.u;
        point.v = h.v;
        point.flags = Int(nodes::ray_shadow);
        point.ray_length = h.t;
        point.backfacing = select(normals.backfacing, Float(1.0f), Float(0.0f));
        const Spectrum t =
            shade_points(*this, nodes::Purpose::transparency, material_of(scene, instance, triangle), point, active);
        passed = select(active, passed * t, passed);
        Mask black = active & ~not_black(passed);
        if (media) {
            const Int material = select(active, material_of(scene, instance, triangle), Int(0));
            const Mask bounds = has_medium(scene, material, active);
            cross_surface(*media, instance, material, normals.backfacing, bounds);
            passed_surfaces += select(only_bounds(scene, material, bounds), Int(0), Int(1));
            black |= active & (passed_surfaces > Int(most));
        }
        visible &= ~black;
        active &= ~black;
        ray.t_min = h.t + offset_step(point.position, h.t);
        active &= ray.t_min < ray.t_max;
    }
    visible &= ~active;
    return passed;
}

}  // namespace cardioid::CD_ISA_NS
