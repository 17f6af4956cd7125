// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/python/convert.h"

#include "scene/error.h"

#include <cmath>
#include <cstring>

namespace cardioid::python {

using nlohmann::json;

namespace {

json number(double v) {
    // JSON has no spelling for them; the reader accepts these words.
    if (std::isnan(v)) return "nan";
    if (std::isinf(v)) return v > 0 ? "inf" : "-inf";
    return v;
}

std::string shape_text(const std::vector<py::ssize_t>& shape) {
    std::string s = "(";
    for (std::size_t i = 0; i < shape.size(); ++i)
        s += (i ? ", " : "") + (shape[i] < 0 ? std::string("N") : std::to_string(shape[i]));
    return s + ")";
}

template <class T>
std::vector<T> array_of(const py::object& object, const std::vector<py::ssize_t>& shape, const std::string& what,
                        const char* type) {
    if (object.is_none()) return {};
    if (!py::isinstance<py::array>(object)) throw scene::SceneError(what + ": a numpy array is wanted");
    const auto array = py::reinterpret_borrow<py::array>(object);
    std::vector<py::ssize_t> given(array.shape(), array.shape() + array.ndim());
    bool fits = given.size() == shape.size();
    for (std::size_t i = 0; fits && i < shape.size(); ++i) fits = shape[i] < 0 || shape[i] == given[i];
    if (!fits)
        throw scene::SceneError(what + ": shape " + shape_text(given) + " where " + shape_text(shape) + " is wanted");
    const bool is_unsigned = sizeof(T) == 4 && std::is_integral_v<T> && array.dtype().kind() == 'u';
    const bool type_fits = array.dtype().itemsize() == sizeof(T) &&
                           (array.dtype().kind() == (std::is_integral_v<T> ? 'i' : 'f') || is_unsigned);
    if (!type_fits)
        throw scene::SceneError(what + ": dtype " + py::str(array.dtype()).cast<std::string>() + " where " + type +
                                " is wanted");
    if (!(array.flags() & py::array::c_style)) throw scene::SceneError(what + ": the array must be C-contiguous");
    std::vector<T> out(static_cast<std::size_t>(array.size()));
    if (!out.empty()) std::memcpy(out.data(), array.data(), out.size() * sizeof(T));
    return out;
}

}  // namespace

json to_json(const py::handle& value, const std::string& what) {
    if (value.is_none()) return nullptr;
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
    if (py::isinstance<py::int_>(value)) return value.cast<std::int64_t>();
    if (py::isinstance<py::float_>(value)) return number(value.cast<double>());
    if (py::isinstance<py::str>(value)) return value.cast<std::string>();
    if (py::isinstance<py::bytes>(value)) {
        const auto text = value.cast<std::string>();
        return json::binary(std::vector<std::uint8_t>(text.begin(), text.end()));
    }
    if (py::isinstance<py::dict>(value)) {
        json object = json::object();
        for (const auto& [k, v] : py::reinterpret_borrow<py::dict>(value)) {
            const std::string key = py::str(k).cast<std::string>();
            object[key] = to_json(v, what + "." + key);
        }
        return object;
    }
    // numpy scalars and arrays, and Blender's vectors and matrices, know how to become lists.
    if (py::hasattr(value, "tolist")) return to_json(value.attr("tolist")(), what);
    if (py::isinstance<py::sequence>(value) || py::hasattr(value, "__iter__")) {
        json list = json::array();
        for (const auto& item : py::iter(value)) list.push_back(to_json(item, what));
        return list;
    }
    throw scene::SceneError(what + ": cannot take a value of type " + py::str(value.get_type()).cast<std::string>());
}

py::object from_json(const json& j) {
    switch (j.type()) {
        case json::value_t::boolean: return py::bool_(j.get<bool>());
        case json::value_t::number_integer: return py::int_(j.get<std::int64_t>());
        case json::value_t::number_unsigned: return py::int_(j.get<std::uint64_t>());
        case json::value_t::number_float: return py::float_(j.get<double>());
        case json::value_t::string: return py::str(j.get<std::string>());
        case json::value_t::array: {
            py::list list;
            for (const auto& v : j) list.append(from_json(v));
            return list;
        }
        case json::value_t::object: {
            py::dict dict;
            for (const auto& [k, v] : j.items()) dict[py::str(k)] = from_json(v);
            return dict;
        }
        default: return py::none();
    }
}

std::vector<float> float_array(const py::object& array, const std::vector<py::ssize_t>& shape,
                               const std::string& what) {
    return array_of<float>(array, shape, what, "float32");
}

std::vector<std::int32_t> int_array(const py::object& array, const std::vector<py::ssize_t>& shape,
                                    const std::string& what) {
    return array_of<std::int32_t>(array, shape, what, "int32 or uint32");
}

}  // namespace cardioid::python
