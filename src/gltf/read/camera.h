// Reads the cameras of a glTF file.
#pragma once

#include <vector>

#include "gltf/file/document.h"
#include "gltf/read/nodes.h"
#include "scene/scene.h"

namespace lavalight {

// One Camera per node that carries one, ordered by the file's camera numbers. Cameras that cannot form an
// image are left out and noted.
[[nodiscard]] std::vector<Camera> readCameras(const GltfDocument& document,
                                              const std::vector<PlacedNode>& nodes, GltfNotes& notes);

} // namespace lavalight
