#include "session/lit_scene.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "gltf/import.h"
#include "image/environment_file.h"
#include "image/srgb.h"
#include "render/setting_names.h"
#include "scene/ground.h"
#include "scene/procedural/sky_environment.h"
#include "scene/procedural/studio_environment.h"
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

void bringStudio(Scene& scene) {
    scene.environmentMap = {std::string(nameOf(ProceduralEnvironment::studio)), makeStudio(), 0};
    scene.environment = glm::vec3(0.0f); // it is not the light any more
}

// In place of the environment that the file may have.
void bringLight(const LightingSettings& lighting, Scene& scene) {
    scene.environmentMap.reset();
    if (!lighting.mapFile.empty())
        readEnvironmentMap(lighting.mapFile, scene);
    else if (lighting.procedural == ProceduralEnvironment::studio)
        bringStudio(scene);
    else if (lighting.procedural == ProceduralEnvironment::sky)
        scene.environmentMap = makeSky(lighting.sky);
}

} // namespace

void lightScene(Scene& scene, const LightingSettings& lighting) {
    if (bringsLight(lighting)) {
        bringLight(lighting, scene);
    } else if (!scene.hasOwnLight) {
        bringStudio(scene);
        scene.hasStandInLight = true;
        scene.warnings.emplace_back(
            "the scene has no light: a studio lights it; give another light with --env");
    }
    if (lighting.rotation != 0.0f && !scene.environmentMap)
        throw UsageError("--env-rotation: cannot turn the environment: it is not a map; try --env studio");
}

Scene loadLitScene(const std::string& nameOrPath, const ImportOptions& options,
                   const LightingSettings& lighting) {
    Scene scene = loadScene(nameOrPath, options);
    lightScene(scene, lighting);
    return scene;
}

double groundHeightOf(const Scene& scene) {
    return scene.origin.y + double{groundHeight(scene.bounds)};
}

void layGround(const GroundSettings& ground, double height, Scene& scene) {
    scene.groundHeight = static_cast<float>(height - scene.origin.y);
    if (ground.kind == Ground::lambert)
        addGround(scene, scene.groundHeight, decodeSrgb8(ground.color));
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
