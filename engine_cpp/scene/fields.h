// SPDX-License-Identifier: GPL-3.0-or-later
// The fields of every description struct, listed once: the reader, the writer and the list of known keys all walk
// these.
#pragma once

#include "scene/scene_desc.h"

#include <concepts>
#include <string_view>
#include <type_traits>
#include <utility>

namespace cardioid::scene {

template <class T, class Desc>
concept Of = std::same_as<std::remove_const_t<T>, Desc>;

/// Enumerator names, in order of value. `what` is how messages call the set.
template <class E>
struct EnumNames;
template <>
struct EnumNames<Domain> {
    static constexpr std::string_view names[] = {"point", "corner", "face"};
};
template <>
struct EnumNames<ImageSource> {
    static constexpr std::string_view names[] = {"file", "packed", "pixels"};
};
template <>
struct EnumNames<AlphaMode> {
    static constexpr std::string_view names[] = {"straight", "premultiplied", "channel_packed", "none"};
};
template <>
struct EnumNames<DisplacementMethod> {
    static constexpr std::string_view names[] = {"bump", "displacement", "both"};
};
template <>
struct EnumNames<LightKind> {
    static constexpr std::string_view names[] = {"point", "spot", "sun", "area"};
};
template <>
struct EnumNames<AreaShape> {
    static constexpr std::string_view names[] = {"square", "rectangle", "disk", "ellipse"};
};
template <>
struct EnumNames<WorldSampling> {
    static constexpr std::string_view names[] = {"none", "automatic", "manual"};
};
template <>
struct EnumNames<CameraKind> {
    static constexpr std::string_view names[] = {"perspective", "orthographic"};
};
template <>
struct EnumNames<IntegratorKind> {
    static constexpr std::string_view names[] = {"path_tracing", "hybrid", "photon_mapping"};
};
template <>
struct EnumNames<FastGi> {
    static constexpr std::string_view names[] = {"off", "replace", "add"};
};
template <>
struct EnumNames<IndirectCaustics> {
    static constexpr std::string_view names[] = {"photons", "path_tracing", "off"};
};
template <>
struct EnumNames<FilterMethod> {
    static constexpr std::string_view names[] = {"none", "clusters", "thesis", "cross_bilateral"};
};
template <>
struct EnumNames<RadiusSchedule> {
    static constexpr std::string_view names[] = {"memoryless", "per_pixel"};
};
template <>
struct EnumNames<PixelFilter> {
    static constexpr std::string_view names[] = {"box", "gaussian", "blackman_harris"};
};

/// What a message calls an object of the type, and whether it has a name.
template <class T>
inline constexpr std::string_view k_kind = "object";
template <>
inline constexpr std::string_view k_kind<AttributeDesc> = "attribute";
template <>
inline constexpr std::string_view k_kind<MeshDesc> = "mesh";
template <>
inline constexpr std::string_view k_kind<InstanceValueDesc> = "instance value";
template <>
inline constexpr std::string_view k_kind<InstanceDesc> = "instance";
template <>
inline constexpr std::string_view k_kind<GroupDesc> = "group";
template <>
inline constexpr std::string_view k_kind<ImageDesc> = "image";
template <>
inline constexpr std::string_view k_kind<MaterialDesc> = "material";
template <>
inline constexpr std::string_view k_kind<LightDesc> = "light";
template <>
inline constexpr std::string_view k_kind<WorldDesc> = "world";
template <>
inline constexpr std::string_view k_kind<CameraDesc> = "camera";
template <>
inline constexpr std::string_view k_kind<Settings> = "settings";
template <>
inline constexpr std::string_view k_kind<SceneDesc> = "scene";
template <>
inline constexpr std::string_view k_kind<NodeDesc> = "node";
template <>
inline constexpr std::string_view k_kind<GraphDesc> = "graph";

/// A vector that the scene file keeps as a raw block.
template <class T>
struct Bulk {
    T& values;
};

template <class V>
void fields(V& v, Of<AttributeDesc> auto& d) {
    v("name", d.name), v("domain", d.domain), v("channels", d.channels), v("data", Bulk{d.data});
}

template <class V>
void fields(V& v, Of<MeshDesc> auto& d) {
    v("name", d.name), v("positions", Bulk{d.positions}), v("triangles", Bulk{d.triangles}), v("slots", Bulk{d.slots});
    v("corner_normals", Bulk{d.corner_normals}), v("attributes", d.attributes), v("active_uv", d.active_uv);
    v("active_color", d.active_color), v("generated_min", d.generated_min), v("generated_size", d.generated_size);
    v("edges", Bulk{d.edges});
}

template <class V>
void fields(V& v, Of<InstanceValueDesc> auto& d) {
    v("name", d.name), v("value", d.value);
}

template <class V>
void fields(V& v, Of<InstanceDesc> auto& d) {
    v("name", d.name), v("mesh", d.mesh), v("group", d.group), v("transform", d.transform), v("materials", d.materials);
    v("visibility", d.visibility), v("holdout", d.holdout), v("pass_index", d.pass_index), v("random", d.random);
    v("color", d.color), v("dupli_generated", d.dupli_generated), v("dupli_uv", d.dupli_uv);
    v("terminator_geometry", d.terminator_geometry), v("terminator_shading", d.terminator_shading);
    v("values", d.values);
}

template <class V>
void fields(V& v, Of<GroupDesc> auto& d) {
    v("name", d.name), v("instances", d.instances);
}

template <class V>
void fields(V& v, Of<ImageDesc> auto& d) {
    v("name", d.name), v("source", d.source), v("path", d.path), v("packed", Bulk{d.packed}), v("width", d.width);
    v("height", d.height), v("channels", d.channels), v("pixels", Bulk{d.pixels}), v("colorspace", d.colorspace);
    v("alpha_mode", d.alpha_mode);
}

template <class V>
void fields(V& v, Of<NodeDesc> auto& d) {
    v("name", d.name), v("type", d.type), v("params", d.params), v("inputs", d.inputs);
}

template <class V>
void fields(V& v, Of<GraphDesc> auto& d) {
    v("nodes", d.nodes), v("surface", d.surface), v("volume", d.volume), v("displacement", d.displacement);
}

template <class V>
void fields(V& v, Of<MaterialDesc> auto& d) {
    v("name", d.name), v("graph", d.graph), v("viewport_color", d.viewport_color), v("metallic", d.metallic);
    v("roughness", d.roughness), v("use_transparent_shadow", d.use_transparent_shadow);
    v("sample_emission", d.sample_emission), v("pass_index", d.pass_index);
    v("displacement_method", d.displacement_method);
}

template <class V>
void fields(V& v, Of<LightDesc> auto& d) {
    v("name", d.name), v("kind", d.kind), v("transform", d.transform), v("color", d.color), v("energy", d.energy);
    v("radius", d.radius), v("spot_angle", d.spot_angle), v("spot_blend", d.spot_blend), v("angle", d.angle);
    v("shape", d.shape), v("size_x", d.size_x), v("size_y", d.size_y), v("spread", d.spread);
    v("cast_shadow", d.cast_shadow), v("use_mis", d.use_mis), v("legacy_lamp", d.legacy_lamp),
        v("soft_falloff", d.soft_falloff);
    v("normalize", d.normalize), v("max_bounces", d.max_bounces), v("visibility", d.visibility);
    v("portal", d.portal), v("object_space", d.object_space), v("random", d.random), v("graph", d.graph);
}

template <class V>
void fields(V& v, Of<WorldDesc> auto& d) {
    v("name", d.name), v("graph", d.graph), v("color", d.color), v("sampling", d.sampling);
    v("map_resolution", d.map_resolution), v("visibility", d.visibility), v("max_bounces", d.max_bounces);
}

template <class V>
void fields(V& v, Of<CameraDesc> auto& d) {
    v("name", d.name), v("kind", d.kind), v("transform", d.transform), v("view_plane", d.view_plane);
    v("clip_start", d.clip_start), v("clip_end", d.clip_end), v("aperture_radius", d.aperture_radius);
    v("focus_distance", d.focus_distance), v("blades", d.blades), v("blade_rotation", d.blade_rotation);
    v("aperture_ratio", d.aperture_ratio);
}

template <class V>
void fields(V& v, Of<FilterSettings> auto& d) {
    v("use_filter", d.use_filter), v("filter_method", d.filter_method), v("firefly_density", d.firefly_density);
    v("luminance_sensitivity", d.luminance_sensitivity), v("filter_size", d.filter_size);
    v("filter_direct", d.filter_direct), v("filter_indirect", d.filter_indirect), v("filter_deep", d.filter_deep);
    v("texture_width", d.texture_width);
}

template <class V>
void fields(V& v, Of<Settings> auto& d) {
    v("integrator", d.integrator), v("width", d.width), v("height", d.height), v("crop", d.crop);
    v("samples", d.samples), v("first_sample", d.first_sample), v("time_limit", d.time_limit), v("threads", d.threads);
    v("seed", d.seed), v("max_bounces", d.max_bounces), v("max_diffuse_bounces", d.max_diffuse_bounces);
    v("max_glossy_bounces", d.max_glossy_bounces), v("max_transmission_bounces", d.max_transmission_bounces);
    v("max_transparent_bounces", d.max_transparent_bounces);
    v("max_volume_bounces", d.max_volume_bounces), v("clamp_direct", d.clamp_direct);
    v("clamp_indirect", d.clamp_indirect), v("reflective_caustics", d.reflective_caustics);
    v("refractive_caustics", d.refractive_caustics), v("filter_glossy", d.filter_glossy);
    v("fast_gi", d.fast_gi), v("fast_gi_bounces", d.fast_gi_bounces), v("fast_gi_factor", d.fast_gi_factor);
    v("fast_gi_distance", d.fast_gi_distance);
    v("caustic_roughness", d.caustic_roughness), v("indirect_caustics", d.indirect_caustics);
    v("photons", d.photons), v("photon_radius", d.photon_radius), v("radius_shrink", d.radius_shrink);
    v("radius_schedule", d.radius_schedule), v("guided_emission", d.guided_emission);
    v("blend_caustic_hits", d.blend_caustic_hits), v("physical_refraction", d.physical_refraction);
    v("adaptive_threshold", d.adaptive_threshold), v("adaptive_min_samples", d.adaptive_min_samples);
    v("record_clusters", d.record_clusters);
    fields(v, d.filter);
    v("pixel_filter", d.pixel_filter), v("filter_width", d.filter_width);
    v("exposure", d.exposure), v("transparent_film", d.transparent_film), v("transparent_glass", d.transparent_glass);
    v("transparent_roughness", d.transparent_roughness), v("robust_intersection", d.robust_intersection);
    v("memory_limit", d.memory_limit);
    v("texture_cache_mb", d.texture_cache_mb), v("ocio_config", d.ocio_config);
}

template <class V>
void fields(V& v, Of<SceneDesc> auto& d) {
    v("images", d.images), v("materials", d.materials), v("meshes", d.meshes), v("groups", d.groups);
    v("instances", d.instances), v("lights", d.lights), v("world", d.world), v("camera", d.camera);
    v("settings", d.settings);
}

}  // namespace cardioid::scene
