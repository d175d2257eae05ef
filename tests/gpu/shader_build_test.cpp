// The shader compiler names file and line of an error, resolves includes, and refuses what cannot be bound.
#include <string>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "gpu/shader_build.h"
#include "gpu/spirv_passes.h"
#include "gpu/texel_storage.h"
#include "kernels/accelerator_name.h"
#include "kernels/kernel_source.h"
#include "support/temporary_folder.h"

namespace lavalight::test {
namespace {

class ShaderBuildTest : public ::testing::Test {
  protected:
    void write(const std::string& name, const std::string& text) {
        std::filesystem::create_directories((folder_ / name).parent_path());
        writeFileAtomically(folder_ / name, text);
    }
    [[nodiscard]] gpu::KernelCode compile(const std::string& name) const {
        return gpu::compileKernel(folder_ / name, folder_.path());
    }
    [[nodiscard]] std::string failure(const std::string& name) const {
        try {
            (void)compile(name);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }

  private:
    TemporaryFolder folder_;
};

// How many functions a module has. Behind a header of five words, each instruction's first word holds its
// length and its kind.
size_t functionsIn(const std::vector<uint32_t>& spirv) {
    constexpr uint32_t kOpFunction = 54;
    size_t count = 0;
    for (size_t at = 5; at < spirv.size(); at += spirv[at] >> 16)
        count += (spirv[at] & 0xffffu) == kOpFunction;
    return count;
}

TEST_F(ShaderBuildTest, AnErrorNamesFileAndLine) {
    write("broken.comp", "#version 460\nlayout(local_size_x = 64) in;\n\nvoid main() { oops; }\n");
    const std::string message = failure("broken.comp");
    EXPECT_NE(message.find("broken.comp:4"), std::string::npos) << message;
    EXPECT_NE(message.find("oops"), std::string::npos) << message;
}

TEST_F(ShaderBuildTest, AnErrorInAnIncludeNamesTheIncludedFileAndItsLine) {
    write("lib/half.glsl", "float half_(float x) {\n    return x * wrong;\n}\n");
    write("kernel.comp",
          "#version 460\n#include \"lib/half.glsl\"\nlayout(local_size_x = 1) in;\nvoid main() {}\n");
    const std::string message = failure("kernel.comp");
    EXPECT_NE(message.find("half.glsl:2"), std::string::npos) << message;
}

TEST_F(ShaderBuildTest, IncludesAreFoundFromTheRootAndOnlyOnce) {
    write("lib/one.glsl", "float one() { return 1.0; }\n");
    write("lib/two.glsl", "#include \"lib/one.glsl\"\nfloat two() { return 2.0 * one(); }\n");
    write("kernels/sum.comp", "#version 460\n#include \"lib/one.glsl\"\n#include \"lib/two.glsl\"\n"
                              "layout(local_size_x = 1) in;\n"
                              "layout(set = 0, binding = 3) buffer Sum { float sum; };\n"
                              "void main() { sum = one() + two(); }\n");
    const gpu::KernelCode code = compile("kernels/sum.comp");
    EXPECT_EQ(code.name, "sum");
    EXPECT_FALSE(code.spirv.empty());
}

TEST_F(ShaderBuildTest, InliningLeavesOneFunction) {
    write("kernel.comp", "#version 460\nlayout(local_size_x = 1) in;\n"
                         "layout(set = 0, binding = 3) buffer Sum { float sum; };\n"
                         "float twice(float x) { return x + x; }\n"
                         "float more(float x) { return twice(x) + twice(x + 1.0); }\n"
                         "void main() { sum = more(sum); }\n");
    const gpu::KernelCode code = compile("kernel.comp");
    EXPECT_EQ(functionsIn(code.spirv), 3u);
    const std::vector<uint32_t> inlined = gpu::inlined(code.spirv);
    EXPECT_EQ(functionsIn(inlined), 1u);
    EXPECT_LT(inlined.size(), 2 * code.spirv.size());
}

// Functions that return early stay. The content is that of the compiled sources.
TEST_F(ShaderBuildTest, EmbeddedKernelsAreInlinedAndKnownByTheirSources) {
    const std::filesystem::path shaders = std::filesystem::path(LAVALIGHT_SOURCE_DIR) / "shaders";
    const gpu::KernelCode compiled = gpu::compileKernel(
        shaders / "kernels/path.comp", shaders, [](const std::string& path) { return includedFile(path); });
    const gpu::KernelCode embedded = embeddedKernel("path");
    EXPECT_EQ(embedded.content, compiled.content);
    EXPECT_GT(functionsIn(compiled.spirv), 50u);
    EXPECT_LT(functionsIn(embedded.spirv), functionsIn(compiled.spirv) / 2);
}

TEST_F(ShaderBuildTest, AMissingIncludeIsNamed) {
    write("kernel.comp",
          "#version 460\n#include \"lib/absent.glsl\"\nlayout(local_size_x = 1) in;\nvoid main() {}\n");
    EXPECT_NE(failure("kernel.comp").find("lib/absent.glsl"), std::string::npos);
}

TEST_F(ShaderBuildTest, BindingsAndPushConstantsAreFoundByName) {
    write("kernel.comp", "#version 460\nlayout(local_size_x = 1) in;\n"
                         "layout(set = 0, binding = 7) uniform utextureBuffer nodes;\n"
                         "layout(set = 0, binding = 2, std430) buffer Words { uint words[]; };\n"
                         "layout(set = 0, binding = 4, std430) buffer Unused { uint unused[]; };\n"
                         "layout(set = 0, binding = 5, std140) uniform Numbers { uint d; };\n"
                         "layout(push_constant) uniform Push { uint a; uint b; uint c; };\n"
                         "void main() { words[a] = texelFetch(nodes, int(b + c)).x + d; }\n");
    const gpu::KernelCode code = compile("kernel.comp");
    ASSERT_EQ(code.bindings.size(), 3u); // the buffers that are used
    EXPECT_EQ(code.bindings[0].name, "Words");
    EXPECT_EQ(code.bindings[0].binding, 2u);
    EXPECT_EQ(code.bindings[0].kind, gpu::BindingKind::storageBuffer);
    EXPECT_EQ(code.bindings[1].name, "Numbers");
    EXPECT_EQ(code.bindings[1].binding, 5u);
    EXPECT_EQ(code.bindings[1].kind, gpu::BindingKind::uniformBuffer);
    EXPECT_EQ(code.bindings[2].name, "nodes");
    EXPECT_EQ(code.bindings[2].binding, 7u);
    EXPECT_EQ(code.bindings[2].kind, gpu::BindingKind::uniformTexelBuffer);
    EXPECT_EQ(code.pushConstantBytes, 12u);
}

// tests/image/device_memory_test.cpp shows that kernels read the same values from them.
TEST_F(ShaderBuildTest, TexelBuffersBecomeStorageBuffersOfTheirNamesAndBindings) {
    write("kernel.comp", "#version 460\nlayout(local_size_x = 1) in;\n"
                         "layout(set = 0, binding = 7) uniform utextureBuffer nodes;\n"
                         "layout(set = 0, binding = 2, std430) buffer Words { uint words[]; };\n"
                         "void main() { words[0] = texelFetch(nodes, 3).x; }\n");
    const gpu::KernelCode code = gpu::withTexelsInStorage(compile("kernel.comp"));
    ASSERT_EQ(code.bindings.size(), 2u);
    EXPECT_EQ(code.bindings[1].name, "nodes");
    EXPECT_EQ(code.bindings[1].binding, 7u);
    EXPECT_EQ(code.bindings[1].kind, gpu::BindingKind::storageBuffer);
    EXPECT_EQ(code.content, compile("kernel.comp").content);
}

TEST_F(ShaderBuildTest, WhatDoesMoreWithTexelBuffersThanFetchIsRefusedByName) {
    write("size.comp", "#version 460\nlayout(local_size_x = 1) in;\n"
                       "layout(set = 0, binding = 7) uniform utextureBuffer nodes;\n"
                       "layout(set = 0, binding = 2, std430) buffer Words { int words[]; };\n"
                       "void main() { words[0] = textureSize(nodes); }\n");
    EXPECT_THROW((void)gpu::withTexelsInStorage(compile("size.comp")), Error);
}

TEST_F(ShaderBuildTest, TwoBlocksOnOneBindingAreRefused) {
    write("clash.comp", "#version 460\nlayout(local_size_x = 1) in;\n"
                        "layout(set = 0, binding = 1, std430) buffer First { uint first[]; };\n"
                        "layout(set = 0, binding = 1, std430) buffer Second { uint second[]; };\n"
                        "void main() { first[0] = second[0]; }\n");
    const std::string message = failure("clash.comp");
    EXPECT_NE(message.find("clash"), std::string::npos) << message;
    EXPECT_NE(message.find("First"), std::string::npos) << message;
    EXPECT_NE(message.find("Second"), std::string::npos) << message;
    EXPECT_NE(message.find("binding 1"), std::string::npos) << message;
}

TEST_F(ShaderBuildTest, AMissingKernelIsNamed) {
    EXPECT_NE(failure("absent.comp").find("absent.comp"), std::string::npos);
}

} // namespace
} // namespace lavalight::test
