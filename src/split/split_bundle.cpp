#include "split/split_bundle.h"

#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "base/content_hash.h"
#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "gltf/pack.h"

namespace lavalight {
namespace {

namespace fs = std::filesystem;

// Writes bytes under the name of their content, and returns that name.
std::string writeByContent(const std::string& kind, const std::string& ending, std::string_view bytes,
                           const fs::path& folder) {
    constexpr size_t kDigits = 16; // 64 bits tell all scenes of a folder apart
    ContentHash hash;
    hash.add(bytes);
    const std::string name = fmt::format("{}-{}{}", kind, hash.text().substr(0, kDigits), ending);
    writeFileAtomically(folder / name, bytes);
    return name;
}

} // namespace

std::string bundleScene(const fs::path& scene, bool allowsExternal, const fs::path& folder) {
    const PackedScene packed = packGltf(scene, allowsExternal);
    for (const std::string& warning : packed.warnings)
        spdlog::warn("{}", warning);
    return writeByContent("scene", ".glb", packed.glb, folder);
}

std::string bundleEnvironment(const fs::path& map, const fs::path& folder) {
    return writeByContent("env", map.extension().string(), readFile(map), folder);
}

std::string bundleShaders(const fs::path& shaders, const fs::path& folder) {
    const std::string name = "shaders";
    std::error_code code;
    const std::string above = fs::weakly_canonical(shaders).string() + "/";
    if (fs::weakly_canonical(folder).string().starts_with(above))
        throw Error(
            fmt::format("cannot copy {}: the job's folder is in it; try another -o", shaders.string()));
    fs::copy(shaders, folder / name, fs::copy_options::recursive, code);
    if (code)
        throw Error(fmt::format("cannot copy {}: {}", shaders.string(), code.message()));
    return name;
}

} // namespace lavalight
