// Buffers become one buffer, the BIN chunk (glTF 2.0, section 4.4); pictures become views of it.
#include "gltf/pack.h"

#include <cstdint>
#include <limits>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "gltf/check/schema.h"
#include "gltf/file/buffers.h"
#include "gltf/file/container.h"
#include "gltf/file/uri.h"
#include "gltf/read/notes.h"
#include "image/picture.h"

namespace lavalight {
namespace {

using Json = nlohmann::json;

// More than any accessor asks for, so that none loses its alignment.
constexpr size_t kAlignment = 16;
constexpr uint64_t kMostBytes = std::numeric_limits<uint32_t>::max();

// The BIN chunk in the making.
class BinaryChunk {
  public:
    // Appends bytes and returns where they begin.
    size_t append(std::string_view bytes) {
        bytes_.resize((bytes_.size() + kAlignment - 1) / kAlignment * kAlignment, '\0');
        const size_t offset = bytes_.size();
        bytes_ += bytes;
        return offset;
    }
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

// Where the bytes of a buffer of the file are now.
struct NewPlace {
    size_t buffer = 0;
    size_t offset = 0;
};

void move(Json& range, const std::vector<NewPlace>& places) {
    const NewPlace& place = places.at(range.at("buffer").get<size_t>());
    range["buffer"] = place.buffer;
    const size_t offset = range.value("byteOffset", size_t{0}) + place.offset;
    if (offset > 0)
        range["byteOffset"] = offset;
}

// Compressed views name a second range in their extension.
void moveViews(Json& views, const std::vector<NewPlace>& places) {
    for (Json& view : views) {
        move(view, places);
        if (!view.contains("extensions"))
            continue;
        for (Json& extension : view["extensions"])
            if (extension.is_object() && extension.contains("buffer"))
                move(extension, places);
    }
}

// Puts the bytes of all buffers into the chunk. Buffers that are declared without bytes, for extensions to
// fill, stay behind buffer 0, which is the chunk.
void packBuffers(Json& json, std::vector<GltfBuffer> loaded, BinaryChunk& chunk) {
    std::vector<NewPlace> places;
    Json buffers = Json::array({Json::object()});
    for (size_t i = 0; i < loaded.size(); ++i) {
        if (!loaded[i].bytes.empty()) {
            places.push_back({0, chunk.append(loaded[i].bytes)});
            loaded[i].bytes = {};
            continue;
        }
        places.push_back({buffers.size(), 0});
        buffers.push_back(json["buffers"][i]);
        buffers.back().erase("uri"); // of a buffer of length 0
    }
    if (json.contains("bufferViews"))
        moveViews(json["bufferViews"], places);
    json["buffers"] = std::move(buffers);
}

void packImages(Json& json, BinaryChunk& chunk, const GltfSource& source, PackedScene& packed) {
    if (!json.contains("images"))
        return;
    for (size_t i = 0; i < json["images"].size(); ++i) {
        Json& image = json["images"][i];
        if (image.contains("bufferView") || !image.contains("uri"))
            continue;
        const std::string uri = image["uri"].get<std::string>();
        try {
            const std::string bytes = loadUri(uri, source);
            const size_t offset = chunk.append(bytes);
            Json& views = json["bufferViews"]; // made where there were none
            image.erase("uri");
            image["bufferView"] = views.size();
            if (const std::string type = mediaTypeOf(bytes); !type.empty())
                image["mimeType"] = type;
            views.push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
        } catch (const Error& error) {
            image.erase("uri"); // a file of that name beside the new scene would be taken for it
            packed.warnings.push_back(fmt::format("{} is not packed: {}",
                                                  describe("image", i, isDataUri(uri) ? std::string() : uri),
                                                  error.what()));
        }
    }
}

void appendWord(std::string& bytes, uint64_t word) {
    for (unsigned i = 0; i < 4; ++i)
        bytes += static_cast<char>(word >> (8 * i) & 0xffu);
}

void appendChunk(std::string& glb, std::string_view type, const std::string& bytes, char padding) {
    const size_t length = (bytes.size() + 3) / 4 * 4;
    appendWord(glb, length);
    glb += type;
    glb += bytes;
    glb.append(length - bytes.size(), padding);
}

std::string containerOf(const std::string& text, const std::string& binary, const std::string& source) {
    constexpr size_t kHeaders = 12 + 2 * 8;
    const uint64_t length = kHeaders + (text.size() + 3) / 4 * 4 + (binary.size() + 3) / 4 * 4;
    if (length > kMostBytes)
        throw Error(fmt::format(
            "cannot pack {}: it has {} bytes with all that it refers to, and a .glb holds at most {}; "
            "try smaller pictures, or compressed geometry",
            source, length, kMostBytes));
    std::string glb = "glTF";
    appendWord(glb, 2);
    appendWord(glb, length);
    appendChunk(glb, "JSON", text, ' ');
    appendChunk(glb, std::string_view("BIN\0", 4), binary, '\0');
    return glb;
}

bool refersToAnything(const Json& json) {
    for (const char* list : {"buffers", "images"})
        if (json.contains(list))
            for (const Json& element : json[list])
                if (element.contains("uri"))
                    return true;
    return false;
}

} // namespace

PackedScene packGltf(const std::filesystem::path& path, bool allowsExternal) {
    const GltfSource source{path.string(), path.parent_path(), allowsExternal};
    const std::string bytes = readFile(path);
    const GltfContainer container = splitContainer(bytes, source.name);
    Json json = parseCheckedJson(container.json, source.name);
    PackedScene packed;
    if (bytes.starts_with("glTF") && !refersToAnything(json)) {
        packed.glb = bytes;
        return packed;
    }
    BinaryChunk chunk;
    packBuffers(json, loadBuffers(json, container.binary, source), chunk);
    packImages(json, chunk, source, packed);
    if (chunk.bytes().empty()) // a file of nodes alone; a chunk needs a byte
        (void)chunk.append(std::string_view("\0", 1));
    json["buffers"][0]["byteLength"] = chunk.bytes().size();
    packed.glb = containerOf(json.dump(), chunk.bytes(), source.name);
    return packed;
}

} // namespace lavalight
