// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/filter_range.h"
#include "apps/python/bindings.h"
#include "apps/python/convert.h"
#include "film/film_file.h"
#include "render/filter_job.h"
#include "scene/error.h"
#include "scene/json.h"

#include <pybind11/stl.h>

#include <algorithm>

namespace cardioid::python {

namespace {

using FilmPointer = std::shared_ptr<film::Film>;

std::uint32_t most_samples(const film::Film& f) {
    std::uint32_t most = 0;
    for (int y = 0; y < f.region().height; ++y) {
        for (int x = 0; x < f.region().width; ++x) most = std::max(most, f.samples(x, y));
    }
    return most;
}

/// The film's own settings, with the dictionary's in their place. Values out of range are errors here, not repaired.
scene::FilterSettings settings_of(const film::Film& film, const py::dict& given) {
    nlohmann::json json = scene::write_json(film.filter_settings());
    json.update(to_json(given, "filter settings"));
    auto settings = scene::read_json<scene::FilterSettings>(json);
    const std::vector<std::string> errors = range_errors(settings);
    if (!errors.empty()) throw scene::SceneError(errors);
    return settings;
}

std::unique_ptr<render::FilterJob> make_job(const FilmPointer& film, const py::dict& given, int threads) {
    if (!film) throw scene::SceneError("there is no film to filter");
    return std::make_unique<render::FilterJob>(film, settings_of(*film, given), threads);
}

}  // namespace

void bind_filter(py::module_& m) {
    const auto no_gil = py::call_guard<py::gil_scoped_release>();
    py::class_<film::Film, FilmPointer>(m, "Film", "What was rendered, to be filtered again; never changes.")
        .def_property_readonly("width", [](const film::Film& f) { return f.region().width; })
        .def_property_readonly("height", [](const film::Film& f) { return f.region().height; })
        .def_property_readonly("samples", &most_samples)
        .def_property_readonly("memory_bytes", &film::Film::memory_bytes)
        .def_property_readonly("has_clusters", &film::Film::has_clusters)
        .def("filter_settings", [](const film::Film& f) { return from_json(scene::write_json(f.filter_settings())); })
        .def(
            "save", [](const film::Film& f, const std::string& path) { film::FilmFile::save(f, path); },
            py::arg("path"), no_gil)
        .def_static(
            "load", [](const std::string& path) { return std::make_shared<film::Film>(film::FilmFile::load(path)); },
            py::arg("path"), no_gil);

    py::class_<render::FilterJob>(m, "FilterJob", "Filters a film on threads of its own; the host polls.")
        .def(py::init(&make_job), py::arg("film"), py::arg("settings") = py::dict(), py::arg("threads") = 0)
        .def("start", &render::FilterJob::start, no_gil)
        .def("wait", &render::FilterJob::wait, py::arg("seconds"), no_gil, "True when the job has ended.")
        .def("cancel", &render::FilterJob::cancel, no_gil)
        .def("progress", [](const render::FilterJob& job) { return stage_dict(job.progress()); })
        .def("frame", [](const render::FilterJob& j) { return std::const_pointer_cast<film::Frame>(j.frame()); })
        .def("stats", [](const render::FilterJob& j) { return from_json(nlohmann::json::parse(j.stats())); });
}

}  // namespace cardioid::python
