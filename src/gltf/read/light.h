// Reads the lights without size of a glTF file.
#pragma once

#include <vector>

#include "gltf/file/document.h"
#include "gltf/read/nodes.h"
#include "scene/scene.h"

namespace lavalight {

// One PunctualLight per node that carries one, in the order of `nodes`. Factors and cone angles out of their
// range are clamped and noted; lights of an unknown type, or whose node gives them no place or direction, are
// left out and noted.
[[nodiscard]] std::vector<PunctualLight>
readPunctualLights(const GltfDocument& document, const std::vector<PlacedNode>& nodes, GltfNotes& notes);

} // namespace lavalight
