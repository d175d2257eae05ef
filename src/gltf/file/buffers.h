// Loads the bytes that a glTF file's buffers refer to.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "gltf/file/uri.h"

namespace lavalight {

struct GltfBuffer {
    size_t byteLength = 0;
    std::string
        bytes; // byteLength bytes, or none: a buffer may be declared without data, for extensions to use
};

// Each element of `json`'s "buffers": the BIN chunk, or what its uri means (gltf/file/uri.h). Throws Error.
[[nodiscard]] std::vector<GltfBuffer> loadBuffers(const nlohmann::json& json, std::string_view binary,
                                                  const GltfSource& source);

struct BufferRange {
    size_t buffer = 0; // below the number of buffers
    size_t offset = 0; // bytes
    size_t length = 0; // bytes
};

// The bytes of a range; `object` is what asks for them. Throws Error where the buffer has no data or is too
// short.
[[nodiscard]] std::string_view bytesOf(const std::vector<GltfBuffer>& buffers, const BufferRange& range,
                                       std::string_view object, const std::string& source);

} // namespace lavalight
