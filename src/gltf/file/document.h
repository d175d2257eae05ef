// A glTF file, parsed and checked, with its bytes at hand.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tiny_gltf.h>

#include "gltf/file/buffers.h"
#include "gltf/file/image.h"
#include "gltf/read/notes.h"
#include "gltf/read/texture.h"

namespace lavalight {

struct GltfDocument {
    std::string source; // for messages
    // Every index in it has been checked against the array that it points into. What follows in members of
    // its own is left out there.
    tinygltf::Model model;
    std::vector<GltfBuffer> buffers;
    std::vector<std::string> extensionsUsed;    // as the file lists them
    std::vector<std::string> ignoredExtensions; // listed or present on an object, and not supported
    std::vector<GltfImage> images;
    std::vector<GltfTexture> textures;
    std::vector<std::string> variants; // names
    std::optional<int> variant;        // that is to be shown

    [[nodiscard]] Error error(std::string_view text) const { return gltfError(source, text); }
};

// Parses the bytes of a .gltf or .glb and loads its buffers. Throws Error for a file that is damaged, of
// another version, or that requires an extension which Lavalight does not support.
[[nodiscard]] GltfDocument parseGltf(std::string_view bytes, const GltfSource& source);

} // namespace lavalight
