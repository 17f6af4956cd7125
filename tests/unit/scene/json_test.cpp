// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/json.h"

#include "scene/fields.h"
#include "scene/sample_scene.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace cardioid::scene {
namespace {

/// The message of the error that reading `text` as a T throws; empty if it does not throw.
template <class T>
std::string error_of(const std::string& text) {
    try {
        read_json<T>(Json::parse(text));
    } catch (const SceneError& error) { return error.what(); }
    return {};
}

template <class T>
void expect_round_trip(const T& value) {
    const Json json = write_json(value);
    const T back = read_json<T>(Json::parse(json.dump()));
    EXPECT_EQ(write_json(back), json);
}

/// Visits two structs side by side would need reflection; instead each known key is changed in JSON and must come back.
template <class T>
void expect_every_key_is_read(const T& sample) {
    const Json changed = write_json(sample), original = write_json(T{});
    for (const auto& [key, value] : changed.items()) {
        Json one = Json::object();
        one[key] = value;
        EXPECT_EQ(write_json(read_json<T>(one))[key], value) << key;
    }
    EXPECT_EQ(changed.size(), original.size());
}

TEST(SceneJson, EveryStructRoundTrips) {
    const SceneDesc scene = test::sample_scene();
    expect_round_trip(scene);
    expect_round_trip(scene.images[0]);
    expect_round_trip(scene.materials[0]);
    expect_round_trip(scene.meshes[0]);
    expect_round_trip(scene.groups[0]);
    expect_round_trip(scene.instances[1]);
    expect_round_trip(scene.lights[0]);
    expect_round_trip(*scene.world);
    expect_round_trip(*scene.camera);
    expect_round_trip(scene.settings);
    expect_every_key_is_read(scene.instances[0]);
    expect_every_key_is_read(scene.lights[0]);
    expect_every_key_is_read(scene.settings);
    expect_every_key_is_read(*scene.camera);
}

TEST(SceneJson, RoundTripKeepsValues) {
    const SceneDesc scene = test::sample_scene();
    const SceneDesc back = read_json<SceneDesc>(write_json(scene));
    EXPECT_EQ(back.settings.seed, 0xffffffffu);
    EXPECT_EQ(back.settings.memory_limit, 1ll << 40);
    EXPECT_EQ(back.instances[0].transform, scene.instances[0].transform);
    EXPECT_EQ(back.meshes[0].positions, scene.meshes[0].positions);
    EXPECT_EQ(back.images[0].packed, scene.images[0].packed);
    EXPECT_EQ(back.lights[0].energy, -12.5f);
    EXPECT_EQ(back.lights[0].shape, AreaShape::ellipse);
    ASSERT_TRUE(back.world);
    EXPECT_EQ(back.world->sampling, WorldSampling::manual);
    EXPECT_EQ(back.materials[0].graph.nodes[1].inputs.at("Name").socket, "some text");
}

TEST(SceneJson, AbsentKeysKeepDefaults) {
    const Settings s = read_json<Settings>(Json::object());
    EXPECT_EQ(s.samples, Settings{}.samples);
    const SceneDesc scene = read_json<SceneDesc>(Json::parse(R"({"camera": null})"));
    EXPECT_FALSE(scene.camera);
    EXPECT_FALSE(scene.world);
}

TEST(SceneJson, GraphAsInTheDocumentation) {
    const Json json = Json::parse(R"({"nodes": [
        {"name": "Principled BSDF", "type": "ShaderNodeBsdfPrincipled",
         "params": {"distribution": "GGX", "flag": true, "n": 3},
         "inputs": {"Base Color": [0.1, 0.2, 0.3, 1], "Roughness": 0.5, "Shader": null, "On": true,
                    "Normal": {"node": 1, "socket": "Normal", "type": "VECTOR"}}},
        {"name": "G", "type": "ShaderNodeNewGeometry", "params": {}, "inputs": {}}],
        "surface": [0, "BSDF"], "volume": null, "displacement": null})");
    const GraphDesc graph = read_json<GraphDesc>(json);
    const NodeDesc& node = graph.nodes.at(0);
    EXPECT_EQ(std::get<std::string>(node.params.at("distribution")), "GGX");
    EXPECT_TRUE(std::get<bool>(node.params.at("flag")));
    EXPECT_EQ(std::get<double>(node.params.at("n")), 3.0);
    EXPECT_EQ(node.inputs.at("Base Color").value, (SocketValue{0.1f, 0.2f, 0.3f, 1}));
    EXPECT_EQ(node.inputs.at("Roughness").value, (SocketValue{0.5f, 0, 0, 0}));
    EXPECT_EQ(node.inputs.at("On").value[0], 1.0f);
    EXPECT_FALSE(node.inputs.at("Shader").linked());
    EXPECT_EQ(node.inputs.at("Normal").node, 1);
    EXPECT_EQ(node.inputs.at("Normal").type, "VECTOR");
    EXPECT_EQ(graph.surface.socket, "BSDF");
    EXPECT_EQ(graph.volume.node, -1);
}

TEST(SceneJson, TransformsInEveryShape) {
    const Float3 expected{4, 8, 12};
    for (const char* text : {R"({"transform": [1,2,3,4, 5,6,7,8, 9,10,11,12]})",
                             R"({"transform": [1,2,3,4, 5,6,7,8, 9,10,11,12, 0,0,0,1]})",
                             R"({"transform": [[1,2,3,4],[5,6,7,8],[9,10,11,12],[0,0,0,1]]})",
                             R"({"transform": [[1,2,3,4],[5,6,7,8],[9,10,11,12]]})"})
        EXPECT_EQ(read_json<InstanceDesc>(Json::parse(text)).transform.translation(), expected) << text;
    EXPECT_NE(error_of<InstanceDesc>(R"({"transform": [1, 2, 3]})").find("12 or 16"), std::string::npos);
    EXPECT_NE(error_of<InstanceDesc>(R"({"transform": [[1, 2, 3]]})").find("row"), std::string::npos);
}

TEST(SceneJson, NonFiniteNumbersSurviveText) {
    CameraDesc camera;
    camera.focus_distance = std::numeric_limits<float>::quiet_NaN();
    camera.clip_end = std::numeric_limits<float>::infinity();
    camera.clip_start = -camera.clip_end;
    const CameraDesc back = read_json<CameraDesc>(Json::parse(write_json(camera).dump()));
    EXPECT_TRUE(std::isnan(back.focus_distance));
    EXPECT_EQ(back.clip_end, camera.clip_end);
    EXPECT_EQ(back.clip_start, camera.clip_start);
}

TEST(SceneJson, ErrorsNameTheObjectAndTheKey) {
    EXPECT_EQ(error_of<LightDesc>(R"({"name": "Lamp", "energy": "bright"})"),
              "light \"Lamp\": key \"energy\": expected a number, got string");
    EXPECT_EQ(error_of<LightDesc>(R"({"name": "Lamp", "enregy": 3})"), "light \"Lamp\": unknown key \"enregy\"");
    EXPECT_EQ(error_of<LightDesc>(R"({"kind": "laser"})"),
              "light: key \"kind\": \"laser\" is none of point, spot, sun, area");
    EXPECT_EQ(error_of<Settings>(R"({"samples": 1.5})"), "settings: key \"samples\": expected an integer, got number");
    EXPECT_EQ(error_of<Settings>(R"({"seed": -1})"), "settings: key \"seed\": -1 is out of range");
    EXPECT_EQ(error_of<Settings>(R"({"samples": 5000000000})"),
              "settings: key \"samples\": 5000000000 is out of range");
    EXPECT_EQ(error_of<InstanceDesc>(R"({"visibility": 256})"), "instance: key \"visibility\": 256 is out of range");
    EXPECT_EQ(error_of<InstanceDesc>(R"({"name": "A", "holdout": 1})"),
              "instance \"A\": key \"holdout\": expected a boolean, got number");
    EXPECT_EQ(error_of<CameraDesc>("[]"), "camera: expected an object, got array");
    EXPECT_EQ(error_of<CameraDesc>(R"({"view_plane": [1, 2]})"),
              "camera: key \"view_plane\": expected 4 values, got 2");
    EXPECT_EQ(error_of<MaterialDesc>(
                  R"({"name": "M", "graph": {"nodes": [{"name": "Noise", "inputs": {"Scale": [1,2,3,4,5]}}]}})"),
              "material \"M\": key \"graph\": graph: key \"nodes\": item 0: node \"Noise\": key \"inputs\": \"Scale\": "
              "a socket has 1 "
              "to 4 numbers, not 5");
    EXPECT_NE(error_of<GraphDesc>(R"({"nodes": [{"inputs": {"A": {"node": 0}}}]})").find("keys node, socket and type"),
              std::string::npos);
    EXPECT_NE(error_of<GraphDesc>(R"({"surface": 3})").find("[node, socket]"), std::string::npos);
    EXPECT_NE(error_of<GraphDesc>(R"({"nodes": [{"params": {"p": {"a": 1}}}]})").find("expected a number"),
              std::string::npos);
}

TEST(SceneJson, BytesAndArraysInside) {
    Json json = Json::object();
    json["packed"] = Json::binary({1, 2, 255});
    EXPECT_EQ(read_json<ImageDesc>(json).packed, (std::vector<std::uint8_t>{1, 2, 255}));
    EXPECT_NE(error_of<ImageDesc>(R"({"packed": [256]})").find("out of range"), std::string::npos);
    EXPECT_NE(error_of<MeshDesc>(R"({"positions": {"at": 0, "count": 3}})").find("expected a list"), std::string::npos);
}

}  // namespace
}  // namespace cardioid::scene
