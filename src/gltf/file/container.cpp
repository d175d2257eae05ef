// The two containers of glTF 2.0: plain JSON, and GLB (specification, section 4.4).
//
//   GLB:   "glTF" version length | chunk length, type, bytes | chunk ...
//          4 bytes each, little-endian; the first chunk is JSON, the second may be BIN, others are skipped
#include "gltf/file/container.h"

#include <cstdint>

#include <fmt/format.h>

#include "gltf/read/notes.h"

namespace lavalight {
namespace {

constexpr std::string_view kMagic = "glTF";
constexpr uint32_t kJsonChunk = 0x4E4F534A;
constexpr uint32_t kBinaryChunk = 0x004E4942;
constexpr size_t kHeaderSize = 12;
constexpr size_t kChunkHeaderSize = 8;

uint32_t littleEndian32(std::string_view bytes, size_t at) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i)
        value |= uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
    return value;
}

struct Chunk {
    uint32_t type = 0;
    std::string_view bytes;
};

// Takes the first chunk off `rest`.
Chunk takeChunk(std::string_view& rest, const std::string& source) {
    if (rest.size() < kChunkHeaderSize)
        throw gltfError(source, "the .glb is truncated inside a chunk header");
    const size_t length = littleEndian32(rest, 0);
    const uint32_t type = littleEndian32(rest, 4);
    rest.remove_prefix(kChunkHeaderSize);
    if (length > rest.size())
        throw gltfError(source, fmt::format("the .glb is truncated: a chunk announces {} bytes, {} are left",
                                            length, rest.size()));
    const Chunk chunk{type, rest.substr(0, length)};
    rest.remove_prefix(length);
    return chunk;
}

GltfContainer splitGlb(std::string_view bytes, const std::string& source) {
    if (bytes.size() < kHeaderSize)
        throw gltfError(source, fmt::format("the .glb is truncated after {} bytes", bytes.size()));
    const uint32_t version = littleEndian32(bytes, 4);
    const size_t length = littleEndian32(bytes, 8);
    if (version != 2)
        throw gltfError(source, fmt::format("GLB version {} is not supported, only 2", version));
    if (length > bytes.size())
        throw gltfError(source, fmt::format("the .glb is truncated: its header announces {} bytes, it has {}",
                                            length, bytes.size()));
    if (length < kHeaderSize)
        throw gltfError(source, fmt::format("the .glb header announces {} bytes, fewer than itself", length));
    std::string_view rest = bytes.substr(kHeaderSize, length - kHeaderSize);
    const Chunk json = takeChunk(rest, source);
    if (json.type != kJsonChunk)
        throw gltfError(source, "the first chunk of the .glb is not JSON");
    GltfContainer container{json.bytes, {}};
    for (bool second = true; !rest.empty(); second = false) {
        const Chunk chunk = takeChunk(rest, source);
        if (second && chunk.type == kBinaryChunk)
            container.binary = chunk.bytes;
    }
    return container;
}

} // namespace

GltfContainer splitContainer(std::string_view bytes, const std::string& source) {
    if (bytes.empty())
        throw gltfError(source, "the file is empty");
    if (bytes.starts_with(kMagic))
        return splitGlb(bytes, source);
    std::string_view text = bytes;
    if (text.starts_with("\xEF\xBB\xBF")) // a byte order mark, which some editors write
        text.remove_prefix(3);
    const size_t start = text.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos || text[start] != '{')
        throw gltfError(source, "it is neither a .glb nor the JSON of a .gltf");
    return {text, {}};
}

} // namespace lavalight
