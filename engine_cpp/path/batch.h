// SPDX-License-Identifier: GPL-3.0-or-later
// A batch: up to 1024 camera paths that are advanced bounce by bounce by one thread. Plain arrays, the same for every lane
// width, so that the kernels of all widths share one scratch.
#pragma once

#include "math/types.h"
#include "nodes/run.h"
#include "nodes/shading.h"
#include "path/media_queue.h"
#include "path/partition.h"
#include "path/subsurface_queue.h"
#include "photon/photon.h"
#include "photon/radius.h"
#include "trace/scene_view.h"

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace cardioid::photon {
class PhotonGuide;
}

namespace cardioid::path {

inline constexpr int k_batch = 1024;
/// Layers of incident light: straight from a lamp, scattered once, scattered more often before x_d (film/cluster.h).
inline constexpr int k_layers = 3;
/// Arrays are padded so that a full-width store at the last element stays inside.
inline constexpr int k_padded = k_batch + 64;

using PathFloats = float[k_padded];
using PathInts = std::int32_t[k_padded];

/// Rays in flight, one entry per live path, stored by field.
struct alignas(64) RayState {
    int n = 0;
    PathFloats origin[3], direction[3];
    PathFloats t_min;  ///< grows when the ray passes a transparent surface
    PathFloats throughput[3];
    PathFloats pdf;             ///< density of the direction for MIS; -1: delta or camera, nothing to weigh against
    PathFloats from_normal[3];  ///< normal at the origin, zero where light from all sides counts
    PathFloats width, spread;   ///< of the pixel's cone: width at the origin, growth per unit length
    PathFloats min_pdf;         ///< least density so far (Filter Glossy); photons: flux at birth
    PathFloats merge;  ///< after x_d: density of its direction per projected sr / (pi r²); photons: of the emission
    PathInts path;     ///< index in the batch
    PathInts flags;    ///< nodes::RayFlag | state << k_state_shift | bits below; photons: PhotonState
    PathInts depth;    ///< bounces: total | diffuse << 8 | glossy << 16 | transmission << 24
    PathInts transparent;  ///< transparent surfaces passed | bounds of media passed << 16 | scatterings in media << 24
    /// Media that the ray is in (path/media.h); with SceneView::has_volumes only.
    PathInts media_instance[k_media], media_material[k_media];
};
inline constexpr int k_state_shift = 8;
/// Camera paths: scatterings since x_d, x_d included, at most k_layers; 0 before it.
inline constexpr int k_layer_shift = 14;
inline constexpr std::int32_t k_flag_last = 1 << 12;        ///< only emission counts at the next surface
inline constexpr std::int32_t k_flag_background = 1 << 13;  ///< nothing but transparency since the camera
inline constexpr std::int32_t k_flag_after_diffuse =
    1 << 24;  ///< some bounce was diffuse: no walks under surfaces any more
/// Photons: scene::Visibility bits of what the segment came from; lobes at its far end that it is hidden from do not see it.
inline constexpr int k_visibility_shift = 16;

/// Closest hits of RayState's rays.
struct alignas(64) HitState {
    PathFloats t, u, v, ng[3];
    PathInts triangle, instance;
    PathInts material;  ///< SceneView::material_count: missed; -1: the ray ended in a medium before
};

/// Vertices of one material at one bounce: the record from which direct light is evaluated once paths are built.
struct alignas(64) VertexChunk {
    VertexChunk* next = nullptr;
    int n = 0, lobes = 0;
    bool own_normals = false;            ///< lobes may have normals of their own (bump, normal maps)
    bool ggx_bump_shadow = false;        ///< ProgramInfo's
    bool all_sides = false;              ///< light from below the smooth normal's horizon counts: transmission, bump
    bool dark_glass_reflection = false;  ///< glass reflects nothing to paths that come from a diffuse bounce
    bool narrows = false;                ///< `narrowing` is there
    bsdf::Lobe* lobe = nullptr;          ///< `lobes` of them
    Row* pick = nullptr;                 ///< probability of each lobe, `lobes` rows
    MediaRecord* media = nullptr;        ///< around the vertices; with SceneView::has_volumes only
    MediumRecord* medium = nullptr;      ///< the vertices are in a medium: no lobes, no normals
    bool boundary = false;               ///< the surface is nothing but the bounds of a medium
    Row position[3], normal_geometric[3], normal[3], wo[3], throughput[3], distance;
    Row gather;     ///< 1 / probability of the D lobes where the path took one for the first time (x_d), otherwise 0
    Row radius;     ///< of the gather
    Row narrowing;  ///< angles to the light count as this many times larger (Shadow Terminator, Shading)
    Row barycentric_u, barycentric_v;  ///< with SceneView::lifts_shadow_rays, as the two rows that follow
    std::int32_t instance[k_chunk];    ///< -1: shadow rays start at the position
    std::int32_t triangle[k_chunk];
    std::int32_t path[k_chunk];
    std::int32_t flags[k_chunk];  ///< as RayState, of the arriving ray
    std::int32_t depth[k_chunk];
    std::int32_t event[k_chunk];  ///< bounces + transparent surfaces: index of the random dimensions
};

using Subsurface = SubsurfaceQueue<k_padded>;
using SubsurfaceExit = SubsurfaceExits<k_padded>;
using Scatterings = ScatterQueue<k_padded>;

/// Shadow rays that wait for full packets.
struct alignas(64) ShadowQueue {
    static constexpr int capacity = 1024;
    int n = 0;
    PathFloats origin[3], direction[3], t_max, radiance[3];
    PathFloats incident[3];  ///< I, where layers are wanted
    PathInts path, path_class, layer;
    PathInts media_instance[k_media], media_material[k_media];  ///< with SceneView::has_volumes only
};

/// Of scene-linear Rec.709.
constexpr float luminance(float r, float g, float b) { return 0.2126f * r + 0.7152f * g + 0.0722f * b; }

/// Light by path.
struct alignas(64) LightSums {
    PathFloats radiance[k_classes][3];
    // With BatchRequest::layers only:
    PathFloats unfiltered[3];  ///< the part of the radiance that is in no layer: D1 and photons
    /// R and I of the layers of incident light (film/cluster.h).
    PathFloats layer_radiance[k_layers][3], layer_incident[k_layers][3];
};

/// What a batch found, by path.
struct alignas(64) BatchResult : LightSums {
    int n = 0;
    PathFloats alpha;             ///< share of the camera ray that something stopped
    PathFloats depth, normal[3];  ///< at the first surface; depth 1e10 where there is none
    // With BatchRequest::layers only, as what follows.
    PathFloats detail[3];  ///< albedo of the D lobes at x_d × throughput before it
    PathFloats feature_normal[3], feature_depth, feature_depth_squared;  ///< at x_d, × luminance(detail)
    PathFloats mirrored_detail[3];  ///< the part of `detail` that lies behind specular lobes
    PathFloats caustic_hits;        ///< luminance of C1 as if camera paths alone brought it; with photons only
    PathInts x, y, sample;          ///< pixel in the frame and number of the sample
};

/// Counted facts; the sums over threads go to the statistics.
struct Counters {
    std::uint64_t camera_paths = 0, rays = 0, shadow_rays = 0, vertices = 0, light_samples = 0, lobes_dropped = 0;
    std::uint64_t gathers = 0, gathered = 0,
                  evaluated = 0;  ///< hit points; photons that they found; those that were evaluated
    std::uint64_t photon_rays = 0, photons_dropped = 0;  ///< dropped: flux that was not finite
    void add(const Counters& o) {
        camera_paths += o.camera_paths;
        rays += o.rays;
        shadow_rays += o.shadow_rays;
        vertices += o.vertices;
        light_samples += o.light_samples;
        lobes_dropped += o.lobes_dropped;
        gathers += o.gathers;
        gathered += o.gathered;
        evaluated += o.evaluated;
        photon_rays += o.photon_rays;
        photons_dropped += o.photons_dropped;
    }
};

/// The photons of a pass, as its camera paths gather them.
struct PhotonPass {
    photon::PhotonMapView map;
    float emitted = 0;  ///< photons of the pass, stored or not
    float per_path =
        0;  ///< the same by camera paths of a pixel: all of them see the same photons, so these weigh against one path
    float radius = 2;  ///< of this pass, in footprints of a pixel
    /// Per emitter: how dense its photons are, a factor of light/emit.h's densities (MIS of hits on lamps).
    const float* emitter_density = nullptr;
    std::atomic<std::uint32_t>* gathered = nullptr;  ///< counts gathers of each photon of the map; null: not wanted
    /// Per-pixel schedule: statistics of the frame's rendered part, rows of `stride` from (x, y). Null: memoryless.
    photon::PixelStatistics* pixels = nullptr;
    int x = 0, y = 0, stride = 0;
    int sample = 0;   ///< per-pixel schedule: the sample of the pass that gathers
    float alpha = 1;  ///< per-pixel schedule
};

/// Photons [first, first + count) of a pass, at most k_batch.
struct PhotonRequest {
    const trace::SceneView* scene = nullptr;
    const photon::PhotonGuide* guide = nullptr;
    const float* emitter_density = nullptr;  ///< as PhotonPass
    ClassSet classes = 0;                    ///< what is stored
    std::uint32_t first = 0;
    int count = 0;
    std::uint32_t seed = 0;            ///< of the pass
    photon::Photon* stored = nullptr;  ///< room for k_batch × (Settings::max_bounces + 1)
};

/// Pixels [x, x+width) × [y, y+height) with samples [first_sample, first_sample+samples) each; at most k_batch paths.
struct BatchRequest {
    const trace::SceneView* scene = nullptr;
    const float* filter_table = nullptr;  ///< film/pixel_filter.h: offsets in pixels by quantile
    int x = 0, y = 0, width = 0, height = 0;
    int first_sample = 0, samples = 1;
    std::uint32_t seed = 0;
    Partition partition;
    const PhotonPass* photons = nullptr;  ///< null: nothing is gathered
    bool layers = false;                  ///< incident light in layers is wanted
    /// Which pixels are traced, width × height from the bottom left; null: all.
    const std::uint8_t* active = nullptr;
};

/// Photons that the vertices of one packet have found: lists by lane. Where there are more, every second one is dropped, as often
/// as it takes: at a focus thousands would be found.
struct alignas(64) GatherLists {
    static constexpr int capacity = 256;
    std::int32_t photon[capacity][16];
    std::int32_t n[16];
    std::int32_t stride[16];  ///< what each photon of the list stands for
};

/// Fixed memory for records; when it is full, direct light is evaluated early.
class Arena {
public:
    static constexpr std::size_t capacity = std::size_t{6} << 20;
    template <class T>
    T* allocate(std::size_t count) {
        const std::size_t bytes = (count * sizeof(T) + 63) & ~std::size_t{63};
        if (used_ + bytes > capacity) return nullptr;
        T* p = reinterpret_cast<T*>(memory_ + used_);
        used_ += bytes;
        return p;
    }
    std::size_t mark() const { return used_; }
    void reset(std::size_t mark = 0) { used_ = mark; }

private:
    std::size_t used_ = 0;
    alignas(64) unsigned char memory_[capacity];
};

/// One vertex of a path that is watched (cardioid-render --pixel).
struct LoggedVertex {
    int path, material, instance, triangle;
    std::int32_t flags, depth;  ///< of the arriving ray, as in RayState
    float position[3], normal[3], throughput[3];
    float distance;
    int lobes;
    float pick[bsdf::k_max_lobes];  ///< probability of each lobe
    bsdf::LobeKind kind[bsdf::k_max_lobes];
};

/// Where to write the vertices of a batch; more than `capacity` are dropped.
struct PathLog {
    LoggedVertex* vertex = nullptr;
    int capacity = 0, n = 0;
};

/// Rays that a batch handed to Embree, for a loop that traces nothing else (bench/cpp/embree_loop.cpp). Packets of the lane
/// width follow each other; a packet's unused lanes have t_max < t_min.
struct RayLog {
    float* field[8] = {};  ///< origin xyz, direction xyz, t_min, t_max; `capacity` floats each
    std::int32_t* mask = nullptr;
    std::uint8_t* kind = nullptr;  ///< RayKind per ray
    std::size_t capacity = 0, n = 0;
};
enum RayKind : std::uint8_t { ray_kind_coherent, ray_kind_bounce, ray_kind_shadow };

/// All memory of one thread; nothing is allocated while tracing.
struct alignas(64) Scratch {
    RayState rays[2];
    HitState hits;
    Arena arena;
    VertexChunk* first_chunk = nullptr;
    VertexChunk** last_chunk = nullptr;
    ShadowQueue shadows;
    nodes::ShadingChunk shading;
    nodes::SurfaceOutput surface;
    nodes::Scratch registers;
    nodes::RayService node_rays;  ///< of the scene that is traced
    PathInts order;               ///< paths sorted by material
    Subsurface walks, disks;
    SubsurfaceExit exits;
    Scatterings scatterings;
    nodes::VolumeOutput medium;
    GatherLists gather;
    PathFloats demodulation[3];         ///< by path: I over R of what arrives at x_d along the sampled direction
    PathInts pixel_seed, sample_index;  ///< by path; sample numbers with their bits reversed, as sample_pair wants them
    std::int32_t* bins = nullptr;       ///< material_count + 2 counters, owned by the caller
    /// What rays met by themselves, apart from what was sought: when the record overflows that comes early, and sums must not
    /// depend on it.
    LightSums met;
    Counters counters;
    const std::atomic<bool>* cancelled = nullptr;
    PathLog* log = nullptr;
    RayLog* ray_log = nullptr;
};

/// Traces the batch; with width 1, 8 or 16 lanes.
using TraceBatch = void (*)(const BatchRequest&, Scratch&, BatchResult&);
/// Traces photons; returns how many it stored.
using TracePhotons = int (*)(const PhotonRequest&, Scratch&);
/// Traces the logged packets again with the same Embree calls and nothing else; returns how many rays hit something.
using ReplayRays = std::uint64_t (*)(RTCSceneTy* scene, const RayLog& log);
ReplayRays select_replay_rays(int width = 0);
/// The kernels for this machine; `width` 0 picks the widest that it can run, otherwise that width (tests).
TraceBatch select_trace_batch(int width = 0);
TracePhotons select_trace_photons(int width = 0);
/// Widest lanes that the processor can run: 1, 8 or 16.
int best_width();

}  // namespace cardioid::path
