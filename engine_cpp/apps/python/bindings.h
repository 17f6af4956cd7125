// SPDX-License-Identifier: GPL-3.0-or-later
// One bind_*.cpp for each class of the module.
#pragma once

#include "render/session.h"
#include "scene/scene_desc.h"
#include "scene/validate.h"

#include <pybind11/pybind11.h>

#include <memory>
#include <vector>

namespace cardioid::python {

namespace py = pybind11;

/// A description that is being filled, and validated once before use; adding to it starts a new one.
class PyScene {
public:
    struct Validated {
        std::shared_ptr<const scene::SceneDesc> desc;
        std::vector<scene::Problem> problems;
    };

    /// For filling; a session that was made before keeps what it had.
    scene::SceneDesc& edit() {
        if (validated_.desc) {
            desc_ = std::make_shared<scene::SceneDesc>(*validated_.desc);
            validated_ = {};
        }
        return *desc_;
    }
    const Validated& validated() {
        if (!validated_.desc) {
            validated_.problems = scene::validate(*desc_);
            validated_.desc = desc_;
        }
        return validated_;
    }

private:
    std::shared_ptr<scene::SceneDesc> desc_ = std::make_shared<scene::SceneDesc>();
    Validated validated_;
};

/// phase, fraction, message and elapsed, as sessions and filter jobs tell them.
py::dict stage_dict(const render::Progress& progress);

void bind_scene(py::module_& m);
void bind_session(py::module_& m);
void bind_filter(py::module_& m);

}  // namespace cardioid::python
