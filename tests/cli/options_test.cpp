// Every option that a command declares is described by its help, and on record with the image that it made.
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"
#include "unit/gltf/builder.h"

namespace lavalight::test {
namespace {

using Words = std::vector<std::string>;

// What a command's help lists: names of options without their dashes, or of commands, each with its text.
using Listed = std::map<std::string, std::string>;

struct Help {
    Listed options;
    Listed commands;
};

// "--camera NAME" of "--camera NAME|INDEX         Camera by name": two spaces part an entry from its text.
std::pair<std::string, std::string> cut(const std::string& line) {
    const size_t gap = line.find("  ");
    const size_t text = gap == std::string::npos ? gap : line.find_first_not_of(' ', gap);
    return {line.substr(0, gap), text == std::string::npos ? "" : line.substr(text)};
}

// "schedule" of "--schedule,--kernels auto|fused", "output" of "-o,--output OUT.exr".
std::string nameOf(const std::string& entry) {
    const size_t dashes = entry.find("--");
    const size_t begin = dashes == std::string::npos ? 0 : dashes + 2;
    return entry.substr(begin, entry.find_first_of(" =,", begin) - begin);
}

Help parseHelp(const std::string& text) {
    Help help;
    Listed none;
    Listed* section = &none;
    std::string last;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const size_t indent = line.find_first_not_of(' ');
        if (indent == 0)
            section = line == "Options:" ? &help.options : line == "Subcommands:" ? &help.commands : &none;
        else if (indent == 2) {
            const auto [entry, words] = cut(line.substr(indent));
            last = nameOf(entry);
            (*section)[last] = words;
        } else if (indent != std::string::npos)
            (*section)[last] += line.substr(indent);
    }
    return help;
}

class Options : public testing::Test {
  protected:
    [[nodiscard]] Help helpOf(Words command) const {
        command.emplace_back("--help");
        const ProgramResult result = runLavalight(command, folder_.path());
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return parseHelp(result.out);
    }
    void expectDescribed(const Words& command) const {
        const Help help = helpOf(command);
        EXPECT_EQ(help.options.count("help"), 1u) << "no options read";
        for (const Listed& listed : {help.options, help.commands})
            for (const auto& [name, text] : listed)
                EXPECT_NE(text, "") << (command.empty() ? "lavalight" : command.back()) << ": " << name;
        for (const auto& [name, text] : help.commands) {
            Words below = command;
            below.push_back(name);
            expectDescribed(below);
        }
    }
    // Names of the settings in the report of a render with these options.
    [[nodiscard]] std::set<std::string> recordedWith(const Words& more) const {
        Words words{"render", "--size", "8x8", "-o", "image.exr", "--report", "report.json", "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        const ProgramResult result = runLavalight(words, folder_.path());
        EXPECT_EQ(result.exitCode, 0) << result.err;
        const Json report = Json::parse(readFile(folder_ / "report.json"));
        std::set<std::string> names;
        for (const auto& [name, value] : report.at("settings").items())
            names.insert(name);
        return names;
    }

    const TemporaryFolder folder_;
};

TEST_F(Options, OfEveryCommandAreDescribedByItsHelp) {
    expectDescribed({});
}

// A triangle that grows, with a variant of its material, in a scene with a name.
GltfBuilder changingTriangle() {
    GltfBuilder builder;
    const int mesh = builder.addTriangle();
    builder.json["materials"] = Json::array({Json::object(), Json::object()});
    builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
        {{"material", 1}, {"variants", {0}}}};
    builder.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "night"}}};
    builder.addNode({{"mesh", mesh}});
    builder.json["scenes"] = Json::array({{{"name", "day"}, {"nodes", Json::array({0})}}});
    const int keys = builder.addVec3({{1, 1, 1}, {3, 3, 3}});
    const int times = builder.addIndices<float>({0, 1}, kFloat);
    builder.json["animations"] = {
        {{"name", "grow"},
         {"samplers", {{{"input", times}, {"output", keys}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}}}}};
    return builder;
}

TEST_F(Options, OfRenderAreOnRecordUnlessTheyAreListedHereWithTheReason) {
    // Options that are on record in another way: under names of their own (scene, camera, device, png), as
    // first-sample and spp, in the ledger (denoise), as the settings that a preset stands for, as --at of
    // each frame, and as content (accelerator, with what it rounds by).
    const std::set<std::string> elsewhere{"camera", "device", "tonemap", "exposure", "samples",    "denoise",
                                          "preset", "frames", "frame",   "fps",      "accelerator"};
    // Options that need no record: what to write and where; how the work is cut up, which no bit depends on;
    // whether to render or refuse; whether to go on or begin again.
    const std::set<std::string> noMatterOfTheImage{
        "help",           "output",         "png",        "report",           "quiet",
        "wave-size",      "band-rows",      "threads",    "validate",         "kernel-timeout",
        "require-device", "allow-external", "checkpoint", "checkpoint-every", "resume",
        "turntable", // "turns" tells of each image
        "watch"};
    std::set<std::string> recorded =
        recordedWith({"--spp", "1", "--look-from", "0,0,1", "--look-at", "0,0,0", "--up", "0,1,0", "--fov",
                      "40", "--aperture", "0.1", "--focus", "1"});
    recorded.merge(recordedWith({"--spp", "1", "--view", "top", "--background", "transparent", "--ground",
                                 "shadow", "--crop", "1,1,2x2", "--aov", "depth"}));
    recorded.merge(
        recordedWith({"--spp", "1", "--env", "sky", "--intrinsics", "8,8,4,4", "--clip", "0.1,9"}));
    std::filesystem::copy_file(folder_ / "image.exr", folder_ / "sky.exr");
    recorded.merge(
        recordedWith({"--spp", "1", "--panorama", "--no-clip", "--env", "sky.exr", "--env-rotation", "20"}));
    ASSERT_EQ(runLavalight({"new-experiment", "mine", "lib/sampling/roulette.glsl"}, folder_.path()).exitCode,
              0);
    std::ofstream(folder_ / "mine/lib/sampling/roulette.glsl", std::ios::app) << "// A change.\n";
    recorded.merge(recordedWith({"--spp", "1", "--shaders", "mine"}));
    writeFileAtomically(folder_ / "changing.glb", changingTriangle().glb());
    recorded.merge(recordedWith({"changing.glb", "--spp", "1", "--at", "0.5", "--animation", "grow",
                                 "--variant", "night", "--scene", "day"}));
    for (const auto& [name, text] : helpOf({"render"}).options) {
        const size_t places = recorded.count(name) + elsewhere.count(name) + noMatterOfTheImage.count(name);
        EXPECT_EQ(places, 1u) << "--" << name << ": record it with the image (describe), or list it here";
    }
}

} // namespace
} // namespace lavalight::test
