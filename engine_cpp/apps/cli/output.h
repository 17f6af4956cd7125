// SPDX-License-Identifier: GPL-3.0-or-later
// What the command line programs share: pictures and texts into files, settings from name=value, errors as exit codes.
#pragma once

#include "film/frame.h"
#include "render/session.h"
#include "scene/error.h"
#include "scene/json.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <vector>

namespace cardioid::cli {

/// One line that is written over again.
void show(const render::Progress& progress);

/// What both programs leave: the picture (.png has the Combined pass as sRGB, anything else is an EXR with all passes and `stats`
/// in its header), `stats` as a file of its own unless `stats_path` is empty, and the picture's name on the terminal.
void write_results(const film::Frame& frame, const std::string& path, const std::string& stats,
                   const std::string& stats_path, bool quiet);

/// Changes keys of `json` by "name=value": value as JSON, or else as text.
void assign(scene::Json& json, const std::vector<std::string>& assignments);

/// The same for anything that json.h reads; unknown names and wrong types throw SceneError.
template <class Settings>
void apply(Settings& settings, const std::vector<std::string>& assignments) {
    if (assignments.empty()) return;
    scene::Json json = scene::write_json(settings);
    assign(json, assignments);
    settings = scene::read_json<Settings>(json);
}

/// Prints "warning: …" or "error: …".
void say(const char* kind, const std::string& message);

/// Runs the program; what it throws is printed in a line each and becomes 1.
int guarded(const std::function<int()>& program);

}  // namespace cardioid::cli
