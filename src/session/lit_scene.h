// Scenes together with the light and the ground that a render brings.
#pragma once

#include <string>

#include "base/input_files.h"
#include "gltf/import_options.h"
#include "render/settings.h"
#include "scene/scene.h"

namespace lavalight {

// The scene, built in or a file, with the environment map that the lighting asks for, if it does. Without
// any, a studio lights a file that has no light. That, or a map whose values had to be changed, adds a
// warning to the scene. Throws Error for a file that is not a scene, or not a map, and UsageError for a
// rotation where there is no map.
[[nodiscard]] Scene loadLitScene(const std::string& nameOrPath, const ImportOptions& options,
                                 const LightingSettings& lighting);

// Gives a scene that is loaded already the light that loadLitScene() would give it.
void lightScene(Scene& scene, const LightingSettings& lighting);

// The height of the ground that belongs right below the scene, in the world.
[[nodiscard]] double groundHeightOf(const Scene& scene);

// Lays the ground that was asked for at a height in the world. What frames the scene comes before it.
void layGround(const GroundSettings& ground, double height, Scene& scene);

// The files that loadLitScene would read: scene, buffers, pictures, map.
[[nodiscard]] InputFiles filesOfLitScene(const std::string& nameOrPath, const LightingSettings& lighting);

} // namespace lavalight
