// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/cli/output.h"

#include "image/write.h"
#include "scene/replace_file.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <span>

namespace cardioid::cli {

namespace {

/// All passes side by side in one EXR: the Combined pass as R, G, B, A, the others as Name.X.
void write_layers(const film::Frame& frame, const std::string& path, const std::string& stats) {
    std::vector<std::string> names;
    for (const film::Pass& p : frame.passes) {
        for (int c = 0; c < p.channels; ++c) {
            const std::string letter(1, p.channels == 1 ? 'Z' : p.name == "Normal" ? "XYZ"[c] : "RGBA"[c]);
            names.push_back(p.name == "Combined" ? letter : p.name + "." + letter);
        }
    }
    const std::size_t pixels = static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
    std::vector<float> all(pixels * names.size());
    std::size_t at = 0;
    for (const film::Pass& p : frame.passes) {
        const auto channels = static_cast<std::size_t>(p.channels);
        for (std::size_t i = 0; i < pixels; ++i)
            std::copy_n(&p.data[i * channels], channels, &all[i * names.size() + at]);
        at += channels;
    }
    image::write_exr(path, frame.width, frame.height, names, all, {{"cardioid:stats", stats}});
}

void write_picture(const film::Frame& frame, const std::string& path, const std::string& stats) {
    const film::Pass& combined = *frame.find("Combined");
    if (path.ends_with(".png")) {
        image::write_png(path, frame.width, frame.height, combined.channels, combined.data);
    } else {
        write_layers(frame, path, stats);
    }
}

void write_text(const std::string& path, const std::string& text) {
    scene::replace_file(path, [&](scene::FileWriter& file) { file.write(std::as_bytes(std::span(text))); });
}

}  // namespace

void show(const render::Progress& p) {
    std::fprintf(stderr, "\r%-40s %5.1f %%  %6.1f s", p.message.empty() ? "rendering" : p.message.c_str(),
                 100 * p.fraction, p.elapsed);
}

void write_results(const film::Frame& frame, const std::string& path, const std::string& stats,
                   const std::string& stats_path, bool quiet) {
    write_picture(frame, path, stats);
    if (!stats_path.empty()) write_text(stats_path, stats);
    if (!quiet) std::cout << path << '\n';
}

void assign(scene::Json& json, const std::vector<std::string>& assignments) {
    for (const std::string& a : assignments) {
        const std::size_t at = a.find('=');
        if (at == std::string::npos) throw scene::SceneError("--set " + a + ": name=value is wanted");
        const std::string text = a.substr(at + 1);
        scene::Json value = scene::Json::parse(text, nullptr, false);
        json[a.substr(0, at)] = value.is_discarded() ? scene::Json(text) : std::move(value);
    }
}

void say(const char* kind, const std::string& message) { std::cerr << kind << ": " << message << '\n'; }

int guarded(const std::function<int()>& program) {
    try {
        return program();
    } catch (const scene::SceneError& e) {
        for (const auto& p : e.problems()) say("error", p);
    } catch (const std::exception& e) { say("error", e.what()); }
    return 1;
}

}  // namespace cardioid::cli
