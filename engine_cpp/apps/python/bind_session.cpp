// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/python/bindings.h"
#include "apps/python/convert.h"
#include "render/session.h"
#include "scene/error.h"

#include <pybind11/stl.h>

namespace cardioid::python {

namespace {

using FramePointer = std::shared_ptr<const film::Frame>;

/// A view of a pass that keeps its frame alive: nothing is copied.
py::array_t<float> pass_array(const FramePointer& frame, const std::string& name) {
    const film::Pass* pass = frame->find(name);
    if (!pass) throw py::key_error("the frame has no pass '" + name + "'");
    const py::capsule owner(new FramePointer(frame), [](void* p) { delete static_cast<FramePointer*>(p); });
    return py::array_t<float>({frame->height, frame->width, pass->channels}, pass->data.data(), owner);
}

std::unique_ptr<render::Session> make_session(PyScene& s) {
    const PyScene::Validated& v = s.validated();
    std::vector<std::string> errors, notes;
    for (const auto& p : v.problems) (p.severity == scene::Severity::error ? errors : notes).push_back(p.message);
    if (!errors.empty()) throw scene::SceneError(errors);
    return std::make_unique<render::Session>(v.desc, 0, std::move(notes));
}

py::dict progress_dict(const render::Session& session) {
    const render::Progress p = session.progress();
    py::dict d = stage_dict(p);
    d["samples"] = p.samples;
    d["total_samples"] = p.total_samples;
    d["remaining"] = p.remaining;
    d["memory_bytes"] = p.memory_bytes;
    d["revision"] = p.revision;
    d["passes"] = p.passes;
    d["photons_emitted"] = p.photons_emitted;
    d["photons_stored"] = p.photons_stored;
    return d;
}

}  // namespace

py::dict stage_dict(const render::Progress& p) {
    py::dict d;
    d["phase"] = render::phase_name(p.phase);
    d["fraction"] = p.fraction;
    d["message"] = p.message;
    d["elapsed"] = p.elapsed;
    return d;
}

void bind_session(py::module_& m) {
    py::class_<film::Frame, std::shared_ptr<film::Frame>>(
        m, "Frame", "A copy of a picture: passes as (height, width, channels) float32, bottom row first.")
        .def_readonly("width", &film::Frame::width)
        .def_readonly("height", &film::Frame::height)
        .def_readonly("samples", &film::Frame::samples)
        .def("names",
             [](const film::Frame& f) {
                 std::vector<std::string> names;
                 for (const auto& p : f.passes) names.push_back(p.name);
                 return names;
             })
        .def(
            "array", [](const std::shared_ptr<film::Frame>& f, const std::string& name) { return pass_array(f, name); },
            py::arg("name"));

    const auto no_gil = py::call_guard<py::gil_scoped_release>();
    py::class_<render::Session>(m, "Session", "One render on threads of its own; the host polls.")
        .def(py::init(&make_session), py::arg("scene"))
        .def("start", &render::Session::start, no_gil)
        .def("wait", &render::Session::wait, py::arg("seconds"), no_gil, "True when the session has ended.")
        .def("cancel", &render::Session::cancel, no_gil)
        .def("progress", &progress_dict)
        .def("frame",
             [](const render::Session& s) {
                 const py::gil_scoped_release release;
                 return std::const_pointer_cast<film::Frame>(s.frame());
             })
        .def(
            "film", [](const render::Session& s) { return std::const_pointer_cast<film::Film>(s.film()); },
            "What was rendered, once the session has ended; None where there is nothing.")
        .def("warnings", &render::Session::warnings)
        .def("stats", [](const render::Session& s) { return from_json(nlohmann::json::parse(s.stats())); });
}

}  // namespace cardioid::python
