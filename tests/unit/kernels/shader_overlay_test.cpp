// A folder of changed shaders replaces what it holds, and only the kernels that include it.
#include <algorithm>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "kernels/kernel_source.h"
#include "kernels/shader_overlay.h"
#include "support/temporary_folder.h"

namespace lavalight::test {
namespace {

using Paths = std::vector<std::string>;

class ShaderOverlayTest : public testing::Test {
  protected:
    void write(const std::string& path, const std::string& text) const {
        std::filesystem::create_directories((folder_ / path).parent_path());
        writeFileAtomically(folder_ / path, text);
    }
    [[nodiscard]] ShaderOverlay overlay() const { return ShaderOverlay(folder_.path()); }
    [[nodiscard]] bool changes(const std::string& kernel) const {
        return overlay().kernel(kernel).content != embeddedKernel(kernel).content;
    }
    [[nodiscard]] std::string failure(const std::string& kernel) const {
        try {
            (void)overlay().kernel(kernel);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }

    TemporaryFolder folder_;
};

std::string ours(const std::string& path) {
    return std::string(embeddedShader(path).value());
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST_F(ShaderOverlayTest, EmbeddedSourcesAreThoseOfTheTree) {
    for (const std::string path : {"lib/sampling/roulette.glsl", "kernels/path.comp", "shared/frame.h"})
        EXPECT_EQ(ours(path), readFile(std::filesystem::path(LAVALIGHT_SOURCE_DIR) / "shaders" / path));
    EXPECT_FALSE(embeddedShader("roulette.glsl").has_value());
}

// Kernels include it by a path that is none of a file.
TEST_F(ShaderOverlayTest, TheAcceleratorIsPartOfTheKernelsThatTraceRays) {
    const std::string path = "scene/bvh8/accelerator.glsl";
    write(path, replaced(ours(path), "slabRay(origin, direction)", "slabRay(origin, 2.0 * direction)"));
    EXPECT_TRUE(changes("trace_any"));
    EXPECT_FALSE(changes("accumulate"));
    EXPECT_EQ(overlay().unused(), Paths{});
}

TEST_F(ShaderOverlayTest, EachAcceleratorIsPartOfItsOwnKernels) {
    const std::string path = "scene/ray_query/accelerator.glsl";
    write(path, replaced(ours(path), "kLongestRay = 3e38", "kLongestRay = 2e38"));
    EXPECT_TRUE(changes("trace_any@ray_query"));
    EXPECT_FALSE(changes("trace_any"));
    EXPECT_FALSE(changes("accumulate@ray_query")); // which traces nothing
    EXPECT_EQ(overlay().unused(), Paths{});
}

TEST_F(ShaderOverlayTest, CopiesChangeNothing) {
    write("lib/sampling/roulette.glsl", ours("lib/sampling/roulette.glsl"));
    write("shared/frame.h", ours("shared/frame.h"));
    EXPECT_EQ(overlay().changed(), Paths{});
    EXPECT_FALSE(changes("path"));
}

// Renders are told apart by what was compiled, so equal ones must be of one code: the embedded one is
// inlined.
TEST_F(ShaderOverlayTest, ACommentLeavesTheEmbeddedKernel) {
    write("lib/sampling/roulette.glsl", ours("lib/sampling/roulette.glsl") + "\n// A comment.\n");
    EXPECT_EQ(overlay().changed(), Paths{"lib/sampling/roulette.glsl"});
    EXPECT_EQ(overlay().kernel("path").spirv, embeddedKernel("path").spirv);
}

TEST_F(ShaderOverlayTest, AChangeReachesTheKernelsThatIncludeIt) {
    write("lib/sampling/roulette.glsl",
          replaced(ours("lib/sampling/roulette.glsl"), "kMaxSurvival = 0.95", "kMaxSurvival = 0.5"));
    EXPECT_EQ(overlay().changed(), Paths{"lib/sampling/roulette.glsl"});
    EXPECT_EQ(overlay().unused(), Paths{});
    EXPECT_TRUE(changes("path"));
    EXPECT_TRUE(changes("shade"));
    EXPECT_FALSE(changes("accumulate"));
}

TEST_F(ShaderOverlayTest, NewFilesMayBeIncluded) {
    write("lib/sampling/roulette.glsl",
          "#include \"lib/mine.glsl\"\n" +
              replaced(ours("lib/sampling/roulette.glsl"), "kMaxSurvival = 0.95", "kMaxSurvival = kMine"));
    write("lib/mine.glsl", "const float kMine = 0.5;\n");
    write("lib/roulete.glsl", ours("lib/sampling/roulette.glsl"));
    write("README.md", "no shader");
    EXPECT_TRUE(changes("path"));
    EXPECT_EQ(overlay().unused(), Paths{"lib/roulete.glsl"});
}

TEST_F(ShaderOverlayTest, ErrorsNameTheUsersFileAndLine) {
    write("lib/sampling/roulette.glsl", "\n\nfloat oops( {}\n");
    EXPECT_NE(failure("path").find((folder_ / "lib/sampling/roulette.glsl").string() + ":3"),
              std::string::npos)
        << failure("path");
    EXPECT_EQ(failure("accumulate"), "");
}

TEST_F(ShaderOverlayTest, SharedHeadersMustBeOurs) {
    write("shared/frame.h", ours("shared/frame.h") + "// changed\n");
    try {
        (void)overlay();
        ADD_FAILURE() << "memory would be read by another layout";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("shared/frame.h"), std::string::npos) << error.what();
    }
    EXPECT_THROW(ShaderOverlay(folder_ / "nowhere"), Error);
}

} // namespace
} // namespace lavalight::test
