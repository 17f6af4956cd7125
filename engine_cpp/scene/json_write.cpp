// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/fields.h"
#include "scene/json.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace cardioid::scene {
namespace {

class Writer;
template <class T>
concept Described = requires(Writer& w, const T& d) {
    fields(w, d);
};

class Writer {
public:
    explicit Writer(ArraySink* arrays) : arrays_(arrays) {}

    template <class T>
    void operator()(const char* key, const T& value) {
        (*object_)[key] = write(value);
    }

    template <Described T>
    Json write(const T& value) {
        Json object = Json::object();
        Json* outer = std::exchange(object_, &object);
        fields(*this, value);
        object_ = outer;
        return object;
    }

private:
    template <class T>
    requires std::is_integral_v<T> Json write(T value) { return value; }
    Json write(float value) { return write(static_cast<double>(value)); }
    Json write(double value) {
        if (std::isfinite(value)) return value;
        return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
    }
    Json write(const std::string& value) { return value; }
    template <class E>
    requires std::is_enum_v<E> Json write(E value) { return EnumNames<E>::names[static_cast<std::size_t>(value)]; }
    Json write(const Float3& value) { return {write(value.x), write(value.y), write(value.z)}; }
    Json write(const Affine& value) { return write(value.m); }
    template <class T, std::size_t n>
    Json write(const std::array<T, n>& values) {
        return list(values);
    }
    template <class T>
    Json write(const std::vector<T>& values) {
        return list(values);
    }
    template <class T>
    Json write(const std::optional<T>& value) {
        return value ? write(*value) : Json();
    }
    template <class T>
    Json write(const std::map<std::string, T>& values) {
        Json object = Json::object();
        for (const auto& [key, value] : values) object[key] = write(value);
        return object;
    }
    template <class T>
    Json write(const Bulk<T>& bulk) {
        if (!arrays_) return write(bulk.values);
        return {{"at", arrays_->put(std::as_bytes(std::span(bulk.values)))}, {"count", bulk.values.size()}};
    }
    Json write(const ParamValue& value) {
        return std::visit([this](const auto& held) { return write(held); }, value);
    }
    Json write(const InputDesc& input) {
        if (input.linked()) return {{"node", input.node}, {"socket", input.socket}, {"type", input.type}};
        if (input.type == "STRING") return input.socket;
        const SocketValue& v = input.value;
        return v[1] == 0 && v[2] == 0 && v[3] == 0 ? write(v[0]) : write(v);
    }
    Json write(const OutputDesc& output) {
        if (output.node < 0) return {};
        return Json::array({output.node, output.socket});
    }
    template <class T>
    Json list(const T& values) {
        Json array = Json::array();
        for (const auto& value : values) array.push_back(write(value));
        return array;
    }

    ArraySink* arrays_;
    Json* object_ = nullptr;
};

}  // namespace

template <class T>
Json write_json(const T& value, ArraySink* arrays) {
    return Writer(arrays).write(value);
}

template Json write_json(const ImageDesc&, ArraySink*);
template Json write_json(const MaterialDesc&, ArraySink*);
template Json write_json(const GraphDesc&, ArraySink*);
template Json write_json(const MeshDesc&, ArraySink*);
template Json write_json(const InstanceDesc&, ArraySink*);
template Json write_json(const GroupDesc&, ArraySink*);
template Json write_json(const LightDesc&, ArraySink*);
template Json write_json(const WorldDesc&, ArraySink*);
template Json write_json(const CameraDesc&, ArraySink*);
template Json write_json(const Settings&, ArraySink*);
template Json write_json(const FilterSettings&, ArraySink*);
template Json write_json(const SceneDesc&, ArraySink*);

}  // namespace cardioid::scene
