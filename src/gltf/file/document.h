// A glTF file, parsed and checked, with its bytes at hand.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "gltf/file/buffers.h"
#include "gltf/file/image.h"
#include "gltf/file/json_view.h"
#include "gltf/read/notes.h"
#include "gltf/read/texture.h"

namespace lavalight {

struct GltfDocument {
    std::string source; // for messages
    // Every type and every index that is read from it has been checked, and compressed data is as if it had
    // been stored plainly. What has members of its own below is read from there.
    nlohmann::json json;
    std::vector<GltfBuffer> buffers;
    std::vector<std::string> extensionsUsed;    // as the file lists them
    std::vector<std::string> ignoredExtensions; // listed or present on an object, and not supported
    std::vector<GltfImage> images;
    std::vector<GltfTexture> textures;
    std::vector<std::string> scenes;   // names
    size_t scene = 0;                  // index of the scene that is to be shown
    std::vector<std::string> variants; // names
    std::optional<size_t> variant;     // index of the variant that is to be shown

    // The array of this name at the root: "nodes", "meshes", ...
    [[nodiscard]] JsonView list(std::string_view name) const { return JsonView(json)[name]; }
    [[nodiscard]] JsonView punctualLights() const {
        return JsonView(json)["extensions"]["KHR_lights_punctual"]["lights"];
    }
    [[nodiscard]] Error error(std::string_view text) const { return gltfError(source, text); }
};

// Parses the bytes of a .gltf or .glb and loads its buffers. Throws Error for a file that is damaged, of
// another version, or that requires an extension which Lavalight does not support.
[[nodiscard]] GltfDocument parseGltf(std::string_view bytes, const GltfSource& source);

} // namespace lavalight
