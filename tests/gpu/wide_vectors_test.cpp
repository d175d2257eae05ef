// Which lavapipe gets vectors of 512 bits, and where code of each width is kept.
#include "gpu/wide_vectors.h"

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/os/environment.h"
#include "support/environment_variable.h"
#include "support/temporary_folder.h"

namespace lavalight::gpu {
namespace {

using test::EnvironmentVariable;
using test::TemporaryFolder;

TEST(WideVectors, AreForLavapipesThatGainByThem) {
    const char* name = "llvmpipe (LLVM 19.1.7, 256 bits)";
    EXPECT_TRUE(gainsByWideVectors("Mesa 25.0.7-2 (LLVM 19.1.7)", name, true));
    EXPECT_TRUE(gainsByWideVectors("Mesa 26.1.0", name, true));
    EXPECT_FALSE(gainsByWideVectors("Mesa 24.3.1", name, true));
    EXPECT_FALSE(gainsByWideVectors("Mesa 22.3.6 (LLVM 15.0.6)", name, true));
    EXPECT_FALSE(gainsByWideVectors("Mesa 25.0.7", name, false)) << "the processor has none";
    EXPECT_FALSE(gainsByWideVectors("Mesa 25.0.7", "llvmpipe (LLVM 19.1.7, 512 bits)", true));
    EXPECT_FALSE(gainsByWideVectors("Mesa 25.0.7", "llvmpipe (LLVM 19.1.7, 128 bits)", true));
    EXPECT_FALSE(gainsByWideVectors("a driver of another make", name, true));
}

TEST(WideVectors, EachDecidedWidthHasAFolderOfMesasCache) {
    const TemporaryFolder folder;
    const EnvironmentVariable cache("MESA_SHADER_CACHE_DIR", folder.path().string());
    const EnvironmentVariable width("LP_NATIVE_VECTOR_WIDTH", "64");
    for (int time = 0; time < 2; ++time) { // a second time it is inside the first one's folder already
        keepKernelsByWidth();
        EXPECT_EQ(environmentPath("MESA_SHADER_CACHE_DIR"), folder / "lavapipe-64-bits");
    }
    EXPECT_TRUE(std::filesystem::is_directory(folder / "lavapipe-64-bits"));
}

TEST(WideVectors, MesaKeepsNothingWhereItsFolderCannotBeMade) {
    const TemporaryFolder folder;
    writeFileAtomically(folder / "file", "");
    const EnvironmentVariable cache("MESA_SHADER_CACHE_DIR", (folder / "file").string());
    const EnvironmentVariable width("LP_NATIVE_VECTOR_WIDTH", "64");
    const EnvironmentVariable disabled("MESA_SHADER_CACHE_DISABLE", "false");
    keepKernelsByWidth();
    EXPECT_EQ(environmentVariable("MESA_SHADER_CACHE_DISABLE"), "true");
}

} // namespace
} // namespace lavalight::gpu
