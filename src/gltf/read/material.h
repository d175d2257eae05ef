// Reads the materials of a glTF file.
#pragma once

#include <vector>

#include "gltf/file/document.h"
#include "scene/scene.h"

namespace lavalight {

// One Material per material of the file, in its order, and a last one for primitives without a material.
// Factors out of their range are clamped and noted. The textures' `picture` is the number of a glTF image
// until readPictures() has decoded them. Occlusion textures are left out: paths find what is occluded.
[[nodiscard]] std::vector<Material> readMaterials(const GltfDocument& document, GltfNotes& notes);

} // namespace lavalight
