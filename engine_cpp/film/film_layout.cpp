// SPDX-License-Identifier: GPL-3.0-or-later
#include "film/film_layout.h"

#include "film/foreign.h"
#include "scene/error.h"
#include "scene/json.h"
#include "scene/limits.h"
#include "scene/validate.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace cardioid::film {
namespace {

using scene::Json;
using scene::SceneError;

/// Far more than its keys need; a damaged length must not allocate.
constexpr std::uint64_t k_longest_json = std::uint64_t{1} << 16;
constexpr int k_widest = 65536;

Region region_of(const Json& numbers) {
    if (!std::ranges::all_of(numbers, [](const Json& n) { return n.is_number_integer(); }))
        throw SceneError("is damaged: its region is not in pixels");
    const auto region = numbers.get<std::array<std::int64_t, 4>>();
    const auto side = [](std::int64_t at, std::int64_t size) {
        return at >= 0 && size >= 1 && size <= k_widest && at <= k_widest - size;
    };
    if (!side(region[0], region[2]) || !side(region[1], region[3]))
        throw SceneError("is damaged: a picture of " + std::to_string(region[2]) + " × " + std::to_string(region[3]) +
                         " pixels");
    return {static_cast<int>(region[0]), static_cast<int>(region[1]), static_cast<int>(region[2]),
            static_cast<int>(region[3])};
}

FilmContents parse(const std::string& text) {
    const Json json = Json::parse(text);
    FilmContents c;
    c.region = region_of(json.at("region"));
    const auto exposure = json.at("exposure").get<double>();
    if (!(std::abs(exposure) <= std::numeric_limits<float>::max()))
        throw SceneError("is damaged: its exposure is not a number");
    c.exposure = static_cast<float>(exposure);
    c.transparent = json.at("transparent_film").get<bool>();
    c.photons = json.at("photons").get<bool>();
    c.clusters = json.at("clusters").get<bool>();
    c.pixel_bytes = json.at("pixel_bytes").get<int>();
    c.filter = scene::read_json<scene::FilterSettings>(json.at("filter"));
    scene::validate(c.filter);
    return c;
}

}  // namespace

FilmHeader read_film_header(std::span<const std::byte> start) {
    FilmHeader header;
    std::memcpy(&header, start.data(), std::min(start.size(), sizeof header));
    if (start.size() < sizeof header.magic || header.magic != k_film_magic) {
        const std::string_view text(reinterpret_cast<const char*>(start.data()), start.size());
        throw SceneError("is not a Cardioid film file" + what_it_is(text));
    }
    if (start.size() < sizeof header) throw SceneError("is truncated");
    if (header.version > k_film_version)
        throw SceneError("was written by a newer Cardioid (file version " + std::to_string(header.version) +
                         ", this one reads up to " + std::to_string(k_film_version) + ")");
    if (header.version == 0 || header.json_bytes > k_longest_json) throw SceneError("is damaged: its header is wrong");
    return header;
}

std::string write_contents(const FilmContents& c) {
    const Json json = {{"region", {c.region.x, c.region.y, c.region.width, c.region.height}},
                       {"exposure", c.exposure},
                       {"transparent_film", c.transparent},
                       {"photons", c.photons},
                       {"clusters", c.clusters},
                       {"pixel_bytes", c.pixel_bytes},
                       {"filter", scene::write_json(c.filter)}};
    // The arrays behind it stay aligned.
    std::string text = json.dump();
    text.append((16 - text.size() % 16) % 16, ' ');
    return text;
}

FilmContents read_contents(const std::string& text) {
    try {
        return parse(text);
    } catch (const Json::exception& error) { throw SceneError(std::string("is damaged: ") + error.what()); }
}

void check_film_size(const FilmContents& c, const FilmHeader& header, std::uint64_t size, std::uint64_t per_pixel) {
    const auto columns = static_cast<std::uint64_t>((c.region.width + k_block - 1) / k_block),
               rows = static_cast<std::uint64_t>((c.region.height + k_block - 1) / k_block);
    const std::uint64_t lists = c.clusters ? columns * rows * k_block_lists : 0;
    if (header.clusters > lists * k_max_clusters)
        throw SceneError("is damaged: it has more clusters than pixels can hold");
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(c.region.width) * static_cast<std::uint64_t>(c.region.height);
    const std::uint64_t need = sizeof header + header.json_bytes + pixels * per_pixel + lists +
                               header.clusters * sizeof(Cluster) + sizeof(std::uint64_t);
    if (size < need) throw SceneError("is truncated");
    if (size > need) throw SceneError("is damaged: it is longer than it should be");
    if (need > static_cast<std::uint64_t>(scene::machine_memory()))
        throw SceneError("needs " + std::to_string(need >> 20) + " MB, more than this machine's memory");
}

}  // namespace cardioid::film
