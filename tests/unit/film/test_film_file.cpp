// SPDX-License-Identifier: GPL-3.0-or-later
#include "film/film_file.h"

#include "film/some_film.h"
#include "scene/checksum.h"
#include "scene/error.h"
#include "scene/scene_file.h"

#include <sys/resource.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace cardioid::film {
namespace {

using scene::SceneError;
using test::settings_of;
namespace fs = std::filesystem;

class FilmFileTest : public testing::Test {
protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::temp_directory_path() / ("cardioid-film-" + std::to_string(::getpid()) + '-' + info->name());
        fs::create_directories(folder_);
        path_ = folder_ / "frame.cardioid";
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string read() const {
        std::ifstream file(path_, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void write(const std::string& bytes) const {
        // A file that is written over is flushed to the disk by some file systems.
        fs::remove(path_);
        std::ofstream(path_, std::ios::binary) << bytes;
    }
    /// With a checksum that fits, so that what comes after it is tested.
    void write_signed(std::string bytes) const {
        scene::Checksum sum;
        sum.add(std::as_bytes(std::span(bytes)).first(bytes.size() - 8));
        const std::uint64_t value = sum.value();
        std::memcpy(bytes.data() + bytes.size() - 8, &value, 8);
        write(bytes);
    }
    /// The message of load(); empty when it succeeds.
    std::string error() const {
        try {
            FilmFile::load(path_);
        } catch (const SceneError& e) { return e.what(); }
        return {};
    }
    void expect_error(const std::string& part) const {
        const std::string message = error();
        EXPECT_NE(message.find(part), std::string::npos) << "'" << message << "' instead of '" << part << "'";
        EXPECT_NE(message.find(path_.string()), std::string::npos) << message;
    }

    fs::path folder_, path_;
};

/// A film with all that a file may hold.
Film rich_film(int width = 11, int height = 9, int samples = 6) {
    scene::Settings s = settings_of(width + 7, height + 5);
    s.crop = {4, 3, width, height};
    s.exposure = 1.7f;
    s.transparent_film = true;
    s.adaptive_threshold = 0.01f;
    s.filter = {true, scene::FilterMethod::thesis, 0.25f, 0.125f, 21, false, true, false, 0.3f};
    Film film(s);
    test::fill(film, samples, 3);
    const float photons[k_classes - 1][3] = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}};
    film.set_photons(width / 2, height / 2, photons);
    return film;
}

TEST_F(FilmFileTest, RoundTripKeepsEveryBit) {
    const Film film = rich_film();
    FilmFile::save(film, path_);
    const std::string bytes = read();
    const Film back = FilmFile::load(path_);
    test::expect_same_lists(film, back);
    EXPECT_EQ(back.region().x, 4);
    EXPECT_EQ(back.region().y, 3);
    EXPECT_EQ(back.exposure(), 1.7f);
    const scene::FilterSettings f = back.filter_settings();
    EXPECT_TRUE(f.use_filter);
    EXPECT_EQ(f.filter_method, scene::FilterMethod::thesis);
    EXPECT_EQ(f.firefly_density, 0.25f);
    EXPECT_EQ(f.luminance_sensitivity, 0.125f);
    EXPECT_EQ(f.filter_size, 21);
    EXPECT_FALSE(f.filter_direct);
    EXPECT_TRUE(f.filter_indirect);
    EXPECT_FALSE(f.filter_deep);
    EXPECT_EQ(f.texture_width, 0.3f);
    const Frame a = test::resolved(film), b = test::resolved(back);
    for (const Pass& p : a.passes) EXPECT_EQ(b.find(p.name)->data, p.data) << p.name;
    EXPECT_EQ(back.memory_bytes(), film.memory_bytes());
    FilmFile::save(back, path_);
    EXPECT_EQ(read(), bytes);
}

TEST_F(FilmFileTest, EverySizeAndKind) {
    for (const auto& [width, height] : {std::pair{1, 1}, {8, 8}, {1, 17}, {65, 1}, {9, 8}}) {
        for (const bool clusters : {true, false}) {
            for (const bool adaptive : {true, false}) {
                scene::Settings s = settings_of(width, height);
                s.record_clusters = clusters;
                s.adaptive_threshold = adaptive ? 0.1f : 0.0f;
                Film film(s);
                test::fill(film, 3, 1);
                FilmFile::save(film, path_);
                const Film back = FilmFile::load(path_);
                EXPECT_EQ(back.has_clusters(), clusters);
                EXPECT_EQ(test::resolved(back).find("Combined")->data, test::resolved(film).find("Combined")->data);
                if (clusters) test::expect_same_lists(film, back);
            }
        }
    }
    FilmFile::save(Film(settings_of(3, 3)), path_);
    EXPECT_EQ(FilmFile::load(path_).samples(2, 2), 0u);
}

TEST_F(FilmFileTest, WhatIsNoFilmIsNamed) {
    expect_error("does not exist");
    scene::save_scene(scene::SceneDesc{}, path_);
    expect_error("it is a Cardioid scene file");
    write("\x76\x2f\x31\x01 and more of it");
    expect_error("it is an OpenEXR picture");
    write("\x89PNG\r\n\x1a\n0000000000000000000000000000000000000000");
    expect_error("it is a PNG picture");
    write("BLENDER-v404");
    expect_error("it is a Blender file");
    write("");
    expect_error("it is empty");
    write("hello");
    expect_error("is not a Cardioid film file");
    path_ = folder_;
    expect_error("is not a file");
    path_ = folder_ / "no" / "such.cardioid";
    expect_error("does not exist");
    EXPECT_THROW(FilmFile::save(rich_film(), path_), SceneError);
}

TEST_F(FilmFileTest, TruncatedAnywhere) {
    FilmFile::save(rich_film(2, 2, 2), path_);
    const std::string bytes = read();
    for (std::size_t n = 0; n < bytes.size(); n += n < 600 ? 1 : 37) {
        write(bytes.substr(0, n));
        EXPECT_NE(error(), "") << n;
    }
    write(bytes.substr(0, bytes.size() - 1));
    expect_error("is truncated");
    write(bytes.substr(0, 20));
    expect_error("is truncated");
    write(bytes + "x");
    expect_error("longer than it should be");
    write(bytes);
    EXPECT_EQ(error(), "");
}

TEST_F(FilmFileTest, EveryFlippedByteIsFound) {
    FilmFile::save(rich_film(2, 1, 2), path_);
    const std::string bytes = read();
    std::mt19937 random(1);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        std::string bad = bytes;
        bad[i] = static_cast<char>(bad[i] ^ (1 << random() % 8));
        // The reserved word and others are covered by the checksum, too.
        write(bad);
        EXPECT_NE(error(), "") << i;
    }
}

/// Everything that the filter reads must be as an editor would leave it.
void expect_sound(const Film& film) {
    for (int y = 0; y < film.region().height; ++y) {
        for (int x = 0; x < film.region().width; ++x) {
            for (int l = 0; l < k_layers; ++l) ASSERT_TRUE(valid(film.clusters().view(x, y, l), film.samples(x, y)));
            float rest[3];
            film.unfiltered(x, y, rest);
            ASSERT_TRUE(std::isfinite(rest[0] + rest[1] + rest[2] + film.features(x, y).detail[0]));
        }
    }
}

TEST_F(FilmFileTest, DamageBehindAGoodChecksumIsFoundOrHarmless) {
    FilmFile::save(rich_film(9, 2, 6), path_);
    const std::string bytes = read();
    std::mt19937 random(7);
    int refused = 0;
    constexpr int k_tries = 3000;
    for (int i = 0; i < k_tries; ++i) {
        std::string bad = bytes;
        // Half of the tries in the header and its JSON.
        const std::size_t range = i % 2 == 0 ? 400 : bytes.size() - 8;
        for (auto n = 1 + random() % 3; n > 0; --n)
            bad[random() % range] = static_cast<char>(random() % 4 == 0 ? 0xff : random());
        write_signed(bad);
        try {
            expect_sound(FilmFile::load(path_));
        } catch (const SceneError&) { ++refused; }
    }
    EXPECT_GT(refused, k_tries / 4);
    EXPECT_LT(refused, k_tries);
}

class FilmFileHeader : public FilmFileTest {
protected:
    void SetUp() override {
        FilmFileTest::SetUp();
        FilmFile::save(rich_film(8, 8, 3), path_);
        bytes_ = read();
    }
    template <class T>
    void put(std::size_t at, T value) {
        std::memcpy(bytes_.data() + at, &value, sizeof value);
    }
    /// Replaces a part of the JSON by as long a text.
    void replace(const std::string& old, const std::string& text) {
        ASSERT_EQ(old.size(), text.size());
        const std::size_t at = bytes_.find(old);
        ASSERT_NE(at, std::string::npos) << old;
        bytes_.replace(at, old.size(), text);
    }
    std::string bytes_;
};

TEST_F(FilmFileHeader, NewerVersion) {
    put<std::uint32_t>(8, 2);
    write_signed(bytes_);
    expect_error("newer Cardioid (file version 2, this one reads up to 1)");
}

TEST_F(FilmFileHeader, OtherPixels) {
    const std::size_t at = bytes_.find("\"pixel_bytes\":") + 14;
    bytes_[at] = '9';
    write_signed(bytes_);
    expect_error("was written by another Cardioid");
}

TEST_F(FilmFileHeader, AbsurdCounts) {
    for (const std::uint64_t count : {1ull << 20, 1ull << 40, ~0ull, ~0ull / 32 + 1}) {
        put(24, count);
        write_signed(bytes_);
        expect_error("more clusters than pixels can hold");
    }
    put<std::uint64_t>(24, 0);
    write_signed(bytes_);
    expect_error("longer than it should be");
}

TEST_F(FilmFileHeader, AbsurdJsonLength) {
    put(16, ~0ull);
    write_signed(bytes_);
    expect_error("is damaged");
    put<std::uint64_t>(16, 1 << 16);
    write_signed(bytes_.substr(0, 4000));
    expect_error("is truncated");
}

TEST_F(FilmFileHeader, AbsurdRegion) {
    replace("[4,3,8,8]", "[4,3,8,0]");
    write_signed(bytes_);
    expect_error("a picture of 8 × 0 pixels");
    for (const char* region :
         {"[4,99999]", "[4,-3,8,8", "[1e9,3,8]", "{4,3,8,8}", "[4,3,8,99", "[0,0,9,8]", "[1e99,3]", "[4,3,8]", "[]"}) {
        SetUp();
        std::string text = region;
        text.resize(9, ' ');
        replace("[4,3,8,8]", text);
        write_signed(bytes_);
        EXPECT_NE(error(), "") << region;
    }
}

TEST_F(FilmFileHeader, AbsurdExposure) {
    for (const char* exposure : {"1e300", "null ", "\"1.7\"", "false"}) {
        SetUp();
        const std::size_t at = bytes_.find("\"exposure\":") + 11;
        bytes_.replace(at, 5,
                       std::string(exposure) + std::string(5 - std::min<std::size_t>(5, std::strlen(exposure)), ' '));
        write_signed(bytes_);
        EXPECT_NE(error(), "") << exposure;
    }
}

TEST_F(FilmFileHeader, AbsurdFilterSettingsAreRepaired) {
    replace("\"filter_size\":21", "\"filter_size\":90");
    write_signed(bytes_);
    EXPECT_EQ(error(), "");
    EXPECT_EQ(FilmFile::load(path_).filter_settings().filter_size, 63);
}

TEST_F(FilmFileTest, MoreThanMemoryIsRefusedBeforeItIsAllocated) {
    // A sparse file of the promised length, 65 536² pixels.
    FilmFile::save(Film([] {
                       scene::Settings s = settings_of(65536, 1);
                       s.record_clusters = false;
                       return s;
                   }()),
                   path_);
    std::string bytes = read();
    const std::uint64_t row = bytes.size();
    const std::size_t at = bytes.find("[0,0,65536,1]");
    ASSERT_NE(at, std::string::npos);
    std::uint64_t json = 0;
    std::memcpy(&json, bytes.data() + 16, 8);
    const std::uint64_t per_pixel = (row - 32 - json - 8) / 65536;
    bytes.resize(32 + json);
    bytes.replace(at, 13, "[0,0,65536,65536]");
    bytes.resize(bytes.size() + (16 - bytes.size() % 16) % 16, ' ');
    json = bytes.size() - 32;
    std::memcpy(bytes.data() + 16, &json, 8);
    write(bytes);
    std::error_code failed;
    fs::resize_file(path_, bytes.size() + (std::uint64_t{65536} * 65536) * per_pixel + 8, failed);
    if (failed) GTEST_SKIP() << "no sparse files here";
    expect_error("more than this machine's memory");
}

TEST_F(FilmFileTest, AFullDiskLeavesTheOldFile) {
    FilmFile::save(rich_film(3, 3, 2), path_);
    const std::string old = read();
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    ::getrlimit(RLIMIT_FSIZE, &before);
    const Film larger = rich_film(40, 40, 4);
    for (const rlim_t limit : {0, 100, 5000, 100000}) {
        const rlimit full{limit, before.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &full);
        EXPECT_THROW(FilmFile::save(larger, path_), SceneError);
        ::setrlimit(RLIMIT_FSIZE, &before);
        EXPECT_EQ(read(), old);
        EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1)
            << "nothing is left over";
    }
    std::signal(SIGXFSZ, SIG_DFL);
    FilmFile::save(larger, path_);
    EXPECT_GT(read().size(), 100000u);
}

}  // namespace
}  // namespace cardioid::film
