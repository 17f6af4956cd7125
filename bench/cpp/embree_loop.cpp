// SPDX-License-Identifier: GPL-3.0-or-later
// How fast the whole engine is beside a bare Embree loop: renders a scene file with one thread, keeps every ray that it handed
// to Embree, and traces the same packets again with nothing around. Prints a JSON object; times are CPU seconds of this thread.
#include "film/pixel_filter.h"
#include "path/batch.h"
#include "render/tiles.h"
#include "scene/scene_file.h"
#include "scene/validate.h"
#include "simd/denormals.h"
#include "trace/traceable_scene.h"

#include <nlohmann/json.hpp>

#include <ctime>
#include <iostream>
#include <memory>
#include <vector>

namespace {

using namespace cardioid;

double cpu_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Memory of a ray log of one batch.
struct Recording {
    static constexpr std::size_t capacity = std::size_t{1} << 18;
    std::vector<float> floats = std::vector<float>(8 * capacity);
    std::vector<std::int32_t> mask = std::vector<std::int32_t>(capacity);
    std::vector<std::uint8_t> kind = std::vector<std::uint8_t>(capacity);
    path::RayLog log;
    Recording() {
        for (std::size_t f = 0; f < 8; ++f) log.field[f] = floats.data() + f * capacity;
        log.mask = mask.data();
        log.kind = kind.data();
        log.capacity = capacity;
    }
};

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::cerr << "usage: embree_loop SCENE\n";
        return 2;
    }
    scene::SceneDesc desc = scene::load_scene(argv[1]);
    if (scene::has_errors(scene::validate(desc))) {
        std::cerr << "the scene cannot be rendered\n";
        return 1;
    }
    const FlushDenormals guard;
    const trace::TraceableScene scene(desc, [](const std::string&) { return false; });
    const auto filter = film::make_filter_table(desc.settings.pixel_filter, desc.settings.filter_width);
    auto scratch = std::make_unique<path::Scratch>();
    auto result = std::make_unique<path::BatchResult>();
    std::vector<std::int32_t> bins(static_cast<std::size_t>(scene.view().material_count) + 3);
    scratch->bins = bins.data();
    Recording recording;
    const auto trace_batch = path::select_trace_batch();
    const auto replay = path::select_replay_rays();
    constexpr int k_samples = 8;
    double engine = 0, bare = 0;
    std::uint64_t hits = 0;
    const auto tiles = render::tiles(film::crop_region(desc.settings), k_samples);
    for (const auto& tile : tiles) {
        path::BatchRequest request;
        request.scene = &scene.view();
        request.filter_table = filter.data();
        request.x = tile.x, request.y = tile.y, request.width = tile.width, request.height = tile.height;
        request.samples = k_samples;
        // The recorded run costs more than a plain one: it is not timed.
        recording.log.n = 0;
        const path::Counters before = scratch->counters;
        scratch->ray_log = &recording.log;
        trace_batch(request, *scratch, *result);
        scratch->ray_log = nullptr;
        scratch->counters = before;
        const double t0 = cpu_seconds();
        trace_batch(request, *scratch, *result);
        const double t1 = cpu_seconds();
        hits += replay(scene.view().embree, recording.log);
        engine += t1 - t0;
        bare += cpu_seconds() - t1;
    }
    const path::Counters& c = scratch->counters;
    const double rays = static_cast<double>(c.rays + c.shadow_rays);
    const nlohmann::json out = {{"rays", rays},
                                {"camera_paths", c.camera_paths},
                                {"hits", hits},
                                {"engine_cpu_seconds", engine},
                                {"embree_cpu_seconds", bare},
                                {"engine_rays_per_cpu_second", rays / engine},
                                {"rays_per_cpu_second", rays / bare},
                                {"share_of_bare_embree", bare / engine}};
    std::cout << out.dump(2) << '\n';
    return 0;
}
