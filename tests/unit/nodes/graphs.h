// SPDX-License-Identifier: GPL-3.0-or-later
// A fluent builder of shading graphs for the tests.
#pragma once

#include "scene/graph_desc.h"

#include <initializer_list>
#include <string>

namespace cardioid::test {

class GraphMaker {
public:
    /// Adds a node; inputs and links follow with value() and link().
    GraphMaker& node(const std::string& type, const std::string& name = "") {
        scene::NodeDesc n;
        n.type = type;
        n.name = name.empty() ? type : name;
        graph.nodes.push_back(n);
        return *this;
    }
    GraphMaker& value(const std::string& id, std::initializer_list<float> values) {
        scene::InputDesc in;
        std::size_t k = 0;
        for (const float v : values) in.value[k++] = v;
        last().inputs[id] = in;
        return *this;
    }
    GraphMaker& link(const std::string& id, int from, const std::string& socket) {
        scene::InputDesc in;
        in.node = from;
        in.socket = socket;
        last().inputs[id] = in;
        return *this;
    }
    GraphMaker& param(const std::string& name, const scene::ParamValue& v) {
        last().params[name] = v;
        return *this;
    }
    /// The last node's output is the surface.
    scene::GraphDesc surface(const std::string& socket) {
        graph.surface = {static_cast<int>(graph.nodes.size()) - 1, socket};
        return graph;
    }
    int index() const { return static_cast<int>(graph.nodes.size()) - 1; }

    scene::GraphDesc graph;

private:
    scene::NodeDesc& last() { return graph.nodes.back(); }
};

}  // namespace cardioid::test
