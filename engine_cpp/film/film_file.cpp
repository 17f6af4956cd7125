// SPDX-License-Identifier: GPL-3.0-or-later
#include "film/film_file.h"

#include "film/foreign.h"
#include "scene/checksum.h"
#include "scene/error.h"
#include "scene/json.h"
#include "scene/limits.h"
#include "scene/replace_file.h"
#include "scene/validate.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <numeric>

namespace cardioid::film {
namespace {

using scene::Json;
using scene::SceneError;

static_assert(std::endian::native == std::endian::little, "film files are little-endian");

constexpr std::array<char, 8> k_magic{'C', 'A', 'R', 'D', 'F', 'L', 'M', '\n'};
constexpr std::uint32_t k_version = 1;
/// Far more than its keys need; a damaged length must not allocate.
constexpr std::uint64_t k_longest_json = std::uint64_t{1} << 16;
constexpr int k_widest = 65536;

/// Pixels of a block by rows, as files have them.
constexpr auto k_rows = [] {
    std::array<int, k_block * k_block> pixels{};
    for (int y = 0; y < k_block; ++y) {
        for (int x = 0; x < k_block; ++x) pixels[static_cast<std::size_t>(y * k_block + x)] = pixel_index(x, y);
    }
    return pixels;
}();

struct FileHeader {
    std::array<char, 8> magic = k_magic;
    std::uint32_t version = k_version;
    std::uint32_t reserved = 0;
    std::uint64_t json_bytes = 0;
    std::uint64_t clusters = 0;
};
static_assert(sizeof(FileHeader) == 32);

/// What stands in the file's JSON.
struct Contents {
    Region region;
    float exposure = 1;
    bool transparent = false, odd = false, photons = false, clusters = false;
    scene::FilterSettings filter;
};

template <class T>
std::span<const std::byte> bytes_of(const T& value) {
    return std::as_bytes(std::span(&value, 1));
}

Json to_json(const Contents& c) {
    return {{"region", {c.region.x, c.region.y, c.region.width, c.region.height}},
            {"exposure", c.exposure},
            {"transparent_film", c.transparent},
            {"odd_samples", c.odd},
            {"photons", c.photons},
            {"clusters", c.clusters},
            {"filter", scene::write_json(c.filter)}};
}

Contents from_json(const std::string& text) {
    const Json json = Json::parse(text);
    Contents c;
    const Json& numbers = json.at("region");
    if (!std::ranges::all_of(numbers, [](const Json& n) { return n.is_number_integer(); }))
        throw SceneError("is damaged: its region is not in pixels");
    const auto region = numbers.get<std::array<std::int64_t, 4>>();
    const auto side = [](std::int64_t at, std::int64_t size) {
        return at >= 0 && size >= 1 && size <= k_widest && at <= k_widest - size;
    };
    if (!side(region[0], region[2]) || !side(region[1], region[3]))
        throw SceneError("is damaged: a picture of " + std::to_string(region[2]) + " × " + std::to_string(region[3]) +
                         " pixels");
    c.region = {static_cast<int>(region[0]), static_cast<int>(region[1]), static_cast<int>(region[2]),
                static_cast<int>(region[3])};
    const auto exposure = json.at("exposure").get<double>();
    if (!(std::abs(exposure) <= std::numeric_limits<float>::max()))
        throw SceneError("is damaged: its exposure is not a number");
    c.exposure = static_cast<float>(exposure);
    c.transparent = json.at("transparent_film").get<bool>();
    c.odd = json.at("odd_samples").get<bool>();
    c.photons = json.at("photons").get<bool>();
    c.clusters = json.at("clusters").get<bool>();
    c.filter = scene::read_json<scene::FilterSettings>(json.at("filter"));
    scene::validate(c.filter);
    return c;
}

template <class Reader>
FileHeader read_header(std::ifstream& file, Reader& in, std::uint64_t size) {
    FileHeader header;
    const std::size_t have = std::min<std::uint64_t>(size, sizeof header);
    in.read(std::as_writable_bytes(std::span(&header, 1)).first(have));
    if (have < k_magic.size() || header.magic != k_magic) {
        file.seekg(0);
        std::string start(std::min<std::uint64_t>(size, 16), '\0');
        file.read(start.data(), static_cast<std::streamsize>(start.size()));
        throw SceneError("is not a Cardioid film file" + what_it_is(start));
    }
    if (have < sizeof header) throw SceneError("is truncated");
    if (header.version > k_version)
        throw SceneError("was written by a newer Cardioid (file version " + std::to_string(header.version) +
                         ", this one reads up to " + std::to_string(k_version) + ")");
    if (header.version == 0 || header.json_bytes > k_longest_json) throw SceneError("is damaged: its header is wrong");
    return header;
}

/// Compares the length of the file with what its header promises, so that no array is larger than the file.
void check_size(const Contents& c, const FileHeader& header, std::uint64_t size, std::uint64_t per_pixel) {
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

}  // namespace

/// Reads a file from its start to its end and sums it up.
class FilmFile::Reader {
public:
    explicit Reader(std::ifstream& file) : file_(file) {}
    void read(std::span<std::byte> out) {
        file_.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size()));
        if (!file_) throw SceneError("cannot be read to its end");
        sum_.add(out);
    }
    template <class T>
    void read(std::vector<T>& values) {
        read(std::as_writable_bytes(std::span(values)));
    }
    void check() {
        const std::uint64_t sum = sum_.value();
        std::uint64_t stored = 0;
        read(std::as_writable_bytes(std::span(&stored, 1)));
        if (stored != sum) throw SceneError("is damaged: its checksum does not match");
    }

private:
    std::ifstream& file_;
    scene::Checksum sum_;
};

std::array<std::uint8_t, k_block_lists> FilmFile::counts_of(const ClusterStore::Block& block) {
    std::array<std::uint8_t, k_block_lists> counts;
    auto* to = counts.data();
    for (const int pixel : k_rows) {
        const std::uint16_t* begin = block.begin + pixel * k_layers;
        for (int l = 0; l < k_layers; ++l) *to++ = static_cast<std::uint8_t>(begin[l + 1] - begin[l]);
    }
    return counts;
}

void FilmFile::save(const Film& film, const std::filesystem::path& path) {
    const Contents contents{.region = film.region_,
                            .exposure = film.exposure_,
                            .transparent = film.transparent_,
                            .odd = !film.odd_.empty(),
                            .photons = !film.photons_.empty(),
                            .clusters = film.has_clusters(),
                            .filter = film.filter_};
    std::string text = to_json(contents).dump();
    text.append((16 - text.size() % 16) % 16, ' ');
    const FileHeader header{.json_bytes = text.size(),
                            .clusters = static_cast<std::uint64_t>(film.clusters_.cluster_count())};
    scene::replace_file(path, [&](scene::FileWriter& out) {
        scene::Checksum sum;
        const auto put = [&](std::span<const std::byte> bytes) {
            sum.add(bytes);
            out.write(bytes);
        };
        put(bytes_of(header));
        put(std::as_bytes(std::span(text)));
        put(std::as_bytes(std::span(film.pixels_)));
        put(std::as_bytes(std::span(film.odd_)));
        put(std::as_bytes(std::span(film.photons_)));
        for (const ClusterStore::Block& b : film.clusters_.blocks_) put(bytes_of(counts_of(b)));
        std::vector<Cluster> rows;
        for (const ClusterStore::Block& b : film.clusters_.blocks_) {
            rows.clear();
            for (const int pixel : k_rows) {
                const std::uint16_t* begin = b.begin + pixel * k_layers;
                rows.insert(rows.end(), b.clusters.get() + begin[0], b.clusters.get() + begin[k_layers]);
            }
            put(std::as_bytes(std::span(rows)));
        }
        out.write(bytes_of(sum.value()));
    });
}

Film FilmFile::read(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) throw SceneError("does not exist");
    if (!std::filesystem::is_regular_file(path, error)) throw SceneError("is not a file");
    std::ifstream file(path, std::ios::binary);
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (!file || error) throw SceneError("cannot be opened");

    Reader in(file);
    const FileHeader header = read_header(file, in, size);
    if (header.json_bytes > size - sizeof header) throw SceneError("is truncated");
    std::string text(header.json_bytes, '\0');
    in.read(std::as_writable_bytes(std::span(text)));
    const Contents c = from_json(text);
    check_size(c, header, size,
               sizeof(Film::Pixel) + (c.odd ? sizeof(Film::Rgb) : 0) + (c.photons ? sizeof(Film::PhotonMeans) : 0));

    scene::Settings settings;
    settings.width = c.region.x + c.region.width;
    settings.height = c.region.y + c.region.height;
    settings.crop = {c.region.x, c.region.y, c.region.width, c.region.height};
    settings.exposure = c.exposure;
    settings.transparent_film = c.transparent;
    settings.adaptive_threshold = c.odd ? 1.0f : 0.0f;
    settings.record_clusters = c.clusters;
    settings.filter = c.filter;
    Film film(settings);
    if (!c.clusters) film.clusters_ = {};
    in.read(film.pixels_);
    in.read(film.odd_);
    if (c.photons) film.photons_.resize(film.pixels_.size());
    in.read(film.photons_);
    read_clusters(film.clusters_, header.clusters, in);
    in.check();
    check(film);
    return film;
}

void FilmFile::set_counts(ClusterStore::Block& block, std::span<const std::uint8_t, k_block_lists> counts) {
    if (std::ranges::any_of(counts, [](int n) { return n > k_max_clusters; }))
        throw SceneError("is damaged: a pixel has too many clusters");
    for (int row = 0; row < k_block * k_block; ++row)
        std::copy_n(counts.data() + row * k_layers, k_layers,
                    block.begin + 1 + k_rows[static_cast<std::size_t>(row)] * k_layers);
    std::partial_sum(std::begin(block.begin), std::end(block.begin), std::begin(block.begin));
}

void FilmFile::read_clusters(ClusterStore& store, std::uint64_t total, Reader& in) {
    std::vector<std::uint8_t> counts(store.blocks_.size() * k_block_lists);
    in.read(counts);
    std::uint64_t sum = 0;
    std::vector<Cluster> rows;
    for (std::size_t b = 0; b < store.blocks_.size(); ++b) {
        ClusterStore::Block& block = store.blocks_[b];
        set_counts(block, std::span(counts).subspan(b * k_block_lists).first<k_block_lists>());
        rows.resize(block.begin[k_block_lists]);
        sum += rows.size();
        if (sum > total) break;
        in.read(rows);
        block.clusters = ClusterStore::allocate(rows.size());
        const Cluster* from = rows.data();
        for (const int pixel : k_rows) {
            const std::uint16_t* begin = block.begin + pixel * k_layers;
            std::copy_n(from, begin[k_layers] - begin[0], block.clusters.get() + begin[0]);
            from += begin[k_layers] - begin[0];
        }
    }
    if (sum != total) throw SceneError("is damaged: its clusters are not as many as it says");
}

void FilmFile::check(const Film& film) {
    const auto all_finite = [](const auto& values) {
        return std::ranges::all_of(values, [](const auto& v) {
            const auto f = std::bit_cast<std::array<float, sizeof v / sizeof(float)>>(v);
            return std::ranges::all_of(f, [](float x) { return std::isfinite(x); });
        });
    };
    // A pixel's number of samples is checked as a float with the rest: it is finite below 2^31 - 2^23.
    if (!all_finite(film.pixels_) || !all_finite(film.odd_) || !all_finite(film.photons_))
        throw SceneError("is damaged: a pixel is not a number");
    if (!film.has_clusters()) return;
    for (int y = 0; y < film.region_.height; ++y) {
        for (int x = 0; x < film.region_.width; ++x) {
            for (int layer = 0; layer < k_layers; ++layer) {
                if (!valid(film.clusters_.view(x, y, layer), film.samples(x, y)))
                    throw SceneError("is damaged: the clusters of a pixel contradict each other");
            }
        }
    }
}

Film FilmFile::load(const std::filesystem::path& path) {
    try {
        return read(path);
    } catch (const SceneError& error) {
        throw SceneError("film file '" + path.string() + "' " + error.what());
    } catch (const Json::exception& error) {
        throw SceneError("film file '" + path.string() + "' is damaged: " + error.what());
    } catch (const std::bad_alloc&) { throw SceneError("film file '" + path.string() + "' does not fit in memory"); }
}

}  // namespace cardioid::film
