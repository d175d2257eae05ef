#include "support/patched_kernel.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "kernels/accelerator_name.h"
#include "support/temporary_folder.h"

namespace lavalight::test {

namespace fs = std::filesystem;

namespace {

void apply(const Patch& patch, const fs::path& shaders) {
    std::stringstream buffer;
    buffer << std::ifstream(shaders / patch.file).rdbuf();
    std::string source = buffer.str();
    const size_t at = source.find(patch.from);
    if (at == std::string::npos || source.find(patch.from, at + 1) != std::string::npos)
        throw std::runtime_error(patch.file + " does not hold exactly one \"" + patch.from + "\"");
    source.replace(at, patch.from.size(), patch.to);
    std::ofstream(shaders / patch.file) << source;
}

} // namespace

gpu::KernelCode patchedKernel(std::string_view kernel, const Patch& patch) {
    return patchedKernel(kernel, std::vector{patch});
}

gpu::KernelCode patchedKernel(std::string_view kernel, const std::vector<Patch>& patches) {
    const TemporaryFolder folder;
    fs::copy(fs::path(LAVALIGHT_SOURCE_DIR) / "shaders", folder.path(),
             fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    for (const Patch& patch : patches)
        apply(patch, folder.path());
    const KernelName name = parseKernelName(kernel);
    return gpu::compileKernel(folder.path() / "kernels" / (std::string(name.file) + ".comp"), folder.path(),
                              [&](const std::string& path) { return includedFile(path, name.accelerator); });
}

} // namespace lavalight::test
