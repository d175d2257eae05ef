// Buffers of glTF: BIN chunk, data URIs, and files beside the scene.
#include "gltf/file/buffers.h"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "gltf/read/notes.h"

namespace lavalight {
namespace {

std::string loadBuffer(const nlohmann::json& buffer, std::string_view binary, const GltfSource& source) {
    const auto uri = buffer.find("uri");
    const bool isEmpty = buffer.at("byteLength").get<uint64_t>() == 0;
    if (uri != buffer.end() && !isEmpty)
        return loadUri(uri->get_ref<const std::string&>(), source);
    return std::string(binary);
}

// What to call a buffer in a message: its file, but never a data URI of megabytes.
std::string nameOf(const nlohmann::json& buffer) {
    const std::string uri = buffer.value("uri", std::string());
    return isDataUri(uri) ? std::string() : uri;
}

} // namespace

std::vector<GltfBuffer> loadBuffers(const nlohmann::json& json, std::string_view binary,
                                    const GltfSource& source) {
    std::vector<GltfBuffer> buffers;
    const auto array = json.find("buffers");
    if (array == json.end())
        return buffers;
    for (const nlohmann::json& buffer : *array) {
        const std::string name = describe("buffer", buffers.size(), nameOf(buffer));
        const uint64_t length = buffer.at("byteLength").get<uint64_t>();
        // Only the first buffer can be the BIN chunk.
        const std::string_view chunk = buffers.empty() ? binary : std::string_view();
        std::string bytes;
        try {
            bytes = loadBuffer(buffer, chunk, source);
        } catch (const Error& error) {
            throw gltfError(source.name, fmt::format("{}: {}", name, error.what()));
        }
        if (bytes.size() < length && !bytes.empty())
            throw gltfError(source.name, fmt::format("{} holds {} bytes, its byteLength is {}", name,
                                                     bytes.size(), length));
        bytes.resize(std::min<size_t>(bytes.size(), length));
        buffers.push_back({length, std::move(bytes)});
    }
    return buffers;
}

std::string_view bytesOf(const std::vector<GltfBuffer>& buffers, const BufferRange& range,
                         std::string_view object, const std::string& source) {
    const GltfBuffer& buffer = buffers.at(range.buffer);
    if (range.offset > buffer.byteLength || range.length > buffer.byteLength - range.offset)
        throw gltfError(source, fmt::format("{} covers {} bytes from {}, but buffer {} has {}", object,
                                            range.length, range.offset, range.buffer, buffer.byteLength));
    if (buffer.bytes.empty())
        throw gltfError(
            source, fmt::format("buffer {} is needed but has neither a uri nor a BIN chunk", range.buffer));
    return std::string_view(buffer.bytes).substr(range.offset, range.length);
}

} // namespace lavalight
