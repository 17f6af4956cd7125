// SPDX-License-Identifier: GPL-3.0-or-later
#include "nodes/node_types.h"

#include <map>

namespace cardioid::nodes {

namespace {

constexpr NodeType k_unsupported[] = {
    {"ShaderNodeBsdfRayPortal", nullptr, nullptr, since_45(Support::none), "paths do not go on elsewhere"},
    {"ShaderNodeRadialTiling", nullptr, nullptr, since_50(Support::none),
     "a thousand lines of cases, found in none of the files"},
    {"ShaderNodeScript", nullptr, nullptr, Support::none, "OSL"},
    {"ShaderNodeTexPointDensity", nullptr, nullptr, until_45(Support::none),
     "Blender itself gathers the points, by no way that an add-on can call; gone in 5.0"},
};

using Index = std::map<std::string, const NodeType*>;

Index make_index() {
    Index index;
    for (const auto family : {closure_nodes(), principled_nodes(), input_nodes(), info_nodes(), math_nodes(),
                              color_nodes(), convert_nodes(), texture_nodes(), image_nodes(), vector_nodes(),
                              ray_nodes(), special_nodes(), sky_nodes(), volume_nodes(), hair_nodes()})
        for (const NodeType& type : family) index.emplace(type.idname, &type);
    return index;
}

const Index& node_index() {
    static const Index index = make_index();
    return index;
}

const char* word(Support s) {
    switch (s) {
        case Support::same: return "same";
        case Support::approximated: return "approximated";
        case Support::none: return "not supported";
        default: return "—";
    }
}

}  // namespace

std::span<const NodeType> unsupported_nodes() { return k_unsupported; }

const NodeType* find_node_type(const std::string& idname) {
    const auto it = node_index().find(idname);
    return it == node_index().end() ? nullptr : it->second;
}

std::string node_table_markdown() {
    Index all = node_index();
    for (const NodeType& type : unsupported_nodes()) all.emplace(type.idname, &type);
    std::string text = "| node |", rule = "\n|---|";
    for (const char* version : k_blender_versions) {
        text += std::string(" ") + version + " |";
        rule += "---|";
    }
    text += " notes |" + rule + "---|\n";
    for (const auto& [name, type] : all) {
        text += "| `" + name + "` |";
        for (const Support s : type->support.in) text += std::string(" ") + word(s) + " |";
        text += std::string(" ") + type->note + " |\n";
    }
    return text;
}

}  // namespace cardioid::nodes
