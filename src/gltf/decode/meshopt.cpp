// EXT_meshopt_compression and KHR_meshopt_compression by way of meshoptimizer's decoders, which are safe for
// any stream as long as the element sizes are among those that they assert.
#include "gltf/decode/meshopt.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include <fmt/format.h>
#include <meshoptimizer.h>
#include <nlohmann/json.hpp>

#include "base/os/memory.h"
#include "gltf/read/notes.h"

namespace lavalight {
namespace {

using Json = nlohmann::json;

// Bytes that a byte of a stream decodes to at most. In version 0, 16 equal bytes take 2 bits, and a triangle
// (12 bytes at most) takes one byte. In version 1, 256 equal bytes take 2 bits.
constexpr uint64_t kMostExpansion = 64;
constexpr uint64_t kMostExpansionOfVersion1 = 1024;

// Libraries before 1.0 decode neither version 1 of vertices nor the filter of colours.
#if MESHOPTIMIZER_VERSION >= 1000
constexpr unsigned char kVertexVersion = 1;
#else
constexpr unsigned char kVertexVersion = 0;
void meshopt_decodeFilterColor(void*, size_t, size_t) {}
#endif
constexpr bool kHasColorFilter = kVertexVersion >= 1;

struct Codec {
    std::string_view mode;
    unsigned char header;  // high half of the first byte of a stream
    unsigned char version; // the newest that the library decodes; the low half of that byte
};
constexpr std::array<Codec, 3> kCodecs = {
    {{"ATTRIBUTES", 0xA0, kVertexVersion}, {"TRIANGLES", 0xE0, 1}, {"INDICES", 0xD0, 1}}};

// One compressed view, its figures as the extension states them.
struct Stream {
    std::string mode;
    std::string filter;
    size_t count = 0;
    size_t stride = 0; // bytes of an element
    std::string_view bytes;

    [[nodiscard]] const unsigned char* data() const {
        return reinterpret_cast<const unsigned char*>(bytes.data());
    }
    [[nodiscard]] const Codec* codec() const {
        const auto* found = std::find_if(kCodecs.begin(), kCodecs.end(),
                                         [&](const Codec& other) { return other.mode == mode; });
        return found == kCodecs.end() ? nullptr : found;
    }
};

// What of the stream the library does not know; empty: nothing.
std::string unsupportedPart(const Stream& stream) {
    const Codec* codec = stream.codec();
    if (codec == nullptr)
        return fmt::format("the mode \"{}\"", stream.mode);
    const auto first = static_cast<unsigned char>(stream.bytes.empty() ? 0 : stream.bytes.front());
    if ((first & 0xF0) == codec->header && (first & 0x0F) > codec->version)
        return fmt::format("version {} of the codec for {}", first & 0x0F, codec->mode);
    for (const char* known : {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"}) {
        if (stream.filter == known)
            return {};
    }
    if (kHasColorFilter && stream.filter == "COLOR")
        return {};
    return fmt::format("the filter \"{}\"", stream.filter);
}

uint64_t mostExpansion(const Stream& stream) {
    const bool isVersion1 = !stream.bytes.empty() && static_cast<unsigned char>(stream.bytes.front()) == 0xA1;
    return isVersion1 ? kMostExpansionOfVersion1 : kMostExpansion;
}

// The figures that the extension allows, which the decoders take for granted.
bool isSound(const Stream& stream, uint64_t viewLength) {
    const bool isIndex = stream.mode != "ATTRIBUTES";
    if (isIndex && ((stream.stride != 2 && stream.stride != 4) || stream.filter != "NONE"))
        return false;
    if (!isIndex && (stream.stride == 0 || stream.stride % 4 != 0 || stream.stride > 256))
        return false;
    if (stream.mode == "TRIANGLES" && stream.count % 3 != 0)
        return false;
    if ((stream.filter == "OCTAHEDRAL" || stream.filter == "COLOR") && stream.stride != 4 &&
        stream.stride != 8)
        return false;
    if (stream.filter == "QUATERNION" && stream.stride != 8)
        return false;
    return stream.count <= viewLength / stream.stride && stream.count * stream.stride == viewLength &&
           viewLength / mostExpansion(stream) <= stream.bytes.size();
}

bool decode(const Stream& stream, std::string& bytes) {
    void* target = bytes.data();
    const auto run = [&](int (*decoder)(void*, size_t, size_t, const unsigned char*, size_t)) {
        return decoder(target, stream.count, stream.stride, stream.data(), stream.bytes.size()) == 0;
    };
    if (stream.mode == "TRIANGLES")
        return run(&meshopt_decodeIndexBuffer);
    if (stream.mode == "INDICES")
        return run(&meshopt_decodeIndexSequence);
    if (!run(&meshopt_decodeVertexBuffer))
        return false;
    if (stream.filter == "OCTAHEDRAL")
        meshopt_decodeFilterOct(target, stream.count, stream.stride);
    else if (stream.filter == "QUATERNION")
        meshopt_decodeFilterQuat(target, stream.count, stream.stride);
    else if (stream.filter == "EXPONENTIAL")
        meshopt_decodeFilterExp(target, stream.count, stream.stride);
    else if (stream.filter == "COLOR")
        meshopt_decodeFilterColor(target, stream.count, stream.stride);
    return true;
}

// The extension's object on a view, and its name; null where there is none.
std::pair<const Json*, std::string> findExtension(const Json& view) {
    for (const char* name : {"KHR_meshopt_compression", "EXT_meshopt_compression"}) {
        if (view.contains("extensions") && view["extensions"].contains(name))
            return {&view["extensions"][name], name};
    }
    return {nullptr, ""};
}

void decodeView(Json& view, const std::string& name, std::vector<GltfBuffer>& buffers,
                const std::string& source) {
    const auto [extension, extensionName] = findExtension(view);
    if (extension == nullptr)
        return;
    const BufferRange range{extension->at("buffer").get<size_t>(), extension->value("byteOffset", size_t{0}),
                            extension->at("byteLength").get<size_t>()};
    const std::string where = fmt::format("{} ({})", name, extensionName);
    const Stream stream{extension->at("mode").get<std::string>(), extension->value("filter", "NONE"),
                        extension->at("count").get<size_t>(), extension->at("byteStride").get<size_t>(),
                        bytesOf(buffers, range, where, source)};
    if (const std::string part = unsupportedPart(stream); !part.empty()) {
        if (!buffers.at(view["buffer"].get<size_t>()).bytes.empty())
            return; // the file's uncompressed data stands in
        throw gltfError(source, fmt::format("{} uses {}, which is not supported", where, part));
    }
    const auto length = view["byteLength"].get<uint64_t>();
    if (!isSound(stream, length))
        throw gltfError(source,
                        fmt::format("{} states {} elements of {} bytes in mode {} with filter {}, which "
                                    "does not fit its {} compressed and {} decoded bytes",
                                    where, stream.count, stream.stride, stream.mode, stream.filter,
                                    stream.bytes.size(), length));
    if (const std::string shortage = memoryShortage(length); !shortage.empty())
        throw gltfError(source, fmt::format("the {} decoded bytes of {} {}", length, where, shortage));
    std::string bytes(length, '\0');
    if (!decode(stream, bytes))
        throw gltfError(source, where + " is damaged: it cannot be decoded");
    view["buffer"] = buffers.size();
    view["byteOffset"] = 0;
    buffers.push_back({length, std::move(bytes)});
}

} // namespace

void decodeMeshopt(Json& json, std::vector<GltfBuffer>& buffers, const std::string& source) {
    if (!json.contains("bufferViews"))
        return;
    Json& views = json["bufferViews"];
    for (size_t i = 0; i < views.size(); ++i)
        decodeView(views[i], describe("buffer view", i, ""), buffers, source);
}

} // namespace lavalight
