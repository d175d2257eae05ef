// Decodes the pictures of a scene's textures.
#pragma once

#include <vector>

#include "gltf/file/document.h"
#include "gltf/read/notes.h"
#include "scene/scene.h"

namespace lavalight {

// Decodes the images that the textures of `materials` name, each once, on all processors, and renumbers the
// textures by the result. Textures of images that cannot be read are taken off their materials, whose plain
// factors then count, and noted; so are damaged ones that can be shown. Throws Error where all of them are
// more than the renderer or memory could hold.
[[nodiscard]] std::vector<Picture> readPictures(const GltfDocument& document,
                                                std::vector<Material>& materials, GltfNotes& notes);

} // namespace lavalight
