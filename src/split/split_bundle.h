// What the parts of a split render read: copies in the job's folder, named by their content.
#pragma once

#include <filesystem>
#include <string>

namespace lavalight {

// Packs a scene file into `folder` and returns its name there: scene-HASH.glb. Warns of pictures that cannot
// be had. Throws Error as packGltf does.
[[nodiscard]] std::string bundleScene(const std::filesystem::path& scene, bool allowsExternal,
                                      const std::filesystem::path& folder);

// Copies an environment map: env-HASH.exr, or whatever its ending is.
[[nodiscard]] std::string bundleEnvironment(const std::filesystem::path& map,
                                            const std::filesystem::path& folder);

// Copies all files of a folder of shaders into `folder`/shaders, and returns "shaders". Throws Error.
[[nodiscard]] std::string bundleShaders(const std::filesystem::path& shaders,
                                        const std::filesystem::path& folder);

} // namespace lavalight
