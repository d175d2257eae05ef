// Compiles GLSL compute kernels to SPIR-V with glslang, in process: the build, the program and the tests
// share this code.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace lavalight::gpu {

enum class BindingKind { storageBuffer, uniformBuffer, uniformTexelBuffer, accelerationStructure };

// One resource of a kernel, in descriptor set 0. `name` is the block's name for storage and uniform buffers
// and the variable's name for texel buffers and acceleration structures.
struct KernelBinding {
    std::string name;
    uint32_t binding = 0;
    BindingKind kind = BindingKind::storageBuffer;
    bool operator==(const KernelBinding&) const = default;
};

// A compiled kernel with what is needed to build its pipeline layout.
struct KernelCode {
    std::string name;            // path below kernels/, without extension
    std::string content;         // ContentHash of the SPIR-V as compiled, by which kernels are told apart
    std::vector<uint32_t> spirv; // as compiled, or inlined() since
    std::vector<KernelBinding> bindings; // ascending binding numbers
    uint32_t pushConstantBytes = 0;
};

// The text of a shader file, and the name that the compiler's messages give it.
struct ShaderText {
    std::string name;
    std::string text;
};

// Finds shader files by their path below shaders/, such as "lib/sampling/mis.glsl".
using ShaderFiles = std::function<std::optional<ShaderText>(const std::string& path)>;

// Compiles an entry point (GLSL 4.60, SPIR-V 1.5 for Vulkan 1.2). #include "a/b.glsl" asks `includes`, so
// that a file is found by the same name from everywhere; each file is included once. Throws Error with the
// compiler's message, file names and line numbers.
[[nodiscard]] KernelCode compileKernel(const ShaderText& source, const ShaderFiles& includes);

// Which file an included path stands for, where that is not the path itself.
using ResolveInclude = std::function<std::string(const std::string& path)>;

// Compiles a file of a folder: the entry point, and the root of all that it includes.
[[nodiscard]] KernelCode compileKernel(const std::filesystem::path& file,
                                       const std::filesystem::path& includeRoot,
                                       const ResolveInclude& resolve = {});

} // namespace lavalight::gpu
