// SPDX-License-Identifier: GPL-3.0-or-later
// Reads what make_golden.py wrote: graphs as the add-on exports them, points, and the values that Cycles gave.
#pragma once

#include "scene/graph_desc.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cardioid::test {

struct GoldenCase {
    std::string name;
    float tolerance = 0;
    float pixel = 0, half_height = 0;  ///< of the camera's picture, scene units
    scene::GraphDesc graph;
    float center[2] = {0, 0};           ///< of the tile
    std::vector<float> points, values;  ///< xyz and rgb
};

inline void PrintTo(const GoldenCase& c, std::ostream* out) { *out << c.name; }

inline scene::ParamValue param_of(const nlohmann::json& j) {
    if (j.is_boolean()) return j.get<bool>();
    if (j.is_number()) return j.get<double>();
    if (j.is_array()) return j.get<std::vector<double>>();
    return j.get<std::string>();
}

inline scene::InputDesc input_of(const nlohmann::json& j) {
    scene::InputDesc in;
    if (j.is_object()) {
        in.node = j.at("node").get<int>();
        in.socket = j.at("socket").get<std::string>();
        in.type = j.at("type").get<std::string>();
    } else if (j.is_array()) {
        for (std::size_t k = 0; k < j.size() && k < 4; ++k) in.value[k] = j[k].get<float>();
    } else {
        in.value[0] = j.get<float>();
    }
    return in;
}

inline scene::GraphDesc graph_of(const nlohmann::json& j) {
    scene::GraphDesc graph;
    for (const auto& n : j.at("nodes")) {
        scene::NodeDesc node;
        node.name = n.at("name").get<std::string>();
        node.type = n.at("type").get<std::string>();
        for (const auto& [key, value] : n.at("params").items()) node.params[key] = param_of(value);
        for (const auto& [key, value] : n.at("inputs").items()) node.inputs[key] = input_of(value);
        graph.nodes.push_back(std::move(node));
    }
    graph.surface = {j.at("surface")[0].get<int>(), j.at("surface")[1].get<std::string>()};
    return graph;
}

inline std::vector<GoldenCase> read_golden(const std::string& path) {
    std::ifstream file(path);
    const auto j = nlohmann::json::parse(file);
    std::vector<GoldenCase> cases;
    for (const auto& c : j.at("cases")) {
        GoldenCase found;
        found.pixel = j.at("pixel").get<float>();
        found.half_height = j.at("half_height").get<float>();
        found.name = c.at("name").get<std::string>();
        found.tolerance = c.at("tolerance").get<float>();
        found.graph = graph_of(c.at("graph"));
        for (std::size_t k = 0; k < 2; ++k) found.center[k] = c.at("center")[k].get<float>();
        found.points = c.at("points").get<std::vector<float>>();
        found.values = c.at("values").get<std::vector<float>>();
        cases.push_back(std::move(found));
    }
    return cases;
}

}  // namespace cardioid::test
