// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/validate.h"

#include "scene/image_path.h"
#include "scene/problems.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace cardioid::scene {
namespace {

constexpr int k_spelled_out = 5;

void check_image_size(ImageDesc& image, const std::string& who, ProblemList& problems) {
    const bool sane = image.width > 0 && image.height > 0 && image.channels > 0 && image.channels <= 4;
    const std::uint64_t expected =
        sane ? std::uint64_t(image.width) * std::uint64_t(image.height) * std::uint64_t(image.channels) : 0;
    if (sane && expected == image.pixels.size()) return;
    problems.warn(who, "has " + std::to_string(image.pixels.size()) + " values for " + std::to_string(image.width) +
                           " × " + std::to_string(image.height) + " pixels of " + std::to_string(image.channels) +
                           " channels; shown magenta");
    image.pixels.clear();
    image.width = image.height = image.channels = 0;
}

void validate_images(SceneDesc& scene, ProblemList& problems) {
    for (std::size_t i = 0; i < scene.images.size(); ++i) {
        ImageDesc& image = scene.images[i];
        const std::string who = label("image", image.name, i);
        if (image.source == ImageSource::pixels) check_image_size(image, who, problems);
        if (image.source == ImageSource::packed && image.packed.empty())
            problems.warn(who, "is packed but empty; shown magenta");
        if (image.source != ImageSource::file) continue;
        std::error_code error;
        if (image.path.empty())
            problems.warn(who, "has no file; shown magenta");
        else if (!is_tiled_name(image.path) && !std::filesystem::exists(image_path(image.path).file, error))
            problems.warn(who, "is missing: '" + image.path + "' does not exist; shown magenta");
    }
}

void validate_materials(SceneDesc& scene, ProblemList& problems) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        MaterialDesc& m = scene.materials[i];
        const std::string who = label("material", m.name, i);
        repair(problems, who, "metallic", m.metallic, 0, 1, 0);
        repair(problems, who, "roughness", m.roughness, 0, 1, 0.4f);
        if (!finite(m.viewport_color)) {
            problems.warn(who, "has a colour that is not finite");
            m.viewport_color = MaterialDesc{}.viewport_color;
        }
        validate_graph(m.graph, who, scene.images.size(), problems);
    }
}

void validate_world(SceneDesc& scene, ProblemList& problems) {
    if (!scene.world) return;
    WorldDesc& world = *scene.world;
    const std::string who = label("world", world.name, 0);
    if (!finite(world.color)) {
        problems.warn(who, "has a colour that is not finite; black is used");
        world.color = {};
    }
    repair(problems, who, "map_resolution", world.map_resolution, 4, 16384);
    repair(problems, who, "max_bounces", world.max_bounces, 0, 1 << 20);
    validate_graph(world.graph, who, scene.images.size(), problems);
}

std::string number(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", static_cast<double>(value));
    return text;
}

}  // namespace

void ProblemList::warn(const std::string& who, const std::string& what) {
    if (++repeats_[what] <= k_spelled_out) problems_.push_back({Severity::warning, who + ' ' + what});
}

std::vector<Problem> ProblemList::take() {
    for (const auto& [what, times] : repeats_)
        if (times > k_spelled_out)
            problems_.push_back({Severity::warning, "and " + std::to_string(times - k_spelled_out) + " more: " + what});
    repeats_.clear();
    return std::move(problems_);
}

std::string label(const char* kind, const std::string& name, std::size_t index) {
    return name.empty() ? std::string(kind) + ' ' + std::to_string(index) : std::string(kind) + " \"" + name + '"';
}

std::string counted(std::size_t n, const char* singular, const char* plural) {
    return std::to_string(n) + ' ' + (n == 1 ? singular : plural);
}

bool finite(const Affine& transform) {
    return std::all_of(transform.m.begin(), transform.m.end(), [](float value) { return finite(value); });
}

bool repair(ProblemList& problems, const std::string& who, const char* what, float& value, float low, float high,
            float otherwise) {
    if (value >= low && value <= high) return false;
    const float better = std::isnan(value) ? otherwise : std::clamp(value, low, high);
    problems.warn(who, std::string("has ") + what + ' ' + number(value) + "; " + number(better) + " is used");
    value = better;
    return true;
}

bool repair(ProblemList& problems, const std::string& who, const char* what, int& value, int low, int high) {
    if (value >= low && value <= high) return false;
    const int better = std::clamp(value, low, high);
    problems.warn(
        who, std::string("has ") + what + ' ' + std::to_string(value) + "; " + std::to_string(better) + " is used");
    value = better;
    return true;
}

bool is_tiled_name(const std::string& path) {
    return path.find("<UDIM>") != std::string::npos || path.find("<UVTILE>") != std::string::npos;
}

std::vector<Problem> validate(SceneDesc& scene) {
    ProblemList problems;
    validate_settings(scene, problems);
    validate_images(scene, problems);
    validate_materials(scene, problems);
    validate_world(scene, problems);
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) validate_mesh(scene.meshes[i], i, problems);
    validate_instances(scene, problems);
    validate_lights(scene, problems);
    return problems.take();
}

std::vector<Problem> validate(FilterSettings& settings) {
    ProblemList problems;
    validate_filter(settings, problems);
    return problems.take();
}

bool has_errors(const std::vector<Problem>& problems) {
    return std::any_of(problems.begin(), problems.end(),
                       [](const Problem& p) { return p.severity == Severity::error; });
}

std::vector<std::string> messages(const std::vector<Problem>& problems) {
    std::vector<std::string> out;
    for (const Severity severity : {Severity::error, Severity::warning})
        for (const Problem& problem : problems)
            if (problem.severity == severity) out.push_back(problem.message);
    return out;
}

}  // namespace cardioid::scene
