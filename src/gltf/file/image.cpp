// Images of glTF: buffer views, data URIs, and files beside the scene.
#include "gltf/file/image.h"

#include <nlohmann/json.hpp>

#include "base/os/memory.h"
#include "gltf/read/image_light.h"
#include "gltf/read/notes.h"
#include "gltf/read/texture.h"

namespace lavalight {
namespace {

using Json = nlohmann::json;

std::string bytesOfView(const Json& json, size_t view, const std::vector<GltfBuffer>& buffers,
                        const std::string& source) {
    const Json& range = json.at("bufferViews").at(view);
    const std::string_view bytes =
        bytesOf(buffers,
                {range.at("buffer").get<size_t>(), range.value("byteOffset", size_t{0}),
                 range.at("byteLength").get<size_t>()},
                describe("bufferView", view, ""), source);
    if (const std::string shortage = memoryShortage(bytes.size()); !shortage.empty())
        throw Error("its bytes " + shortage);
    return std::string(bytes);
}

GltfImage loadImage(const Json& json, size_t index, const std::vector<GltfBuffer>& buffers,
                    const GltfSource& source) {
    const Json& image = json.at("images").at(index);
    const std::string uri = image.value("uri", std::string());
    GltfImage loaded;
    loaded.name = describe("image", index, uri.empty() || isDataUri(uri) ? image.value("name", "") : uri);
    try {
        if (image.contains("bufferView"))
            loaded.bytes = bytesOfView(json, image.at("bufferView").get<size_t>(), buffers, source.name);
        else if (!uri.empty())
            loaded.bytes = loadUri(uri, source);
        else
            loaded.problem = "it has neither a uri nor a bufferView";
    } catch (const Error& error) {
        loaded.problem = error.what();
    }
    return loaded;
}

} // namespace

std::vector<GltfImage> loadImages(const Json& json, const std::vector<GltfBuffer>& buffers,
                                  const GltfSource& source) {
    std::vector<GltfImage> images(json.contains("images") ? json.at("images").size() : 0);
    const auto load = [&](size_t index) {
        if (index < images.size() && images[index].name.empty())
            images[index] = loadImage(json, index, buffers, source);
    };
    for (const GltfTexture& texture : readTextures(json))
        if (texture.image)
            load(*texture.image);
    for (const size_t face : facesOfLights(json))
        load(face);
    return images;
}

} // namespace lavalight
