// Where memory does not suffice: one line, exit 1, no file left behind.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/file.h"
#include "support/memory_limit.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"
#include "unit/gltf/builder.h"

namespace lavalight {
namespace {

using test::MemoryLimit;

class ProgramMemory : public testing::Test {
  protected:
    void SetUp() override {
        if (!MemoryLimit::isPossible())
            GTEST_SKIP() << "memory cannot be limited here";
    }

    // The limit of this process is the program's, too.
    void expectFailure(const std::vector<std::string>& arguments, const std::string& part) const {
        const long filesBefore = folder_.count();
        const MemoryLimit limit(uint64_t{512} << 20);
        const test::ProgramResult result = test::runLavalight(arguments, folder_.path());
        EXPECT_EQ(result.exitCode, 1);
        EXPECT_EQ(result.out, "");
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
        EXPECT_EQ(folder_.count(), filesBefore) << "a file was left behind";
    }

    const test::TemporaryFolder folder_;
};

TEST_F(ProgramMemory, AllocationThatFailsAfterAllIsToldInOneLine) {
    expectFailure({"info", "dense-30000000"}, "lavalight: error: out of memory");
}

TEST_F(ProgramMemory, SceneThatWouldNotFitIsRefusedWithBothFigures) {
    test::GltfBuilder gltf;
    const int positions =
        gltf.addAccessor({{"componentType", test::kFloat}, {"count", 9'000'000}, {"type", "VEC3"}});
    gltf.addMesh({{"attributes", {{"POSITION", positions}}}});
    for (int i = 0; i < 14; ++i)
        gltf.addNode({{"mesh", 0}});
    writeFileAtomically(folder_ / "large.glb", gltf.glb());
    for (const char* command : {"info", "render"})
        expectFailure({command, "large.glb"},
                      "the 42000000 triangles that it draws take 3.8 GiB of memory, ");
}

TEST_F(ProgramMemory, FileBeyondMemoryIsRefusedByItsSize) {
    writeFileAtomically(folder_ / "large.glb", "glTF");
    std::filesystem::resize_file(folder_ / "large.glb", uint64_t{1} << 40); // sparse: none of the disk
    expectFailure({"info", "large.glb"}, "large.glb: its bytes take 1024.0 GiB of memory");
}

} // namespace
} // namespace lavalight
