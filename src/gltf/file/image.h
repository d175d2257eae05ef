// The bytes of the pictures that a glTF file's textures refer to.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "gltf/file/buffers.h"

namespace lavalight {

// An image that cannot be had does not fail the scene: it has a problem instead of bytes.
struct GltfImage {
    std::string name;  // for messages
    std::string bytes; // as in the file; none for images that no texture and no light uses
    std::string problem;
};

// Each element of `json`'s "images", by the rules of gltf/file/uri.h for what may be read.
[[nodiscard]] std::vector<GltfImage>
loadImages(const nlohmann::json& json, const std::vector<GltfBuffer>& buffers, const GltfSource& source);

} // namespace lavalight
