// Reads the cameras of a glTF file.
#pragma once

#include <vector>

#include "gltf/file/document.h"
#include "gltf/read/nodes.h"
#include "scene/scene.h"

namespace lavalight {

struct PlacedCamera {
    size_t number = 0;        // the file's
    glm::dvec3 position{0.0}; // before it is rounded to single precision
    Camera camera;
};

// One per node that carries a camera, ordered by the file's numbers. Cameras that cannot form an image are
// left out and noted.
[[nodiscard]] std::vector<PlacedCamera> readCameras(const GltfDocument& document,
                                                    const std::vector<PlacedNode>& nodes, GltfNotes& notes);

} // namespace lavalight
