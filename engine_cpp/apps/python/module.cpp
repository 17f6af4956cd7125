// SPDX-License-Identifier: GPL-3.0-or-later
// cardioid._core: the add-on's only door to the engine (docs/python-api.md).
#include "apps/python/bindings.h"
#include "image/version.h"
#include "path/batch.h"
#include "render/session.h"
#include "scene/error.h"
#include "trace/embree_scene.h"

#include <pybind11/stl.h>

namespace cardioid::python {

namespace {

py::dict version() {
    py::dict d;
    d["engine"] = CARDIOID_VERSION;
    d["embree"] = trace::embree_version();
    d["openimageio"] = image::openimageio_version();
    d["opencolorio"] = image::opencolorio_version();
    d["tbb"] = render::tbb_version();
    d["isa"] = path::best_width() == 16 ? "avx512" : path::best_width() == 8 ? "avx2" : "baseline";
    return d;
}

/// Error, with the list of messages as `.problems`.
void bind_error(py::module_& m) {
    static PyObject* error = PyErr_NewException("cardioid._core.Error", PyExc_RuntimeError, nullptr);
    m.attr("Error") = py::handle(error);
    py::register_exception_translator([](std::exception_ptr p) {
        try {
            if (p) std::rethrow_exception(p);
        } catch (const scene::SceneError& e) {
            const py::object value = py::reinterpret_borrow<py::object>(error)(py::str(e.what()));
            value.attr("problems") = py::cast(e.problems());
            PyErr_SetObject(error, value.ptr());
        }
    });
}

}  // namespace

PYBIND11_MODULE(_core, m) {
    m.doc() = "Cardioid's render engine";
    m.attr("__version__") = CARDIOID_VERSION;
    bind_error(m);
    bind_scene(m);
    bind_filter(m);
    bind_session(m);
    m.def("version", &version, "Versions of the engine and its libraries, and the instruction set in use.");
    m.def(
        "integrators",
        [] {
            return std::vector<std::string>{"PT", "PTPPM", "SPPM"};
        },
        "Integrators that this build offers, by the add-on's names.");
    m.def("available_threads", &render::available_threads);
}

}  // namespace cardioid::python
