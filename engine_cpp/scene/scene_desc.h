// SPDX-License-Identifier: GPL-3.0-or-later
// SceneDesc: everything that the engine is told, as plain named values. It knows nothing of Blender's memory, is saved
// to and loaded from one file (scene_file.h), and is validated on entry (validate.h). Lengths in scene units (metres),
// angles in radians, colours scene-linear, lamps in Blender's units (watts; W/m² for the sun).
#pragma once

#include "math/types.h"
#include "scene/filter_settings.h"
#include "scene/graph_desc.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cardioid::scene {

/// Kinds of ray that an object or lamp can be hidden from; bits of a visibility mask.
enum Visibility : std::uint8_t {
    visible_camera = 1,
    visible_diffuse = 2,
    visible_glossy = 4,
    visible_transmission = 8,
    visible_volume = 16,
    visible_shadow = 32,
    visible_all = 63,
};

enum class Domain : std::uint8_t { point, corner, face };

/// A named layer of a mesh: `channels` floats for each element of the domain (corner: 3 per triangle).
struct AttributeDesc {
    std::string name;
    Domain domain = Domain::corner;
    int channels = 2;
    std::vector<float> data;
};

struct MeshDesc {
    std::string name;
    std::vector<float> positions;           ///< xyz per vertex, object space
    std::vector<std::uint32_t> triangles;   ///< three vertex indices each
    std::vector<std::int32_t> slots;        ///< material slot per triangle; empty: all 0
    std::vector<float> corner_normals;      ///< xyz per corner; empty: flat shading
    std::vector<std::uint32_t> edges;       ///< two vertices each, in the host's order; empty: triangles' sides
    std::vector<AttributeDesc> attributes;  ///< UV maps (2 channels), colours (4), …
    std::string active_uv;                  ///< render-active UV map, may be empty
    std::string active_color;               ///< render-active colour attribute, may be empty
    Float3 generated_min{0, 0, 0}, generated_size{1, 1, 1};  ///< texture space box for Generated coordinates
};

/// A number, vector or colour that nodes read by name from an instance: "object:NAME" and "instancer:NAME" for Attribute nodes of
/// those types, "particle:index|random|age|lifetime|size|location|velocity|angular_velocity" for Particle Info. `value` is as
/// Blender's attribute gives it: a number is (v, v, v, 1), a vector (x, y, z, 1).
struct InstanceValueDesc {
    std::string name;
    std::array<float, 4> value{0, 0, 0, 1};
};

/// A placed mesh, or a placed group (then `mesh` is -1).
struct InstanceDesc {
    std::string name;  ///< the object's name, used in messages
    int mesh = -1;
    int group = -1;
    Affine transform;
    std::vector<int> materials;  ///< SceneDesc::materials index per slot; -1: the default grey
    std::uint8_t visibility = visible_all;
    bool holdout = false;
    int pass_index = 0;
    float random = 0;                        ///< [0,1), Object Info ▸ Random
    std::array<float, 4> color{1, 1, 1, 1};  ///< Object Info ▸ Color
    Float3 dupli_generated{0, 0, 0};
    std::array<float, 2> dupli_uv{0, 0};
    float terminator_geometry = 0;  ///< smooth meshes: shadow rays near the terminator start off the faces, [0,1]
    float terminator_shading = 0;   ///< shadows begin before the light is at the horizon, [0,1]
    std::vector<InstanceValueDesc> values;  ///< those that some material reads
};

/// A collection that is placed as a whole; groups may contain groups, loops are an error.
struct GroupDesc {
    std::string name;
    std::vector<InstanceDesc> instances;
};

enum class ImageSource : std::uint8_t { file, packed, pixels };
enum class AlphaMode : std::uint8_t { straight, premultiplied, channel_packed, none };

struct ImageDesc {
    std::string name;
    ImageSource source = ImageSource::file;
    std::string path;                         ///< file: absolute path
    std::vector<std::uint8_t> packed;         ///< packed: the bytes of the image file
    int width = 0, height = 0, channels = 0;  ///< pixels: float, bottom row first
    std::vector<float> pixels;
    std::string colorspace = "sRGB";  ///< a name in the colour configuration
    AlphaMode alpha_mode = AlphaMode::straight;
};

/// What the displacement output does: turns shading normals, moves the vertices, or moves them and turns normals by what the mesh
/// is too coarse for.
enum class DisplacementMethod : std::uint8_t { bump, displacement, both };

struct MaterialDesc {
    std::string name;
    GraphDesc graph;                          ///< empty: the default grey of Blender
    Float3 viewport_color{0.8f, 0.8f, 0.8f};  ///< colour, metallic and roughness when the material has no nodes
    float metallic = 0, roughness = 0.4f;
    bool use_transparent_shadow = true;
    bool sample_emission = true;  ///< false: emission is found by hits only
    int pass_index = 0;
    DisplacementMethod displacement_method = DisplacementMethod::bump;
};

enum class LightKind : std::uint8_t { point, spot, sun, area };
enum class AreaShape : std::uint8_t { square, rectangle, disk, ellipse };

struct LightDesc {
    std::string name;
    LightKind kind = LightKind::point;
    Affine transform;  ///< points along its -z
    Float3 color{1, 1, 1};
    float energy = 0;               ///< W; sun: W/m². May be negative, as in Blender
    float radius = 0;               ///< point and spot
    float spot_angle = 0.7853982f;  ///< full cone angle
    float spot_blend = 0.15f;
    float angle = 0.00918f;  ///< sun: full angle of the disk
    AreaShape shape = AreaShape::square;
    float size_x = 1, size_y = 1;
    float spread = 3.14159265f;  ///< area: full angle
    bool cast_shadow = true;
    bool use_mis = true;
    bool legacy_lamp = false;   ///< sizes and units as in Blender before 4.0 (see light/README)
    bool soft_falloff = false;  ///< point and spot since 4.1: a disk that faces the receiver instead of a sphere
    bool normalize = true;      ///< false: energy is per area
    int max_bounces = 1024;
    std::uint8_t visibility = visible_all & ~visible_camera;
    bool portal = false;
    bool object_space =
        false;  ///< nodes see the lamp as an object (Blender 4.5 and newer); false: only normals are in its space
    float random = 0;  ///< [0,1), Object Info ▸ Random
    GraphDesc graph;   ///< empty: colour × energy alone
};

enum class WorldSampling : std::uint8_t { none, automatic, manual };

struct WorldDesc {
    std::string name;
    GraphDesc graph;  ///< empty: `color`
    Float3 color{0, 0, 0};
    WorldSampling sampling = WorldSampling::automatic;
    int map_resolution = 1024;
    std::uint8_t visibility = visible_all;
    int max_bounces = 1024;
};

enum class CameraKind : std::uint8_t { perspective, orthographic };

/// Looks along -z of `transform`. The view plane is at distance 1 (perspective) or in scene units (orthographic), for
/// the whole frame; lens shift, sensor fit and pixel aspect are in it already.
struct CameraDesc {
    std::string name;
    CameraKind kind = CameraKind::perspective;
    Affine transform;
    std::array<float, 4> view_plane{-0.5f, 0.5f, -0.5f, 0.5f};  ///< left, right, bottom, top
    float clip_start = 0.1f, clip_end = 1000;                   ///< distances along the view axis
    float aperture_radius = 0;                                  ///< 0: pinhole
    float focus_distance = 10;
    int blades = 0;  ///< under 3: round
    float blade_rotation = 0;
    float aperture_ratio = 1;  ///< anamorphic bokeh: > 1 squeezes horizontally
};

/// Which of the path classes D1…C2 camera paths estimate, and which photons do (spec 2).
enum class IntegratorKind : std::uint8_t {
    path_tracing,    ///< PT: camera paths all
    hybrid,          ///< PTPPM: camera paths D1, D2, D3; photons C1, C2
    photon_mapping,  ///< SPPM: camera paths D1; photons the rest
};
enum class IndirectCaustics : std::uint8_t { photons, path_tracing, off };  ///< C2 in the hybrid
enum class RadiusSchedule : std::uint8_t {
    memoryless,  ///< by the number of the pass alone (Knaus & Zwicker 2011)
    per_pixel,   ///< by the photons that each pixel has found (thesis 5.2–5.5)
};
/// Cycles' Fast GI: bounced light is replaced by what short rays see of the sky, or such light is added.
enum class FastGi : std::uint8_t { off, replace, add };
enum class PixelFilter : std::uint8_t { box, gaussian, blackman_harris };

struct Settings {
    IntegratorKind integrator = IntegratorKind::path_tracing;
    int width = 512, height = 512;        ///< pixels of the whole frame
    std::array<int, 4> crop{0, 0, 0, 0};  ///< x, y, width, height from the bottom left; zeros: all
    int samples = 64;                     ///< camera paths a pixel, >= 1
    int first_sample = 0;                 ///< passes are independent: a frame can be split by sample range
    float time_limit = 0;                 ///< seconds; 0: none
    int threads = 0;                      ///< 0: all
    std::uint32_t seed = 0;
    int max_bounces = 12;
    int max_diffuse_bounces = 4, max_glossy_bounces = 4, max_transmission_bounces = 12;
    int max_transparent_bounces = 8;
    int max_volume_bounces = 0;                  ///< scatterings in media; 0: each path may scatter once, as in Cycles
    float clamp_direct = 0, clamp_indirect = 0;  ///< 0: off
    bool reflective_caustics = true, refractive_caustics = true;
    float filter_glossy = 0;
    FastGi fast_gi = FastGi::off;
    int fast_gi_bounces = 1;      ///< replace: bounces that are traced in full, at least 1
    float fast_gi_factor = 1;     ///< replace: of the world's light after them; add: of the white light that is added
    float fast_gi_distance = 10;  ///< how far their rays go
    float caustic_roughness = 0.1f;  ///< lobes at or under it are class S; path tracing alone takes 0
    IndirectCaustics indirect_caustics = IndirectCaustics::path_tracing;
    std::int64_t photons = 0;  ///< emitted for each sample of the whole frame; 0: by the number of pixels and balance
    float photon_radius = 1;   ///< first radius of a gather, in footprints of a pixel
    float radius_shrink = 0.6666667f;  ///< alpha in (0, 1]: the smaller, the faster radii shrink; 1: never
    RadiusSchedule radius_schedule = RadiusSchedule::memoryless;
    bool guided_emission = true;       ///< photons learn in the first passes where they are needed
    bool blend_caustic_hits = true;    ///< camera paths that meet a lamp through D S+ count too, weighted by MIS
    float adaptive_threshold = 0;      ///< noise at which a pixel needs no more samples, as in Cycles; 0: all get all
    int adaptive_min_samples = 0;      ///< that every pixel gets; 0: by the threshold
    bool record_clusters = true;       ///< keep what the filter needs, so that it can be used after the render
    FilterSettings filter;             ///< its names stand beside these in files
    bool physical_refraction = false;  ///< radiance scaled by eta² in denser media; false: as Cycles, where it is not
    PixelFilter pixel_filter = PixelFilter::blackman_harris;
    float filter_width = 1.5f;  ///< pixels
    float exposure = 1;
    bool transparent_film = false;
    bool transparent_glass = false;
    float transparent_roughness = 0.1f;
    bool robust_intersection = false;
    std::int64_t memory_limit = 0;  ///< bytes for film and geometry; 0: the machine's memory
    int texture_cache_mb = 1024;
    std::string ocio_config;  ///< path; empty: built-in standard spaces
};

struct SceneDesc {
    std::vector<ImageDesc> images;
    std::vector<MaterialDesc> materials;
    std::vector<MeshDesc> meshes;
    std::vector<GroupDesc> groups;
    std::vector<InstanceDesc> instances;
    std::vector<LightDesc> lights;
    std::optional<WorldDesc> world;
    std::optional<CameraDesc> camera;
    Settings settings;
};

}  // namespace cardioid::scene
