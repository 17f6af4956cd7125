// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace/traceable_scene.h"

#include "image/image_store.h"
#include "light/light_table.h"
#include "nodes/compile.h"
#include "nodes/run.h"
#include "trace/bounds.h"
#include "trace/displace.h"
#include "trace/embree_scene.h"
#include "trace/geometry_pool.h"

#include <algorithm>
#include <chrono>

namespace cardioid::trace {

namespace {

class Stopwatch {
public:
    explicit Stopwatch(double& seconds) : seconds_(seconds), start_(Clock::now()) {}
    ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

private:
    using Clock = std::chrono::steady_clock;
    double& seconds_;
    Clock::time_point start_;
};

bool is_limited(std::uint8_t visibility, int max_bounces, int path_bounces) {
    constexpr int lobes = scene::visible_diffuse | scene::visible_glossy | scene::visible_transmission;
    return (visibility & lobes) != lobes || max_bounces < path_bounces;
}

/// Path tracing calls deltas alone specular. With photons the classes of a path must be the same from both ends, so nothing that
/// changes lobes on one side applies.
scene::Settings effective_settings(scene::Settings s) {
    if (s.integrator == scene::IntegratorKind::path_tracing) {
        s.caustic_roughness = 0;
    } else {
        s.reflective_caustics = s.refractive_caustics = true;
        s.filter_glossy = 0;
        // Where photons bring all light, there are no bounces of camera paths to be replaced.
        if (s.integrator == scene::IntegratorKind::photon_mapping) s.fast_gi = scene::FastGi::off;
    }
    return s;
}

bool is_black(Float3 c) { return c.x == 0 && c.y == 0 && c.z == 0; }

}  // namespace

struct TraceableScene::Impl {
    SceneView view;
    BuildStats stats;
    nodes::Warnings warnings;
    PoolNames names;
    std::unique_ptr<image::ImageStore> images;
    std::vector<nodes::CompiledGraph> graphs;  // materials, default grey, lamps, world: SceneView::materials' ids
    std::vector<bool> use_transparent_shadow;
    std::vector<MaterialView> materials;
    std::unique_ptr<GeometryPool> pool;
    std::unique_ptr<EmbreeScene> embree;
    std::unique_ptr<light::LightTable> lights;

    void compile_graphs(const scene::SceneDesc& desc);
    void build_geometry(const scene::SceneDesc& desc, const BuildProgress& progress);
    void build_lights(const scene::SceneDesc& desc, const light::Checkpoint& checkpoint);
    std::vector<light::LampInput> lamp_inputs(const scene::SceneDesc& desc) const;
    std::vector<light::EmissiveTriangle> emissive_triangles(const light::Checkpoint& checkpoint);
    /// Some lobe of the instance may be specular (spec 1).
    bool may_cast(int instance) const;
    void evaluate_world(int n, const Float3* directions, Float3* radiance) const;
    int default_material() const { return view.material_count - 1; }
};

TraceableScene::TraceableScene(const scene::SceneDesc& desc, const BuildProgress& progress)
    : impl_(std::make_unique<Impl>()) {
    Impl& s = *impl_;
    const auto stage = [&](const char* name) {
        if (progress(name)) throw BuildCancelled{};
    };
    s.view.settings = effective_settings(desc.settings);
    stage("Loading images");
    {
        const Stopwatch watch(s.stats.images_seconds);
        s.images =
            std::make_unique<image::ImageStore>(desc.images, desc.settings.ocio_config, desc.settings.texture_cache_mb);
    }
    stage("Compiling materials");
    {
        const Stopwatch watch(s.stats.materials_seconds);
        s.compile_graphs(desc);
    }
    SceneView& v = s.view;
    if (desc.camera) v.camera.desc = *desc.camera;
    const auto& plane = v.camera.desc.view_plane;
    v.camera.pixel_x = (plane[1] - plane[0]) / static_cast<float>(desc.settings.width);
    v.camera.pixel_y = (plane[3] - plane[2]) / static_cast<float>(desc.settings.height);
    const bool orthographic = v.camera.desc.kind == scene::CameraKind::orthographic;
    v.camera.pixel_angle = orthographic ? 1.0f / static_cast<float>(desc.settings.width) : v.camera.pixel_x;
    v.geometry.camera_to_world = v.camera.desc.transform;
    v.geometry.world_to_camera = inverse(v.camera.desc.transform);
    v.geometry.view_plane = plane;
    v.geometry.orthographic = orthographic;
    stage("Preparing geometry");
    s.build_geometry(desc, progress);
    stage("Preparing lights");
    {
        const Stopwatch watch(s.stats.lights_seconds);
        s.build_lights(desc, [&] { stage("Preparing lights"); });
    }
    s.stats.image_bytes = s.images->memory_bytes();
    s.stats.light_bytes = s.lights->memory_bytes();
}

TraceableScene::~TraceableScene() = default;

const SceneView& TraceableScene::view() const { return impl_->view; }
const BuildStats& TraceableScene::stats() const { return impl_->stats; }

std::vector<std::string> TraceableScene::warnings() const {
    std::vector<std::string> all = impl_->warnings.messages();
    const auto& images = impl_->images->warnings();
    all.insert(all.end(), images.begin(), images.end());
    return all;
}

void TraceableScene::Impl::compile_graphs(const scene::SceneDesc& desc) {
    const auto compile = [&](const std::string& name, nodes::GraphKind kind, const scene::GraphDesc& graph,
                             Float3 fallback, scene::DisplacementMethod displacement = {}) {
        nodes::CompileContext context;
        context.name = name;
        context.kind = kind;
        context.attribute_names = &names.attributes;
        context.instance_value_names = &names.instance_values;
        context.displacement_method = displacement;
        context.images = images.get();
        context.fallback_color = fallback;
        graphs.push_back(nodes::compile(graph, context, warnings));
    };
    for (const auto& m : desc.materials) {
        compile(m.name, nodes::GraphKind::material, m.graph, m.viewport_color, m.displacement_method);
        use_transparent_shadow.push_back(m.use_transparent_shadow);
    }
    compile("default", nodes::GraphKind::material, {}, {0.8f, 0.8f, 0.8f});
    use_transparent_shadow.push_back(true);
    view.material_count = static_cast<int>(graphs.size());
    for (const auto& l : desc.lights) compile(l.name, nodes::GraphKind::light, l.graph, {1, 1, 1});
    view.world_program = static_cast<int>(graphs.size());
    const scene::WorldDesc world = desc.world.value_or(scene::WorldDesc{});
    compile(world.name, nodes::GraphKind::world, world.graph, world.color);

    materials.resize(graphs.size());
    for (std::size_t i = 0; i < graphs.size(); ++i) {
        MaterialView& m = materials[i];
        m.surface = &graphs[i].of(nodes::Purpose::surface);
        m.emission = &graphs[i].of(nodes::Purpose::emission);
        m.transparency = &graphs[i].of(nodes::Purpose::transparency);
        m.info = graphs[i].info;
        if (m.info.has_volume) m.volume = &graphs[i].of(nodes::Purpose::volume);
        const bool moves =
            i < desc.materials.size() && desc.materials[i].displacement_method != scene::DisplacementMethod::bump;
        if (moves && m.info.has_displacement) m.displacement = &graphs[i].of(nodes::Purpose::displacement);
        if (i < desc.materials.size()) {
            m.pass_index = desc.materials[i].pass_index;
            m.emission_sampled = desc.materials[i].sample_emission && m.info.has_emission;
        }
    }
    const nodes::ProgramInfo& w = materials.back().info;
    view.materials = materials.data();
    view.world_visibility = world.visibility;
    view.world_max_bounces = world.max_bounces;
    view.world_constant = w.emission_value;
    view.has_world = desc.world.has_value() && w.has_emission && !(w.constant_emission && is_black(w.emission_value));
}

void TraceableScene::Impl::build_geometry(const scene::SceneDesc& desc, const BuildProgress& progress) {
    {
        const Stopwatch watch(stats.geometry_seconds);
        const MeshVariants displaced = displaced_meshes(desc, names, view, materials, default_material(), [&] {
            if (progress("Displacing surfaces")) throw BuildCancelled{};
        });
        pool = std::make_unique<GeometryPool>(desc, names, default_material(), displaced);
        pool->fill(view);
    }
    if (progress("Building the ray tracing tree")) throw BuildCancelled{};
    const Stopwatch watch(stats.bvh_seconds);
    const auto has_transparency = [&](int instance) {
        const auto ids = pool->materials_of(instance);
        // A medium's surface is asked whatever the setting says, as in Cycles: light enters it.
        return std::any_of(ids.begin(), ids.end(), [&](int id) {
            const nodes::ProgramInfo& info = materials[id].info;
            return info.has_transparency && (use_transparent_shadow[id] || info.has_volume);
        });
    };
    const auto keep_going = [&] { return !progress("Building the ray tracing tree"); };
    embree = std::make_unique<EmbreeScene>(*pool, desc.settings.robust_intersection, has_transparency, keep_going);
    if (embree->cancelled()) throw BuildCancelled{};
    view.embree = embree->top();
    const auto& placed = pool->placed();
    for (std::size_t i = 0; i < placed.size(); ++i) {
        stats.triangles += pool->meshes()[placed[i].mesh].triangles;
        view.has_transparent_shadows = view.has_transparent_shadows || has_transparency(static_cast<int>(i));
        for (const int id : pool->materials_of(static_cast<int>(i)))
            view.has_volumes = view.has_volumes || materials[id].info.has_volume;
    }
    view.has_volumes = view.has_volumes || materials[view.world_program].info.has_volume;
    for (const auto& r : pool->meshes()) stats.unique_triangles += r.used ? r.triangles : 0;
    stats.instances = static_cast<std::int64_t>(placed.size());
    stats.embree_bytes = embree->memory_bytes();
    stats.geometry_bytes = pool->memory_bytes();
}

std::vector<light::LampInput> TraceableScene::Impl::lamp_inputs(const scene::SceneDesc& desc) const {
    std::vector<light::LampInput> lamps;
    for (std::size_t i = 0; i < desc.lights.size(); ++i) {
        light::LampInput lamp;
        lamp.desc = desc.lights[i];
        lamp.soft_falloff = desc.lights[i].soft_falloff;
        if (!lamp.desc.graph.empty()) {
            const int id = view.material_count + static_cast<int>(i);
            const nodes::ProgramInfo& info = materials[id].info;
            if (info.constant_emission || !info.has_emission) {
                lamp.desc.color = lamp.desc.color * info.emission_value;
            } else {
                lamp.program = id;
                lamp.program_estimate = info.emission_estimate;
            }
        }
        lamps.push_back(std::move(lamp));
    }
    return lamps;
}

std::vector<light::EmissiveTriangle> TraceableScene::Impl::emissive_triangles(const light::Checkpoint& checkpoint) {
    std::vector<light::EmissiveTriangle> list;
    const auto& placed = pool->placed();
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const int instance = static_cast<int>(i);
        const auto ids = pool->materials_of(instance);
        const auto shines = [&](int id) {
            const MaterialView& m = materials[id];
            return m.emission_sampled && !(m.info.constant_emission && is_black(m.info.emission_value));
        };
        if (std::none_of(ids.begin(), ids.end(), shines)) continue;
        const std::uint32_t count = pool->meshes()[placed[i].mesh].triangles;
        for (std::uint32_t t = 0; t < count; ++t) {
            if (t % 65536 == 0) checkpoint();
            const int id = pool->material(instance, t);
            if (!shines(id)) continue;
            const nodes::ProgramInfo& info = materials[id].info;
            Float3 corner[3];
            pool->world_triangle(instance, t, corner);
            light::EmissiveTriangle e;
            e.p0 = corner[0];
            e.p1 = corner[1];
            e.p2 = corner[2];
            e.radiance = info.constant_emission ? info.emission_value : info.emission_estimate;
            e.instance = instance;
            e.triangle = static_cast<std::int32_t>(t);
            e.program = info.constant_emission ? -1 : id;
            list.push_back(e);
        }
    }
    stats.emissive_triangles = static_cast<std::int64_t>(list.size());
    return list;
}

void TraceableScene::Impl::evaluate_world(int n, const Float3* directions, Float3* radiance) const {
    auto chunk = std::make_unique<nodes::ShadingChunk>();
    auto out = std::make_unique<nodes::SurfaceOutput>();
    auto scratch = std::make_unique<nodes::Scratch>();
    chunk->n = n;
    chunk->geometry = &view.geometry;
    for (int i = 0; i < k_chunk; ++i) {
        const Float3 d = directions[std::min(i, n - 1)];
        const float v[3] = {d.x, d.y, d.z};
        for (int c = 0; c < 3; ++c) {
            chunk->position[c][i] = v[c];
            chunk->wo[c][i] = chunk->normal[c][i] = chunk->normal_geometric[c][i] = -v[c];
        }
        chunk->instance[i] = -1;
        chunk->ray_flags[i] = nodes::ray_diffuse;
        chunk->ray_length[i] = 1e30f;
    }
    CD_ISA_NS::run_program(*materials[view.world_program].emission, *chunk, *out, *scratch);
    for (int i = 0; i < n; ++i) radiance[i] = {out->emission[0][i], out->emission[1][i], out->emission[2][i]};
}

void TraceableScene::Impl::build_lights(const scene::SceneDesc& desc, const light::Checkpoint& checkpoint) {
    const auto lamps = lamp_inputs(desc);
    const auto triangles = emissive_triangles(checkpoint);
    light::WorldInput world;
    if (view.has_world) {
        const nodes::ProgramInfo& info = materials[view.world_program].info;
        world.sampling = desc.world->sampling;
        world.map_resolution = desc.world->map_resolution;
        if (world.sampling == scene::WorldSampling::automatic) {
            world.map_resolution = 0;
            for (int i = 0; i < images->size(); ++i)
                world.map_resolution = std::max(world.map_resolution, images->width(i));
        }
        world.visibility = desc.world->visibility;
        world.max_bounces = desc.world->max_bounces;
        world.constant = info.constant_emission;
        world.color = info.emission_value;
        world.program = info.constant_emission ? -1 : view.world_program;
        world.eval = [this](int n, const Float3* d, Float3* r) { evaluate_world(n, d, r); };
    }
    const Box all = scene_bounds(*pool, [](int) { return true; });
    const Box casters = scene_bounds(*pool, [&](int instance) { return may_cast(instance); });
    view.has_casters = !casters.empty();
    light::PhotonTargets targets;
    targets.any_casters = view.has_casters;
    targets.casters_min = casters.low;
    targets.casters_max = casters.high;
    const Box bounds = all.empty() ? Box{{0, 0, 0}, {0, 0, 0}} : all;
    lights = std::make_unique<light::LightTable>(lamps, triangles, view.has_world ? &world : nullptr, bounds.low,
                                                 bounds.high, checkpoint, targets);
    view.lights = &lights->data();
    view.has_lights = !lights->empty();
    for (const auto& l : lamps) {
        view.lights_are_limited =
            view.lights_are_limited || is_limited(l.desc.visibility, l.desc.max_bounces, desc.settings.max_bounces);
    }
    if (desc.world) {
        view.lights_are_limited = view.lights_are_limited || is_limited(desc.world->visibility, desc.world->max_bounces,
                                                                        desc.settings.max_bounces);
    }
    view.is_limited = view.lights_are_limited;
    for (const PlacedMesh& p : pool->placed())
        view.is_limited = view.is_limited || is_limited(p.visibility, desc.settings.max_bounces, 0);
}

bool TraceableScene::Impl::may_cast(int instance) const {
    const float roughness = view.settings.caustic_roughness;
    const float alpha = std::max(roughness * roughness, bsdf::k_delta_alpha);
    const auto ids = pool->materials_of(instance);
    return std::any_of(ids.begin(), ids.end(), [&](int id) { return materials[id].info.least_alpha <= alpha; });
}

}  // namespace cardioid::trace
