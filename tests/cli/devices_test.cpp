// `lavalight devices`: what it lists, and what a machine without Vulkan is told.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gpu/wide_vectors.h"
#include "support/environment_variable.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

using nlohmann::json;
using test::EnvironmentVariable;
using test::ProgramResult;
using test::runLavalight;
using test::TemporaryFolder;

constexpr const char* kLavapipe = "/usr/lib/x86_64-linux-gnu/libvulkan_lvp.so";

class Devices : public testing::Test {
  protected:
    [[nodiscard]] ProgramResult run(const std::vector<std::string>& arguments) const {
        return runLavalight(arguments, folder_.path());
    }

    const TemporaryFolder folder_;
};

TEST_F(Devices, JsonHasEveryFieldOfEveryDevice) {
    const ProgramResult result = run({"devices", "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const json devices = json::parse(result.out);
    ASSERT_GE(devices.size(), 1u);
    for (size_t i = 0; i < devices.size(); ++i) {
        EXPECT_EQ(devices[i].at("index"), i);
        for (const char* key : {"name", "driver", "type", "api"})
            EXPECT_FALSE(devices[i].at(key).get<std::string>().empty()) << key;
        EXPECT_TRUE(devices[i].at("refusals").is_array());
    }
    EXPECT_TRUE(std::any_of(devices.begin(), devices.end(),
                            [](const json& device) { return device.at("refusals").empty(); }));
}

TEST_F(Devices, TextHasALinePerDeviceThatSaysWhetherItCanRender) {
    const json devices = json::parse(run({"devices", "--json"}).out);
    const ProgramResult result = run({"devices"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), static_cast<long>(devices.size()));
    for (const json& device : devices) {
        EXPECT_NE(result.out.find(device.at("name").get<std::string>()), std::string::npos) << result.out;
        EXPECT_NE(result.out.find(device.at("driver").get<std::string>()), std::string::npos) << result.out;
    }
    EXPECT_NE(result.out.find("can render"), std::string::npos) << result.out;
}

TEST_F(Devices, WithoutADriverThereIsOneLineAndExitOne) {
    const EnvironmentVariable oldName("VK_ICD_FILENAMES", (folder_ / "none.json").string());
    const EnvironmentVariable newName("VK_DRIVER_FILES", (folder_ / "none.json").string());
    for (const char* command : {"devices", "render"}) {
        const ProgramResult result = run({command});
        EXPECT_EQ(result.exitCode, 1) << command;
        EXPECT_EQ(result.out, "") << command;
        EXPECT_TRUE(result.err.starts_with("lavalight: error: ")) << result.err;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_NE(result.err.find("Vulkan"), std::string::npos) << result.err;
    }
    EXPECT_EQ(folder_.count(), 0);
}

// A driver that is not installed: the system's lavapipe under another name. The loader takes the library
// itself or, where it is an older one, the manifest beside it.
std::string namedDriver(const TemporaryFolder& folder) {
    std::string library = (folder / "driver.so").string();
    std::filesystem::create_symlink(kLavapipe, library);
    std::ofstream(folder / "driver.json")
        << R"({"file_format_version": "1.0.0", "ICD": {"api_version": "1.3.0", "library_path": "./driver.so"}})";
    return library;
}

TEST_F(Devices, ADriverThatIsNamedServesWhereTheSystemHasNone) {
    if (!std::filesystem::exists(kLavapipe))
        GTEST_SKIP() << kLavapipe << " is not there";
    const std::string library = namedDriver(folder_);
    const EnvironmentVariable data("XDG_DATA_DIRS", folder_.path().string()); // where drivers are installed
    ASSERT_EQ(run({"devices"}).exitCode, 1) << "a driver is found elsewhere";
    const EnvironmentVariable driver("LAVALIGHT_DRIVER", library);
    const ProgramResult result = run({"devices"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("llvmpipe"), std::string::npos) << result.out;
}

TEST_F(Devices, ADriverThatIsNamedTakesThePlaceOfTheSystemsLavapipe) {
    if (!std::filesystem::exists(kLavapipe))
        GTEST_SKIP() << kLavapipe << " is not there";
    const std::string before = run({"devices"}).out;
    const EnvironmentVariable driver("LAVALIGHT_DRIVER", namedDriver(folder_));
    const ProgramResult result = run({"devices"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.out, before);
}

// The rule takes the driver's text without its name, "llvmpipe Mesa 25.0.7 (LLVM 19.1.7)".
TEST_F(Devices, LavapipeUsesWideVectorsWhereItGainsByThem) {
    const auto listed = [&] { return json::parse(run({"devices", "--json"}).out); };
    const json wide = listed();
    const EnvironmentVariable width("LP_NATIVE_VECTOR_WIDTH", "256");
    const json narrow = listed();
    ASSERT_EQ(wide.size(), narrow.size());
    if (wide.size() != 1 || narrow[0]["name"].get<std::string>().find("256 bits") == std::string::npos)
        GTEST_SKIP() << "the one device is not a lavapipe";
    const auto driver = narrow[0]["driver"].get<std::string>();
    const bool gains =
        gpu::gainsByWideVectors(driver.substr(driver.find("Mesa")), narrow[0]["name"].get<std::string>(),
                                gpu::processorHasWideVectors());
    const bool isWide = wide[0]["name"].get<std::string>().find("512 bits") != std::string::npos;
    EXPECT_EQ(isWide, gains) << wide << narrow;
}

TEST_F(Devices, WhatIsNoDriverIsRefusedByName) {
    const std::string missing = (folder_ / "no.so").string();
    const EnvironmentVariable driver("LAVALIGHT_DRIVER", missing);
    const ProgramResult result = run({"devices"});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.err.find("cannot load the Vulkan driver " + missing), std::string::npos) << result.err;
    const EnvironmentVariable other("LAVALIGHT_DRIVER", "libz.so.1");
    EXPECT_NE(run({"devices"}).err.find("does not export what drivers do"), std::string::npos);
}

} // namespace
} // namespace lavalight
