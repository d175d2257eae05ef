// Tells .glb from .gltf by content and takes a .glb apart.
#pragma once

#include <string>
#include <string_view>

namespace lavalight {

struct GltfContainer {
    std::string_view json;
    std::string_view binary; // the BIN chunk of a .glb; empty: none
};

// Views into `bytes`. Throws Error naming `source` for anything that is neither form, and for a damaged .glb.
[[nodiscard]] GltfContainer splitContainer(std::string_view bytes, const std::string& source);

} // namespace lavalight
