// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/scene_file.h"

#include "scene/checksum.h"
#include "scene/json.h"
#include "scene/sample_scene.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/resource.h>
#include <unistd.h>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace cardioid::scene {
namespace {

namespace fs = std::filesystem;

class SceneFile : public testing::Test {
protected:
    void SetUp() override {
        // Thousands of damaged files are written: in memory where the system has it, since disks flush each of them.
        const fs::path base = fs::is_directory("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path();
        std::string pattern = (base / "cardioid-scene-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
        path_ = folder_ / "scene.cardioid";
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string bytes() const {
        std::ifstream file(path_, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void overwrite(const std::string& content) const {
        std::ofstream file(path_, std::ios::binary | std::ios::trunc);
        file.write(content.data(), static_cast<std::streamsize>(content.size()));
    }
    /// The message with which loading fails; empty if it does not.
    std::string load_error() const {
        try {
            load_scene(path_);
        } catch (const SceneError& error) { return error.what(); }
        return {};
    }
    std::size_t files() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {})); }
    /// A file with a valid frame and checksum around any JSON text.
    static std::string framed(std::string json, const std::string& data) {
        std::string file = std::string("CARDSCN\n", 8) + std::string("\1\0\0\0\0\0\0\0", 8);
        for (const std::uint64_t size : {std::uint64_t(json.size()), std::uint64_t(data.size())})
            file.append(reinterpret_cast<const char*>(&size), 8);
        file += json + data;
        Checksum sum;
        sum.add(std::as_bytes(std::span(file)));
        const std::uint64_t value = sum.value();
        return file.append(reinterpret_cast<const char*>(&value), 8);
    }

    fs::path folder_, path_;
};

TEST_F(SceneFile, RoundTrip) {
    const SceneDesc scene = test::sample_scene();
    save_scene(scene, path_);
    EXPECT_EQ(write_json(load_scene(path_)), write_json(scene));
    EXPECT_EQ(files(), 1u);
}

TEST_F(SceneFile, EmptySceneAndOverwrite) {
    save_scene(test::sample_scene(), path_);
    save_scene(SceneDesc{}, path_);
    EXPECT_EQ(write_json(load_scene(path_)), write_json(SceneDesc{}));
}

TEST_F(SceneFile, EveryTruncationIsAnError) {
    save_scene(test::sample_scene(), path_);
    const std::string whole = bytes();
    for (std::size_t n = 0; n < whole.size(); ++n) {
        overwrite(whole.substr(0, n));
        ASSERT_NE(load_error(), "") << n << " of " << whole.size() << " bytes";
    }
    overwrite(whole + 'x');
    EXPECT_NE(load_error().find("damaged"), std::string::npos);
}

TEST_F(SceneFile, EveryFlippedBitIsAnError) {
    save_scene(test::sample_scene(), path_);
    const std::string whole = bytes();
    for (std::size_t n = 0; n < whole.size(); ++n) {
        std::string damaged = whole;
        damaged[n] = static_cast<char>(damaged[n] ^ (1 << (n % 8)));
        overwrite(damaged);
        ASSERT_NE(load_error(), "") << "byte " << n;
    }
}

TEST_F(SceneFile, ErrorsSayWhatIsWrong) {
    EXPECT_NE(load_error().find("does not exist"), std::string::npos);
    EXPECT_NE(load_error().find(path_.string()), std::string::npos);
    overwrite("PNG something else entirely");
    EXPECT_NE(load_error().find("not a Cardioid scene file"), std::string::npos);
    save_scene(test::sample_scene(), path_);
    std::string newer = bytes();
    newer[8] = 9;
    overwrite(newer);
    EXPECT_NE(load_error().find("newer Cardioid (file version 9"), std::string::npos);
    fs::remove(path_);
    fs::create_directory(path_);
    EXPECT_NE(load_error().find("not a file"), std::string::npos);
}

TEST_F(SceneFile, HostileContentWithAValidFrame) {
    overwrite(framed("{}", ""));
    EXPECT_EQ(load_error(), "");
    overwrite(framed("{", ""));
    EXPECT_NE(load_error().find("damaged"), std::string::npos);
    overwrite(framed(R"({"future": 1})", ""));
    EXPECT_NE(load_error().find("unknown key \"future\""), std::string::npos);
    for (const char* block : {R"({"at": 0, "count": 5})", R"({"at": 0, "count": 4611686018427387905})",
                              R"({"at": 18446744073709551615, "count": 1})"}) {
        overwrite(framed(std::string(R"({"meshes": [{"positions": )") + block + "}]}", std::string(16, '\0')));
        EXPECT_NE(load_error().find("outside the file"), std::string::npos) << block;
    }
    overwrite(framed(std::string(200000, '['), ""));
    EXPECT_NE(load_error(), "");
}

/// Files may not grow beyond the limit while this lives: to a writer it is a full disk.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t limit) {
        old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &old_);
        const rlimit now{limit, old_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &now);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &old_);
        std::signal(SIGXFSZ, old_handler_);
    }

private:
    rlimit old_{};
    void (*old_handler_)(int) = nullptr;
};

TEST_F(SceneFile, AFullDiskKeepsTheOldFile) {
    save_scene(test::sample_scene(), path_);
    const std::string before = bytes();
    SceneDesc large = test::sample_scene();
    large.meshes[0].positions.resize(1 << 16);
    {
        FileSizeLimit limit(10000);
        EXPECT_THROW(save_scene(large, path_), SceneError);
    }
    EXPECT_EQ(bytes(), before);
    EXPECT_EQ(files(), 1u) << "the temporary file is gone";
}

TEST_F(SceneFile, AnUnwritableFolderIsAnError) {
    try {
        save_scene(SceneDesc{}, folder_ / "no such folder" / "scene.cardioid");
        FAIL() << "no error";
    } catch (const SceneError& error) {
        EXPECT_NE(std::string(error.what()).find("no such folder"), std::string::npos);
    }
}

TEST(Checksum, DoesNotDependOnTheCuts) {
    std::vector<std::byte> data(100);
    for (std::size_t i = 0; i < data.size(); ++i) data[i] = static_cast<std::byte>(i * 37);
    Checksum whole;
    whole.add(data);
    for (std::size_t cut = 1; cut < 30; ++cut) {
        Checksum parts;
        for (std::size_t at = 0; at < data.size(); at += cut)
            parts.add(std::span(data).subspan(at, std::min(cut, data.size() - at)));
        EXPECT_EQ(parts.value(), whole.value()) << cut;
    }
    Checksum shorter;
    shorter.add(std::span(data).first(99));
    EXPECT_NE(shorter.value(), whole.value());
}

}  // namespace
}  // namespace cardioid::scene
