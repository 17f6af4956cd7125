// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/replay.h"

#include "film/pixel_filter.h"
#include "path/batch.h"
#include "trace/traceable_scene.h"

#include <memory>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace cardioid::render {

namespace {

constexpr const char* k_state_names[] = {"S*", "S*D", "..DD", "..DS+", "..DS+D"};
constexpr const char* k_class_names[] = {"D1", "D2", "D3", "C1", "C2"};

const char* lobe_name(bsdf::LobeKind kind) {
    constexpr const char* names[] = {"diffuse", "translucent", "ggx reflection", "ggx refraction", "ggx glass",
                                     "sheen",   "burley",      "velvet",         "sheen v1"};
    return names[static_cast<int>(kind)];
}

std::string triple(const float (&v)[3]) {
    std::ostringstream s;
    s << '(' << v[0] << ", " << v[1] << ", " << v[2] << ')';
    return s.str();
}

std::string material_name(const scene::SceneDesc& desc, int id) {
    return id < static_cast<int>(desc.materials.size()) ? "'" + desc.materials[id].name + "'" : "the default material";
}

void print(std::ostringstream& out, const scene::SceneDesc& desc, const path::LoggedVertex& v) {
    const int state = (v.flags >> path::k_state_shift) & 7;
    out << "bounce " << (v.depth & 255) << "  after " << k_state_names[state] << "  " << material_name(desc, v.material)
        << ", instance " << v.instance << ", triangle " << v.triangle << "\n    at " << triple(v.position)
        << ", distance " << v.distance << ", normal " << triple(v.normal) << "\n    throughput " << triple(v.throughput)
        << '\n';
    for (int k = 0; k < v.lobes; ++k) out << "    " << lobe_name(v.kind[k]) << "  chosen with " << v.pick[k] << '\n';
}

}  // namespace

std::string replay_sample(const scene::SceneDesc& desc, int x, int y, int sample) {
    if (x < 0 || y < 0 || x >= desc.settings.width || y >= desc.settings.height)
        throw std::out_of_range("the pixel is outside the frame");
    const trace::TraceableScene scene(desc, [](const std::string&) { return false; });
    const auto filter = film::make_filter_table(desc.settings.pixel_filter, desc.settings.filter_width);
    auto scratch = std::make_unique<path::Scratch>();
    auto result = std::make_unique<path::BatchResult>();
    std::vector<std::int32_t> bins(static_cast<std::size_t>(scene.view().material_count) + 3);
    std::vector<path::LoggedVertex> vertices(1024);
    path::PathLog log{vertices.data(), static_cast<int>(vertices.size()), 0};
    scratch->bins = bins.data();
    scratch->log = &log;
    path::BatchRequest request{&scene.view(), filter.data(), x, y, 1, 1, sample, 1, desc.settings.seed, {}, nullptr};
    // The camera half alone: no photons are traced for one sample.
    request.partition.camera = path::make_partition(scene.view().settings, scene.view().has_casters).camera;
    path::select_trace_batch()(request, *scratch, *result);
    std::ostringstream out;
    out << "pixel " << x << ", " << y << ", sample " << sample << ": " << log.n << " vertices\n";
    for (int i = 0; i < log.n; ++i) print(out, desc, vertices[i]);
    for (int c = 0; c < path::k_classes; ++c) {
        const float rgb[3] = {result->radiance[c][0][0], result->radiance[c][1][0], result->radiance[c][2][0]};
        out << k_class_names[c] << ' ' << triple(rgb) << '\n';
    }
    return out.str();
}

}  // namespace cardioid::render
