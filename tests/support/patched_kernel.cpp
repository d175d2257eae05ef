#include "support/patched_kernel.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "kernels/accelerator_name.h"
#include "support/temporary_folder.h"

namespace lavalight::test {

namespace fs = std::filesystem;

gpu::KernelCode patchedKernel(std::string_view kernel, const Patch& patch) {
    const TemporaryFolder folder;
    fs::copy(fs::path(LAVALIGHT_SOURCE_DIR) / "shaders", folder.path(),
             fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    std::stringstream buffer;
    buffer << std::ifstream(folder.path() / patch.file).rdbuf();
    std::string source = buffer.str();
    const size_t at = source.find(patch.from);
    if (at == std::string::npos || source.find(patch.from, at + 1) != std::string::npos)
        throw std::runtime_error(patch.file + " does not hold exactly one \"" + patch.from + "\"");
    source.replace(at, patch.from.size(), patch.to);
    std::ofstream(folder.path() / patch.file) << source;
    return gpu::compileKernel(folder.path() / "kernels" / (std::string(kernel) + ".comp"), folder.path(),
                              includedFile);
}

} // namespace lavalight::test
