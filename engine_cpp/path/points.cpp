// SPDX-License-Identifier: GPL-3.0-or-later
#include "path/tracer.h"

#include <bit>

namespace cardioid::CD_ISA_NS {

namespace {

/// Fills scratch.shading with the lanes of `here`; the others repeat lane `first`, so that any program can read them.
void fill_points(Tracer& tracer, int program, const ShadedPoint& at, Mask here, int first) {
    nodes::ShadingChunk& s = tracer.scratch.shading;
    const trace::SceneView& scene = tracer.scene;
    const auto spread = [&](Float x) { return select(here, x, Float(x[first])); };
    const auto spread_int = [&](Int x) { return select(here, x, Int(x[first])); };
    const auto put = [&](Row(&rows)[3], Vec3 v) { store3(rows, 0, {spread(v.x), spread(v.y), spread(v.z)}); };
    s.n = W;
    s.geometry = &scene.geometry;
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
    if (at.instance[first] >= 0 && scene.materials[program].info.needs_triangle_frame) {
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

Spectrum shade_points(Tracer& tracer, nodes::Purpose purpose, Int program, const ShadedPoint& at, Mask active) {
    const bool emission = purpose == nodes::Purpose::emission;
    nodes::SurfaceOutput& out = tracer.scratch.surface;
    Spectrum result{0.0f};
    for (std::uint32_t left = bits(active); left != 0;) {
        const int first = std::countr_zero(left);
        const int id = program[first];
        const Mask here = active & (program == Int(id));
        left &= ~bits(here);
        fill_points(tracer, id, at, here, first);
        const trace::MaterialView& m = tracer.scene.materials[id];
        run_program(emission ? *m.emission : *m.transparency, tracer.scratch.shading, out, tracer.scratch.registers);
        result = select(here, load_rgb(emission ? out.emission : out.transparency, 0), result);
    }
    return result;
}

}  // namespace cardioid::CD_ISA_NS
