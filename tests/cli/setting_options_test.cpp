// Options of the estimator's settings are those of the table.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "render/setting_text.h"
#include "support/changed_setting.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

using test::runLavalight;
using test::TemporaryFolder;
using test::withAnother;

TEST(SettingOptions, HelpNamesEverySettingItsValuesAndItsDefault) {
    const TemporaryFolder folder;
    const std::string help = runLavalight({"render", "--help"}, folder.path()).out;
    for (const SettingRow& row : settingRows()) {
        const std::string head = fmt::format("--{} {}", row.name, valueNames(row));
        const std::string chosen = textOf(row, EstimatorSettings{});
        // Versions of CLI11 differ in how they print the default.
        EXPECT_TRUE(help.find(fmt::format("{}={}", head, chosen)) != std::string::npos ||
                    help.find(fmt::format("{} [{}]", head, chosen)) != std::string::npos)
            << head << " with its default is not in\n"
            << help;
        const std::string_view start = row.help.substr(0, 20); // the rest may be on the next line
        EXPECT_NE(help.find(start), std::string::npos) << start;
    }
}

// All settings at once, from the command line to the report; the image has one pixel.
TEST(SettingOptions, EveryOptionSetsItsSetting) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments{"render", "--size", "1x1",      "--spp",  "1",
                                       "-o",     "a.exr",  "--report", "a.json", "--quiet"};
    for (const SettingRow& row : settingRows()) {
        arguments.push_back("--" + std::string(row.name));
        arguments.push_back(textOf(row, withAnother(row)));
    }
    const test::ProgramResult result = runLavalight(arguments, folder.path());
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const auto settings = nlohmann::json::parse(readFile(folder / "a.json")).at("settings");
    for (const SettingRow& row : settingRows())
        EXPECT_EQ(settings.at(std::string(row.name)), textOf(row, withAnother(row))) << row.name;
}

TEST(SettingOptions, AnOptionWinsOverThePresetWhateverTheirOrder) {
    const TemporaryFolder folder;
    const test::ProgramResult result =
        runLavalight({"render", "--size", "1x1", "--spp", "1", "-o", "a.exr", "--report", "a.json", "--quiet",
                      "--hemisphere", "cosine", "--preset", "naive"},
                     folder.path());
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const auto settings = nlohmann::json::parse(readFile(folder / "a.json")).at("settings");
    EXPECT_EQ(settings.at("hemisphere"), "cosine");
    EXPECT_EQ(settings.at("nee"), "off");
}

TEST(SettingOptions, KernelsIsTheOlderNameOfSchedule) {
    const TemporaryFolder folder;
    const test::ProgramResult result =
        runLavalight({"render", "--size", "1x1", "--spp", "1", "-o", "a.exr", "--report", "a.json", "--quiet",
                      "--kernels", "wavefront"},
                     folder.path());
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(nlohmann::json::parse(readFile(folder / "a.json")).at("settings").at("schedule"), "wavefront");
    const test::ProgramResult both = runLavalight(
        {"render", "--schedule", "fused", "--kernels", "wavefront", "-o", "b.exr"}, folder.path());
    EXPECT_EQ(both.exitCode, 2);
    EXPECT_NE(both.err.find("--kernels"), std::string::npos) << both.err;
}

} // namespace
} // namespace lavalight
