// SPDX-License-Identifier: GPL-3.0-or-later
// JSON ⇄ the structs of scene_desc.h and graph_desc.h, with their field names as keys (docs/python-api.md). Used by the
// scene file, the command line and the Python module. Reading is strict: an unknown key, a wrong type or a number that
// does not fit throws SceneError with a message that names the object and the key; a key that is absent keeps its
// default.
//
//   enums       lower-case enumerator names ("channel_packed")
//   transforms  12 numbers (row-major 3×4), 16 numbers, or 3 or 4 rows of 4
//   numbers     non-finite ones may be written as "nan", "inf", "-inf" (JSON has no spelling for them)
//   bytes       a JSON binary value or a list of 0…255
//   sockets     a number, flag, list of 1…4 numbers, null (shader sockets), {"node", "socket", "type"} for a link,
//               or text: kept as InputDesc{type "STRING", socket = the text}
#pragma once

#include "scene/error.h"
#include "scene/scene_desc.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace cardioid::scene {

using Json = nlohmann::json;

/// Where long arrays (geometry, pixels) live when they are not inside the JSON: the scene file's raw blocks.
class ArraySink {
public:
    virtual ~ArraySink() = default;
    /// Keeps `bytes` for as long as the description lives; returns where they will be.
    virtual std::uint64_t put(std::span<const std::byte> bytes) = 0;
};
class ArraySource {
public:
    virtual ~ArraySource() = default;
    /// Bytes available from `at`; get() is only called within them.
    virtual std::uint64_t available(std::uint64_t at) const = 0;
    virtual void get(std::uint64_t at, std::span<std::byte> out) = 0;
};

/// T: ImageDesc, MaterialDesc, GraphDesc, MeshDesc, InstanceDesc, GroupDesc, LightDesc, WorldDesc, CameraDesc,
/// Settings, SceneDesc. Without a sink or source, arrays are lists inside the JSON.
template <class T>
Json write_json(const T& value, ArraySink* arrays = nullptr);
template <class T>
T read_json(const Json& json, ArraySource* arrays = nullptr);

}  // namespace cardioid::scene
