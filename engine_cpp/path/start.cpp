// SPDX-License-Identifier: GPL-3.0-or-later
#include "path/camera_rays.h"
#include "path/media.h"

namespace cardioid::CD_ISA_NS {

namespace {
/// Every second bit of a Morton code.
int even_bits(int code) {
    int r = 0;
    for (int b = 0; b < 8; ++b) r |= ((code >> (2 * b)) & 1) << b;
    return r;
}

/// Pixels in Morton order, the samples of a pixel next to each other: neighbours in a packet take like paths.
int assign_pixels(const path::BatchRequest& request, path::BatchResult& result) {
    int n = 0;
    for (int code = 0; code < (1 << 12); ++code) {
        const int dx = even_bits(code), dy = even_bits(code >> 1);
        if (dx >= request.width || dy >= request.height) continue;
        if (request.active && request.active[dy * request.width + dx] == 0) continue;
        for (int s = 0; s < request.samples; ++s, ++n) {
            result.x[n] = request.x + dx;
            result.y[n] = request.y + dy;
            result.sample[n] = request.first_sample + s;
        }
        if (n == request.width * request.height * request.samples) break;
    }
    return n;
}

void clear_light(path::LightSums& sums, bool layers, int i) {
    const auto clear = [i](path::PathFloats(&rows)[3]) { store3(rows, i, {0.0f, 0.0f, 0.0f}); };
    for (auto& c : sums.radiance) clear(c);
    if (!layers) return;
    clear(sums.unfiltered);
    for (int l = 0; l < path::k_layers; ++l) {
        clear(sums.layer_radiance[l]);
        clear(sums.layer_incident[l]);
    }
}

void clear_features(path::BatchResult& result, int i) {
    const auto clear = [i](path::PathFloats(&rows)[3]) { store3(rows, i, {0.0f, 0.0f, 0.0f}); };
    clear(result.detail);
    clear(result.mirrored_detail);
    clear(result.feature_normal);
    store(result.feature_depth + i, Float(0.0f));
    store(result.feature_depth_squared + i, Float(0.0f));
}
}  // namespace

void Tracer::start() {
    const int n = assign_pixels(request, result);
    result.n = n;
    scratch.counters.camera_paths += static_cast<std::uint64_t>(n);
    const int frame_width = scene.settings.width;
    path::RayState& rays = *now;
    rays.n = n;
    MediaLanes around = no_media();
    for (int i = 0; i < n; i += W) {
        const Int x = load(result.x + i), y = load(result.y + i), sample = reverse_bits(load(result.sample + i));
        const Int seed = hash(y * Int(frame_width) + x, Int::of_bits(request.seed * 0x9e3779b9u + 0x7f4a7c15u));
        store(scratch.pixel_seed + i, seed);
        store(scratch.sample_index + i, sample);
        const CameraRays r =
            camera_rays(scene.camera, request.filter_table, to_float(x), to_float(y),
                        sample_pair(seed, sample, Int(pair_pixel)), sample_pair(seed, sample, Int(pair_lens)));
        store3(rays.origin, i, r.o);
        store3(rays.direction, i, r.d);
        store(rays.t_min + i, r.t_min);
        store3(rays.throughput, i, {1.0f, 1.0f, 1.0f});
        store(rays.pdf + i, Float(-1.0f));
        store3(rays.from_normal, i, {0.0f, 0.0f, 0.0f});
        store(rays.width + i, r.width);
        store(rays.spread + i, r.spread);
        store(rays.min_pdf + i, Float(1e30f));
        store(rays.merge + i, Float(0.0f));
        store(rays.path + i, Int(i) + lane_index());
        store(rays.flags + i, Int(nodes::ray_camera | path::k_flag_background));
        store(rays.depth + i, Int(0));
        store(rays.transparent + i, Int(0));
        if (scene.has_volumes) {
            // Where every ray starts in the same point, the first packet's media are all rays'.
            const bool same_point =
                scene.camera.desc.kind == scene::CameraKind::perspective && scene.camera.desc.aperture_radius <= 0;
            const Mask lanes = first_lanes(n - i);
            if (i == 0 || !same_point) around = media_around(scene, same_point ? r.o : r.o + r.d * r.t_min, lanes);
            for (int k = 0; k < path::k_media; ++k) {
                const bool spread = same_point;
                store(rays.media_instance[k] + i, spread ? Int(around.instance[k][0]) : around.instance[k]);
                store(rays.media_material[k] + i, spread ? Int(around.material[k][0]) : around.material[k]);
            }
        }
        // Far clipping concerns camera rays alone: kept where hits look for it.
        store(scratch.hits.t + i, r.t_max);
        clear_light(result, request.layers, i);
        clear_light(scratch.met, request.layers, i);
        if (request.layers) clear_features(result, i);
        store(result.alpha + i, Float(1.0f));
        store(result.caustic_hits + i, Float(0.0f));
        store(result.depth + i, Float(1e10f));
        store3(result.normal, i, {0.0f, 0.0f, 0.0f});
    }
}

void Tracer::finish() {
    for (int i = 0; i < result.n; i += W) {
        const auto add = [i](path::PathFloats(&to)[3], const path::PathFloats(&from)[3]) {
            for (int c = 0; c < 3; ++c) store(to[c] + i, load(to[c] + i) + load(from[c] + i));
        };
        for (int k = 0; k < path::k_classes; ++k) add(result.radiance[k], scratch.met.radiance[k]);
        if (!request.layers) continue;
        add(result.unfiltered, scratch.met.unfiltered);
        for (int l = 0; l < path::k_layers; ++l) {
            add(result.layer_radiance[l], scratch.met.layer_radiance[l]);
            add(result.layer_incident[l], scratch.met.layer_incident[l]);
        }
    }
}

}  // namespace cardioid::CD_ISA_NS
