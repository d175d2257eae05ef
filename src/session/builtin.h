// Scenes by name: those that the program carries, or files.
#pragma once

#include <string>
#include <vector>

#include "gltf/import_options.h"
#include "scene/scene.h"

namespace lavalight {

// Names of the scenes that loadScene has without a file, for help and messages; "dense-N" stands for any
// number of triangles, "lamps-N" of lights.
[[nodiscard]] std::vector<std::string> builtinNames();

// Whether a scene of that name is built in.
[[nodiscard]] bool isBuiltin(const std::string& name);

// A built-in scene by its name, else the .gltf or .glb file of that path. Throws Error; UsageError
// for options that ask for what the scene does not have.
[[nodiscard]] Scene loadScene(const std::string& nameOrPath, const ImportOptions& options = {});

} // namespace lavalight
