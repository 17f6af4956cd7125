// SPDX-License-Identifier: GPL-3.0-or-later
#include "film/foreign.h"

#include <utility>

namespace cardioid::film {

std::string what_it_is(std::string_view start) {
    using namespace std::string_view_literals;
    static constexpr std::pair<std::string_view, const char*> k_kinds[] = {
        {"CARDSCN\n"sv, "a Cardioid scene file"},
        {"\x76\x2f\x31\x01"sv, "an OpenEXR picture"},
        {"\x89PNG"sv, "a PNG picture"},
        {"\xff\xd8\xff"sv, "a JPEG picture"},
        {"II*\0"sv, "a TIFF picture"},
        {"MM\0*"sv, "a TIFF picture"},
        {"BLENDER"sv, "a Blender file"},
        {"\x28\xb5\x2f\xfd"sv, "a compressed file, maybe of Blender"},
        {"\x1f\x8b"sv, "a compressed file, maybe of Blender"},
        {"PK\x03\x04"sv, "a ZIP archive"},
    };
    if (start.empty()) return ": it is empty";
    for (const auto& [magic, name] : k_kinds) {
        if (start.starts_with(magic)) return std::string(": it is ") + name;
    }
    return {};
}

}  // namespace cardioid::film
