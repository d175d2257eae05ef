#include "session/lit_scene.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "gltf/import.h"
#include "image/environment_file.h"
#include "session/builtin.h"

namespace lavalight {
namespace {

void readEnvironmentMap(const std::string& path, Scene& scene) {
    EnvironmentFile file = readEnvironmentFile(path);
    if (file.badTexels > 0)
        scene.warnings.push_back(
            fmt::format("{}: {} of {} pixels had negative, infinite or undefined values, "
                        "which were set to 0",
                        path, file.badTexels, file.image.pixels.size()));
    scene.environmentMap = {path, std::move(file.image), file.badTexels};
}

} // namespace

Scene loadLitScene(const std::string& nameOrPath, ImportOptions options, const LightingSettings& lighting) {
    options.bringsLight = lighting.constant.has_value() || !lighting.mapFile.empty();
    Scene scene = loadScene(nameOrPath, options);
    if (!lighting.mapFile.empty())
        readEnvironmentMap(lighting.mapFile, scene);
    return scene;
}

InputFiles filesOfLitScene(const std::string& nameOrPath, const LightingSettings& lighting) {
    InputFiles files;
    files.add(nameOrPath, "the scene that is rendered");
    std::error_code code;
    if (std::filesystem::is_regular_file(nameOrPath, code))
        for (const std::filesystem::path& file : referencedFiles(nameOrPath))
            files.add(file, "a buffer or picture of the scene");
    files.add(lighting.mapFile, "the environment map");
    return files;
}

} // namespace lavalight
