// Loads the bytes that a glTF file's buffers refer to.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace lavalight {

// Where a file's own words come from and what it may reach.
struct GltfSource {
    std::string name;                            // for messages
    std::optional<std::filesystem::path> folder; // of the scene; none: embedded, nothing outside may be read
};

struct GltfBuffer {
    size_t byteLength = 0;
    std::string
        bytes; // byteLength of them, or none: a buffer may be declared without data, for extensions to use
};

// Each element of `json`'s "buffers". A buffer is the BIN chunk, a base64
// data URI, or a regular file inside the scene's folder: a file from somewhere else must not make this
// program read the user's other files, so absolute paths, schemes and ways out of the folder are refused.
// Throws Error.
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
