// What scenes may refer to, as the commands have it: files outside the scene's folder only with
// --allow-external.
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/file.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"
#include "unit/gltf/builder.h"

namespace lavalight {
namespace {

using test::GltfBuilder;
using test::ProgramResult;
using test::runLavalight;
using test::TemporaryFolder;

class ExternalFiles : public testing::Test {
  protected:
    void SetUp() override {
        GltfBuilder gltf;
        gltf.addNode({{"mesh", gltf.addTriangle()}});
        writeFileAtomically(folder_ / "data.bin", gltf.bytes);
        std::filesystem::create_directory(folder_ / "scene");
        gltf.json["buffers"] = {{{"byteLength", gltf.bytes.size()}, {"uri", "../data.bin"}}};
        writeFileAtomically(folder_ / "scene/scene.gltf", gltf.json.dump());
    }

    [[nodiscard]] ProgramResult run(std::vector<std::string> arguments, bool allows) const {
        if (allows)
            arguments.emplace_back("--allow-external");
        return runLavalight(arguments, folder_.path());
    }

    const TemporaryFolder folder_;
};

TEST_F(ExternalFiles, EveryCommandThatReadsScenesRefusesThemWithTheRemedyAndReadsThemWhereAllowed) {
    const std::vector<std::vector<std::string>> commands = {
        {"info", "scene/scene.gltf"},
        {"render", "scene/scene.gltf", "--size", "8x8", "--spp", "1", "-o", "out.exr"},
        {"trace", "scene/scene.gltf", "--size", "8x8", "--pixel", "4,4"},
        {"bench", "rays", "scene/scene.gltf", "--rays", "1000", "--repeats", "1"}};
    for (const auto& command : commands) {
        SCOPED_TRACE(command.front());
        const ProgramResult refused = run(command, false);
        EXPECT_EQ(refused.exitCode, 1);
        EXPECT_NE(refused.err.find("buffer 0 \"../data.bin\": it lies outside the scene's folder; "
                                   "--allow-external lets it be read"),
                  std::string::npos)
            << refused.err;
        const ProgramResult allowed = run(command, true);
        EXPECT_EQ(allowed.exitCode, 0) << allowed.err;
    }
}

TEST_F(ExternalFiles, WindowsTakeTheOptionToo) {
    const ProgramResult help = runLavalight({"view", "--help"}, folder_.path());
    EXPECT_NE(help.out.find("--allow-external"), std::string::npos) << help.out;
}

} // namespace
} // namespace lavalight
