// Buffers of glTF: BIN chunk, data URIs, and files beside the scene.
#include "scene/gltf_buffers.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#include "base/file.h"
#include "scene/gltf_notes.h"

namespace lavalight {
namespace {

constexpr std::string_view kBase64 = ";base64";

std::string percentDecoded(std::string_view uri) {
    const auto isHex = [&](size_t i) {
        return i < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[i]));
    };
    std::string text;
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && isHex(i + 1) && isHex(i + 2)) {
            text += static_cast<char>(std::stoi(std::string(uri.substr(i + 1, 2)), nullptr, 16));
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

std::string decodeDataUri(std::string_view uri) {
    const size_t comma = uri.find(',');
    if (comma == std::string_view::npos)
        throw Error("its data URI has no data");
    if (!uri.substr(0, comma).ends_with(kBase64))
        return percentDecoded(uri.substr(comma + 1));
    // tinygltf decodes only the media types that it knows; for bytes the type makes no difference.
    const std::string known =
        std::string("data:application/octet-stream;base64,").append(uri.substr(comma + 1));
    std::vector<unsigned char> bytes;
    std::string mediaType;
    if (!tinygltf::DecodeDataURI(&bytes, mediaType, known, 0, false))
        throw Error("its data URI cannot be decoded");
    return {bytes.begin(), bytes.end()};
}

bool hasScheme(std::string_view uri) {
    const size_t colon = uri.find(':');
    return colon != std::string_view::npos && colon > 0 && std::isalpha(static_cast<unsigned char>(uri[0])) &&
           std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon),
                       [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '-' || c == '.'; });
}

// The file that a relative URI means. Links are followed before the folder is compared.
std::filesystem::path fileInFolder(std::string_view uri, const GltfSource& source) {
    if (!source.folder)
        throw Error("an embedded scene cannot refer to files");
    if (hasScheme(uri))
        throw Error("only files beside the scene are read, no other addresses");
    const std::string name = percentDecoded(uri);
    if (name.empty() || name.find('\0') != std::string::npos)
        throw Error("that is not a file name");
    const std::filesystem::path relative(name);
    if (relative.is_absolute())
        throw Error("absolute paths are not read, only files beside the scene");
    std::error_code code;
    const auto folder = std::filesystem::canonical(source.folder->empty() ? "." : *source.folder, code);
    const auto file = std::filesystem::weakly_canonical(folder / relative, code);
    const auto outside = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    if (code || outside.first != folder.end())
        throw Error("it lies outside the scene's folder, which is not read");
    return file;
}

std::string loadUri(std::string_view uri, const GltfSource& source) {
    return uri.starts_with("data:") ? decodeDataUri(uri) : readFile(fileInFolder(uri, source));
}

std::string loadBuffer(const nlohmann::json& buffer, std::string_view binary, const GltfSource& source) {
    const auto uri = buffer.find("uri");
    if (uri != buffer.end())
        return loadUri(uri->get_ref<const std::string&>(), source);
    return std::string(binary);
}

// What to call a buffer in a message: its file, but never a data URI of megabytes.
std::string nameOf(const nlohmann::json& buffer) {
    const std::string uri = buffer.value("uri", std::string());
    return uri.starts_with("data:") ? std::string() : uri;
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
