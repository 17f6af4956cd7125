// SPDX-License-Identifier: GPL-3.0-or-later
// Graphs and meshes with media.
#pragma once

#include "analytic/scenes.h"

namespace cardioid::test {

inline scene::GraphDesc with_volume(scene::GraphDesc surface, const scene::GraphDesc& volume) {
    const int shift = static_cast<int>(surface.nodes.size());
    for (scene::NodeDesc node : volume.nodes) {
        for (auto& [id, input] : node.inputs) {
            if (input.linked()) input.node += shift;
        }
        surface.nodes.push_back(node);
    }
    surface.volume = {volume.volume.node + shift, volume.volume.socket};
    return surface;
}

inline scene::GraphDesc volume_of(GraphMaker& maker, const char* socket = "Volume") {
    maker.graph.volume = {maker.index(), socket};
    return maker.graph;
}
inline scene::GraphDesc absorbing(Float3 color, float density) {
    GraphMaker g;
    g.node("ShaderNodeVolumeAbsorption").value("Color", {color.x, color.y, color.z, 1}).value("Density", {density});
    return volume_of(g);
}
inline scene::GraphDesc scattering(Float3 color, float density, float anisotropy = 0) {
    GraphMaker g;
    g.node("ShaderNodeVolumeScatter")
        .value("Color", {color.x, color.y, color.z, 1})
        .value("Density", {density})
        .value("Anisotropy", {anisotropy});
    return volume_of(g);
}
inline scene::GraphDesc glowing(float strength) {
    GraphMaker g;
    g.node("ShaderNodeEmission").value("Color", {1, 1, 1, 1}).value("Strength", {strength});
    return volume_of(g, "Emission");
}
inline scene::GraphDesc added(const scene::GraphDesc& a, const scene::GraphDesc& b) {
    scene::GraphDesc g = with_volume(a, b);
    scene::NodeDesc add;
    add.type = add.name = "ShaderNodeAddShader";
    add.inputs["Shader"].node = a.volume.node;
    add.inputs["Shader"].socket = a.volume.socket;
    add.inputs["Shader_001"].node = g.volume.node;
    add.inputs["Shader_001"].socket = g.volume.socket;
    g.nodes.push_back(add);
    g.volume = {static_cast<int>(g.nodes.size()) - 1, "Shader"};
    return g;
}

/// Closed box, faces outward.
inline scene::MeshDesc box(Float3 low, Float3 high) {
    scene::MeshDesc m;
    m.name = "box";
    for (int k = 0; k < 8; ++k) {
        m.positions.push_back((k & 1) != 0 ? high.x : low.x);
        m.positions.push_back((k & 2) != 0 ? high.y : low.y);
        m.positions.push_back((k & 4) != 0 ? high.z : low.z);
    }
    m.triangles = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                   2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    m.generated_min = low;
    m.generated_size = high - low;
    return m;
}

}  // namespace cardioid::test
