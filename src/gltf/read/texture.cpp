// Textures, samplers, KHR_texture_transform, EXT_texture_webp.
#include "gltf/read/texture.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace lavalight {
namespace {

using Json = nlohmann::json;

// Sampler constants of glTF, which are those of OpenGL.
constexpr int kNearest = 9728;
constexpr int kClampToEdge = 33071;
constexpr int kMirroredRepeat = 33648;
constexpr int kRepeat = 10497;

Wrap wrapOf(int mode) {
    return mode == kClampToEdge ? Wrap::clamp : mode == kMirroredRepeat ? Wrap::mirror : Wrap::repeat;
}

// One that points past the images is as good as none.
std::optional<size_t> existing(const Json& source, size_t imageCount) {
    const auto image = source.get<size_t>();
    return image < imageCount ? std::optional(image) : std::nullopt;
}

std::optional<size_t> imageOf(const Json& texture, size_t imageCount) {
    const Json none = Json::object();
    const Json& extensions = texture.contains("extensions") ? texture.at("extensions") : none;
    if (extensions.contains("EXT_texture_webp") && extensions.at("EXT_texture_webp").contains("source"))
        return existing(extensions.at("EXT_texture_webp").at("source"), imageCount);
    if (texture.contains("source"))
        return existing(texture.at("source"), imageCount);
    return std::nullopt;
}

double numberAt(const tinygltf::Value& object, const char* member, int index, double otherwise) {
    return object.Has(member) ? object.Get(member).Get(index).GetNumberAsDouble() : otherwise;
}

// KHR_texture_transform: scaled, then turned, then moved. The sense of the rotation is that of the
// extension's sample renderer and of its test model.
void applyTransform(const tinygltf::Value& transform, Texture& texture) {
    const double angle = transform.Has("rotation") ? transform.Get("rotation").GetNumberAsDouble() : 0.0;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double scaleU = numberAt(transform, "scale", 0, 1.0);
    const double scaleV = numberAt(transform, "scale", 1, 1.0);
    texture.uRow = glm::vec3(c * scaleU, s * scaleV, numberAt(transform, "offset", 0, 0.0));
    texture.vRow = glm::vec3(-s * scaleU, c * scaleV, numberAt(transform, "offset", 1, 0.0));
    if (transform.Has("texCoord"))
        texture.uvSet = static_cast<uint32_t>(transform.Get("texCoord").GetNumberAsInt());
}

} // namespace

std::vector<GltfTexture> readTextures(const Json& json) {
    std::vector<GltfTexture> textures;
    if (!json.contains("textures"))
        return textures;
    const size_t imageCount = json.contains("images") ? json.at("images").size() : 0;
    for (const Json& source : json.at("textures")) {
        GltfTexture& texture = textures.emplace_back();
        texture.image = imageOf(source, imageCount);
        if (!source.contains("sampler"))
            continue;
        const Json& sampler = json.at("samplers").at(source.at("sampler").get<size_t>());
        texture.wrapU = wrapOf(sampler.value("wrapS", kRepeat));
        texture.wrapV = wrapOf(sampler.value("wrapT", kRepeat));
        texture.isNearest = sampler.value("magFilter", 0) == kNearest;
    }
    return textures;
}

GltfTextureValue::GltfTextureValue(const tinygltf::Value& extension, const char* member) {
    if (!extension.Has(member))
        return;
    const tinygltf::Value& value = extension.Get(member);
    info.texture = value.Get("index").GetNumberAsInt();
    info.uvSet = value.Has("texCoord") ? value.Get("texCoord").GetNumberAsInt() : 0;
    if (value.Has("extensions"))
        for (const std::string& name : value.Get("extensions").Keys())
            extensions_.emplace(name, value.Get("extensions").Get(name));
    info.extensions = &extensions_;
}

std::optional<Texture> makeTexture(const std::vector<GltfTexture>& textures, const GltfTextureInfo& info,
                                   bool isSrgb) {
    if (info.texture < 0)
        return std::nullopt;
    const GltfTexture& source = textures.at(static_cast<size_t>(info.texture));
    if (!source.image)
        return std::nullopt;
    Texture texture;
    texture.picture = static_cast<uint32_t>(*source.image);
    texture.uvSet = static_cast<uint32_t>(info.uvSet);
    texture.wrapU = source.wrapU;
    texture.wrapV = source.wrapV;
    texture.isNearest = source.isNearest;
    texture.isSrgb = isSrgb;
    if (const auto transform = info.extensions->find("KHR_texture_transform");
        transform != info.extensions->end())
        applyTransform(transform->second, texture);
    return texture;
}

} // namespace lavalight
