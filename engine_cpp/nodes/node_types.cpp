// SPDX-License-Identifier: GPL-3.0-or-later
#include "nodes/node_types.h"

#include <map>

namespace cardioid::nodes {

namespace {

std::map<std::string, const NodeType*> make_index() {
    std::map<std::string, const NodeType*> index;
    for (const auto family : {closure_nodes(), principled_nodes(), input_nodes(), math_nodes(), color_nodes(),
                              convert_nodes(), texture_nodes(), image_nodes(), vector_nodes()})
        for (const NodeType& type : family) index.emplace(type.idname, &type);
    return index;
}

const std::map<std::string, const NodeType*>& node_index() {
    static const std::map<std::string, const NodeType*> index = make_index();
    return index;
}

}  // namespace

const NodeType* find_node_type(const std::string& idname) {
    const auto it = node_index().find(idname);
    return it == node_index().end() ? nullptr : it->second;
}

std::string node_table_markdown() {
    std::string text = "| node | as in Cycles | notes |\n|---|---|---|\n";
    for (const auto& [name, type] : node_index())
        text += "| `" + name + "` | " + (type->support == Support::same ? "same" : "approximated") + " | " +
                type->note + " |\n";
    return text;
}

}  // namespace cardioid::nodes
