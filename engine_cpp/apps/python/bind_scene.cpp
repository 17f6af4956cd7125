// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/python/bindings.h"
#include "apps/python/convert.h"
#include "scene/json.h"
#include "scene/limits.h"
#include "scene/scene_file.h"
#include "scene/validate.h"

#include <pybind11/stl.h>

namespace cardioid::python {

namespace {

int last_index(std::size_t size) { return static_cast<int>(size) - 1; }

std::string kind_and_name(const char* kind, const py::dict& d) {
    const std::string name = d.contains("name") ? py::str(d["name"]).cast<std::string>() : std::string("?");
    return std::string(kind) + " '" + name + "'";
}

template <class Desc>
Desc read(const char* kind, const py::dict& d) {
    return scene::read_json<Desc>(to_json(d, kind_and_name(kind, d)));
}

int add_image(PyScene& s, py::dict d) {
    const std::string what = kind_and_name("image", d);
    py::dict rest;
    for (const auto& [k, v] : d) {
        const std::string key = py::str(k).cast<std::string>();
        if (key != "pixels" && key != "packed") rest[k] = v;
    }
    auto image = scene::read_json<scene::ImageDesc>(to_json(rest, what));
    if (d.contains("packed")) {
        if (!py::isinstance<py::bytes>(d["packed"])) throw scene::SceneError(what + ": 'packed' must be bytes");
        const auto bytes = d["packed"].cast<std::string>();
        image.packed.assign(bytes.begin(), bytes.end());
    }
    if (d.contains("pixels")) {
        const py::object pixels = d["pixels"];
        image.pixels = float_array(pixels, {-1, -1, -1}, what + ": pixels");
        const auto array = py::reinterpret_borrow<py::array>(pixels);
        image.height = static_cast<int>(array.shape(0));
        image.width = static_cast<int>(array.shape(1));
        image.channels = static_cast<int>(array.shape(2));
    }
    s.edit().images.push_back(std::move(image));
    return last_index(s.edit().images.size());
}

scene::Domain domain_of(const std::string& name, const std::string& what) {
    if (name == "corner") return scene::Domain::corner;
    if (name == "point") return scene::Domain::point;
    if (name == "face") return scene::Domain::face;
    throw scene::SceneError(what + ": unknown domain '" + name + "'");
}

scene::AttributeDesc read_attribute(const py::handle& item, const std::string& mesh) {
    const auto tuple = py::reinterpret_borrow<py::sequence>(item);
    if (py::len(tuple) != 3) throw scene::SceneError(mesh + ": an attribute is (name, domain, array)");
    scene::AttributeDesc a;
    a.name = py::str(tuple[0]).cast<std::string>();
    const std::string what = mesh + ": attribute '" + a.name + "'";
    a.domain = domain_of(py::str(tuple[1]).cast<std::string>(), what);
    const py::object data = tuple[2];
    if (!py::isinstance<py::array>(data)) throw scene::SceneError(what + ": a numpy array is wanted");
    const auto array = py::reinterpret_borrow<py::array>(data);
    // Corner data may come as (triangles, 3, channels).
    const bool per_corner = array.ndim() == 3;
    a.data =
        float_array(data, per_corner ? std::vector<py::ssize_t>{-1, 3, -1} : std::vector<py::ssize_t>{-1, -1}, what);
    a.channels = static_cast<int>(array.shape(array.ndim() - 1));
    return a;
}

int add_mesh(PyScene& s, const std::string& name, const py::object& positions, const py::object& triangles,
             const py::object& slots, const py::object& corner_normals, const py::iterable& attributes,
             const std::string& active_uv, const std::string& active_color, const std::array<float, 3>& generated_min,
             const std::array<float, 3>& generated_size, const py::object& edges) {
    const std::string what = "mesh '" + name + "'";
    scene::MeshDesc m;
    m.name = name;
    m.positions = float_array(positions, {-1, 3}, what + ": positions");
    const auto indices = int_array(triangles, {-1, 3}, what + ": triangles");
    m.triangles.assign(indices.begin(), indices.end());
    const auto count = static_cast<py::ssize_t>(indices.size() / 3);
    m.slots = int_array(slots, {count}, what + ": slots");
    m.corner_normals = float_array(corner_normals, {count, 3, 3}, what + ": corner_normals");
    for (const auto& a : attributes) m.attributes.push_back(read_attribute(a, what));
    m.active_uv = active_uv;
    m.active_color = active_color;
    m.generated_min = {generated_min[0], generated_min[1], generated_min[2]};
    m.generated_size = {generated_size[0], generated_size[1], generated_size[2]};
    const auto pairs = int_array(edges, {-1, 2}, what + ": edges");
    m.edges.assign(pairs.begin(), pairs.end());
    s.edit().meshes.push_back(std::move(m));
    return last_index(s.edit().meshes.size());
}

int add_instance(PyScene& s, const py::dict& d, int group) {
    auto instance = read<scene::InstanceDesc>("object", d);
    scene::SceneDesc& desc = s.edit();
    if (group < 0) {
        desc.instances.push_back(std::move(instance));
        return last_index(desc.instances.size());
    }
    if (group >= static_cast<int>(desc.groups.size()))
        throw scene::SceneError(kind_and_name("object", d) + ": there is no group " + std::to_string(group));
    desc.groups[group].instances.push_back(std::move(instance));
    return last_index(desc.groups[group].instances.size());
}

}  // namespace

void bind_scene(py::module_& m) {
    py::class_<PyScene, std::shared_ptr<PyScene>>(m, "Scene",
                                                  "Everything that a render is told; see docs/python-api.md.")
        .def(py::init<>())
        .def("add_image", &add_image, py::arg("image"))
        .def(
            "add_material",
            [](PyScene& s, const py::dict& d) {
                s.edit().materials.push_back(read<scene::MaterialDesc>("material", d));
                return last_index(s.edit().materials.size());
            },
            py::arg("material"))
        .def("add_mesh", &add_mesh, py::arg("name"), py::arg("positions"), py::arg("triangles"),
             py::arg("slots") = py::none(), py::arg("corner_normals") = py::none(), py::arg("attributes") = py::list(),
             py::arg("active_uv") = "", py::arg("active_color") = "",
             py::arg("generated_min") = std::array<float, 3>{0, 0, 0},
             py::arg("generated_size") = std::array<float, 3>{1, 1, 1}, py::arg("edges") = py::none())
        .def(
            "add_group",
            [](PyScene& s, const std::string& name) {
                s.edit().groups.push_back({name, {}});
                return last_index(s.edit().groups.size());
            },
            py::arg("name"))
        .def("add_instance", &add_instance, py::arg("instance"), py::arg("group") = -1)
        .def(
            "add_light",
            [](PyScene& s, const py::dict& d) {
                s.edit().lights.push_back(read<scene::LightDesc>("light", d));
                return last_index(s.edit().lights.size());
            },
            py::arg("light"))
        .def(
            "set_world", [](PyScene& s, const py::dict& d) { s.edit().world = read<scene::WorldDesc>("world", d); },
            py::arg("world"))
        .def(
            "set_camera", [](PyScene& s, const py::dict& d) { s.edit().camera = read<scene::CameraDesc>("camera", d); },
            py::arg("camera"))
        .def(
            "set_settings",
            [](PyScene& s, const py::dict& d) { s.edit().settings = read<scene::Settings>("settings", d); },
            py::arg("settings"))
        .def(
            "problems", [](PyScene& s) { return scene::messages(s.validated().problems); },
            "Everything that is wrong or was replaced, with the object's name.")
        .def(
            "memory_estimate", [](PyScene& s) { return scene::memory_estimate(*s.validated().desc).total(); },
            "Bytes, before anything is built.")
        .def(
            "save",
            [](PyScene& s, const std::string& path) {
                const auto desc = s.validated().desc;
                const py::gil_scoped_release release;
                scene::save_scene(*desc, path);
            },
            py::arg("path"))
        .def_static(
            "load",
            [](const std::string& path) {
                auto s = std::make_shared<PyScene>();
                const py::gil_scoped_release release;
                s->edit() = scene::load_scene(path);
                return s;
            },
            py::arg("path"));
}

}  // namespace cardioid::python
