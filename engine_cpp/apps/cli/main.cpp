// SPDX-License-Identifier: GPL-3.0-or-later
// cardioid-render: renders a saved scene file, as the add-on's Export operator or Scene.save() writes it.
#include "apps/cli/output.h"
#include "film/film_file.h"
#include "render/replay.h"
#include "render/session.h"
#include "scene/scene_file.h"
#include "scene/validate.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <iostream>
#include <vector>

namespace {

using namespace cardioid;

struct Options {
    std::string scene, output = "cardioid.exr", film, stats;
    int samples = 0, threads = -1, lanes = 0;
    double time_limit = -1;
    long long seed = -1;
    std::vector<int> pixel;
    std::vector<std::string> set;
    bool quiet = false;
};

int parse(int argc, char** argv, Options& o) {
    CLI::App app{"Renders a Cardioid scene file"};
    app.add_option("scene", o.scene, "scene file")->required();
    app.add_option("-o,--output", o.output, "picture: .exr (linear, all passes) or .png (sRGB)");
    app.add_option("--film", o.film, "save the film too, which cardioid-filter filters again: .cardioid");
    app.add_option("--samples", o.samples, "camera paths a pixel")->check(CLI::PositiveNumber);
    app.add_option("--time-limit", o.time_limit, "seconds, 0: none")->check(CLI::NonNegativeNumber);
    app.add_option("--threads", o.threads, "0: all")->check(CLI::NonNegativeNumber);
    app.add_option("--seed", o.seed)->check(CLI::NonNegativeNumber);
    app.add_option("--lanes", o.lanes, "width of the kernels: 1, 8 or 16 (0: the best here)")
        ->check(CLI::IsMember({0, 1, 8, 16}));
    app.add_option("--set", o.set, "name=value of any setting, as in the scene file (docs/python-api.md); repeatable");
    app.add_option("--stats", o.stats, "write what was counted as JSON");
    app.add_option("--pixel", o.pixel,
                   "x,y,sample: trace this sample alone and print its vertices (x, y from the bottom left)")
        ->delimiter(',')
        ->expected(3);
    app.add_flag("-q,--quiet", o.quiet, "no progress");
    CLI11_PARSE(app, argc, argv);
    return -1;
}

int run(const Options& o) {
    auto desc = std::make_shared<scene::SceneDesc>(scene::load_scene(o.scene));
    cli::apply(desc->settings, o.set);
    if (o.samples > 0) desc->settings.samples = o.samples;
    if (o.threads >= 0) desc->settings.threads = o.threads;
    if (o.time_limit >= 0) desc->settings.time_limit = static_cast<float>(o.time_limit);
    if (o.seed >= 0) desc->settings.seed = static_cast<std::uint32_t>(o.seed);
    const auto problems = scene::validate(*desc);
    for (const auto& p : problems) cli::say(p.severity == scene::Severity::error ? "error" : "warning", p.message);
    if (scene::has_errors(problems)) return 2;
    if (!o.pixel.empty()) {
        std::cout << render::replay_sample(*desc, o.pixel[0], o.pixel[1], o.pixel[2]);
        return 0;
    }
    render::Session session(desc, o.lanes);
    session.start();
    while (!session.wait(0.25)) {
        if (!o.quiet) cli::show(session.progress());
    }
    if (!o.quiet) std::fputc('\n', stderr);
    const render::Progress p = session.progress();
    for (const auto& w : session.warnings()) cli::say("warning", w);
    if (p.phase == render::Phase::failed) throw scene::SceneError(p.message);
    const auto frame = session.frame();
    if (!frame) throw scene::SceneError("nothing was rendered: the time limit ended before the first tile");
    cli::write_results(*frame, o.output, session.stats(), o.stats, o.quiet);
    if (!o.film.empty()) film::FilmFile::save(*session.film(), o.film);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    const int done = parse(argc, argv, options);
    if (done >= 0) return done;
    return cli::guarded([&] { return run(options); });
}
