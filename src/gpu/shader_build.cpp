#include "gpu/shader_build.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <set>

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include "base/content_hash.h"
#include "base/error.h"
#include "base/file.h"

namespace lavalight::gpu {
namespace {

// A file asked for twice comes back empty the second time: include guards for free.
class OnceIncluder : public glslang::TShader::Includer {
  public:
    explicit OnceIncluder(const ShaderFiles& files) : files_(files) {}

    IncludeResult* includeLocal(const char* path, const char*, size_t) override {
        std::optional<ShaderText> file = files_(path);
        if (!file)
            return nullptr;
        if (!seen_.insert(std::filesystem::path(file->name).lexically_normal().string()).second)
            file->text.clear();
        const auto& kept = texts_.emplace_back(std::make_unique<ShaderText>(std::move(*file)));
        auto& result = results_.emplace_back(
            std::make_unique<IncludeResult>(kept->name, kept->text.data(), kept->text.size(), nullptr));
        return result.get();
    }
    void releaseInclude(IncludeResult*) override {} // owned by results_

  private:
    const ShaderFiles& files_;
    std::set<std::string> seen_;
    std::vector<std::unique_ptr<ShaderText>> texts_;
    std::vector<std::unique_ptr<IncludeResult>> results_;
};

void initialiseGlslang() {
    static std::once_flag once;
    std::call_once(once, [] { glslang::InitializeProcess(); });
}

// glslang 15 (Debian 13) hides TType. Vulkan's own rules say as much: every block but push constants has a
// binding, and a uniform outside all blocks is a texel buffer or an acceleration structure. OpenGL has a type
// for the former alone.
bool isPushConstant(const glslang::TObjectReflection& block) {
    return block.getBinding() < 0;
}
bool isOutsideBlocks(const glslang::TObjectReflection& uniform) {
    return uniform.index < 0;
}
BindingKind kindOf(const glslang::TObjectReflection& uniform) {
    return uniform.glDefineType == 0 ? BindingKind::accelerationStructure : BindingKind::uniformTexelBuffer;
}

std::vector<KernelBinding> reflectBindings(const glslang::TProgram& program) {
    std::vector<KernelBinding> bindings;
    for (int i = 0; i < program.getNumUniformVariables(); ++i) {
        const glslang::TObjectReflection& uniform = program.getUniform(i);
        if (isOutsideBlocks(uniform))
            bindings.push_back({uniform.name, static_cast<uint32_t>(uniform.getBinding()), kindOf(uniform)});
    }
    for (int i = 0; i < program.getNumBufferBlocks(); ++i) {
        const glslang::TObjectReflection& block = program.getBufferBlock(i);
        bindings.push_back(
            {block.name, static_cast<uint32_t>(block.getBinding()), BindingKind::storageBuffer});
    }
    for (int i = 0; i < program.getNumUniformBlocks(); ++i) {
        const glslang::TObjectReflection& block = program.getUniformBlock(i);
        if (!isPushConstant(block))
            bindings.push_back(
                {block.name, static_cast<uint32_t>(block.getBinding()), BindingKind::uniformBuffer});
    }
    std::sort(bindings.begin(), bindings.end(),
              [](const KernelBinding& a, const KernelBinding& b) { return a.binding < b.binding; });
    return bindings;
}

uint32_t reflectPushConstantBytes(const glslang::TProgram& program) {
    uint32_t bytes = 0;
    for (int i = 0; i < program.getNumUniformBlocks(); ++i) {
        const glslang::TObjectReflection& block = program.getUniformBlock(i);
        if (isPushConstant(block))
            bytes = static_cast<uint32_t>(block.size);
    }
    return bytes;
}

void rejectClashes(const KernelCode& code) {
    for (size_t i = 1; i < code.bindings.size(); ++i)
        if (code.bindings[i].binding == code.bindings[i - 1].binding)
            throw Error(fmt::format("kernel {}: {} and {} share binding {}", code.name,
                                    code.bindings[i - 1].name, code.bindings[i].name,
                                    code.bindings[i].binding));
}

// "lab/dice" of ".../kernels/lab/dice.comp", "dice" of a file that lies elsewhere.
std::string kernelName(const std::filesystem::path& file) {
    std::filesystem::path name = file.stem();
    for (std::filesystem::path folder = file.parent_path(), below = name; folder.has_filename();
         below = folder.filename() / below, folder = folder.parent_path())
        if (folder.filename() == "kernels")
            name = below;
    return name.generic_string();
}

} // namespace

KernelCode compileKernel(const ShaderText& source, const ShaderFiles& includes) {
    initialiseGlslang();
    const char* text = source.text.c_str();
    const int length = static_cast<int>(source.text.size());
    const char* name = source.name.c_str();

    glslang::TShader shader(EShLangCompute);
    shader.setStringsWithLengthsAndNames(&text, &length, &name, 1);
    shader.setPreamble("#extension GL_GOOGLE_include_directive : require\n"
                       "#extension GL_EXT_samplerless_texture_functions : require\n"); // utextureBuffer
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, 120);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_5);
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    OnceIncluder includer(includes);
    const int defaultVersion = 460;
    if (!shader.parse(GetDefaultResources(), defaultVersion, false, messages, includer))
        throw Error(fmt::format("cannot compile {}:\n{}", source.name, shader.getInfoLog()));

    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages) ||
        !program.buildReflection(EShReflectionSeparateBuffers | EShReflectionAllBlockVariables))
        throw Error(fmt::format("cannot link {}:\n{}", source.name, program.getInfoLog()));

    KernelCode code;
    code.name = kernelName(source.name);
    code.bindings = reflectBindings(program);
    code.pushConstantBytes = reflectPushConstantBytes(program);
    rejectClashes(code);
    glslang::SpvOptions options;
    options.validate = false; // the validation layer checks every module in the device tests
    glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), code.spirv, &options);
    ContentHash hash;
    hash.add(code.spirv);
    code.content = hash.text();
    return code;
}

KernelCode compileKernel(const std::filesystem::path& file, const std::filesystem::path& includeRoot,
                         const ResolveInclude& resolve) {
    return compileKernel({file.string(), readFile(file)}, [&](const std::string& path) {
        const std::filesystem::path included = includeRoot / (resolve ? resolve(path) : path);
        return std::filesystem::is_regular_file(included)
                   ? std::optional<ShaderText>({included.string(), readFile(included)})
                   : std::nullopt;
    });
}

} // namespace lavalight::gpu
