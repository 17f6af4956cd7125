// SPDX-License-Identifier: GPL-3.0-or-later
// cardioid-filter as a program, with films that cardioid-render has saved.
#include "analytic/scenes.h"
#include "apps/program.h"
#include "scene/scene_file.h"

#include <nlohmann/json.hpp>

#include <unistd.h>

namespace cardioid::test {
namespace {

namespace fs = std::filesystem;

Finished filter(const std::string& arguments) { return run_program(CARDIOID_FILTER, arguments); }

class FilterCli : public testing::Test {
protected:
    FilterCli() {
        fs::create_directories(folder);
        fs::copy_file(suite_folder / "scene.cardioid", at("scene.cardioid"));
        fs::copy_file(suite_folder / "film.cardioid", film);
    }
    ~FilterCli() override {
        std::error_code ignored;
        fs::remove_all(folder, ignored);
    }
    FilterCli(const FilterCli&) = delete;
    FilterCli& operator=(const FilterCli&) = delete;

    static void SetUpTestSuite() {
        fs::create_directories(suite_folder);
        SceneMaker m = busy_scene();
        m.scene.settings.width = 40;
        m.scene.settings.height = 24;
        m.scene.settings.samples = 8;
        scene::save_scene(m.scene, suite_folder / "scene.cardioid");
        render(suite_folder, "");
    }
    static void TearDownTestSuite() {
        std::error_code ignored;
        fs::remove_all(suite_folder, ignored);
    }

    std::string at(const std::string& name) const { return (folder / name).string(); }
    /// Renders the folder's scene.cardioid; leaves film.cardioid and render.png.
    static void render(const fs::path& folder, const std::string& options) {
        const std::string in = folder.string();
        const Finished r = run_program(CARDIOID_RENDER, in + "/scene.cardioid -q --film " + in + "/film.cardioid -o " +
                                                            in + "/render.png " + options);
        ASSERT_EQ(r.code, 0) << r.output;
    }
    /// Bytes of the picture that the options make.
    std::string png(const std::string& options) const {
        const Finished r = filter(film + " -q -o " + at("f.png") + " " + options);
        EXPECT_EQ(r.code, 0) << r.output;
        EXPECT_EQ(r.output, "");
        return bytes_of(at("f.png"));
    }

    static inline const fs::path suite_folder =
        fs::temp_directory_path() / ("cardioid_films_" + std::to_string(getpid()));
    fs::path folder = fs::temp_directory_path() / ("cardioid_filter_" + std::to_string(getpid()));
    std::string film = (folder / "film.cardioid").string();
};

TEST_F(FilterCli, WritesExrWithEveryPassAndStatistics) {
    const Finished r = filter(film + " -o " + at("out.exr") + " --threads 1 --stats " + at("s.json"));
    ASSERT_EQ(r.code, 0) << r.output;
    EXPECT_NE(r.output.find("out.exr"), std::string::npos) << "says where the picture went";
    const std::string header = bytes_of(at("out.exr")).substr(0, 8000);
    EXPECT_EQ(header.substr(0, 4), "\x76\x2f\x31\x01");
    for (const char* channel : {"Depth.Z", "D1.R", "C2.B", "Raw.R", "Filtered.G", "Withheld.B"})
        EXPECT_NE(header.find(channel), std::string::npos) << channel;
    const auto stats = nlohmann::json::parse(bytes_of(at("s.json")));
    EXPECT_EQ(stats["phase"], "done");
    EXPECT_EQ(stats["threads"], 1);
    EXPECT_GT(stats["clusters"].get<int>(), 40 * 24);
}

TEST_F(FilterCli, FiltersAsTheRenderDid) {
    const std::string plain = bytes_of(suite_folder / "render.png");
    EXPECT_EQ(png("--set use_filter=false"), plain) << "without the filter it is the rendered picture";
    const std::string filtered = png("");
    EXPECT_NE(filtered, plain) << "it filters unless told not to";
    EXPECT_NE(png("--set filter_size=3"), filtered);
    render(folder, "--set use_filter=true --set filter_size=5");
    EXPECT_EQ(png(""), bytes_of(at("render.png"))) << "the film remembers its settings";
    EXPECT_EQ(png("--set filter_size=11"), filtered);
}

TEST_F(FilterCli, WrongSettingsAreExplained) {
    const auto refuse = [&](const std::string& assignment, const std::string& word) {
        expect_refusal(filter(film + " -q -o " + at("x.exr") + " --set " + assignment), "error", word);
        EXPECT_FALSE(fs::exists(at("x.exr")));
    };
    refuse("filter_sise=3", "filter_sise");
    refuse("filter_size", "name=value");
    refuse("firefly_density=nan", "firefly_density");
    refuse("filter_method=magic", "magic");
    refuse("samples=4", "samples");
    const Finished r = filter(film + " -q -o " + at("x.exr") + " --set filter_size=65");
    EXPECT_EQ(r.code, 2);
    EXPECT_EQ(r.output, "error: settings has filter_size 65, which is out of range\n");
}

TEST_F(FilterCli, SettingsAtTheirLimitsWork) {
    const std::string low = " --set filter_size=1 --set luminance_sensitivity=0 --set firefly_density=0",
                      high = " --set filter_size=63 --set luminance_sensitivity=0.99 --set firefly_density=1000";
    for (const std::string& options : {low, high})
        EXPECT_EQ(filter(film + " -q -o " + at("limits.exr") + options).code, 0) << options;
}

TEST_F(FilterCli, BadFilesAreNamed) {
    const auto refuse = [&](const std::string& name, const std::string& word) {
        const Finished r = filter(at(name) + " -q -o " + at("x.exr"));
        expect_refusal(r, "error", name);
        expect_refusal(r, word);
        EXPECT_FALSE(fs::exists(at("x.exr")));
    };
    refuse("missing.cardioid", "does not exist");
    refuse("scene.cardioid", "scene");
    std::ofstream(at("text.cardioid")) << "not a film at all, just some words that are long enough to hold a header";
    refuse("text.cardioid", "not a Cardioid film");
    std::ofstream(at("empty.cardioid")).close();
    refuse("empty.cardioid", "empty.cardioid");
    fs::copy_file(film, at("short.cardioid"));
    fs::resize_file(at("short.cardioid"), fs::file_size(film) / 2);
    refuse("short.cardioid", "truncated");
    std::string damaged = bytes_of(film);
    damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 0x40);
    std::ofstream(at("damaged.cardioid"), std::ios::binary) << damaged;
    refuse("damaged.cardioid", "damaged");
    std::string newer = bytes_of(film);
    newer[8] = 100;
    std::ofstream(at("newer.cardioid"), std::ios::binary) << newer;
    refuse("newer.cardioid", "newer");
    expect_refusal(filter(folder.string() + " -q -o " + at("x.exr")), "error");
}

TEST_F(FilterCli, FilmsWithoutClustersSayWhy) {
    render(folder, "--set record_clusters=false");
    expect_refusal(filter(film + " -q -o " + at("x.exr")), "error", "record_clusters");
    EXPECT_EQ(png("--set use_filter=false"), bytes_of(at("render.png")));
}

TEST_F(FilterCli, WrongArgumentsAndOutputsAreExplained) {
    expect_refusal(filter(""), "film");
    expect_refusal(filter(film + " --lanes 3"), "lanes");
    expect_refusal(filter(film + " --no-such-option"), "no-such-option");
    expect_refusal(filter(film + " -q -o " + at("no/such/folder/out.exr")), "error", "no/such/folder");
    expect_refusal(run_program(CARDIOID_RENDER, at("scene.cardioid") + " -q -o " + at("y.png") + " --film " +
                                                    at("no/such/folder/f.cardioid")),
                   "error", "no/such/folder");
    const Finished help = filter("--help");
    EXPECT_EQ(help.code, 0);
    for (const char* option : {"--output", "--set", "--threads", "--lanes", "--stats", "--quiet"})
        EXPECT_NE(help.output.find(option), std::string::npos) << option;
}

}  // namespace
}  // namespace cardioid::test
