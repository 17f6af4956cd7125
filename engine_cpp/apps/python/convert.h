// SPDX-License-Identifier: GPL-3.0-or-later
// Python values ⇄ JSON and numpy arrays ⇄ vectors, with messages that name what was wrong.
#pragma once

#include "scene/scene_desc.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace cardioid::python {

namespace py = pybind11;

/// dict, list, tuple, str, numbers, bool, None and numpy values; anything else raises Error naming `what`.
nlohmann::json to_json(const py::handle& value, const std::string& what);
py::object from_json(const nlohmann::json& json);

/// An array of exactly this type and shape (-1: any length); Error names `what` otherwise. Empty vector for None.
std::vector<float> float_array(const py::object& array, const std::vector<py::ssize_t>& shape, const std::string& what);
std::vector<std::int32_t> int_array(const py::object& array, const std::vector<py::ssize_t>& shape,
                                    const std::string& what);

}  // namespace cardioid::python
