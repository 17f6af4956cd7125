// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of validate() share.
#pragma once

#include "scene/validate.h"

#include <cmath>
#include <map>
#include <string>

namespace cardioid::scene {

/// Collects messages; of each kind only the first few are spelled out, so that 100 000 bad instances stay readable.
class ProblemList {
public:
    void error(std::string message) { problems_.push_back({Severity::error, std::move(message)}); }
    void warn(const std::string& who, const std::string& what);
    std::vector<Problem> take();

private:
    std::vector<Problem> problems_;
    std::map<std::string, int> repeats_;
};

/// `object "Name"`, or `object 7` without a name.
std::string label(const char* kind, const std::string& name, std::size_t index);
std::string counted(std::size_t n, const char* singular, const char* plural);

inline bool finite(float value) { return std::isfinite(value); }
inline bool finite(Float3 v) { return finite(v.x) && finite(v.y) && finite(v.z); }
bool finite(const Affine& transform);

/// A replacement for a number that is NaN, infinite or outside [low, high]; true (and a warning) if it was.
bool repair(ProblemList& problems, const std::string& who, const char* what, float& value, float low, float high,
            float otherwise);
bool repair(ProblemList& problems, const std::string& who, const char* what, int& value, int low, int high);

/// Names with <UDIM> or <UVTILE> stand for several files.
bool is_tiled_name(const std::string& path);

void validate_mesh(MeshDesc& mesh, std::size_t index, ProblemList& problems);
void validate_graph(GraphDesc& graph, const std::string& who, std::size_t images, ProblemList& problems);
void validate_instances(SceneDesc& scene, ProblemList& problems);
void validate_lights(SceneDesc& scene, ProblemList& problems);
void validate_settings(SceneDesc& scene, ProblemList& problems);
void validate_filter(FilterSettings& settings, ProblemList& problems);

}  // namespace cardioid::scene
