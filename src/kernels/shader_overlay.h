// Shaders that a user changed: a folder of files that stand in for ours of the same path.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/shader_build.h"
#include "kernels/accelerator_name.h"
#include "kernels/kernel_source.h"

namespace lavalight {

// The sources that the build embedded, by their path below shaders/.
[[nodiscard]] std::optional<std::string_view> embeddedShader(std::string_view path);
[[nodiscard]] std::vector<std::string> embeddedShaderPaths();

class ShaderOverlay {
  public:
    // Reads the .glsl, .comp and .h files below `folder`; those equal to ours change nothing. Throws Error
    // where there is no such folder, or where a file of shared/ differs: the program itself was built with
    // it.
    explicit ShaderOverlay(const std::filesystem::path& folder);

    // The kernel, compiled anew, once, where one of its files is changed, else the embedded one. Throws Error
    // with the compiler's message. May be called from any thread.
    [[nodiscard]] const gpu::KernelCode& kernel(std::string_view name);

    // Paths of the files that differ from ours or are new, ascending.
    [[nodiscard]] std::vector<std::string> changed() const;
    // Paths of changed files that no kernel includes: a misspelt name, most likely.
    [[nodiscard]] std::vector<std::string> unused() const;

  private:
    [[nodiscard]] std::optional<gpu::ShaderText> find(const std::string& path) const;
    [[nodiscard]] std::vector<std::string> filesOf(const KernelName& name) const;
    [[nodiscard]] gpu::KernelCode compile(std::string_view name) const;

    std::map<std::string, gpu::ShaderText> texts_;                // texts of the changed files, by path
    std::mutex mutex_;                                            // guards kernels_
    std::map<std::string, gpu::KernelCode, std::less<>> kernels_; // kernels that were asked for, by name
};

// Kernels with the overlay's changes; the embedded ones without an overlay.
[[nodiscard]] KernelSource sourceOf(std::shared_ptr<ShaderOverlay> overlay);

} // namespace lavalight
