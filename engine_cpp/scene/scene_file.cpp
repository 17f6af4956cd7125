// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/scene_file.h"

#include "scene/checksum.h"
#include "scene/json.h"
#include "scene/replace_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <vector>

namespace cardioid::scene {
namespace {

static_assert(std::endian::native == std::endian::little, "scene files are little-endian");

constexpr std::array<char, 8> k_magic{'C', 'A', 'R', 'D', 'S', 'C', 'N', '\n'};
constexpr std::uint32_t k_version = 1;
constexpr std::uint64_t k_alignment = 16;

struct FileHeader {
    std::array<char, 8> magic = k_magic;
    std::uint32_t version = k_version;
    std::uint32_t reserved = 0;
    std::uint64_t json_bytes = 0;
    std::uint64_t data_bytes = 0;
};
static_assert(sizeof(FileHeader) == 32);

template <class T>
std::span<const std::byte> bytes_of(const T& value) {
    return std::as_bytes(std::span(&value, 1));
}

std::uint64_t padding(std::uint64_t size) { return (k_alignment - size % k_alignment) % k_alignment; }

/// Remembers the arrays in the order of their places in the file.
class BlockList : public ArraySink {
public:
    std::uint64_t put(std::span<const std::byte> bytes) override {
        const std::uint64_t at = size_;
        blocks_.push_back(bytes);
        size_ += bytes.size() + padding(bytes.size());
        return at;
    }
    std::uint64_t size() const { return size_; }
    const std::vector<std::span<const std::byte>>& blocks() const { return blocks_; }

private:
    std::vector<std::span<const std::byte>> blocks_;
    std::uint64_t size_ = 0;
};

/// Reads arrays straight from the file's data part.
class FileBlocks : public ArraySource {
public:
    FileBlocks(std::ifstream& file, std::uint64_t begin, std::uint64_t size)
        : file_(file), begin_(begin), size_(size) {}
    std::uint64_t available(std::uint64_t at) const override { return at <= size_ ? size_ - at : 0; }
    void get(std::uint64_t at, std::span<std::byte> out) override {
        file_.seekg(static_cast<std::streamoff>(begin_ + at));
        file_.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size()));
        if (!file_) throw SceneError("cannot read a block of data");
    }

private:
    std::ifstream& file_;
    std::uint64_t begin_, size_;
};

/// The file's checksum without its last eight bytes; leaves the stream at those.
std::uint64_t checksum_of(std::ifstream& file, std::uint64_t size) {
    std::vector<std::byte> buffer(std::min<std::uint64_t>(size, std::uint64_t{1} << 20));
    Checksum sum;
    file.seekg(0);
    while (size > 0) {
        const std::size_t part = std::min<std::uint64_t>(size, buffer.size());
        file.read(reinterpret_cast<char*>(buffer.data()), static_cast<std::streamsize>(part));
        if (!file) throw SceneError("cannot be read to its end");
        sum.add({buffer.data(), part});
        size -= part;
    }
    return sum.value();
}

FileHeader read_header(std::ifstream& file, std::uint64_t file_size) {
    FileHeader header;
    const std::size_t have = std::min<std::uint64_t>(file_size, sizeof header);
    file.read(reinterpret_cast<char*>(&header), static_cast<std::streamsize>(have));
    if (have < k_magic.size() || header.magic != k_magic) throw SceneError("is not a Cardioid scene file");
    if (have < sizeof header) throw SceneError("is truncated");
    if (header.version > k_version)
        throw SceneError("was written by a newer Cardioid (file version " + std::to_string(header.version) +
                         ", this one reads up to " + std::to_string(k_version) + ")");
    const std::uint64_t rest = file_size - sizeof header;
    if (rest < 8 || header.json_bytes > rest - 8 || header.data_bytes > rest - 8 - header.json_bytes)
        throw SceneError("is truncated");
    if (header.json_bytes + header.data_bytes != rest - 8)
        throw SceneError("is damaged: it is longer than it should be");
    return header;
}

SceneDesc load(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) throw SceneError("does not exist");
    if (!std::filesystem::is_regular_file(path, error)) throw SceneError("is not a file");
    std::ifstream file(path, std::ios::binary);
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (!file || error) throw SceneError("cannot be opened");

    const FileHeader header = read_header(file, size);
    std::uint64_t stored = 0;
    const std::uint64_t sum = checksum_of(file, size - 8);
    file.read(reinterpret_cast<char*>(&stored), 8);
    if (!file || stored != sum) throw SceneError("is damaged: its checksum does not match");

    std::string text(header.json_bytes, '\0');
    file.seekg(sizeof header);
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (!file) throw SceneError("cannot be read");
    FileBlocks blocks(file, sizeof header + header.json_bytes, header.data_bytes);
    try {
        return read_json<SceneDesc>(Json::parse(text), &blocks);
    } catch (const Json::exception& bad) { throw SceneError(std::string("is damaged: ") + bad.what()); }
}

}  // namespace

void save_scene(const SceneDesc& scene, const std::filesystem::path& path) {
    BlockList blocks;
    std::string text;
    try {
        text = write_json(scene, &blocks).dump(-1, ' ', false, Json::error_handler_t::replace);
    } catch (const Json::exception& bad) { throw SceneError("cannot save '" + path.string() + "': " + bad.what()); }
    text.append(padding(text.size()), ' ');
    const FileHeader header{.json_bytes = text.size(), .data_bytes = blocks.size()};

    replace_file(path, [&](FileWriter& out) {
        Checksum sum;
        const auto put = [&](std::span<const std::byte> bytes) {
            sum.add(bytes);
            out.write(bytes);
        };
        put(bytes_of(header));
        put(std::as_bytes(std::span(text)));
        static constexpr std::array<std::byte, k_alignment> zeros{};
        for (const auto block : blocks.blocks()) {
            put(block);
            put(std::span(zeros).first(padding(block.size())));
        }
        out.write(bytes_of(sum.value()));
    });
}

SceneDesc load_scene(const std::filesystem::path& path) {
    try {
        return load(path);
    } catch (const SceneError& error) {
        throw SceneError("scene file '" + path.string() + "' " + error.what());
    } catch (const std::bad_alloc&) { throw SceneError("scene file '" + path.string() + "' does not fit in memory"); }
}

}  // namespace cardioid::scene
