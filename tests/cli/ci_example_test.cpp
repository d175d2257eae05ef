// docs/ci.md and docs/ci-example.yml: their commands do what they say, on a small scene.
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/file.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

using test::ProgramResult;
using test::runLavalight;
using test::TemporaryFolder;

const std::string kSource = LAVALIGHT_SOURCE_DIR;

// The arguments of each line that starts with `lavalight`, continued lines joined, comments off, of small
// images.
std::vector<std::vector<std::string>> commandsOf(const std::string& file) {
    std::string text = readFile(kSource + "/docs/" + file);
    text = std::regex_replace(text, std::regex("\\\\\n *"), "");
    text = std::regex_replace(text, std::regex("256x256"), "32x32");
    text = std::regex_replace(text, std::regex("--spp 1024"), "--spp 64");
    std::vector<std::vector<std::string>> commands;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line.substr(0, line.find(" #")));
        std::string word;
        if (!(words >> word) || word != "lavalight")
            continue;
        commands.emplace_back();
        while (words >> word)
            commands.back().push_back(word);
    }
    return commands;
}

class CiExample : public testing::Test {
  protected:
    void SetUp() override {
        for (const char* name : {"models", "golden", "out"})
            std::filesystem::create_directory(folder_ / name);
        useScene("cornell-box");
    }

    void useScene(const std::string& name) const {
        std::filesystem::copy_file(kSource + "/assets/" + name + ".gltf", folder_ / "models" / "lamp.gltf",
                                   std::filesystem::copy_options::overwrite_existing);
    }

    // The exit code of the last command; the others must be 0.
    [[nodiscard]] int runAll(const std::string& file, size_t count) const {
        const auto commands = commandsOf(file);
        EXPECT_EQ(commands.size(), count);
        int last = 0;
        for (const std::vector<std::string>& command : commands) {
            EXPECT_EQ(last, 0);
            const ProgramResult result = runLavalight(command, folder_.path());
            last = result.exitCode;
            EXPECT_TRUE(last == 0 || command.front() == "compare") << command.front() << ": " << result.err;
        }
        return last;
    }

    const TemporaryFolder folder_;
};

TEST_F(CiExample, ItsCommandsFindTheModelEqualToTheDocumentsGoldenImage) {
    EXPECT_EQ(runAll("ci.md", 3), 0);
    EXPECT_EQ(runAll("ci-example.yml", 3), 0);
    for (const char* file : {"lamp.exr", "lamp.png", "lamp.json", "lamp.html", "lamp-flip.png"})
        EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / file)) << file;
}

TEST_F(CiExample, AnotherModelFailsAndLeavesTheReport) {
    EXPECT_EQ(runAll("ci.md", 3), 0);
    std::filesystem::remove(folder_ / "out" / "lamp.html");
    useScene("cornell-glass");
    EXPECT_EQ(runAll("ci-example.yml", 3), 1);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / "lamp.html"));
}

TEST_F(CiExample, WithoutAGoldenImageThereIsNoComparison) {
    EXPECT_EQ(runAll("ci-example.yml", 3), 3);
}

} // namespace
} // namespace lavalight
