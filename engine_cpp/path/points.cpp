// SPDX-License-Identifier: GPL-3.0-or-later
#include "path/node_rays.h"
#include "path/subsurface.h"

#include <bit>

namespace cardioid::CD_ISA_NS {

namespace {

constexpr std::int32_t k_ray_flags = 0xff;

/// Fills scratch.shading with the lanes of `here`; the others repeat lane `first`, so that any program can read them.
void fill_points(Walk& walk, int program, const ShadedPoint& at, Mask here, int first) {
    nodes::ShadingChunk& s = walk.scratch.shading;
    const trace::SceneView& scene = walk.scene;
    const auto spread = [&](Float x) { return select(here, x, Float(x[first])); };
    const auto spread_int = [&](Int x) { return select(here, x, Int(x[first])); };
    const auto put = [&](Row(&rows)[3], Vec3 v) { store3(rows, 0, {spread(v.x), spread(v.y), spread(v.z)}); };
    s.n = W;
    s.geometry = &scene.geometry;
    s.rays = nullptr;  // as in Cycles, lights and shadows see no rays of nodes
    s.material_pass_index = scene.materials[program].pass_index;
    put(s.position, at.position);
    put(s.normal_geometric, at.normal_geometric);
    put(s.normal, at.normal);
    put(s.wo, at.wo);
    const Int instance = spread_int(at.instance), triangle = spread_int(at.triangle);
    store(s.instance, instance);
    store(s.triangle, triangle);
    store(s.mesh, gather(scene.instances.mesh, max(instance, Int(0))));
    store(s.barycentric_u, spread(at.u));
    store(s.barycentric_v, spread(at.v));
    const bool on_mesh = at.instance[first] >= 0 && at.instance[first] < scene.first_lamp_instance;
    if (on_mesh && scene.materials[program].info.needs_triangle_frame) {
        Vec3 e1, e2;
        triangle_edges(scene, instance, triangle, e1, e2);
        store3(s.dp_du, 0, e1);
        store3(s.dp_dv, 0, e2);
    }
    store(s.footprint, Float(0.0f));
    store(s.ray_length, spread(at.ray_length));
    store(s.backfacing, spread(at.backfacing));
    store(s.time, Float(0.0f));
    store(reinterpret_cast<std::int32_t*>(s.ray_flags), spread_int(at.flags));
    store(s.ray_depth, to_float(byte_of(at.depth, 0)));
    store(s.diffuse_depth, to_float(byte_of(at.depth, 1)));
    store(s.glossy_depth, to_float(byte_of(at.depth, 2)));
    store(s.transmission_depth, to_float(byte_of(at.depth, 3)));
    store(s.transparent_depth, Float(0.0f));
}

}  // namespace

namespace {

/// Length of a camera ray before the near clip, where Cycles' rays start and Ray Length counts from; 0 for others.
Float before_near_clip(const trace::CameraView& camera, Vec3 d, Int flags) {
    const auto& m = camera.desc.transform.m;
    const Vec3 axis = normalize(Vec3{-m[2], -m[6], -m[10]});
    const Float along = max(dot(d, axis), 1e-6f);
    return select((flags & Int(nodes::ray_camera)) != Int(0), camera.desc.clip_start / along, Float(0.0f));
}

}  // namespace

void Walk::fill_shading(int material, const std::int32_t* list, int n) {
    nodes::ShadingChunk& s = scratch.shading;
    const nodes::ProgramInfo& info = scene.materials[material].info;
    const path::RayState& rays = *now;
    const path::HitState& hits = scratch.hits;
    s.n = n;
    s.geometry = &scene.geometry;
    scratch.node_rays = {&scene, node_closest};
    s.rays = info.sends_rays ? &scratch.node_rays : nullptr;
    s.material_pass_index = scene.materials[material].pass_index;
    for (int i = 0; i < n; i += W) {
        const Int ray = load(list + i);
        const Int instance = gather(hits.instance, ray), triangle = gather(hits.triangle, ray);
        const Float t = gather(hits.t, ray), u = gather(hits.u, ray), v = gather(hits.v, ray);
        const Vec3 d = load3(rays.direction, ray);
        const Vec3 p = load3(rays.origin, ray) + d * t;
        const SurfaceNormals normals = surface_normals(scene, instance, triangle, load3(hits.ng, ray), u, v, -d);
        cardioid::CD_ISA_NS::store3(s.position, i, p);
        cardioid::CD_ISA_NS::store3(s.normal_geometric, i, normals.ng);
        cardioid::CD_ISA_NS::store3(s.normal, i, normals.n);
        cardioid::CD_ISA_NS::store3(s.wo, i, -d);
        store(s.ray_length + i, t);
        store(s.backfacing + i, select(normals.backfacing, Float(1.0f), Float(0.0f)));
        store(s.triangle + i, triangle);
        store(s.instance + i, instance);
        store(s.mesh + i, gather(scene.instances.mesh, instance));
        const Int flags = gather(rays.flags, ray);
        store(reinterpret_cast<std::int32_t*>(s.ray_flags) + i, flags & Int(k_ray_flags));
        store(s.footprint + i, footprint(gather(rays.width, ray), gather(rays.spread, ray), t));
        if (info.needs_triangle_frame || info.has_bump || scene.lifts_shadow_rays) {
            Vec3 e1, e2;
            triangle_edges(scene, instance, triangle, e1, e2);
            cardioid::CD_ISA_NS::store3(s.dp_du, i, e1);
            cardioid::CD_ISA_NS::store3(s.dp_dv, i, e2);
            store(s.barycentric_u + i, u);
            store(s.barycentric_v + i, v);
            store(s.time + i, Float(0.0f));
        }
        if (info.sends_rays) store(s.random_seed + i, node_seed(*this, ray));
        if (info.needs_light_path) {
            const Int depth = gather(rays.depth, ray);
            store(s.ray_depth + i, to_float(byte_of(depth, 0)));
            store(s.diffuse_depth + i, to_float(byte_of(depth, 1)));
            store(s.glossy_depth + i, to_float(byte_of(depth, 2)));
            store(s.transmission_depth + i, to_float(byte_of(depth, 3)));
            store(s.transparent_depth + i, to_float(surfaces_passed(gather(rays.transparent, ray))));
            store(s.ray_length + i, t - before_near_clip(scene.camera, d, flags));
        }
    }
}

Mask lanes_with(Int values, int value, Mask among) { return among & (values == Int(value)); }

void run_surface(Walk& walk, int program, const ShadedPoint& at, Float footprint, nodes::SurfaceOutput& out, Mask here,
                 int first) {
    fill_points(walk, program, at, here, first);
    store(walk.scratch.shading.footprint, select(here, footprint, Float(footprint[first])));
    run_program(*walk.scene.materials[program].surface, walk.scratch.shading, out, walk.scratch.registers);
}

void Walk::take_bumped_normal(int n) {
    for (int c = 0; c < 3; ++c) {
        for (int i = 0; i < n; i += W) store(scratch.shading.normal[c] + i, load(scratch.surface.normal[c] + i));
    }
}

Spectrum shade_points(Walk& walk, nodes::Purpose purpose, Int program, const ShadedPoint& at, Mask active) {
    const bool emission = purpose == nodes::Purpose::emission;
    nodes::SurfaceOutput& out = walk.scratch.surface;
    Spectrum result{0.0f};
    for (std::uint32_t left = bits(active); left != 0;) {
        const int first = std::countr_zero(left);
        const int id = program[first];
        const Mask here = active & (program == Int(id));
        left &= ~bits(here);
        fill_points(walk, id, at, here, first);
        const trace::MaterialView& m = walk.scene.materials[id];
        run_program(emission ? *m.emission : *m.transparency, walk.scratch.shading, out, walk.scratch.registers);
        result = select(here, load_rgb(emission ? out.emission : out.transparency, 0), result);
    }
    return result;
}

const nodes::VolumeOutput& volume_points(Walk& walk, int program, const ShadedPoint& at, Mask here, int first) {
    fill_points(walk, program, at, here, first);
    nodes::SurfaceOutput& out = walk.scratch.surface;
    out.volume = &walk.scratch.medium;
    run_program(*walk.scene.materials[program].volume, walk.scratch.shading, out, walk.scratch.registers);
    out.volume = nullptr;
    return walk.scratch.medium;
}

}  // namespace cardioid::CD_ISA_NS
