// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/image_path.h"

#include <charconv>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace cardioid::scene {

ImagePath image_path(const std::string& path) {
    static constexpr std::string_view mark = "#frame=";
    const auto at = path.rfind(mark);
    if (at == std::string::npos) return {path, 0};
    const char* end = path.data() + path.size();
    int frame = 0;
    const auto read = std::from_chars(path.data() + at + mark.size(), end, frame);
    std::error_code error;
    if (read.ec != std::errc() || read.ptr != end || frame < 0 || std::filesystem::exists(path, error))
        return {path, 0};
    return {path.substr(0, at), frame};
}

}  // namespace cardioid::scene
