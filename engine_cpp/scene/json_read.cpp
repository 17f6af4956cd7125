// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/fields.h"
#include "scene/json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardioid::scene {
namespace {

[[noreturn]] void wrong_type(std::string_view expected, const Json& json) {
    throw SceneError("expected " + std::string(expected) + ", got " + json.type_name());
}

std::string in_quotes(std::string_view text) { return '"' + std::string(text) + '"'; }

/// Runs `step`; an error inside is reported with `prefix` before it. The prefix is only made when it is needed.
template <class Prefix, class Step>
void within(Prefix prefix, Step step) {
    try {
        step();
    } catch (const SceneError& error) { throw SceneError(prefix() + ": " + error.what()); }
}

struct KnownKeys {
    std::vector<std::string_view> keys;
    template <class T>
    void operator()(const char* key, T&&) {
        keys.emplace_back(key);
    }
};

class Reader;
template <class T>
concept Described = requires(Reader& r, T& d) {
    fields(r, d);
};

class Reader {
public:
    explicit Reader(ArraySource* arrays) : arrays_(arrays) {}

    template <class T>
    void operator()(const char* key, T&& out) {
        const auto found = object_->find(key);
        if (found == object_->end()) return;
        ++keys_found_;
        within([&] { return "key " + in_quotes(key); }, [&] { read(*found, out); });
    }

    template <Described T>
    void read(const Json& json, T& out) {
        const auto label = [&] {
            const bool named = json.is_object() && json.contains("name") && json["name"].is_string();
            return std::string(k_kind<T>) + (named ? ' ' + in_quotes(json["name"].template get<std::string>()) : "");
        };
        within(label, [&] { read_object(json, out); });
    }

private:
    template <class T>
    void read_object(const Json& json, T& out) {
        if (!json.is_object()) wrong_type("an object", json);
        const Json* outer = std::exchange(object_, &json);
        const std::size_t outer_found = std::exchange(keys_found_, 0);
        fields(*this, out);
        if (keys_found_ != json.size()) unknown_key(json, out);
        object_ = outer;
        keys_found_ = outer_found;
    }

    template <class T>
    [[noreturn]] static void unknown_key(const Json& json, T& out) {
        KnownKeys known;
        fields(known, out);
        for (const auto& item : json.items())
            if (std::find(known.keys.begin(), known.keys.end(), item.key()) == known.keys.end())
                throw SceneError("unknown key " + in_quotes(item.key()));
        throw SceneError("unknown key");
    }

    void read(const Json& json, bool& out) {
        if (!json.is_boolean()) wrong_type("a boolean", json);
        out = json.get<bool>();
    }
    template <class T>
    requires std::is_integral_v<T>
    void read(const Json& json, T& out) {
        if (!json.is_number_integer()) wrong_type("an integer", json);
        const bool fits = json.is_number_unsigned() ? std::in_range<T>(json.get<std::uint64_t>())
                                                    : std::in_range<T>(json.get<std::int64_t>());
        if (!fits) throw SceneError(json.dump() + " is out of range");
        out = json.get<T>();
    }
    void read(const Json& json, double& out) {
        if (json.is_number()) {
            out = json.get<double>();
        } else if (json == "nan") {
            out = std::numeric_limits<double>::quiet_NaN();
        } else if (json == "inf" || json == "-inf") {
            out = json == "inf" ? HUGE_VAL : -HUGE_VAL;
        } else {
            wrong_type("a number", json);
        }
    }
    void read(const Json& json, float& out) {
        double value = 0;
        read(json, value);
        out = static_cast<float>(value);
    }
    void read(const Json& json, std::string& out) {
        if (!json.is_string()) wrong_type("text", json);
        out = json.get<std::string>();
    }
    template <class E>
    requires std::is_enum_v<E>
    void read(const Json& json, E& out) {
        std::string text;
        read(json, text);
        std::string allowed;
        for (std::size_t i = 0; i < std::size(EnumNames<E>::names); ++i) {
            if (EnumNames<E>::names[i] == text) {
                out = static_cast<E>(i);
                return;
            }
            allowed += (i ? ", " : "") + std::string(EnumNames<E>::names[i]);
        }
        throw SceneError(in_quotes(text) + " is none of " + allowed);
    }
    void read(const Json& json, Float3& out) {
        std::array<float, 3> xyz;
        read(json, xyz);
        out = {xyz[0], xyz[1], xyz[2]};
    }
    void read(const Json& json, Affine& out) {
        if (!json.is_array()) wrong_type("a matrix", json);
        std::vector<float> flat;
        for (const Json& row : json) {
            const std::size_t width = row.is_array() ? row.size() : 1;
            if (row.is_array() && width != 4)
                throw SceneError("a matrix row has " + std::to_string(width) + " numbers, not 4");
            for (std::size_t i = 0; i < width; ++i) read(row.is_array() ? row[i] : row, flat.emplace_back());
        }
        if (flat.size() != 12 && flat.size() != 16)
            throw SceneError("a matrix has 12 or 16 numbers, not " + std::to_string(flat.size()));
        std::copy_n(flat.begin(), 12, out.m.begin());
    }
    template <class T, std::size_t n>
    void read(const Json& json, std::array<T, n>& out) {
        if (!json.is_array()) wrong_type("a list of " + std::to_string(n), json);
        if (json.size() != n)
            throw SceneError("expected " + std::to_string(n) + " values, got " + std::to_string(json.size()));
        for (std::size_t i = 0; i < n; ++i) read(json[i], out[i]);
    }
    template <class T>
    void read(const Json& json, std::vector<T>& out) {
        if (!json.is_array()) wrong_type("a list", json);
        out.clear();
        out.reserve(json.size());
        for (const Json& item : json)
            within([&] { return "item " + std::to_string(out.size() - 1); }, [&] { read(item, out.emplace_back()); });
    }
    template <class T>
    void read(const Json& json, std::optional<T>& out) {
        if (json.is_null()) {
            out.reset();
        } else {
            read(json, out.emplace());
        }
    }
    template <class T>
    void read(const Json& json, std::map<std::string, T>& out) {
        if (!json.is_object()) wrong_type("an object", json);
        for (const auto& [key, value] : json.items())
            within([&, name = key] { return in_quotes(name); }, [&, name = key] { read(value, out[name]); });
    }
    template <class T>
    void read(const Json& json, Bulk<std::vector<T>>& bulk) {
        if constexpr (std::is_same_v<T, std::uint8_t>) {
            if (json.is_binary()) {
                bulk.values = json.get_binary();
                return;
            }
        }
        if (json.is_object() && arrays_) return read_block(json, bulk.values);
        read(json, bulk.values);
    }
    template <class T>
    void read_block(const Json& json, std::vector<T>& out) {
        std::uint64_t at = 0, count = 0;
        if (json.size() != 2 || !json.contains("at") || !json.contains("count")) wrong_type("a block of data", json);
        read(json["at"], at);
        read(json["count"], count);
        if (count > arrays_->available(at) / sizeof(T)) throw SceneError("the block of data lies outside the file");
        out.resize(count);
        arrays_->get(at, std::as_writable_bytes(std::span(out)));
    }
    void read(const Json& json, ParamValue& out) {
        if (json.is_boolean()) {
            out = json.get<bool>();
        } else if (json.is_array()) {
            read(json, out.emplace<std::vector<double>>());
        } else if (json.is_string() && json != "nan" && json != "inf" && json != "-inf") {
            out = json.get<std::string>();
        } else {
            read(json, out.emplace<double>());
        }
    }
    void read(const Json& json, InputDesc& out) {
        if (json.is_object()) {
            if (json.size() != 3 || !json.contains("node") || !json.contains("socket") || !json.contains("type"))
                throw SceneError("a link has the keys node, socket and type");
            read(json["node"], out.node);
            read(json["socket"], out.socket);
            read(json["type"], out.type);
            if (out.node < 0) throw SceneError("a link to node " + std::to_string(out.node));
        } else if (json.is_string() && json != "nan" && json != "inf" && json != "-inf") {
            out.type = "STRING";
            read(json, out.socket);
        } else if (json.is_boolean()) {
            out.value[0] = json.get<bool>() ? 1.0f : 0.0f;
        } else if (json.is_array()) {
            if (json.empty() || json.size() > 4)
                throw SceneError("a socket has 1 to 4 numbers, not " + std::to_string(json.size()));
            for (std::size_t i = 0; i < json.size(); ++i) read(json[i], out.value[i]);
        } else if (!json.is_null()) {
            read(json, out.value[0]);
        }
    }
    void read(const Json& json, OutputDesc& out) {
        if (json.is_null()) return;
        if (!json.is_array() || json.size() != 2) wrong_type("null or [node, socket]", json);
        read(json[0], out.node);
        read(json[1], out.socket);
    }

    ArraySource* arrays_;
    const Json* object_ = nullptr;
    std::size_t keys_found_ = 0;
};

}  // namespace

template <class T>
T read_json(const Json& json, ArraySource* arrays) {
    T out;
    Reader(arrays).read(json, out);
    return out;
}

template ImageDesc read_json(const Json&, ArraySource*);
template MaterialDesc read_json(const Json&, ArraySource*);
template GraphDesc read_json(const Json&, ArraySource*);
template MeshDesc read_json(const Json&, ArraySource*);
template InstanceDesc read_json(const Json&, ArraySource*);
template GroupDesc read_json(const Json&, ArraySource*);
template LightDesc read_json(const Json&, ArraySource*);
template WorldDesc read_json(const Json&, ArraySource*);
template CameraDesc read_json(const Json&, ArraySource*);
template Settings read_json(const Json&, ArraySource*);
template FilterSettings read_json(const Json&, ArraySource*);
template SceneDesc read_json(const Json&, ArraySource*);

}  // namespace cardioid::scene
