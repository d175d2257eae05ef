#include "session/lit_scene.h"

#include <utility>

#include <fmt/format.h>

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

} // namespace lavalight
