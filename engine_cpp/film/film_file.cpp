// SPDX-License-Identifier: GPL-3.0-or-later
#include "film/film_file.h"

#include "film/film_layout.h"
#include "scene/checksum.h"
#include "scene/error.h"
#include "scene/replace_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <numeric>

namespace cardioid::film {
namespace {

using scene::SceneError;

static_assert(std::endian::native == std::endian::little, "film files are little-endian");

/// Pixels of a block by rows, as files have them.
constexpr auto k_rows = [] {
    std::array<int, k_block * k_block> pixels{};
    for (int y = 0; y < k_block; ++y) {
        for (int x = 0; x < k_block; ++x) pixels[static_cast<std::size_t>(y * k_block + x)] = pixel_index(x, y);
    }
    return pixels;
}();

template <class T>
std::span<const std::byte> bytes_of(const T& value) {
    return std::as_bytes(std::span(&value, 1));
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
    const std::string text = write_contents({.region = film.region_,
                                             .exposure = film.exposure_,
                                             .transparent = film.transparent_,
                                             .photons = !film.photons_.empty(),
                                             .clusters = film.has_clusters(),
                                             .pixel_bytes = sizeof(Film::Pixel),
                                             .filter = film.filter_});
    const FilmHeader header{.json_bytes = text.size(),
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
    std::array<std::byte, sizeof(FilmHeader)> start{};
    const auto begun = std::span(start).first(std::min<std::uint64_t>(size, start.size()));
    in.read(begun);
    const FilmHeader header = read_film_header(begun);
    if (header.json_bytes > size - sizeof header) throw SceneError("is truncated");
    std::string text(header.json_bytes, '\0');
    in.read(std::as_writable_bytes(std::span(text)));
    const FilmContents c = read_contents(text);
    if (c.pixel_bytes != sizeof(Film::Pixel))
        throw SceneError("was written by another Cardioid: its pixels have " + std::to_string(c.pixel_bytes) +
                         " bytes, not " + std::to_string(sizeof(Film::Pixel)));
    check_film_size(c, header, size, sizeof(Film::Pixel) + (c.photons ? sizeof(Film::PhotonMeans) : 0));

    scene::Settings settings;
    settings.width = c.region.x + c.region.width;
    settings.height = c.region.y + c.region.height;
    settings.crop = {c.region.x, c.region.y, c.region.width, c.region.height};
    settings.exposure = c.exposure;
    settings.transparent_film = c.transparent;
    settings.record_clusters = c.clusters;
    settings.filter = c.filter;
    Film film(settings);
    if (!c.clusters) film.clusters_ = {};
    in.read(film.pixels_);
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
        block.room = static_cast<std::uint16_t>(ClusterStore::room_for(block.begin[k_block_lists]));
        block.clusters = ClusterStore::allocate(block.room);
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
    if (!all_finite(film.pixels_) || !all_finite(film.photons_))
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
    } catch (const std::bad_alloc&) { throw SceneError("film file '" + path.string() + "' does not fit in memory"); }
}

}  // namespace cardioid::film
