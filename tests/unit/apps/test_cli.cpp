// SPDX-License-Identifier: GPL-3.0-or-later
// cardioid-render as a program: files in, pictures and exit codes out.
#include "analytic/scenes.h"
#include "apps/program.h"
#include "scene/scene_file.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <limits>

namespace cardioid::test {
namespace {

namespace fs = std::filesystem;

Finished run(const std::string& arguments) { return run_program(CARDIOID_RENDER, arguments); }

class Cli : public testing::Test {
protected:
    Cli() {
        fs::create_directories(folder);
        SceneMaker m = busy_scene();
        m.scene.settings.width = 24;
        m.scene.settings.height = 16;
        m.scene.settings.samples = 4;
        scene::save_scene(m.scene, scene_file);
    }
    ~Cli() override {
        std::error_code ignored;
        fs::remove_all(folder, ignored);
    }
    Cli(const Cli&) = delete;
    Cli& operator=(const Cli&) = delete;

    std::string at(const std::string& name) const { return (folder / name).string(); }
    nlohmann::json stats(const std::string& options) const {
        const Finished r = run(scene_file + " -q " + options + " -o " + at("s.exr") + " --stats " + at("s.json"));
        EXPECT_EQ(r.code, 0) << r.output;
        return nlohmann::json::parse(bytes_of(at("s.json")));
    }

    fs::path folder = fs::temp_directory_path() / ("cardioid_cli_" + std::to_string(getpid()));
    std::string scene_file = (folder / "scene.cardioid").string();
};

TEST_F(Cli, WritesExrWithEveryPass) {
    const Finished r = run(scene_file + " -o " + at("out.exr"));
    ASSERT_EQ(r.code, 0) << r.output;
    const std::string exr = bytes_of(at("out.exr"));
    ASSERT_GT(exr.size(), 1000u);
    EXPECT_EQ(exr.substr(0, 4), "\x76\x2f\x31\x01");
    const std::string header = exr.substr(0, 8000);
    for (const char* channel : {"Depth.Z", "Normal.X", "D1.R", "D2.G", "D3.B", "C1.R", "C2.B"})
        EXPECT_NE(header.find(channel), std::string::npos) << channel;
    EXPECT_NE(header.find("camera_paths"), std::string::npos) << "statistics are in the file";
    EXPECT_NE(r.output.find("out.exr"), std::string::npos) << "says where the picture went";
}

TEST_F(Cli, WritesPngOfTheFramesSize) {
    ASSERT_EQ(run(scene_file + " -q -o " + at("out.png")).code, 0);
    const std::string png = bytes_of(at("out.png"));
    ASSERT_GT(png.size(), 100u);
    EXPECT_EQ(png.substr(1, 3), "PNG");
    EXPECT_EQ(png.substr(16, 8), std::string("\0\0\0\x18\0\0\0\x10", 8));
}

TEST_F(Cli, OptionsOverrideTheFile) {
    const auto plain = stats("");
    EXPECT_EQ(plain["counts"]["camera_paths"], 24 * 16 * 4);
    const auto changed = stats("--samples 7 --threads 1 --seed 42 --lanes 1");
    EXPECT_EQ(changed["counts"]["camera_paths"], 24 * 16 * 7);
    EXPECT_EQ(changed["threads"], 1);
    EXPECT_EQ(changed["seed"], 42);
    EXPECT_EQ(changed["lanes"], 1);
    const auto limited = stats("--samples 100000000 --time-limit 1.5");
    EXPECT_EQ(limited["phase"], "done");
    EXPECT_LT(limited["seconds"]["render"].get<double>(), 5);
}

TEST_F(Cli, TheSameSeedGivesTheSamePicture) {
    ASSERT_EQ(run(scene_file + " -q --threads 1 -o " + at("a.png")).code, 0);
    ASSERT_EQ(run(scene_file + " -q --threads 2 -o " + at("b.png")).code, 0);
    ASSERT_EQ(run(scene_file + " -q --seed 5 -o " + at("c.png")).code, 0);
    EXPECT_EQ(bytes_of(at("a.png")), bytes_of(at("b.png")));
    EXPECT_NE(bytes_of(at("a.png")), bytes_of(at("c.png")));
}

TEST_F(Cli, QuietSaysNothing) { EXPECT_EQ(run(scene_file + " -q -o " + at("out.exr")).output, ""); }

TEST_F(Cli, BadFilesAreNamed) {
    expect_refusal(run(at("missing.cardioid") + " -q -o " + at("x.exr")), "error", "missing.cardioid");
    std::ofstream(at("text.cardioid")) << "not a scene at all, just some words that are long enough to hold a header";
    expect_refusal(run(at("text.cardioid") + " -q -o " + at("x.exr")), "error", "text.cardioid");
    std::ofstream(at("empty.cardioid")).close();
    expect_refusal(run(at("empty.cardioid") + " -q -o " + at("x.exr")), "error", "empty.cardioid");
    fs::copy_file(scene_file, at("short.cardioid"));
    fs::resize_file(at("short.cardioid"), fs::file_size(scene_file) / 2);
    expect_refusal(run(at("short.cardioid") + " -q -o " + at("x.exr")), "error", "short.cardioid");
    std::string damaged = bytes_of(scene_file);
    damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 0x40);
    std::ofstream(at("damaged.cardioid"), std::ios::binary) << damaged;
    expect_refusal(run(at("damaged.cardioid") + " -q -o " + at("x.exr")), "error", "damaged.cardioid");
    expect_refusal(run(folder.string() + " -q -o " + at("x.exr")), "error");
    EXPECT_FALSE(fs::exists(at("x.exr")));
}

TEST_F(Cli, ScenesThatCannotBeRenderedSayWhy) {
    SceneMaker m = busy_scene();
    m.scene.camera.reset();
    scene::save_scene(m.scene, at("blind.cardioid"));
    expect_refusal(run(at("blind.cardioid") + " -q -o " + at("x.exr")), "error", "camera");
    m = busy_scene();
    m.scene.settings.width = 0;
    scene::save_scene(m.scene, at("narrow.cardioid"));
    expect_refusal(run(at("narrow.cardioid") + " -q -o " + at("x.exr")), "error", "frame");
    m = busy_scene();
    m.scene.settings.width = m.scene.settings.height = 60000;
    m.scene.settings.memory_limit = 1 << 20;
    scene::save_scene(m.scene, at("huge.cardioid"));
    expect_refusal(run(at("huge.cardioid") + " -q -o " + at("x.exr")), "error", "memory");
}

TEST_F(Cli, BrokenObjectsAreWarnedOfByName) {
    SceneMaker m = busy_scene();
    m.scene.settings.samples = 1;
    m.scene.meshes[2].positions[5] = std::numeric_limits<float>::quiet_NaN();
    m.scene.meshes[2].name = "Broken Ball";
    scene::save_scene(m.scene, at("broken.cardioid"));
    const Finished r = run(at("broken.cardioid") + " -q -o " + at("broken.exr"));
    EXPECT_EQ(r.code, 0);
    EXPECT_NE(r.output.find("warning"), std::string::npos) << r.output;
    EXPECT_NE(r.output.find("Broken Ball"), std::string::npos) << r.output;
    EXPECT_TRUE(fs::exists(at("broken.exr")));
}

TEST_F(Cli, WrongArgumentsAreExplained) {
    expect_refusal(run(""), "scene");
    expect_refusal(run(scene_file + " --samples 0"), "samples");
    expect_refusal(run(scene_file + " --samples many"), "samples");
    expect_refusal(run(scene_file + " --lanes 3"), "lanes");
    expect_refusal(run(scene_file + " --no-such-option"), "no-such-option");
    const Finished help = run("--help");
    EXPECT_EQ(help.code, 0);
    for (const char* option : {"--output", "--samples", "--time-limit", "--threads", "--seed", "--stats"}) {
        EXPECT_NE(help.output.find(option), std::string::npos) << option;
    }
}

TEST_F(Cli, AnOutputThatCannotBeWrittenIsAnError) {
    expect_refusal(run(scene_file + " -q -o " + at("no/such/folder/out.exr")), "error", "no/such/folder");
    expect_refusal(run(scene_file + " -q -o " + at("out.exr") + " --stats " + at("no/such/folder/s.json")), "error",
                   "no/such/folder");
}

}  // namespace
}  // namespace cardioid::test
