// SPDX-License-Identifier: GPL-3.0-or-later
// cardioid-filter: filters a film again that cardioid-render --film or the add-on has saved, without rendering.
#include "apps/cli/output.h"
#include "apps/filter_range.h"
#include "film/film_file.h"
#include "render/filter_job.h"

#include <CLI/CLI.hpp>

#include <cstdio>

namespace {

using namespace cardioid;

struct Options {
    std::string film, output = "cardioid.exr", stats;
    int threads = 0, lanes = 0;
    std::vector<std::string> set;
    bool quiet = false;
};

int parse(int argc, char** argv, Options& o) {
    CLI::App app{"Filters a Cardioid film again"};
    app.add_option("film", o.film, "film file")->required();
    app.add_option("-o,--output", o.output, "picture: .exr (linear, all passes) or .png (sRGB)");
    app.add_option("--set", o.set, "name=value of a filter setting (docs/python-api.md), else as rendered; repeatable");
    app.add_option("--threads", o.threads, "0: all")->check(CLI::NonNegativeNumber);
    app.add_option("--lanes", o.lanes, "width of the kernels: 1, 8 or 16 (0: the best here)")
        ->check(CLI::IsMember({0, 1, 8, 16}));
    app.add_option("--stats", o.stats, "write what was counted as JSON");
    app.add_flag("-q,--quiet", o.quiet, "no progress");
    CLI11_PARSE(app, argc, argv);
    return -1;
}

int run(const Options& o) {
    const auto film = std::make_shared<const film::Film>(film::FilmFile::load(o.film));
    scene::FilterSettings settings = film->filter_settings();
    // Whoever calls this wants it filtered, whether or not it was while rendering.
    settings.use_filter = true;
    cli::apply(settings, o.set);
    const std::vector<std::string> errors = range_errors(settings);
    for (const std::string& e : errors) cli::say("error", e);
    if (!errors.empty()) return 2;
    render::FilterJob job(film, settings, o.threads, o.lanes);
    job.start();
    while (!job.wait(0.25)) {
        if (!o.quiet) cli::show(job.progress());
    }
    if (!o.quiet) std::fputc('\n', stderr);
    const auto frame = job.frame();
    if (!frame) throw scene::SceneError(job.progress().message);
    cli::write_results(*frame, o.output, job.stats(), o.stats, o.quiet);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    const int done = parse(argc, argv, options);
    if (done >= 0) return done;
    return cli::guarded([&] { return run(options); });
}
