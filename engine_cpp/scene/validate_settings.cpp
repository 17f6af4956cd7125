// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/limits.h"
#include "scene/problems.h"

#include <algorithm>
#include <limits>

namespace cardioid::scene {
namespace {

constexpr int k_widest = 65536;
constexpr float k_large = 1e18f;
/// Paths count their bounces in bytes (path/batch.h).
constexpr int k_most_bounces = 254;
constexpr int k_most_transparent_bounces = 1024;

void check_frame(const Settings& s, ProblemList& problems) {
    if (s.width < 1 || s.height < 1 || s.width > k_widest || s.height > k_widest)
        return problems.error("settings: a frame of " + std::to_string(s.width) + " × " + std::to_string(s.height) +
                              " pixels; each side has 1 to " + std::to_string(k_widest));
    const auto [x, y, w, h] = s.crop;
    const bool whole = x == 0 && y == 0 && w == 0 && h == 0;
    const bool inside = x >= 0 && y >= 0 && w > 0 && h > 0 && x <= s.width - w && y <= s.height - h;
    if (!whole && !inside)
        problems.error("settings: the render border (x " + std::to_string(x) + ", y " + std::to_string(y) + ", " +
                       std::to_string(w) + " × " + std::to_string(h) + ") does not lie inside the frame of " +
                       std::to_string(s.width) + " × " + std::to_string(s.height));
}

void check_samples(const Settings& s, ProblemList& problems) {
    if (s.samples < 1) problems.error("settings: " + std::to_string(s.samples) + " samples; at least 1 is needed");
    if (s.first_sample < 0) problems.error("settings: first_sample is " + std::to_string(s.first_sample) + ", below 0");
    if (s.first_sample > 0 && s.samples > std::numeric_limits<int>::max() - s.first_sample)
        problems.error("settings: first_sample and samples together exceed what can be counted");
}

void repair_filter(FilterSettings& s, ProblemList& problems) {
    const std::string who = "settings";
    repair(problems, who, "firefly_density", s.firefly_density, 0, k_large, FilterSettings{}.firefly_density);
    repair(problems, who, "luminance_sensitivity", s.luminance_sensitivity, 0, 0.99f, 0.5f);
    repair(problems, who, "texture_width", s.texture_width, 1e-4f, k_large, 0.1f);
    repair(problems, who, "filter_size", s.filter_size, 1, k_largest_filter);
    // A kernel has a pixel in its middle.
    s.filter_size |= 1;
}

void repair_settings(Settings& s, ProblemList& problems) {
    const std::string who = "settings";
    repair_filter(s.filter, problems);
    repair(problems, who, "adaptive_threshold", s.adaptive_threshold, 0, 1, 0);
    repair(problems, who, "adaptive_min_samples", s.adaptive_min_samples, 0, 1 << 24);
    repair(problems, who, "time_limit", s.time_limit, 0, k_large, 0);
    repair(problems, who, "threads", s.threads, 0, 1024);
    repair(problems, who, "max_bounces", s.max_bounces, 0, k_most_bounces);
    repair(problems, who, "max_diffuse_bounces", s.max_diffuse_bounces, 0, k_most_bounces);
    repair(problems, who, "max_glossy_bounces", s.max_glossy_bounces, 0, k_most_bounces);
    repair(problems, who, "max_transmission_bounces", s.max_transmission_bounces, 0, k_most_bounces);
    repair(problems, who, "max_volume_bounces", s.max_volume_bounces, 0, k_most_bounces);
    repair(problems, who, "max_transparent_bounces", s.max_transparent_bounces, 0, k_most_transparent_bounces);
    repair(problems, who, "clamp_direct", s.clamp_direct, 0, k_large, 0);
    repair(problems, who, "clamp_indirect", s.clamp_indirect, 0, k_large, 0);
    repair(problems, who, "filter_glossy", s.filter_glossy, 0, 1000, 0);
    repair(problems, who, "fast_gi_bounces", s.fast_gi_bounces, 1, 1024);
    repair(problems, who, "fast_gi_factor", s.fast_gi_factor, 0, k_large, 1);
    repair(problems, who, "fast_gi_distance", s.fast_gi_distance, 0, k_large, 10);
    repair(problems, who, "caustic_roughness", s.caustic_roughness, 0, 1, 0);
    repair(problems, who, "photon_radius", s.photon_radius, 0.01f, 1000, 1);
    repair(problems, who, "radius_shrink", s.radius_shrink, 0.01f, 1, 0.6666667f);
    if (s.photons < 0) {
        problems.warn(who, "has a negative number of photons; the engine chooses");
        s.photons = 0;
    }
    // Photons are numbered in 32 bits; what is refused below for its memory is far less.
    s.photons = std::min(s.photons, std::int64_t{1} << 31);
    repair(problems, who, "filter_width", s.filter_width, 0.01f, 64, 1.5f);
    repair(problems, who, "exposure", s.exposure, 0, k_large, 1);
    repair(problems, who, "transparent_roughness", s.transparent_roughness, 0, 1, 0.1f);
    repair(problems, who, "texture_cache_mb", s.texture_cache_mb, 16, 1 << 20);
    if (s.memory_limit < 0) {
        problems.warn(who, "has a negative memory limit; the machine's memory is used");
        s.memory_limit = 0;
    }
}

void check_lens(CameraDesc& camera, const std::string& who, ProblemList& problems) {
    repair(problems, who, "clip_start", camera.clip_start, 0, k_large, 0);
    repair(problems, who, "clip_end", camera.clip_end, 0, k_large, k_large);
    if (camera.clip_end <= camera.clip_start)
        problems.warn(who, "clips everything: its clip end is not beyond its clip start");
    repair(problems, who, "aperture_radius", camera.aperture_radius, 0, k_large, 0);
    repair(problems, who, "focus_distance", camera.focus_distance, 1e-5f, k_large, 10);
    repair(problems, who, "blades", camera.blades, 0, 1024);
    repair(problems, who, "blade_rotation", camera.blade_rotation, -k_large, k_large, 0);
    repair(problems, who, "aperture_ratio", camera.aperture_ratio, 1e-3f, 1e3f, 1);
}

void check_camera(SceneDesc& scene, ProblemList& problems) {
    if (!scene.camera) return problems.error("the scene has no camera");
    CameraDesc& camera = *scene.camera;
    const std::string who = label("camera", camera.name, 0);
    if (!finite(camera.transform) || camera.transform.determinant() == 0)
        return problems.error(who + " has a transform that is singular or not finite");
    const auto& view = camera.view_plane;
    const bool open = std::all_of(view.begin(), view.end(), [](float v) { return finite(v); }) && view[0] != view[1] &&
                      view[2] != view[3];
    if (!open) return problems.error(who + " has an empty view");
    check_lens(camera, who, problems);
}

}  // namespace

void validate_filter(FilterSettings& settings, ProblemList& problems) { repair_filter(settings, problems); }

void validate_settings(SceneDesc& scene, ProblemList& problems) {
    check_camera(scene, problems);
    check_frame(scene.settings, problems);
    check_samples(scene.settings, problems);
    repair_settings(scene.settings, problems);
    if (std::string problem = memory_problem(scene); !problem.empty()) problems.error(std::move(problem));
}

}  // namespace cardioid::scene
