// glTF 2.0 in, plain Scene out.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "gltf/import_options.h"
#include "scene/scene.h"

namespace lavalight {

// A scene of a .gltf or .glb file, told apart by content. What the importer does not understand is
// named in Scene::warnings; a scene without any light gets a constant white environment, one without a camera
// gets one that frames it. Throws Error, in one line with the file's name, for what cannot be read: a missing
// or damaged file, data out of range, a buffer outside the file's folder unless that is allowed, a required
// extension that is not supported.
[[nodiscard]] Scene importGltf(const std::filesystem::path& path, const ImportOptions& options = {});

// Imports a file that is in memory; it cannot refer to other files. `name` stands for the file in messages.
[[nodiscard]] Scene importGltf(const std::string& name, std::string_view bytes,
                               const ImportOptions& options = {});

// The files that the URIs of a file may mean, whether used, readable or there at all; none of them is read.
// None for what is no glTF file, which importGltf tells.
[[nodiscard]] std::vector<std::filesystem::path> referencedFiles(const std::filesystem::path& gltf);

} // namespace lavalight
