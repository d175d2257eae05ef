// A glTF file, parsed and checked, with its bytes at hand.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <tiny_gltf.h>

#include "scene/gltf_buffers.h"
#include "scene/gltf_notes.h"

namespace lavalight {

struct GltfDocument {
    std::string source; // for messages
    // Every index in it has been checked against the array that it points into. Buffers are in `buffers`;
    // images and textures are left out.
    tinygltf::Model model;
    std::vector<GltfBuffer> buffers;
    std::vector<std::string> extensionsUsed;    // as the file lists them
    std::vector<std::string> ignoredExtensions; // listed or present on an object, and not supported
    size_t textureCount = 0;

    [[nodiscard]] Error error(std::string_view text) const { return gltfError(source, text); }
};

// Parses the bytes of a .gltf or .glb and loads its buffers. Throws Error for a file that is damaged, of
// another version, or that requires an extension which Lavalight does not support.
[[nodiscard]] GltfDocument parseGltf(std::string_view bytes, const GltfSource& source);

} // namespace lavalight
